"""Loads that begin where none acts: the contact bears nothing, so no friction holds its body."""

from __future__ import annotations

import functools
import math

import pytest

import frot


@functools.cache
def begins(power: int) -> frot.Model:
    return frot.compile(f"""
planar model Begins
  world(gravity = 0 m/s^2);
  parameter Force F = 1 N;
  parameter Mass m = 1 kg;
  parameter Angle tilt = 0;
  body b: particle(mass = m);
  curve line on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  liaison c: point_courbe(b, line) with coulomb(0.3);
  Real s = time/(1 s);
  force f: on(b, value = F*s^{power}*(cos(tilt), sin(tilt)));
initial
  b.position = (0, 0) m;
  b.velocity = (0, 0) m/s;
  experiment(stop = 1 s, tolerance = 1e-10);
end Begins;
""")


@pytest.mark.parametrize("power", [1, 2, 3])
@pytest.mark.parametrize(
    ("force", "mass", "tilt"),
    [(1.0, 1.0, 0.0), (-2e6, 1e6, 0.0), (3e-14, 0.07, 0.0), (-1e-9, 1e-6, 1.1)],
)
def test_it_moves_in_the_direction_in_which_the_load_grows(
    power: int, force: float, mass: float, tilt: float
) -> None:
    values = {"F": force, "m": mass, "tilt": tilt}
    (motion,) = begins(power).motions(parameters=values)
    (law,) = motion.laws
    assert law.moving and law.since == power
    assert law.direction == (math.copysign(1.0, force),)
    result = begins(power).simulate(parameters=values)
    assert result.events == ()
    way = force / mass / ((power + 1) * (power + 2))
    assert result["b.position.x"][-1] == pytest.approx(way * math.cos(tilt), rel=1e-8)
