"""A run of many events takes the room that it fills, and little more."""

from __future__ import annotations

from array import array

import pytest
from frot.runtime import engine

import frot

TICKS = """model M
  parameter Time T = 0.1 ms;
  Real x(start = 1);
equation
  der(x) = -x/(1 s);
  when sample(0 s, T) then
    reinit(x, 1);
  end when;
  experiment(stop = 1 s);
end M;
"""


def test_room_for_steps_does_not_grow_with_events(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten thousand ticks: all that was asked for is within a few times what is kept."""
    asked = 0

    def counted(count: int) -> array[float]:
        nonlocal asked
        asked += count
        return array("d", [0.0]) * count

    model = frot.compile(TICKS)
    model.simulate(stop=1e-3)
    monkeypatch.setattr(engine, "zeros", counted)
    result = model.simulate()
    assert len(result.events) == 10_000
    assert asked < 4 * len(result._record)
