"""A crank that rests in its exact dead centre, and what its neighbours do beside it."""

from __future__ import annotations

import functools
import itertools
import math

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

CRANK = """
  body a1: rod(mass = 1 kg, length = 0.1 m);
  body a2: rod(mass = 1 kg, length = 0.3 m);
  curve one on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison A: rotoide(ground, a1.start) with coulomb(mu, radius = 1 cm);
  liaison B: rotoide(a1.tip, a2.start) with coulomb(mu, radius = 1 cm);
  liaison C: point_courbe(a2.tip, one) with coulomb(mu);
  force motor: couple(A, value = c);
"""
SECOND = """
  body b1: rod(mass = 1 kg, length = 0.1 m);
  body b2: rod(mass = 1 kg, length = 0.3 m);
  frame eye on ground at (0 m, 0.5 m);
  curve two on ground: line(through = (0, 0.5) m, direction = (1, 0));
  liaison D: rotoide(eye, b1.start) with coulomb(mu, radius = 1 cm);
  liaison E: rotoide(b1.tip, b2.start) with coulomb(mu, radius = 1 cm);
  liaison G: point_courbe(b2.tip, two) with coulomb(mu);
"""


@functools.cache
def cranks(second: bool) -> frot.Model:
    """A driven crank on a spring to a second one, or to the place where that one rests."""
    rests = "" if second else "frame place on ground at (0.3 m + 0.1 m*cos(q), 0.5 m);"
    return frot.compile(f"""
planar model Cranks
  world(gravity = 0 m/s^2);
  parameter Stiffness k = 1e4 N/m;
  parameter Real mu = 0.1;
  parameter Torque c = 10 N.m;
  parameter Angle p = 0;
  parameter Angle q = 0;
  parameter AngularVelocity w = 0 rad/s;
  {CRANK}{SECOND if second else rests}
  force s: spring(a2.tip, {"b2.tip" if second else "place"}, k = k, length = 0.5 m);
initial
  a1.angle = p;
  a1.angular_velocity = w;
  guess(a2.angle = 0);
  {"b1.angle = q; b1.angular_velocity = 0 rad/s; guess(b2.angle = 0);" if second else ""}
  experiment(stop = 0.5 s);
end Cranks;
""")


def draw(random: np.random.Generator) -> dict[str, float]:
    return {
        "k": 10 ** random.uniform(2, 5),
        "mu": random.choice([0.01, 0.1, 0.3]),
        "c": random.uniform(1, 20),
        "p": random.choice([0, 0.5, math.pi]),
        "q": random.choice([0, math.pi]),
        "w": random.choice([0, 5, -5]),
    }


def assert_rests(alone: frot.Result, values: dict[str, float], tolerance: float) -> None:
    result = cranks(True).simulate(tolerance=tolerance, parameters=values)
    assert np.all(result["b1.angular_velocity"] == 0)
    assert np.all(result["b2.angular_velocity"] == 0)
    turned = abs(alone["a1.angle"][-1] - values["p"])
    missed = abs(result["a1.angle"][-1] - alone["a1.angle"][-1])
    assert missed < 100 * max(tolerance, 1e-11) * max(turned, 1)


@pytest.mark.parametrize("seed", range(10))
def test_a_crank_rests_in_its_dead_centre_whatever_pulls_across_it(seed: int) -> None:
    """Its guide takes what the spring pulls across, which is none whenever the other crank passes
    its own dead centre: then its pins bear nothing, and hold no couple. The other crank moves as on
    a fixed eye."""
    values = draw(np.random.default_rng(seed))
    alone = cranks(False).simulate(tolerance=1e-11, parameters=values)
    for tolerance in (1e-4, 1e-8, 1e-12):
        assert_rests(alone, values, tolerance)


@pytest.mark.parametrize("seed", [3, 6, 7, 28, 37])
def test_no_last_bit_of_the_start_decides_whether_it_runs(seed: int) -> None:
    """The spring pulls with the fourth power of the time to the dead centre of the other crank, or
    with the third: for a while there all reactions of the crank at rest are rounding, and steps
    that are long for them say nothing of their signs."""
    random = np.random.default_rng(seed)
    values = draw(random)
    alone = cranks(False).simulate(tolerance=1e-11, parameters=values)
    for tolerance, part in itertools.product((1e-3, 1e-4, 1e-8), (1e-16, 1e-14, 1e-12)):
        moved = {k: v * (1 + part * random.uniform(-1, 1)) for k, v in values.items() if k != "q"}
        assert_rests(alone, {**values, **moved}, tolerance)
