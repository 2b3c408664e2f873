"""One run of a setting, judged; and the worker that does many of one text in its own process."""

from __future__ import annotations

import json
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field

import numpy as np

import frot
from judge.alike import FAMILIES as ALIKE
from judge.anything import FAMILIES as ANYTHING
from judge.check import Judge
from judge.collisions.families import FAMILIES as COLLISIONS
from judge.collisions.scene import ImpactScene
from judge.collisions.trial import try_impacts
from judge.compare import compare
from judge.family import Family, Setting, Structure
from judge.guesses import FAMILIES as GUESSES
from judge.held import FAMILIES as HELD
from judge.impacts import impact_times
from judge.machines import FAMILIES as MACHINES
from judge.others import Ran, agree
from judge.space.families import FAMILIES as SPACE
from judge.space.scene import SpaceScene
from judge.space.trial import try_mechanism
from judge.speeds import judge_refusal, judge_speeds
from judge.tables import FAMILIES as TABLES
from judge.verdict import (
    EXACT,
    SILENT,
    SLOW,
    Verdict,
    judge_several,
    judge_start,
    judge_stop,
)
from judge.write import END, write

FAMILIES: dict[str, Family] = {
    f.name: f for f in (*ANYTHING, *MACHINES, *TABLES, *GUESSES, *HELD, *ALIKE, *SPACE, *COLLISIONS)
}

# Steps that a radian or an event is worth at most, where a run takes its time.
BUSY = 20


@dataclass(slots=True)
class Record:
    """What became of one run; `key` is seed, family, structure, setting."""

    key: tuple[int, str, int, int]
    verdict: str
    why: list[str] = field(default_factory=list)
    seconds: float = 0.0
    worst: dict[str, float] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)


def structure_of(seed: int, family: str, number: int) -> Structure:
    rng = np.random.default_rng([seed, list(FAMILIES).index(family), number])
    return FAMILIES[family].make(rng)


def setting_of(structure: Structure, seed: int, family: str, number: int, setting: int) -> Setting:
    rng = np.random.default_rng([seed, list(FAMILIES).index(family), number, setting + 1])
    return structure.draw(rng)


def turns_on(structure: Structure, result: frot.Result) -> bool:
    """Whether a run is long for what happens in it: turns, in radians, and events."""
    fast = sum(
        float(np.mean(np.abs(result[f"{b.name}.angular_velocity"])))
        for b in structure.scene.bodies
        if b.turns
    )
    turned = fast * float(result.time[-1] - result.time[0])
    return result.figures.steps <= BUSY * (turned + len(result.events))


def try_setting(
    model: frot.Model, structure: Structure, setting: Setting, seed: int, limit: float
) -> Verdict:
    """Run and judge; `limit` is processor time of the run in seconds."""
    if isinstance(structure.scene, SpaceScene):
        return try_mechanism(model, structure.scene, setting, seed, limit)
    if isinstance(structure.scene, ImpactScene):
        return try_impacts(model, structure.scene, setting, seed, limit)
    late: list[int] = []

    def fresh() -> Callable[[float], bool]:
        deadline = time.process_time() + limit

        def watch(_: float) -> bool:
            if time.process_time() > deadline:
                late.append(1)
            return bool(late)

        return watch

    def run(values: Mapping[str, float], tolerance: float) -> frot.Result:
        every = {**values, END: setting.stop}
        return model.simulate(tolerance=tolerance, parameters=every, watch=fresh())

    def whole(values: Mapping[str, float], tolerance: float) -> frot.Result | None:
        try:
            other = run(values, tolerance)
        except frot.FrotError:
            return None
        return None if late else other

    error: frot.FrotError | None = None
    result: frot.Result | None = None
    try:
        result = run(setting.values, setting.tolerance)
    except frot.SimulationError as stop:
        error, result = stop, stop.result
    except frot.FrotError as refused:
        error = refused
    if late and not (result is not None and turns_on(structure, result)):
        reached = (
            ""
            if result is None
            else f" reached {result.time[-1]!r} of {setting.stop!r} s, {result.figures.steps} steps"
        )
        return Verdict(SLOW, [f"more than {limit:g} s:{reached}"])
    code, text = _told(error) if error is not None else ("", "")
    if result is None:
        verdict = _unstarted(structure, setting, code, text, whole)
    else:
        verdict = _started(structure, setting, result, code, text, whole, seed, bool(late))
    met = result is not None and impact_times(result.events)
    if structure.others and not late and not met:
        judge = result and Judge(structure.scene, setting.values, result, setting.tolerance)
        ran = Ran(result, code, 0.0 if result is None else float(result.time[-1]))
        faults = agree(judge, ran, structure.others, setting, fresh(), seed)
        if faults:
            verdict = Verdict(SILENT, faults + verdict.why, verdict.worst)
    return verdict


Whole = Callable[[Mapping[str, float], float], frot.Result | None]


def _unstarted(
    structure: Structure, setting: Setting, code: str, text: str, whole: Whole
) -> Verdict:
    """A run without a start."""
    scene = structure.scene
    refusal = judge_refusal(scene, setting.values, setting.stop, structure.speeds, text)
    if refusal is not None:
        return refusal
    smooth = {k: 0.0 if k.startswith(("mu", "nu")) else x for k, x in setting.values.items()}
    return judge_start(scene, setting, code, text, whole(smooth, setting.tolerance))


def _started(
    structure: Structure,
    setting: Setting,
    result: frot.Result,
    code: str,
    text: str,
    whole: Whole,
    seed: int,
    late: bool,
) -> Verdict:
    """A run that starts; of one that is `late` what it reached is judged."""
    judge = Judge(structure.scene, setting.values, result, setting.tolerance)
    judge.placed = setting.start_known
    found = judge.examine(np.random.default_rng(seed), stopped=bool(code))
    found.faults += judge_several(judge)
    if structure.speeds:
        found.faults += judge_speeds(
            structure.scene, setting.values, setting.stop, structure.speeds, judge
        )
    stop = Verdict(EXACT)
    if late:
        pass
    elif code:
        stop = judge_stop(judge, code, text, float(result.time[-1]))
    elif abs(result.time[-1] - setting.stop) > 1e-12 * abs(setting.stop):
        found.faults.append(f"ends early: at {result.time[-1]!r} of {setting.stop!r}")
    elif setting.compare and setting.tolerance > 1e-11 and not impact_times(result.events):
        found.faults += compare(structure.scene, setting, result, whole, seed)
    if found.faults:
        return Verdict(SILENT, found.faults + stop.why, found.worst)
    return Verdict(stop.kind, stop.why, found.worst)


def _told(error: frot.FrotError) -> tuple[str, str]:
    first = error.diagnostics[0]
    return first.code, f"{first.code}: {first.message}"


def work(job: dict[str, object]) -> None:
    """Do settings of one text and write a line of JSON for each."""
    seed, family, number = int(job["seed"]), str(job["family"]), int(job["number"])  # type: ignore[call-overload]
    structure = structure_of(seed, family, number)
    text = write(structure.scene)

    def tell(kind: str, **what: object) -> None:
        print(json.dumps({"kind": kind, **what}), flush=True)

    try:
        model = frot.compile(text)
        model.program()
    except frot.FrotError as refused:
        tell("text", why=str(refused))
        return
    tell("compiled")
    for k in job["settings"]:  # type: ignore[attr-defined]
        tell("begin", setting=k)
        setting = setting_of(structure, seed, family, number, k)
        begun = time.process_time()
        try:
            verdict = try_setting(model, structure, setting, k, float(job["limit"]))  # type: ignore[arg-type]
        except Exception:
            verdict = Verdict("broken", [traceback.format_exc(limit=-4)])
        record = Record(
            (seed, family, number, k),
            verdict.kind,
            verdict.why,
            time.process_time() - begun,
            verdict.worst,
            verdict.counts,
        )
        tell("record", record=asdict(record))


if __name__ == "__main__":
    work(json.loads(sys.stdin.read()))
