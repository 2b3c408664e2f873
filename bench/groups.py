"""Does a group of bodies move as it does alone, whatever stands beside it, in whatever units?

    python bench/groups.py --seed 1 --count 200

Each scene has three groups that nothing binds together (`drawn_groups.py`). It is run whole, group
by group, with lengths in mm and masses in g, and in axes turned by right angles; starts and motions
are compared. What differs is printed with its text; the exit status is 1 then.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import frot

sys.path.insert(0, str(Path(__file__).parent))

from drawn_groups import PLAIN, Axes, Group, draw_group, text_of

# Of a start, and of a motion at the tolerance of the texts; both in SI, for values of about 1.
START, MOTION = 1e-8, 1e-6
BALANCE = 1e-7
WRITTEN = (Axes(small_units=True), Axes(turns=1), Axes(turns=2), Axes(turns=3))


@dataclass(frozen=True)
class Run:
    """A run, or the code of the message that refused it; `end` is the last time it reached."""

    result: frot.Result | None
    refusal: str
    end: float


def run(text: str) -> Run:
    """Run a text; one that stops on the way is kept up to there."""
    try:
        result = frot.compile(text).simulate()
    except frot.FrotError as error:
        kept = getattr(error, "result", None)
        code = str(error).partition("[")[2].partition("]")[0]
        return Run(kept, code, float(kept.time[-1]) if kept is not None else -1.0)
    return Run(result, "", float(result.time[-1]))


def values_of(result: frot.Result, group: Group, t: float, axes: Axes) -> dict[str, float]:
    """Places, speeds and gaps of a group at a time, in axes that are not turned."""
    at, found = result.at(t), {}
    back = Axes(-axes.turns % 4)
    for body in group.bodies:
        for what in ("position", "velocity"):
            x, y = back.turned(float(at[f"{body}.{what}.x"]), float(at[f"{body}.{what}.y"]))
            found[f"{body}.{what}.x"], found[f"{body}.{what}.y"] = x, y
        if f"{body}.angle" in result:
            found[f"{body}.angle"] = float(at[f"{body}.angle"]) - axes.turns * np.pi / 2
            found[f"{body}.angular_velocity"] = float(at[f"{body}.angular_velocity"])
    for contact in group.contacts:
        found[f"{contact}.gap"] = float(at[f"{contact}.gap"])
    return found


def differences(
    one: Run, other: Run, groups: Sequence[Group], axes: Axes = PLAIN
) -> list[tuple[str, float, float, float]]:
    """Values that differ: name, time, the value of `one`, that of `other` in `axes`."""
    if (one.result is None) != (other.result is None):
        return [(f"refused: {one.refusal or 'no'}, {other.refusal or 'no'}", 0, 0, 0)]
    if one.result is None or other.result is None:
        return []
    end, found = min(one.end, other.end), []
    for t, bound in ((0.0, START), (0.5 * end, MOTION), (0.99 * end, MOTION)):
        for group in groups:
            first = values_of(one.result, group, t, PLAIN)
            second = values_of(other.result, group, t, axes)
            found += [
                (name, t, first[name], second[name])
                for name in first
                if not abs(first[name] - second[name]) <= bound * (1 + abs(first[name]))
            ]
        if found:
            break
    return found


def examine(seed: int, number: int, others: Sequence[Axes] = WRITTEN) -> tuple[int, list[str]]:
    """How many groups of a scene start, and what is wrong with them; `others` are compared too."""
    chance = np.random.default_rng((seed, number))
    groups = [draw_group(chance, f"_{k}") for k in range(3)]
    gravity = float(chance.choice([0.0, chance.uniform(0.5, 10)]))
    faults: list[str] = []
    alone = [run(text_of([group], gravity)) for group in groups]
    able = [group for group, own in zip(groups, alone, strict=True) if own.result is not None]
    runs = [own for own in alone if own.result is not None]
    for group, own in zip(able, runs, strict=True):
        text = text_of([group], gravity)
        faults += [f"{fault}\n{text}" for fault in _wrong(own, group)]
        for axes in others:
            found = differences(own, run(text_of([group], gravity, axes)), [group], axes)
            if found:
                faults.append(f"{axes}: {found[:2]}\n{text}")
    if len(able) > 1:
        whole = run(text_of(able, gravity))
        for group, own in zip(able, runs, strict=True):
            found = differences(own, whole, [group])
            if found:
                faults.append(f"beside others: {found[:2]}\n{text_of(able, gravity)}")
    return len(able), faults


def _wrong(own: Run, group: Group) -> list[str]:
    """What one run alone shows: bodies in each other, and energy that is not kept."""
    assert own.result is not None
    found = [
        f"{contact}.gap = {float(own.result[f'{contact}.gap'][0])} at the start"
        for contact in group.contacts
        if not own.result[f"{contact}.gap"][0] >= -1e-8
    ]
    if abs(own.result.balance.relative) > BALANCE:
        found.append(f"energy is not kept: {own.result.balance}")
    if own.refusal and own.end <= 1e-9:
        found.append(f"it ends at t = {own.end} with {own.refusal}")
    return found


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--beside", action="store_true", help="neither other units nor other axes")
    chosen = parser.parse_args()
    others = () if chosen.beside else WRITTEN
    ran = wrong = 0
    for number in range(chosen.first, chosen.first + chosen.count):
        count, faults = examine(chosen.seed, number, others)
        ran, wrong = ran + count, wrong + bool(faults)
        for fault in faults:
            print(f"scene {number}: {fault}", flush=True)
    print(f"{chosen.count} scenes, {ran} groups that start, {wrong} scenes with differences")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
