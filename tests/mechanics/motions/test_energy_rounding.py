"""Energies of what rests are rounding of what they are made of; those of a small motion are not."""

from __future__ import annotations

import math

import pytest

import frot

pytestmark = pytest.mark.finding

LOGS = """
planar model Logs "Two logs on a floor, one on top of them, pressed on ever harder"
  parameter Length r = 0.2 m, H = 0 m;
  curve floor on ground: line(through = (0 m, H), direction = (1, 0));
  body a: disc(mass = 10 kg, radius = r);
  body b: disc(mass = 10 kg, radius = r);
  body c: disc(mass = 10 kg, radius = r);
  liaison fa: contact_ponctuel(a.rim, floor) with coulomb(0.2);
  liaison fb: contact_ponctuel(b.rim, floor) with coulomb(0.2);
  liaison ca: contact_ponctuel(c.rim, a.rim) with coulomb(0.4);
  liaison cb: contact_ponctuel(c.rim, b.rim) with coulomb(0.4);
  force load: on(c, value = (0 N, -30 N/s*time));
initial
  a.position = (-r, H + r); b.position = (r, H + r); c.position = (0 m, H + r + r*sqrt(3));
  experiment(stop = 1 s);
end Logs;
"""


@pytest.mark.parametrize("height", [0.0, 50.0])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-7, 1e-9, 1e-11, 1e-13])
def test_a_resting_pile_of_logs_keeps_its_energy(tolerance: float, height: float) -> None:
    """Weights of 98 N at places of a metre: what these are rounded by makes 1e-14 J."""
    result = frot.compile(LOGS).simulate(tolerance=tolerance, parameters={"H": height})
    assert not result.events
    assert "warning" not in result.summary()
    assert abs(result.balance.residual) < 1e-14 * 300 * (1 + height)


@pytest.mark.parametrize("height", [0.0, 100.0])
def test_a_small_motion_high_up_is_judged_by_its_own_energy(height: float) -> None:
    """A pendulum that swings by a thousandth: m g l (1 - cos a), wherever its pin is."""
    result = frot.compile(f"""
planar model Small
  world(gravity = 9.81 m/s^2);
  body bob: rod(mass = 1 kg, length = 1 m);
  frame pin on ground at (0 m, {height} m);
  liaison O: rotoide(pin, bob.start);
initial
  O.angle = -90 deg + 1e-3;
  experiment(stop = {math.pi / 2 * math.sqrt(2 / 3 / 9.81)} s, tolerance = 1e-10);
end Small;
""").simulate()
    energy = 9.81 * 0.5 * (1 - math.cos(1e-3))
    assert result.balance.scale == pytest.approx(energy, rel=1e-5)
    assert result.balance.relative < 1e-7
