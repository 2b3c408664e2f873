"""Roots that change their branch where a variable passes zero."""

from __future__ import annotations

import pytest

import frot

FORCED = """
model Forced
  parameter Real push = 0.3;
  Real x, y;
initial
  x = 1;
equation
  y = if x > 0 then sqrt(x) else -sqrt(-x);
  der(x) = -y*(2 1/s) - push*sin(3*time/(1 s))*(1 1/s);
  experiment(stop = 10 s);
end Forced;
"""


@pytest.mark.parametrize("push", [0.3, -0.7, 3.0])
def test_a_root_passes_zero_with_speed_at_any_tolerance(push: float) -> None:
    """Its slope is without bound there; the instant is known to a rounding of time."""
    model = frot.compile(FORCED)
    runs = {
        tolerance: model.simulate(tolerance=tolerance, parameters={"push": push})
        for tolerance in (1e-5, 1e-8, 1e-10, 1e-12, 1e-13)
    }
    exact = runs[1e-13]
    assert len(exact.events) >= 5
    for tolerance, run in runs.items():
        assert len(run.events) == len(exact.events)
        for t in (1.0, 4.0, 10.0):
            assert run.at(t)["x"] == pytest.approx(exact.at(t)["x"], abs=300 * tolerance + 1e-13)


def test_an_equation_without_a_value_at_an_event_is_named() -> None:
    """Both tanks are empty at once: the root of the second has no value beyond it."""
    with pytest.raises(frot.FrotError) as told:
        frot.compile("""
model Tanks
  Real h[2], q[2];
initial
  h[1] = 1; h[2] = 0;
equation
  q[1] = if h[1] > h[2] then sqrt(h[1] - h[2]) else -sqrt(h[2] - h[1]);
  q[2] = if h[2] > 0 then sqrt(h[2]) else 0;
  der(h[1]) = -q[1]/(1 s);
  der(h[2]) = (q[1] - q[2])/(1 s);
end Tanks;
""").simulate(stop=10)
    diagnostic = told.value.diagnostics[0]
    assert diagnostic.code == "E0904"
    assert "the equation `q[2] = if h[2] > 0" in diagnostic.message
