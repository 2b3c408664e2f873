"""Cylinders that roll on each other stay parallel: a roller outside and inside, planetary gears."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot
from tests.liaisons.table import turned, unit

ROLLER = """
model Roller "On a cylinder of the base, or in it, from rest or not"
  parameter Length R = 0.5 m, r = 0.2 m;
  parameter Angle begin = 0.2, tilt = 0;
  parameter Velocity v = 0 m/s;
  world(gravity = 0 m/s^2);
  frame base on ground rotated(axis = (0.3, -1, 0.5), angle = tilt);
  surface s on base: cylinder(radius = R, axis = x);
  body c: cylinder(mass = 1 kg, radius = r, length = 2 m);
  liaison L: roulement({places});
  force weight: on(c, value = -9.81 N*base.ez);
  output Real n = L.normal_force/(1 N);
initial
  guess(c.position = (R {sign} r)*(sin(begin)*base.ey + cos(begin)*base.ez));
  guess(dot(c.ez, base.ex) = 1);
  guess(c.velocity = v*(cos(begin)*base.ey - sin(begin)*base.ez));
  experiment(stop = 0.4 s, tolerance = 1e-9);
end Roller;
"""


@pytest.mark.parametrize("places", ["s, c.side", "c.side, s"])
@pytest.mark.parametrize("sign", "+-")
def test_a_roller_goes_as_a_pendulum_does(places: str, sign: str) -> None:
    """th'' = g sin(th)/(3/2 L), L the distance of the axes; n = m (g cos(th) - L th'^2)."""
    model = frot.compile(ROLLER.format(places=places, sign=sign))
    for given in (
        {"begin": 0.2 if sign == "+" else 2.5, "v": 0.3},
        {"R": 0.7, "r": 0.3, "begin": -0.4 if sign == "+" else 3.5, "tilt": 1.3, "v": -0.4},
    ):
        result = model.simulate(parameters=given)
        way = given.get("R", 0.5) + (1 if sign == "+" else -1) * given.get("r", 0.2)
        back = turned(unit(0.3, -1, 0.5), given.get("tilt", 0.0)).T
        place = back @ [result[f"c.position.{e}"] for e in "xyz"]
        speed = back @ [result[f"c.velocity.{e}"] for e in "xyz"]
        angle = np.unwrap(np.arctan2(place[1], place[2]))
        begin = angle[0], (speed[1, 0] * np.cos(angle[0]) - speed[2, 0] * np.sin(angle[0])) / way

        def rate(_: float, y: np.ndarray, way: float = way) -> list[float]:
            return [y[1], 9.81 * np.sin(y[0]) / (1.5 * way)]

        want = solve_ivp(rate, (0, 0.4), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
        assert np.hypot(place[1], place[2]) == pytest.approx(way, abs=1e-12)
        assert angle[-1] == pytest.approx(want[0], abs=1e-10)
        assert abs(angle[-1] - angle[0]) > 0.02
        pressed = abs(9.81 * np.cos(want[0]) - way * want[1] ** 2)
        assert abs(result["n"][-1]) == pytest.approx(pressed, abs=1e-9)


PLANETS = """
model Planets "A sun drives a planet that rolls in a ring at rest"
  body sun: cylinder(mass = 2 kg, radius = 0.2 m, length = 0.2 m);
  body planet: cylinder(mass = 1 kg, radius = 0.1 m, length = 0.2 m);
  body arm: rod(mass = 1 kg, length = 0.3 m, inertia = (0.001, 0.0075, 0.0075) kg.m^2);
  surface ring on ground: cylinder(radius = 0.4 m, axis = z);
  liaison A: rotoide(ground, sun);
  liaison B: rotoide(ground, arm.start);
  liaison C: rotoide(arm.tip, planet);
  liaison D: roulement(sun.side, planet.side);
  liaison E: roulement(ring, planet.side);
  force drive: couple(A, value = 1 N.m);
  output Force push = D.force;
  experiment(stop = 1 s, tolerance = 1e-10);
end Planets;
"""


def test_planets_go_as_willis_says() -> None:
    """R. Willis 1841: the sun turns 1 + 0.4/0.2 times as fast as the arm; all are cylinders."""
    model = frot.compile(PLANETS)
    result = model.simulate()
    sun, arm = result.at(1.0)["A.speed"], result.at(1.0)["B.speed"]
    assert sun / arm == pytest.approx(3, rel=1e-10)
    # seen at the sun: its own inertia, the arm's about its pin, the planet going round and turning
    inertia = 2 * 0.2**2 / 2 + ((0.0075 + 0.15**2) + 0.3**2 + 0.1**2 / 2 * 3**2) / 3**2
    assert sun == pytest.approx(1 / inertia, rel=1e-9)
    assert model.report().mobility.degrees_of_freedom == 1
