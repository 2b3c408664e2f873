"""A run whose events have no end in sight ends by name, with the motion up to there."""

import math

import pytest
from frot.runtime import engine, run

import frot

SAMPLED = """
model Fast
  Real x(start = 1);
  Integer n(start = 0);
initial
  x = 1;
equation
  der(x) = -x*(1 1/s);
  when sample(0 s, 1e-9 s) then
    n = pre(n) + 1;
  end when;
  experiment(stop = 1 s);
end Fast;
"""


def test_more_events_than_a_run_may_have_end_it(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (engine, run):
        monkeypatch.setattr(module, "MOST_EVENTS", 5000)
    with pytest.raises(frot.SimulationError, match=r"E0901.*more than 5000 events up to t") as told:
        frot.compile(SAMPLED).simulate()
    result = told.value.result
    assert result is not None
    last = result.time[-1]
    assert 5e-6 <= last < 2e-5
    assert result["n"][-1] == pytest.approx(last * 1e9 + 1, abs=1.5)
    assert result["x"][-1] == pytest.approx(math.exp(-last), rel=1e-12)


def test_a_run_with_fewer_events_ends_at_its_stop(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (engine, run):
        monkeypatch.setattr(module, "MOST_EVENTS", 5000)
    result = frot.compile(SAMPLED).simulate(stop=1e-6)
    assert result["n"][-1] == 1001 and result.time[-1] == 1e-6
