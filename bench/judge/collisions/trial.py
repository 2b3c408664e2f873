"""One run of a scene with impacts, judged."""

from __future__ import annotations

import numpy as np

import frot
from judge.attempt import attempt
from judge.collisions.check import ImpactJudge
from judge.collisions.rows import Bodies
from judge.collisions.scene import ImpactScene
from judge.family import Setting
from judge.verdict import CONFIRMED, EXACT, REFUTED, SILENT, Verdict

# Painleve's coefficient, in parts of W_nn, below which friction jams a contact: a documented end.
JAMS = 0.02


def try_impacts(
    model: frot.Model, scene: ImpactScene, setting: Setting, seed: int, limit: float
) -> Verdict:
    """Run and judge; a start exists always, and a run stops rightly where friction jams alone."""
    made = attempt(model, setting, limit)
    if isinstance(made, Verdict):
        return made
    result, message = made
    judge = ImpactJudge(scene, setting, result)
    found = judge.examine(np.random.default_rng(seed))
    counts = dict(judge.counts)
    end = float(result.time[-1])
    if not message and abs(end - setting.stop) > 1e-12 * setting.stop:
        found.faults.append(f"ends early: at {end!r} of {setting.stop!r}")
    if found.faults:
        return Verdict(SILENT, found.faults + [message] * bool(message), found.worst, counts)
    if not message:
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
