"""The side of a cylinder within a hollow sphere touches that with its two rims."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

G = 9.81
R, RADIUS, LENGTH = 0.5, 0.1, 0.3
REACH = math.sqrt(R**2 - LENGTH**2 / 4) - RADIUS  # of G from the centre of the bowl
TEXT = """
model Bowl
  parameter Mass m = 1 kg;
  parameter Angle tilt = 0;
  parameter Angle angle = 0.6;
  parameter Length far = 0.1 m;
  parameter Real wx = 0;
  parameter Real wy = 0;
  parameter Real wz = 0;
  parameter Angle turn = 90 deg;
  parameter Angle yaw = 0;
  world(gravity = 9.81 m/s^2, down = (-sin(tilt), 0, -cos(tilt)));
  frame f on ground at (1, 2, 3) m rotated(axis = y, angle = tilt);
  frame k on f at (far*sin(angle), 0 m, -far*cos(angle)) rotated(axis = z, angle = yaw);
  frame g on k at (0, 0, 0) m rotated(axis = x, angle = turn);
  body b: cylinder(mass = m, radius = 0.1 m, length = 0.3 m);
  {bowl}
  liaison c: contact_ponctuel({places}) {law};
initial
  b.position = g.position;
  b.orientation = g.orientation;
  b.angular_velocity = (wx, wy, wz)*(1 1/s);
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Bowl;
"""
OF_TEXT = "surface s on f: sphere(0.5 m);"
OF_SHELL = "body o: shell(mass = 3 kg, radius = 0.5 m); liaison w: encastrement(f, o);"


def model(law: str = "", bowl: str = OF_TEXT, places: str = "s, b.side") -> frot.Model:
    return frot.compile(TEXT.format(law=law, bowl=bowl, places=places))


def pendulum(angle: float, pace: float, times: np.ndarray) -> np.ndarray:
    """Angles of a'' = -pace g/h sin a from rest."""

    def slope(_: float, x: np.ndarray) -> list[float]:
        return [x[1], -pace * G / REACH * math.sin(x[0])]

    found = solve_ivp(slope, (0, times[-1]), [angle, 0], "DOP853", times, rtol=1e-12, atol=1e-13)
    return found.y[0]


def local(result: frot.Result, times: np.ndarray, tilt: float) -> np.ndarray:
    rows = result.at(times)
    way = np.array([rows[f"b.position.{c}"] for c in "xyz"]).T - [1, 2, 3]
    c, s = math.cos(tilt), math.sin(tilt)
    return way @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@pytest.mark.parametrize(
    ("law", "pace"), [("", 1.0), ("with coulomb(2)", 2 / 3)], ids=["smooth", "rough"]
)
@pytest.mark.parametrize(
    ("bowl", "places"), [(OF_TEXT, "s, b.side"), (OF_SHELL, "b.side, o.surface")]
)
@pytest.mark.parametrize(
    ("angle", "mass", "tilt"), [(0.6, 1, 0), (-0.6, 1e6, 1.1), (0.9, 1e-6, -2.5)]
)
def test_a_cylinder_swings_in_a_bowl(
    law: str, pace: float, bowl: str, places: str, angle: float, mass: float, tilt: float
) -> None:
    """Its rims touch circles of radius (R^2 - l^2/4)^(1/2): G swings at that less r.

    Smooth it does not turn. Rough it rolls: h a'' = -2/3 g sin a.
    """
    given = {"far": f"{REACH!r} m", "angle": angle, "m": f"{mass} kg", "tilt": tilt}
    result = model(law, bowl, places).simulate(parameters=given)
    times = np.linspace(0, 0.8, 33)
    expected, way = pendulum(angle, pace, times), local(result, times, tilt)
    assert way[:, 0] == pytest.approx(REACH * np.sin(expected), abs=1e-8)
    assert way[:, 2] == pytest.approx(-REACH * np.cos(expected), abs=1e-8)
    assert abs(way[:, 1]).max() < 1e-9


def test_a_cylinder_falls_to_the_bottom_of_a_bowl_and_rests() -> None:
    result = model("with coulomb(0.3)").simulate(parameters={"angle": 0})
    fall = math.sqrt(2 * (REACH - 0.1) / G)
    assert [e.time for e in result.events] == pytest.approx([fall] * 4, abs=1e-10)
    assert {e.liaison for e in result.events} == {"c[2]", "c[3]"}
    assert sum(e.energy_lost for e in result.events) == pytest.approx(G * (REACH - 0.1), rel=1e-9)
    # each rim presses towards the centre: twice N (h + r)/R is the weight
    assert result["c.normal_force"][-1] == pytest.approx(G * R / (REACH + RADIUS), rel=1e-9)


@pytest.mark.parametrize("law", ["with restitution(1)", "with coulomb(0.2)"])
def test_thrown_cylinders_stay_in_the_bowl(law: str) -> None:
    """Points all around both rims stay within the radius; energy is kept, or falls."""
    rng, own = np.random.default_rng(8), model(law)
    around = np.linspace(0, 2 * math.pi, 721)
    circle = RADIUS * np.array([np.cos(around), np.sin(around), 0 * around])
    hits = 0
    for _ in range(6):
        wx, wy, wz = (float(x) for x in rng.uniform(-4, 4, 3))
        given = {"angle": rng.uniform(-1, 1), "wx": wx, "wy": wy, "wz": wz,
                 "turn": rng.uniform(0, math.pi), "yaw": rng.uniform(-2, 2)}  # fmt: skip
        result = own.simulate(parameters=given, stop=0.5)
        hits += len(result.events) > 0
        times = np.linspace(0, 0.5, 41)
        rows = result.at(times)
        way = local(result, times, 0)
        for k in range(len(times)):
            w, x, y, z = (float(rows[f"b.orientation.{c}"][k]) for c in "wxyz")
            skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            turn = np.eye(3) + 2 * w * skew + 2 * skew @ skew
            for end in (-1, 1):
                rim = way[k][:, None] + turn @ (circle + np.array([[0], [0], [end * LENGTH / 2]]))
                assert np.linalg.norm(rim, axis=0).max() < R + 1e-8
        energy = rows["b.kinetic_energy"] + G * way[:, 2]
        assert np.diff(energy).max() < 1e-8
        if "restitution" in law:
            assert np.ptp(energy) < 1e-8
    assert hits == 6


@pytest.mark.parametrize(("x", "end"), [(0.0, 0.6), (0.05, None)])
def test_a_cylinder_outside_lies_on_the_ball(x: float, end: float | None) -> None:
    """It meets the top of the sphere with its side, as without ends."""
    text = TEXT.replace("frame k on f at (far*sin(angle), 0 m, -far*cos(angle))",
                        f"frame k on f at ({x} m, 0 m, 0.8 m)")  # fmt: skip
    result = frot.compile(text.format(law="", bowl=OF_TEXT, places="s, b.side")).simulate()
    fall = math.sqrt(2 * (0.8 - math.sqrt(0.36 - x**2)) / G)
    assert [(e.time, e.liaison) for e in result.events] == [(pytest.approx(fall), "c[1]")] * 2
    if end is not None:
        assert result["b.position.z"][-1] == pytest.approx(3 + end, abs=1e-9)
