"""A coefficient of motion that comes above that of rest ends the run at that instant (E0904)."""

from __future__ import annotations

import pytest

import frot

PLANE = """
planar model Crossing
  body b: particle(mass = 1 kg);
  liaison f: contact_ponctuel(b, ground.line) with coulomb(mu = {mu}, mu_s = {mu_s});
initial
  b.velocity = (20, 0) m/s;
  experiment(stop = {stop} s, tolerance = 1e-9);
end Crossing;
"""
SPACE = """
model Crossing
  body b: box(mass = 1 kg, size = (1, 1, 1) m);
  liaison f: point_surface(b.bottom, ground.plane) with coulomb(mu = {mu}, mu_s = {mu_s});
initial
  b.velocity = (16, 12, 0) m/s;
  experiment(stop = {stop} s, tolerance = 1e-9);
end Crossing;
"""


@pytest.mark.parametrize("text", [PLANE, SPACE])
def test_the_run_ends_where_rest_is_weaker_than_motion(text: str) -> None:
    model = frot.compile(text.format(mu="0.3 + 0.1*time/(1 s)", mu_s="0.4", stop=6))
    with pytest.raises(frot.SimulationError, match=r"E0904.*below that of motion") as raised:
        model.simulate()
    assert raised.value.result is not None
    assert raised.value.result.time[-1] == pytest.approx(1.0, abs=1e-8)
    assert raised.value.result["b.velocity.x"][-1] < 20


@pytest.mark.parametrize("text", [PLANE, SPACE])
def test_equal_coefficients_written_otherwise_are_equal(text: str) -> None:
    """(0.1 + 0.2) t and 0.3 t differ by rounding."""
    rising = text.format(mu="0.1*time/(1 s) + 0.2*time/(1 s)", mu_s="0.3*time/(1 s)", stop=3)
    same = text.format(mu="0.3*time/(1 s)", mu_s="0.3*time/(1 s)", stop=3)
    one, two = (frot.compile(x).simulate()["b.velocity.x"][-1] for x in (rising, same))
    assert one == pytest.approx(two, rel=1e-7)
