"""A light body on a stiff damper: what loads could bring it in a step is far from what it gets."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]


@functools.cache
def scene() -> frot.Model:
    """A bead on a rough rail is drawn by a damper whose other end goes to and fro."""
    return frot.compile("""
planar model Light
  world(gravity = 0 m/s^2);
  parameter Mass light = 1e-9 kg;
  parameter Damping c = 1 N.s/m;
  parameter Force load = 1 N;
  parameter Real mu = 0.3;
  parameter Angle turn = 0;
  parameter Velocity fast = 1 m/s;
  parameter AngularVelocity w = 2 rad/s;
  curve floor on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  body bead: particle(mass = light);
  liaison rail: point_courbe(bead, floor, unilateral = false) with coulomb(mu);
  Velocity v = fast*cos(w*time) - bead.velocity.x*cos(turn) - bead.velocity.y*sin(turn);
  force pull: on(bead, value = c*v*(cos(turn), sin(turn)) + load*(sin(turn), -cos(turn)));
initial
  bead.position = (0, 0) m;
  bead.velocity = (fast - mu*load/c)*(cos(turn), sin(turn));
end Light;
""")


@pytest.mark.parametrize("seed", range(10))
def test_it_stops_and_departs_as_the_damper_draws(seed: int) -> None:
    """Without mass it slides while |fast cos(w t)| > mu load / c, and rests else; its mass delays
    that by some light / c."""
    random = np.random.default_rng(seed)
    light = 10 ** random.uniform(-14, -5)
    c, load, fast = 10 ** random.uniform(-1, 1, 3)
    w, turn = random.uniform(1, 6), random.uniform(-3, 3)
    part, tolerance = random.uniform(0.1, 0.95), 10 ** random.uniform(-11, -3)
    values = {"light": light, "c": c, "load": load, "fast": fast, "w": w, "turn": turn}
    values["mu"] = part * c * fast / load
    result = scene().simulate(stop=3.2 * np.pi / w, parameters=values, tolerance=tolerance)
    stops = np.arccos(part) + np.pi * np.arange(4)
    departs = np.pi - np.arccos(part) + np.pi * np.arange(4)
    wanted = np.sort([t for t in (*stops, *departs) if t < 3.2 * np.pi])
    found = w * np.array([e.time for e in result.events])
    assert found == pytest.approx(wanted, abs=100 * tolerance + 20 * w * light / c)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8, 1e-10, 1e-11, 1e-12])
def test_a_speed_of_rounding_does_not_hide_a_stiff_one(tolerance: float, finding: Finding) -> None:
    """The whip turns where its dampers let it, after 5000 s as at any other time: in some hundred
    steps, where an explicit method takes 130 000."""
    held = finding("held_beside_a_stiff_one")
    result = held.simulate(tolerance=tolerance)
    best = held.simulate(tolerance=1e-13)
    assert result.figures.steps < 1000
    for name in ("whip.angular_velocity", "plank.velocity.x"):
        far = np.max(np.abs(best[name]))
        assert abs(result[name][-1] - best[name][-1]) <= 100 * tolerance * far
