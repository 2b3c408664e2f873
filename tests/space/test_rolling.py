"""What rolls on a plane: its angular velocity moves it, and rows elsewhere say the same."""

from __future__ import annotations

import numpy as np
import pytest
from frot.runtime.result import Result

import frot

# A plane that is tilted, one that turns under a ball, one with a ball below it; a lamina, an egg.
SCENE = """model Rolling
  parameter Length a = 0.3 m;
  parameter Angle tilt = 0.3 rad;
  surface incline on ground: plane(through = (0, 0, 5) m, normal = (sin(tilt), 0, cos(tilt)));
  surface ceiling on ground: plane(through = (0, 0, 9) m, normal = (0, 0, 1));
  body ball: sphere(mass = 2 kg, radius = a);
  body hung: sphere(mass = 2 kg, radius = a);
  body hoop: ring(mass = 1 kg, radius = 2*a);
  body lamina: ellipse(mass = 2 kg, a = a, b = 0.4 m);
  body egg: ellipsoid(mass = 2 kg, semi_axes = (0.3, 0.4, 0.2) m);
  body table: disc(mass = 100 kg, radius = 1 m);
  surface top on table: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  body rider: sphere(mass = 1 kg, radius = 0.1 m);
  body bob: particle(mass = 0.5 kg);
  liaison down: roulement(incline, ball.surface);
  liaison under: roulement(ceiling, hung.surface);
  liaison along: roulement(hoop.rim, ground.plane);
  liaison flat: roulement(ground.plane, lamina.rim);
  liaison upright: roulement(ground.plane, egg.surface);
  liaison shaft: rotoide(ground, table);
  liaison rides: roulement(top, rider.surface);
  liaison arm: spherique(ball, bob);
  {0}
  output Force load = along.normal_force;
  output Force drag = norm(down.tangential_force);
  output Force push[3] = rides.force;
initial
  guess(hung.position.z = 8.5 m);
  ball.angular_velocity = (0.1, 2, 0.5) rad/s;
  hung.angular_velocity = (1, -2, 3) rad/s;
  hoop.orientation = (0.8, 0.6, 0, 0);
  hoop.angular_velocity = (0.1, -5, 3) rad/s;
  lamina.orientation = (0.7, 0.5, 0.1, 0.5);
  lamina.angular_velocity = (1, -2, 2) rad/s;
  egg.angular_velocity = (1, -1, 0.5) rad/s;
  shaft.speed = 2 rad/s;
  rider.position = (0.5 m, 0.2 m, 0.1 m);
  rider.angular_velocity = (1, 2, 2) rad/s;
  experiment(stop = 0.8 s, tolerance = 1e-11);
end Rolling;
"""
# With something that time moves anywhere, rows keep what rolls.
ELSEWHERE = "frame mark on ground at (0 m, 0 m, 1 m/s*time);"
BODIES = ("ball", "hung", "hoop", "lamina", "egg", "rider", "bob")


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(SCENE.format(""))


@pytest.fixture(scope="module")
def motion(model: frot.Model) -> Result:
    return model.simulate()


@pytest.fixture(scope="module")
def by_rows() -> Result:
    return frot.compile(SCENE.format(ELSEWHERE)).simulate()


def vector(result: Result, name: str) -> np.ndarray:
    return np.array([result[f"{name}.{k}"] for k in "xyz"])


@pytest.mark.parametrize("body", BODIES)
def test_the_motion_is_that_with_rows(motion: Result, by_rows: Result, body: str) -> None:
    for name in ("position", "velocity"):
        own, other = vector(motion, f"{body}.{name}"), vector(by_rows, f"{body}.{name}")
        assert np.abs(own - other).max() < 1e-10 * max(1, np.abs(other).max())


def test_reactions_are_those_of_rows(motion: Result, by_rows: Result) -> None:
    for name in ("load", "drag", "push.x", "push.y", "push.z"):
        assert motion[name] == pytest.approx(by_rows[name], rel=1e-9, abs=1e-9)


def test_what_rolls_touches_and_does_not_slip(motion: Result) -> None:
    """To rounding, whatever the tolerance: the relations of velocities are in the coordinates."""
    assert np.abs(vector(motion, "hung.position")[2] - 8.7).max() < 1e-14 * 9
    turning = vector(motion, "hung.angular_velocity")
    along = vector(motion, "hung.velocity")
    # from where it touches, above, to G: (0, 0, -a)
    assert np.abs(along[0] + 0.3 * turning[1]).max() < 1e-13
    assert np.abs(along[1] - 0.3 * turning[0]).max() < 1e-13
    for name in ("along", "flat", "upright", "rides"):
        assert np.abs(motion[f"{name}.gap"]).max() < 1e-12


def test_a_ball_on_a_turning_table_goes_round(motion: Result) -> None:
    """v' = 2/7 W x v + 2/7 W' x r (E. Milne, Vectorial Mechanics, 1948); with the push m v'."""
    spin = motion["shaft.speed"]
    velocity = vector(motion, "rider.velocity")
    place = vector(motion, "rider.position")
    push = vector(motion, "push")
    turned = 2 / 7 * spin * np.array([-velocity[1], velocity[0]])
    # W' from the couple of the ball on the table: (r x -push).z = J W'
    rate = -(place[0] * push[1] - place[1] * push[0]) / 50
    turned += 2 / 7 * rate * np.array([-place[1], place[0]])
    assert np.abs(push[:2] - turned).max() < 1e-9
    assert push[2] == pytest.approx(9.81, rel=1e-12)


def test_energy_is_kept(motion: Result) -> None:
    energies = sum(motion[f"{b}.kinetic_energy"] for b in (*BODIES, "table"))
    masses = {"ball": 2, "hung": 2, "hoop": 1, "lamina": 2, "egg": 2, "rider": 1, "bob": 0.5}
    whole = energies + sum(9.81 * m * motion[f"{b}.position.z"] for b, m in masses.items())
    assert np.abs(whole - whole[0]).max() < 1e-9 * abs(whole[0])


def test_speeds_are_one_more_than_are_free(model: frot.Model, motion: Result) -> None:
    """Of what rolls the angular velocity and the rate of the height, which a row keeps.

    So the equations themselves have it; they give the load at the start.
    """
    dae = model.dae()
    of_hoop = [x for x in dae.names.x if x.startswith(("hoop.", "der(along", "der(hoop"))]
    turning = [f"hoop.angular_velocity.{k}" for k in "xyz"]
    assert of_hoop == [
        *(f"hoop.orientation[{k}]" for k in (1, 2, 3, 4)),
        "der(along.height)",
        *turning,
    ]
    x = dae.start(0, dae.u0, dae.p0)
    names = [k for k in dae.names.x if k.startswith("hoop.orientation")]
    place = {name: k for k, name in enumerate(dae.names.x)}
    for name, value in zip(names, (0.8, 0.6, 0, 0), strict=True):
        x[place[name]] = value
    for name in turning:
        x[place[name]] = motion[name][0]
    x[place["along.height"]] = motion["hoop.position.z"][0]
    x[place["der(along.height)"]] = motion["hoop.velocity.z"][0]
    z = dae.solve(0, x, dae.u0, dae.p0, [])
    load = z[dae.names.z.index("along.reaction[1]")]
    assert float(load) == pytest.approx(motion["load"][0], rel=1e-12)
