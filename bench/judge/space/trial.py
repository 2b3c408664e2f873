"""One run of a mechanism in space, judged."""

from __future__ import annotations

import time

import numpy as np

import frot
from judge.family import Setting
from judge.space.check import SpaceJudge
from judge.space.scene import END, SpaceScene
from judge.verdict import CONFIRMED, EXACT, REFUTED, SILENT, SLOW, Verdict


def try_mechanism(
    model: frot.Model, scene: SpaceScene, setting: Setting, seed: int, limit: float
) -> Verdict:
    """Run and judge; a start exists always, and a run stops rightly in a singular posture only."""
    deadline = time.process_time() + limit
    late: list[int] = []

    def watch(_: float) -> bool:
        if time.process_time() > deadline:
            late.append(1)
        return bool(late)

    error: frot.FrotError | None = None
    result: frot.Result | None = None
    try:
        every = {**setting.values, END: setting.stop}
        result = model.simulate(tolerance=setting.tolerance, parameters=every, watch=watch)
    except frot.SimulationError as stop:
        error, result = stop, stop.result
    except frot.FrotError as refused:
        error = refused
    if late:
        reached = "" if result is None else f" {result.time[-1]!r} of {setting.stop!r} s"
        return Verdict(SLOW, [f"more than {limit:g} s:{reached}"])
    message = (
        "" if error is None else f"{error.diagnostics[0].code}: {error.diagnostics[0].message}"
    )
    if result is None:
        return Verdict(REFUTED, [f"no start: {message}"])
    judge = SpaceJudge(scene, setting, result)
    found = judge.examine(np.random.default_rng(seed))
    if found.faults:
        return Verdict(SILENT, found.faults + [message] * bool(message), found.worst)
    if error is None:
        return Verdict(EXACT, [], found.worst)
    end = float(result.time[-1])
    if judge.singular(end):
        return Verdict(CONFIRMED, [f"a singular posture: {message}"], found.worst)
    return Verdict(REFUTED, [message], found.worst)
