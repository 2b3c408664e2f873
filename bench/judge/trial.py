"""One run of a setting, judged; and the worker that does many of one text in its own process."""

from __future__ import annotations

import json
import sys
import time
import traceback
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

import numpy as np

import frot
from judge.anything import FAMILIES as ANYTHING
from judge.check import Judge
from judge.compare import compare
from judge.family import Family, Setting, Structure
from judge.machines import FAMILIES as MACHINES
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

FAMILIES: dict[str, Family] = {f.name: f for f in (*ANYTHING, *MACHINES, *TABLES)}

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
    late: list[int] = []

    def run(values: Mapping[str, float], tolerance: float) -> frot.Result:
        deadline = time.process_time() + limit

        def watch(_: float) -> bool:
            if time.process_time() > deadline:
                late.append(1)
            return bool(late)

        every = {**values, END: setting.stop}
        return model.simulate(tolerance=tolerance, parameters=every, watch=watch)

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
    if error is not None and result is None:
        smooth = {k: 0.0 if k.startswith(("mu", "nu")) else x for k, x in setting.values.items()}
        begun = whole(smooth, setting.tolerance)
        return judge_start(structure.scene, setting, *_told(error), begun)
    assert result is not None
    rng = np.random.default_rng(seed)
    judge = Judge(structure.scene, setting.values, result, setting.tolerance)
    found = judge.examine(rng, stopped=error is not None)
    found.faults += judge_several(judge)
    stop = Verdict(EXACT)
    if late:  # what was reached is judged
        pass
    elif error is not None:
        code, text = _told(error)
        stop = judge_stop(judge, code, text, float(result.time[-1]))
    elif abs(result.time[-1] - setting.stop) > 1e-12 * abs(setting.stop):
        found.faults.append(f"ends early: at {result.time[-1]!r} of {setting.stop!r}")
    elif setting.compare and setting.tolerance > 1e-11:
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
        )
        tell("record", record=asdict(record))


if __name__ == "__main__":
    work(json.loads(sys.stdin.read()))
