"""A posture that a motion was to meet is met by nothing once that motion has come to rest."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def ladder() -> frot.Model:
    """A bar whose ends stay on two dry rails, shaken so that it slips and sticks."""
    return frot.compile("""
planar model Ladder
  parameter Length size = 1 m;
  parameter Angle turn = 0 rad;
  parameter Angle between = 0.5 rad;
  parameter Angle leans = 1 rad;
  parameter Real mu = 0.3;
  parameter Real nu = 0.25;
  parameter Acceleration push = 1 m/s^2;
  parameter Acceleration pull = 0 m/s^2;
  parameter AngularVelocity w = 3 rad/s;
  parameter Mass heavy = 1 kg;
  world(gravity = 0 m/s^2);
  parameter Angle other = turn + between;
  Real swell = 1 + 0.3*sin(w*time);
  Acceleration along = push*sin(w*time);
  Acceleration across = pull*time*w;
  body b: rod(mass = heavy, length = size);
  curve one on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  curve two on ground: line(through = (0, 0) m, direction = (cos(other), sin(other)));
  liaison A: contact_ponctuel(b.tip, one, unilateral = false) with coulomb(mu*swell);
  liaison B: contact_ponctuel(b.start, two, unilateral = false) with coulomb(nu);
  force shake: on(b, value = heavy*(along*(cos(turn), sin(turn))
      + across*(-sin(turn), cos(turn))));
initial
  b.angle = turn + leans;
  b.angular_velocity = 0 rad/s;
  guess(b.position = size*(cos(turn), sin(turn)));
  experiment(stop = 2 s);
end Ladder;
""")


@pytest.mark.parametrize("seed", [60, 118, 273, 281])
@pytest.mark.parametrize(("size", "heavy", "about"), [(1.0, 1.0, 0.0), (1e-6, 1e6, 1.3)])
def test_a_sticking_ladder_meets_no_posture(
    seed: int, size: float, heavy: float, about: float
) -> None:
    random = np.random.default_rng(seed)
    drawn = {
        "turn": random.uniform(-3, 3) + about,
        "between": random.uniform(0.2, 2.9),
        "leans": random.uniform(-3, 3),
        "mu": random.uniform(0.02, 0.4),
        "nu": random.uniform(0.02, 0.4),
        "push": random.choice([-1, 1]) * 10 ** random.uniform(0, 1.3) * size,
        "pull": random.uniform(-1, 1) * size,
        "w": random.uniform(3, 12),
        "size": size,
        "heavy": heavy,
    }
    result = ladder().simulate(parameters=drawn, tolerance=10 ** random.uniform(-11, -4))
    assert result.time[-1] == 2
    sticks = [e.time for e in result.events if e.kind == "stick"]
    assert len(sticks) > 0
    at = result.at(np.nextafter(sticks[-1], np.inf))
    assert at["b.angular_velocity"] == at["A.slip"] == at["B.slip"] == 0


def test_a_disc_stops_sliding_on_a_locked_rod() -> None:
    """A pin and a line hold the rod in its place. The disc slides up a line of it, first turning,
    then held by its resistance to rolling, and stops: at that instant nothing moves, and what is
    left of the rows that hold the rod is as far from vanishing as before."""
    model = frot.compile("""
planar model Locked
  parameter Acceleration g = 9.81e-10 m/s^2;
  parameter Real mu = 0.06;
  parameter Angle leans = -1.77 rad;
  parameter Angle along = 5.18 rad;
  parameter Length r = 1.85 mm;
  world(gravity = g);
  body rod: rod(mass = 17500 kg, length = 8.6 mm);
  body disc: disc(mass = 38000 kg, radius = r);
  frame hinge on ground at (-1.18, 11.4) mm;
  curve way on rod: line(through = (4.5, -5.28) mm, direction = (cos(along), sin(along)));
  curve wall on ground: line(through = (-2.88, 2.98) mm, direction = (cos(1.545), sin(1.545)));
  liaison slide: contact_ponctuel(disc.rim, way, unilateral = false)
    with coulomb(mu), rolling_resistance(0.39 mm);
  liaison lock: contact_ponctuel(wall, rod.tip, unilateral = false) with coulomb(0.2);
  liaison pin: rotoide(hinge, rod.start);
initial
  guess(rod.angle = leans);
  slide.gap = 0 m;
  guess(disc.position = (-4.72, 6.7) mm);
  guess(disc.velocity = (8.2e-7, 2.3e-7) m/s);
  disc.angular_velocity = -1.5e-4 rad/s;
  experiment(stop = 1e4 s);
end Locked;
""")
    for tolerance in (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13):
        result = model.simulate(tolerance=tolerance)
        held, stopped = (e.time for e in result.events)
        at = result.at(held)
        slope = 5.18 + at["rod.angle"]
        slows = 9.81e-10 * (abs(np.sin(slope)) + 0.06 * abs(np.cos(slope)))
        speed = np.hypot(at["disc.velocity.x"], at["disc.velocity.y"])
        assert [e.kind for e in result.events] == ["roll_stop", "reversal"]
        assert stopped - held == pytest.approx(speed / slows, rel=1e-9)
