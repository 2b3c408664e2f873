"""A crank that falls from its dead centre: its piston's slip begins as rounding of lengths."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def crank() -> frot.Model:
    """A light slider crank with a short rod."""
    return frot.compile("""
planar model Falls
  parameter Length r = 100 mm, l = 120 mm, pin = 10 mm;
  parameter Mass mc = 1 kg, mb = 1 kg, mp = 1 kg;
  parameter Real mu = 0.1, mu_g = 0.1;
  parameter Torque c = 0 N.m;
  body crank: rod(mass = mc, length = r);
  body rod: rod(mass = mb, length = l);
  body piston: particle(mass = mp);
  liaison O: rotoide(ground, crank.start) with coulomb(mu, radius = pin);
  liaison A: rotoide(crank.tip, rod.start) with coulomb(mu, radius = pin);
  liaison B: rotoide(rod.tip, piston) with coulomb(mu, radius = pin);
  parameter Angle tilt = 0;
  curve rail on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  liaison C: point_courbe(piston, rail) with coulomb(mu_g, mu_s = 1.25*mu_g);
  force motor: couple(O, value = c*sin(5*time/(1 s)));
initial
  O.angle = tilt;
  O.speed = 0 rad/s;
  guess(rod.angle = tilt);
  experiment(stop = 0.1 s);
end Falls;
""")


@pytest.mark.parametrize("heavy", [1, 1e6])
@pytest.mark.parametrize(
    ("mc", "mb", "mp", "mu", "mu_g", "l"),
    [
        (0.64, 0.049, 0.1, 0.06, 0.32, 0.115),
        (0.8, 0.015, 0.24, 0.09, 0.27, 0.118),
        (0.69, 0.077, 0.11, 0.1, 0.37, 0.12),
    ],
)
def test_it_falls_at_any_tolerance(
    mc: float,
    mb: float,
    mp: float,
    mu: float,
    mu_g: float,
    l: float,  # noqa: E741
    heavy: float,
) -> None:
    """Where the row of the slip came to be more than rounding the steps of tight runs ended."""
    given = {"mc": heavy * mc, "mb": heavy * mb, "mp": heavy * mp, "mu": mu, "mu_g": mu_g, "l": l}
    best = crank().simulate(tolerance=1e-13, parameters=given)
    size = np.abs(best["O.speed"]).max()
    assert size > 5
    for tolerance in (1e-5, 1e-8, 1e-12):
        result = crank().simulate(tolerance=tolerance, parameters=given)
        assert np.abs(result["O.speed"] - best["O.speed"]).max() < (30 * tolerance + 1e-10) * size
