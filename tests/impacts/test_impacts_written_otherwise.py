"""A run with impacts depends on its tolerance by its error alone, and not on how it is written."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from written_otherwise import SCENES, Floats, Way

import frot

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
# Where bounces accumulate, the last flights, lower than 4e-9 of the size, are contact: the limit
# has that error at every tolerance.
FLOOR = {"thrown_rod": 1e-11, "chain": 1e-7, "discs": 3e-8, "cord_in_space": 3e-8}
WAYS = {
    "mm, g, ms": Way(small=True),
    "turned": Way(turn=(0.0, 0.0, 0.7)),
    "mirrored": Way(mirrored=True),
    "reordered": Way(reverse=True),
    "all of these": Way(True, (0.0, 0.0, -2.1), True, True),
}
TUMBLED = {
    "turned": Way(turn=(0.3, -0.8, 1.1)),
    "all of these": Way(True, (1.0, 2.0, -0.5), True, True),
}
# An angle that is mirrored comes to its other bound.
OTHER = {"k.stops.min": "k.stops.max"}


@functools.cache
def run(name: str, way: Way, tolerance: float) -> tuple[dict[str, Floats], tuple[frot.Event, ...]]:
    """Places and speeds at the end, in SI and in the axes of the first way, and the events."""
    result = frot.compile(SCENES[name](way)).simulate(tolerance=tolerance)
    end = result.at([result.time[-1]])
    plane = "a.position.z" not in result
    state = {}
    for body in "ab":
        for of in ("position", "velocity", "angular_velocity"):
            scalar = plane and of == "angular_velocity"
            if f"{body}.{of}" + ("" if scalar else ".x") not in result:
                continue
            if scalar:
                state[f"{body}.{of}"] = np.array([way.sign * end[f"{body}.{of}"][0]])
                continue
            v = np.array([end[f"{body}.{of}.{k}"][0] for k in "xyz"[: 3 - plane]] + [0.0] * plane)
            state[f"{body}.{of}"] = (way.sign if of[0] == "a" else 1.0) * way.matrix.T @ v
    return state, result.events


def apart(one: dict[str, Floats], other: dict[str, Floats]) -> float:
    """The largest difference; lengths, speeds and spins are of the order of one."""
    assert one.keys() == other.keys()
    return max(float(np.max(np.abs(one[k] - other[k]))) for k in one)


def impacts(events: tuple[frot.Event, ...]) -> list[tuple[str, frot.Event]]:
    """The first impacts, before bounces accumulate, those of one instant by their names."""
    struck = [e for e in events if e.kind == "impact" and e.impulse > 1e-12][:4]
    named = [(OTHER.get(e.liaison, e.liaison), e) for e in struck]
    return sorted(named, key=lambda x: (round(x[1].time, 9), x[0]))


def alike(one: tuple[frot.Event, ...], other: tuple[frot.Event, ...], error: float) -> None:
    """The same contacts strike at the same instants, with the same impulses and losses."""
    pairs = list(zip(impacts(one), impacts(other), strict=True))
    assert len(pairs) >= 2
    for (name, a), (same, b) in pairs:
        assert name == same
        assert a.phases == b.phases
        for word in ("time", "impulse", "energy_lost"):
            assert getattr(a, word) == pytest.approx(getattr(b, word), abs=error), (name, word)


@pytest.mark.parametrize("name", SCENES)
def test_the_tolerance_changes_a_run_with_impacts_by_its_error(name: str) -> None:
    exact, events = run(name, Way(), 1e-13)
    for tolerance in TOLERANCES:
        state, found = run(name, Way(), tolerance)
        alike(found, events, 100 * tolerance + 1e-10)
        assert apart(state, exact) <= 1000 * tolerance + FLOOR.get(name, 1e-10)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", SCENES)
def test_a_run_with_impacts_is_the_same_however_it_is_written(name: str, way: str) -> None:
    first, events = run(name, Way(), 1e-10)
    chosen = TUMBLED.get(way, WAYS[way]) if "space" in name else WAYS[way]
    state, found = run(name, chosen, 1e-10)
    alike(found, events, 1e-9)
    assert apart(state, first) <= FLOOR.get(name, 1e-10)
