"""Four-bar mechanisms with dry pins, the crank along the line of the fixed pins at the start: there
the rod and the rocker turn alike, so that no speed turns the pin between them."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

TEXT = """
planar model FourBar
  parameter Length a = 100 mm, b = 300 mm, h = 250 mm, d = 280 mm, pin = 10 mm;
  parameter Mass m1 = 2 kg, m2 = 1 kg, m3 = 0.8 kg;
  parameter Real mu = 0.08, mu_r = 0.1, side = 1;
  parameter Angle tilt = 0 deg, start = 0 deg;
  parameter Torque c = 4 N.m, s = 0 N.m;
  parameter AngularVelocity w = 0 rad/s;
  body crank: rod(mass = m1, length = a);
  body link: rod(mass = m2, length = b);
  body rocker: rod(mass = m3, length = h);
  frame G on ground at (d*cos(tilt), d*sin(tilt));
  liaison O: rotoide(ground, crank.start) with coulomb(mu, radius = pin);
  liaison A: rotoide(crank.tip, link.start) with coulomb(mu, radius = pin);
  liaison B: rotoide(link.tip, rocker.tip) with coulomb(mu_r, radius = pin);
  liaison C: rotoide(G, rocker.start) with coulomb(mu_r, mu_s = 1.25*mu_r, radius = pin);
  force motor: couple(O, value = c + s*sin(5*time/(1 s)));
initial
  O.angle = tilt + start;
  O.speed = w;
  guess(rocker.angle = tilt + side*90 deg);
end FourBar;
"""


@pytest.fixture(scope="module")
def four_bar() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    "given",
    [
        {"w": 40.0, "mu": 0.0},
        {"w": -40.0, "start": math.pi, "side": -1.0},
        {"w": 0.0, "tilt": math.pi / 2, "mu": 0.001},
        {"w": 0.0, "c": 0.0, "s": 25.0, "tilt": -0.52},
        {"w": 60.0, "m1": 1e-3, "m2": 2e-3, "m3": 1e-3, "c": -0.2, "d": 0.31},
        {"w": 0.0, "a": 10.0, "b": 30.0, "h": 25.0, "d": 28.0, "pin": 1.0, "c": 600.0, "tilt": 2.9},
    ],
)
def test_a_four_bar_sets_out_from_where_its_rod_and_rocker_turn_alike(
    four_bar: frot.Model, given: dict[str, float], tolerance: float
) -> None:
    result = four_bar.simulate(stop=0.4, tolerance=tolerance, parameters=given)
    reference = four_bar.simulate(stop=0.4, tolerance=1e-13, parameters=given)
    slip = reference["B.speed"]
    assert abs(slip[0]) < 1e-10 * max(1, abs(reference["O.speed"][0]))
    assert np.abs(slip).max() > 1e-3
    speed, turned = reference["O.speed"], np.ptp(reference["O.angle"])
    error = np.abs(result["O.speed"] - speed).max() / np.abs(speed).max()
    assert error < 100 * tolerance * max(1, turned) + 3e-9
    assert abs(result.balance.residual) <= 1e3 * tolerance * result.balance.scale
