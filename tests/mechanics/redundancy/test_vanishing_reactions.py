"""Where a reaction vanishes, or what it follows from, no rounding decides what comes next."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]
TOLERANCES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11]
# of the pin of vanish_together: its coefficient times its radius
BOUND = 0.33 * 0.04


@pytest.mark.parametrize(("spin", "heavy"), [(1.78, 0.5), (1.78, 1.0), (1.6, 0.74), (2.2, 1.0)])
def test_a_pin_and_a_line_lose_their_reactions_together(
    finding: Finding, spin: float, heavy: float
) -> None:
    model = finding("vanish_together")
    parameters = {"spin": spin, "heavy": heavy}
    reference = model.simulate(tolerance=1e-13, parameters=parameters)
    assert any(e.kind == "reaction" and e.liaison == "touch" for e in reference.events)
    for tolerance in TOLERANCES:
        result = model.simulate(tolerance=tolerance, parameters=parameters)
        told = [(e.kind, e.liaison) for e in result.events]
        assert told == [(e.kind, e.liaison) for e in reference.events]
        for one, other in zip(result.events, reference.events, strict=True):
            assert one.time == pytest.approx(other.time, abs=tolerance)
        # the rod's middle stays: its pin bears what the line does, and no more
        line = np.hypot(result["touch.force.x"], result["touch.force.y"])
        assert np.abs(result["pin.normal_force"] - line).max() < 1e-12
        # and its friction has the whole of that for a bound
        couple = -BOUND * line * np.sign(result["pin.speed"])
        assert np.abs(result["pin.torque"] - couple).max() < 1e-12


@pytest.mark.parametrize(
    "parameters", [{}, {"bar_mass": 0.35}, {"bar_mass": 0.5}, {"rough": 0.2}], ids=str
)
def test_a_run_ends_at_a_pole_of_a_bounded_reaction(
    finding: Finding, parameters: dict[str, float]
) -> None:
    """It went on beyond, or not, as the tolerance had it, and told motions that were one."""
    ends = []
    for tolerance in [*TOLERANCES, 1e-12]:
        with pytest.raises(frot.SimulationError, match=r"E0901.*slide") as told:
            finding("ends_at_a_pole").simulate(tolerance=tolerance, parameters=parameters)
        assert told.value.result is not None and not told.value.result.events
        ends.append(float(told.value.result.time[-1]))
    for tolerance, end in zip(TOLERANCES, ends, strict=False):
        assert end == pytest.approx(ends[-1], abs=tolerance + 1e-10)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_successive_ends_of_slip_have_a_limit(finding: Finding, tolerance: float) -> None:
    """The run ended in E0903 beside it: loads hardly change, so that each round is a part r of the
    one before, and the limit of their instants is t + (t - s) r / (1 - r).
    """
    result = finding("slips_in_turn").simulate(tolerance=tolerance)
    (limit,) = [e.time for e in result.events if e.liaison == "pin" and e.time > 1e-7]
    rounds = [e.time for e in result.events if e.kind == "reaction"][1::2]
    before, then, now = rounds[60:63]
    part = (now - then) / (then - before)
    assert limit == pytest.approx(now + (now - then) * part / (1 - part), rel=1e-8)
    assert result.time[-1] == pytest.approx(1e-5)
    # both slips begin there, and grow alike
    for slip in ("touch.slip", "pin.speed"):
        soon, later = result.at(limit + 1e-9)[slip], result.at(limit + 2e-9)[slip]
        assert later == pytest.approx(2 * soon, rel=1e-3) and soon != 0
