"""The list of admissible motions beside the runs of random planar scenes: see `judge/`.

    python bench/listed_motions.py --seed 1 --count 500

At the start of each run, at its first events and where it stops, the accelerations that the run
continues with must be those of a listed motion; where it stops for want of one, none may be listed.
Scenes differ where they are printed, with what they differ in.
"""

from __future__ import annotations

import argparse
import signal
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from frot.runtime import motions as listing
from frot.runtime.run import begin, simulate
from judge.space.scene import SpaceScene
from judge.trial import FAMILIES, setting_of, structure_of
from judge.write import END, write

import frot
from frot.second import second_program

MOST_EVENTS = 4
# Part of the largest acceleration by which those of one motion differ.
ALIKE = 1e-6
# Seconds after which a run, or a list, is left out.
LIMIT = 20.0
IMPASSE = "E0902"


class Late(Exception):
    """Something takes too long."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    def stop(*_: object) -> None:
        raise Late

    signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def distance(own: Mapping[str, float], run: Mapping[str, float], size: float) -> float:
    return max((abs(own[n] - run[n]) for n in own), default=0.0) / size


def compare(program: frot.runtime.program.Program, values: dict[str, float], tolerance: float):
    """Outcomes of one run: (what, time, words)."""
    error, result = None, None
    try:
        result = simulate(program, parameters=values, tolerance=tolerance)
    except frot.SimulationError as stopped:
        error, result = stopped, stopped.result
    except frot.FrotError:
        return [("refused", 0.0, "")]
    if result is None and error is not None and error.diagnostics[0].code != IMPASSE:
        return [("refused", 0.0, "")]
    stopped = error is not None and error.diagnostics[0].code == IMPASSE
    several = stopped and "admissible motions" in error.diagnostics[0].message
    times = [] if result is None else [float(result.time[0])]
    if result is not None:
        end = float(result.time[-1])
        times += sorted({e.time for e in result.events if times[0] < e.time < end})[:MOST_EVENTS]
    found = []
    engine = begin(program, parameters=values, tolerance=tolerance, tolerated=listing.STOPS)
    at_start = engine.fault.status in listing.STOPS
    for t in times or [0.0]:
        if t > engine.time:
            engine.advance(t)
        began = time.perf_counter()
        status, raw, memory = engine.motions(listing.NODES)
        seconds = time.perf_counter() - began
        if status != 0:
            found.append(("no list", t, engine.fault_text))
            continue
        told = listing._read(program, engine, raw)
        del memory
        if seconds > 1:
            found.append(("slow", t, f"{seconds:.2f} s, {told.nodes} nodes"))
        if not told.complete:
            found.append(("budget", t, f"{told.nodes} nodes"))
        if at_start:
            kind = "same" if (len(told) == 0 or several) else "run stops, motions listed"
            found.append((kind, t, f"{error.diagnostics[0].message[:150]} | {told}"))
            continue
        run = result.at(t)
        for part in told.parts:
            names = list(told[0].accelerations) if len(list(told)) else []
            if not part.motions:
                found.append(("run continues, none listed", t, f"{part.liaisons}"))
                continue
            size = max((abs(m.accelerations[n]) for m in told for n in names), default=0.0)
            size = max(size, max((abs(run[n]) for n in names), default=0.0), 1e-3)
            near = min(distance(m.accelerations, run, size) for m in part.motions)
            one_part = len(told.parts) == 1
            if one_part and near > ALIKE:
                shown = {n: f"{run[n]:.6g}" for n in names}
                found.append(("run's motion not listed", t, f"{near:.2g} {shown}\n{told}"))
            else:
                found.append(("same" if len(part.motions) == 1 else "one of several", t, ""))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--settings", type=int, default=8, help="of each text")
    parser.add_argument("--only", default="")
    parser.add_argument("--show", action="store_true", help="print the texts of what differs")
    options = parser.parse_args()
    only = [x for x in options.only.split(",") if x]
    chosen = {n: f for n, f in FAMILIES.items() if not only or n in only}
    total = sum(f.weight for f in chosen.values())
    counts: Counter[str] = Counter()
    for name, family in chosen.items():
        runs, number = max(1, round(options.count * family.weight / total)), 0
        while runs > 0:
            here = min(runs, options.settings)
            structure = structure_of(options.seed, name, number)
            runs -= here
            if isinstance(structure.scene, SpaceScene):
                break
            text = write(structure.scene)
            try:
                program = second_program(frot.compile(text), "motions", orders=True)
            except frot.FrotError as error:
                print(name, number, error.diagnostics[0].code, flush=True)
                number += 1
                continue
            for k in range(here):
                setting = setting_of(structure, options.seed, name, number, k)
                values = {**setting.values, END: setting.stop}
                try:
                    with limited(LIMIT):
                        found = compare(program, values, setting.tolerance)
                except Late:
                    found = [("late", 0.0, "")]
                for kind, t, words in found:
                    counts[kind] += 1
                    if kind not in ("same", "one of several", "refused"):
                        print(f"{name} {number} {k} at {t!r}: {kind} {words}", flush=True)
                        if options.show:
                            print(text, {**values})
            number += 1
    print(dict(counts))


if __name__ == "__main__":
    main()
