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


RESTING = """
model Resting
  parameter Real part = 0.5;
  Real x, y;
initial
  x = -1; y = 1;
equation
  der(x) = -2*sign(x)*sqrt(abs(x))*(1 1/s);
  der(y) = -(if y > 0 then y^part else -(-y)^part)*(1 1/s) + (if time < 3 s then 0 else 1)*(1 1/s);
  experiment(stop = 3.5 s);
end Resting;
"""


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_what_a_root_brings_to_zero_stays_there_and_leaves_again(tolerance: float) -> None:
    """x = -(1 - t)^2, y^(1 - p) = 1 - (1 - p) t up to zero; from 3 s on y is filled again."""
    model = frot.compile(RESTING)
    for part in (0.3, 0.5):
        run = model.simulate(tolerance=tolerance, parameters={"part": part})
        empty = 1 / (1 - part)
        assert run.at(0.6)["x"] == pytest.approx(-0.16, rel=100 * tolerance)
        assert all(run.at(t)["x"] == 0 for t in (1.01, 2.0, 3.0))
        assert run.at(0.5 * empty)["y"] == pytest.approx(0.5**empty, rel=100 * tolerance)
        assert all(run.at(t)["y"] == 0 for t in (empty + 0.01, 2.99))
        assert 0.2 < run.at(3.5)["y"] < 0.5
        assert len([e for e in run.events if e.liaison == "x >= 0"]) == 2


@pytest.mark.parametrize("tolerance", [1e-6, 1e-7, 1e-8, 1e-11, 1e-12])
def test_two_tanks_are_empty_at_one_instant(tolerance: float) -> None:
    """Both levels end as squares of the time left, in a ratio b/a that their equations give."""
    model = frot.compile("""
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
""")
    run = model.simulate(stop=10, tolerance=tolerance)
    assert run.events[1].time == pytest.approx(3.3408069096586, abs=30 * tolerance**0.5)
    assert run.at(9.0)["h[1]"] == pytest.approx(0, abs=1e-27)
    assert run.at(9.0)["h[2]"] == pytest.approx(0, abs=1e-27)
    ratio = run.at(3.34)["h[2]"] / run.at(3.34)["h[1]"]  # h = (a, b) (T - t)^2
    assert (1 + ratio) * (1 - ratio) ** 0.5 == pytest.approx(ratio**0.5, rel=0.02)


SWITCHED = """
model Switched
  parameter Real o = {o};
  Real a(start = 1), b(start = 0);
equation
  der(a) = (if a - b > o then -sqrt(a - b) - 0.1 else 0)/(1 s);
  der(b) = 0/(1 s);
  experiment(stop = 6 s);
end Switched;
"""


@pytest.mark.parametrize("default", [0.0, -1.0, 1.0])
def test_what_switches_a_root_is_judged_at_the_parameters_of_the_run(default: float) -> None:
    """Of a root that no condition ends at zero the text has no value beyond, whatever the default.

    With o = 0 it comes to rest at zero, with o = 0.25 there.
    """
    model = frot.compile(SWITCHED.format(o=default))
    for o in (0, 0.25):
        assert model.simulate(parameters={"o": o})["a"][-1] == pytest.approx(o, abs=1e-7)
    with pytest.raises(frot.FrotError, match="E0904"):
        model.simulate(parameters={"o": -1})
