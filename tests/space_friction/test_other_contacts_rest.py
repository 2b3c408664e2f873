"""Components of several contacts: a stop, a departure or a third law changes no other contact."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import frot

HERE = Path(__file__).parent


def slips(name: str, liaison: str, turn: str | None = None) -> list[float]:
    """Times at which the liaison begins to slip."""
    parameters = {} if turn is None else {"turn": turn}
    result = frot.load(HERE / f"{name}.frot").simulate(parameters=parameters)
    return [e.time for e in result.events if e.liaison.startswith(liaison) and e.after == "slip"]


def test_a_point_swings_round_another_that_rests() -> None:
    """The rod pulls with m v^2/l, which vanishes with v: the resting point keeps its place."""
    assert slips("swing_round_a_resting_point", "cb") == []


def test_a_sphere_takes_friction_and_both_resistances() -> None:
    result = frot.load(HERE / "three_laws_of_a_sphere.frot").simulate()
    spin = 0.4 * 0.01 * 4 / (0.001 * 9.81)
    roll = 1 / (5 / 7 * 0.02 * 9.81)
    assert [e.time for e in result.events] == pytest.approx([spin, roll], abs=1e-10)


@pytest.mark.parametrize("turn", ["0 deg", "30 deg", "77 deg", "-77 deg", "200 deg"])
def test_a_chain_departs_as_late_when_it_is_turned(turn: str) -> None:
    """The first point departs at this instant. The stop of another point changes nothing."""
    departs = math.asin(0.25 * 9.81 / 4.191) / 2
    assert slips("chain_departs_after_a_stop", "cp", turn) == pytest.approx([departs], abs=1e-8)


@pytest.mark.parametrize("turn", ["0 deg", "40 deg", "77 deg", "-130 deg"])
def test_one_point_of_a_chain_stops_while_another_begins_to_slip(turn: str) -> None:
    """However the scene is turned, the three events come at the same instants."""
    result = frot.load(HERE / "stop_in_a_chain.frot").simulate(parameters={"turn": turn})
    assert [(e.liaison, e.after) for e in result.events] == [
        ("cp", "slip"),
        ("cq", "stick"),
        ("cr", "stick"),
    ]
    times = [0.1796263135835, 0.1921322258758, 1.4419853259143]
    assert [e.time for e in result.events] == pytest.approx(times, abs=1e-9)


def test_a_box_departs_with_what_it_carries() -> None:
    """Both depart where 3 t is 0.05 of both weights. Then 3 t - 0.35 g moves the point alone."""
    result = frot.load(HERE / "box_departs_with_its_load.frot").simulate()
    begun = [(e.liaison[0], e.time) for e in result.events if e.after == "slip"]
    assert [name for name, _ in begun] == ["g"] * 4 + ["c"]
    assert [time for _, time in begun] == pytest.approx([0.4905] * 4 + [1.4715], abs=1e-10)
