"""One run of a scene with impacts, judged."""

from __future__ import annotations

import time

import numpy as np

import frot
from judge.collisions.check import ImpactJudge
from judge.collisions.rows import Bodies
from judge.collisions.scene import END, ImpactScene
from judge.family import Setting
from judge.verdict import CONFIRMED, EXACT, REFUTED, SILENT, SLOW, Verdict

# Painleve's coefficient, in parts of W_nn, below which friction jams a contact: a documented end.
JAMS = 0.02


def try_impacts(
    model: frot.Model, scene: ImpactScene, setting: Setting, seed: int, limit: float
) -> Verdict:
    """Run and judge; a start exists always, and a run stops rightly where friction jams alone."""
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
    judge = ImpactJudge(scene, setting, result)
    found = judge.examine(np.random.default_rng(seed))
    counts = dict(judge.counts)
    end = float(result.time[-1])
    if not message and abs(end - setting.stop) > 1e-12 * setting.stop:
        found.faults.append(f"ends early: at {end!r} of {setting.stop!r}")
    if found.faults:
        return Verdict(SILENT, found.faults + [message] * bool(message), found.worst, counts)
    if error is None:
        return Verdict(EXACT, [], found.worst, counts)
    if message.startswith("E09") and jams(judge.bodies(end), judge.length):
        return Verdict(CONFIRMED, [f"friction jams: {message}"], found.worst, counts)
    return Verdict(REFUTED, [message], found.worst, counts)


def jams(now: Bodies, length: float) -> bool:
    """Whether friction may press a contact that is closed: W_nn <= mu |W_nt|."""
    inverse = now.mobility()
    for m in now.meetings.values():
        if len(m.rows) > 1 and abs(m.gap) < 1e-6 * length:
            w = m.rows @ inverse @ m.rows.T
            if w[0, 0] - max(m.mu, m.mu_s) * np.linalg.norm(w[0, 1:]) < JAMS * w[0, 0]:
                return True
    return False
