"""One run of a mechanism in space, judged."""

from __future__ import annotations

import numpy as np

import frot
from judge.attempt import attempt
from judge.family import Setting
from judge.space.check import SpaceJudge
from judge.space.scene import SpaceScene
from judge.verdict import CONFIRMED, EXACT, REFUTED, SILENT, Verdict


def try_mechanism(
    model: frot.Model, scene: SpaceScene, setting: Setting, seed: int, limit: float
) -> Verdict:
    """Run and judge; a start exists always, and a run stops rightly in a singular posture only."""
    made = attempt(model, setting, limit)
    if isinstance(made, Verdict):
        return made
    result, message = made
    judge = SpaceJudge(scene, setting, result)
    found = judge.examine(np.random.default_rng(seed))
    if found.faults:
        return Verdict(SILENT, found.faults + [message] * bool(message), found.worst)
    if not message:
        return Verdict(EXACT, [], found.worst)
    end = float(result.time[-1])
    if judge.singular(end):
        return Verdict(CONFIRMED, [f"a singular posture: {message}"], found.worst)
    return Verdict(REFUTED, [message], found.worst)
