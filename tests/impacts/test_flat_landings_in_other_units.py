"""A rod that falls flat and bounces: both ends meet together, in every bounce and in all units.

Its ends meet at the speed v, and leave at e v; a bounce lasts 2 e v/g, so that all end at the time
T (1 + e)/(1 - e), T = sqrt(2 h/g). The slip loses mu (1 + e) v in each blow until it is zero.
"""

from __future__ import annotations

import functools
import math
from itertools import pairwise

import pytest

import frot

HEIGHT = 1.0


@functools.cache
def model() -> frot.Model:
    return frot.compile("""
planar model FlatRod
  parameter Acceleration g = 9.81 m/s^2;
  parameter Real e = 0.5;
  parameter Real mu = 0.3;
  parameter Velocity u = 10 m/s;
  parameter Mass m = 1 kg;
  parameter Length length = 1 m;
  parameter Time whole = 1 s;
  world(gravity = g);
  body b: rod(mass = m, length = length);
  liaison tip: contact_ponctuel(b.tip, ground.line) with coulomb(mu), restitution(e);
  liaison start: contact_ponctuel(b.start, ground.line) with coulomb(mu), restitution(e);
initial
  b.position = (0 m, 1 m);
  b.velocity = (u, 0 m/s);
  experiment(stop = whole, tolerance = 1e-8);
end FlatRod;
""")


@pytest.mark.parametrize("g", [1.62, 9.81, 981.0, 9810.0, 98100.0])
@pytest.mark.parametrize(
    "values",
    [
        {"e": 0.5, "u": 1.0},
        {"e": 0.5, "u": -1.0, "m": 1e6},
        {"e": 0.2, "u": 5.0, "mu": 0.05},
        {"e": 0.8, "u": 0.0, "mu": 0.6, "m": 1e-6},
    ],
)
def test_both_ends_meet_together_until_the_rod_lies(g: float, values: dict[str, float]) -> None:
    e, mu, m = values["e"], values.get("mu", 0.3), values.get("m", 1.0)
    first = math.sqrt(2 * HEIGHT / g)
    limit = first * (1 + e) / (1 - e)
    speed = g * first
    u = values["u"] * speed
    run = model().simulate(parameters={**values, "u": u, "g": g, "whole": 1.2 * limit})
    blows = [x for x in run.events if x.kind in ("impact", "last_impact")]
    assert len(blows) >= 10 and len(blows) % 2 == 0
    meets = speed
    for one, two in zip(blows[::2], blows[1::2], strict=True):
        assert one.time == two.time and {one.liaison, two.liaison} == {"tip", "start"}
        assert one.impulse == pytest.approx(two.impulse, rel=1e-9)
        if one.kind == "impact":
            assert one.impulse == pytest.approx(m * (1 + e) * meets / 2, rel=1e-5)
        meets *= e
    assert all(a.time < b.time for a, b in pairwise(blows[::2]))
    last = blows[-1]
    assert last.kind == "last_impact" and last.until == pytest.approx(limit, rel=1e-8)
    # what friction has taken of the slip: mu m (1 + e) v of each blow, and mu m g afterwards
    taken = mu * (1 + e) * speed / (1 - e) + mu * g * (run.time[-1] - limit)
    left = math.copysign(max(abs(u) - taken, 0.0), u)
    assert run["b.velocity.x"][-1] == pytest.approx(left, abs=1e-7 * speed)
    assert abs(run["b.position.y"][-1]) < 4e-9 and abs(run["b.angle"][-1]) < 1e-8
