"""Where nothing loads a body, reactions are zero: rounding of its speeds is no load."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def on_two_guides(first: str, second: str) -> frot.Model:
    """A disc glides without weight along two parallel guides; the `first` is rough."""
    return frot.compile(f"""
planar model Guided
  world(gravity = 0 m/s^2);
  parameter Mass mass = 2 kg;
  parameter Angle tilt = 0.19;
  parameter Angle turn = -3.05;
  parameter Velocity speed = -0.0427 m/s;
  parameter Real mu = 0.55;
  parameter Length x = -0.71 m;
  parameter Length y = 0.62 m;
  parameter Angle pose = tilt + turn;
  body bar: disc(mass = mass, radius = 1.39 m);
  frame f0 on bar at (-0.78, 1.64) m;
  frame f1 on bar at (-0.28, 0.89) m;
  curve l0 on ground: line(
    through = (x + (-0.78*cos(pose) - 1.64*sin(pose))*1 m,
               y + (-0.78*sin(pose) + 1.64*cos(pose))*1 m),
    direction = (cos(tilt), sin(tilt)));
  curve l1 on ground: line(
    through = (x + (-0.28*cos(pose) - 0.89*sin(pose))*1 m,
               y + (-0.28*sin(pose) + 0.89*cos(pose))*1 m),
    direction = (cos(tilt), sin(tilt)));
  liaison c0: {first} with coulomb(mu);
  liaison c1: {second};
initial
  bar.position = (x, y);
  bar.velocity = (speed*cos(tilt), speed*sin(tilt));
  bar.angle = pose;
  bar.angular_velocity = 0 rad/s;
  experiment(stop = 2.7 s, tolerance = 1e-7, on_indeterminate = rest);
end Guided;""")


PAIRS = [
    ("contact_ponctuel(f0, l0, unilateral = false)", "point_courbe(f1, l1)"),
    ("point_courbe(f0, l0)", "point_courbe(f1, l1)"),
    ("point_courbe(f0, l0)", "point_courbe(f1, l1) with coulomb(0.2)"),
]


@pytest.mark.parametrize(("first", "second"), PAIRS)
@pytest.mark.parametrize("mass", [2e-6, 2.0, 2e6])
@pytest.mark.parametrize("speed", [-0.0427, 0.0427, 31.0, -1e-6])
def test_a_disc_on_parallel_guides_glides_on(
    speed: float, mass: float, first: str, second: str
) -> None:
    """No force acts and the guides are straight: x(t) = x0 + v t along them, without an event."""
    model = on_two_guides(first, second)
    for tilt in np.linspace(-2.9, 3.1, 13):
        for turn in (-3.05, 0.4):
            values = {"tilt": tilt, "turn": turn, "speed": speed, "mass": mass}
            result = model.simulate(parameters=values)
            assert not result.events
            for name, start, part in (("x", -0.71, np.cos(tilt)), ("y", 0.62, np.sin(tilt))):
                exact = start + part * speed * result.time
                bound = 1e-13 * (1 + abs(speed))
                assert np.abs(result[f"bar.position.{name}"] - exact).max() < bound
                assert np.abs(result[f"c0.force.{name}"]).max() <= 1e-14 * mass * speed**2
