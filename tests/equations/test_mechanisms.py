"""Equations that meet a mechanism in its flanges, forces and reactions."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

COUPLED = """
planar model Coupled "two pendulums and a gear: their accelerations and its couple are one system"
  import Rotational.*;
  body one: rod(mass = 1 kg, length = 1 m);
  body two: rod(mass = 2 kg, length = 0.5 m);
  frame post on ground at (3, 0) m;
  liaison h1: rotoide(ground, one.start);
  liaison h2: rotoide(post, two.start);
  Gear gear(ratio = {ratio});
initial
  h1.angle = 0.2 rad; h1.speed = 0 rad/s;
equation
  connect(h1.flange, gear.a);
  connect(gear.b, h2.flange);
  experiment(stop = 3 s, tolerance = 1e-10);
end Coupled;
"""


@pytest.mark.parametrize("ratio", [-2.0, 0.7])
def test_pendulums_coupled_by_a_gear(ratio: float) -> None:
    result = frot.compile(COUPLED.format(ratio=ratio)).simulate(interval=0.05)
    inertia = 1 / 3 + (2 * 0.25 / 3) / ratio**2

    def rate(_: float, y: np.ndarray) -> list[float]:
        pull = -9.81 * 0.5 * np.cos(y[0]) - 2 * 9.81 * 0.25 * np.cos(y[0] / ratio) / ratio
        return [y[1], pull / inertia]

    exact = solve_ivp(
        rate, (0, 3), [0.2, 0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=result.time
    )
    assert np.abs(result["h1.angle"] - exact.y[0]).max() < 1e-8
    assert np.abs(result["h1.angle"] - ratio * result["h2.angle"]).max() < 1e-14


PRESCRIBED = """
planar model Prescribed "the couple that moves a pendulum as told, against gravity and friction"
  import Rotational.*;
  body arm: rod(mass = 1.5 kg, length = 0.8 m);
  liaison hinge: rotoide(ground, arm.start) with coulomb(0.2, radius = 10 mm);
  AngleSource source;
equation
  source.angle = {size}*sin(3 rad/s*time);
  connect(source.a, hinge.flange);
  experiment(stop = 3 s, tolerance = 1e-10);
end Prescribed;
"""


@pytest.mark.parametrize("size", [0.5, -1.3])
def test_the_couple_of_a_prescribed_motion_is_that_of_inverse_dynamics(size: float) -> None:
    result = frot.compile(PRESCRIBED.format(size=size)).simulate(interval=0.05)
    t = result.time
    angle, speed = size * np.sin(3 * t), 3 * size * np.cos(3 * t)
    reaction = np.hypot(result["hinge.force.x"], result["hinge.force.y"])
    couple = (
        1.5 * 0.64 / 3 * -9 * angle
        + 1.5 * 9.81 * 0.4 * np.cos(angle)
        + 0.2 * 0.01 * reaction * np.sign(speed)
    )
    assert np.abs(result["hinge.flange.torque"] - couple).max() < 1e-12
    turns = np.pi / 6 + np.pi / 3 * np.arange(3)
    assert [e.time for e in result.events] == pytest.approx(list(turns), abs=1e-10)


CIRCLE = """
planar model Circle "a bead on a circle by a force whose size is unknown: index 3 with a body"
  body bead: particle(mass = 2 kg);
  Real pull(unit = "N/m");
  force ring: on(bead, value = (-pull*bead.position.x, -pull*bead.position.y));
initial
  bead.position = (0.6, -0.8) m;
  bead.velocity = (0, 0) m/s;
equation
  bead.position.x^2 + bead.position.y^2 = 1 m^2;
  experiment(stop = 4 s, tolerance = 1e-10);
end Circle;
"""


def test_an_unknown_force_keeps_a_bead_on_a_circle() -> None:
    result = frot.compile(CIRCLE).simulate(interval=0.05)
    x, y = result["bead.position.x"], result["bead.position.y"]
    assert np.abs(x**2 + y**2 - 1).max() < 1e-12
    start = np.arctan2(-0.8, 0.6)
    exact = solve_ivp(
        lambda _, s: [s[1], -9.81 * np.cos(s[0])],
        (0, 4), [start, 0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=result.time,
    )  # fmt: skip
    assert np.abs(x - np.cos(exact.y[0])).max() < 1e-7


BRAKED = """
planar model Braked "a brake on the axle of a pendulum: it holds, and lets go when pressed less"
  import Rotational.*;
  body arm: rod(mass = 2 kg, length = 1 m);
  liaison hinge: rotoide(ground, arm.start);
  Brake brake(mu = 0.5, radius = 0.2 m);
initial
  hinge.angle = 0 rad; hinge.speed = 0 rad/s;
equation
  brake.force = 200 N - 50 N/s*time;
  connect(hinge.flange, brake.a);
  experiment(stop = 3 s, tolerance = 1e-10);
end Braked;
"""


def test_a_brake_holds_a_pendulum_until_it_is_too_weak() -> None:
    result = frot.compile(BRAKED).simulate(interval=0.01)
    # holds as long as 0.1 m times the force is more than the moment of the weight, 9.81 N.m
    release = (200 - 98.1) / 50
    first = result.events[0]
    assert (first.liaison, first.before, first.after) == ("brake", "stick", "slip")
    assert first.time == pytest.approx(release, rel=1e-10)
    assert np.all(result["hinge.angle"][result.time < release] == 0)
    assert result["hinge.angle"][-1] < -0.01


def test_a_reaction_may_be_read_by_an_equation() -> None:
    text = """
planar model Worn "wear: the integral of the power that friction takes"
  Energy worn;
  body block: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(block, ground.line) with coulomb(0.25);
initial
  block.position = (0, 0) m; block.velocity = (3, 0) m/s; worn = 0 J;
equation
  der(worn) = -floor.power;
  experiment(stop = 2 s, tolerance = 1e-10);
end Worn;
"""
    result = frot.compile(text).simulate()
    assert result["worn"][-1] == pytest.approx(9.0, rel=1e-9)
    assert result.events[0].time == pytest.approx(3 / (0.25 * 9.81), rel=1e-10)
