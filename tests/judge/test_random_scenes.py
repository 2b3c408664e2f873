"""Some hundred runs of random scenes, judged by Newton-Euler alone: exact, or rightly refused.

`bench/random_scenes.py` does thousands; here are texts of every family, each with many settings.
"""

from __future__ import annotations

import pytest
from judge.trial import setting_of, structure_of, try_setting
from judge.verdict import CONFIRMED, EXACT
from judge.write import write

import frot

SEED = 3
# family, number of its text, settings
SCENES = (
    ("anything", 1, 20),
    ("chain", 0, 24),
    ("blocks", 0, 24),
    ("rest", 0, 40),
    ("crank", 0, 12),
    ("trammel", 0, 40),
    ("legs", 0, 25),
    ("zero", 0, 30),
)


@pytest.mark.parametrize(("family", "number", "settings"), SCENES)
def test_every_run_of_random_scenes_is_exact_or_rightly_refused(
    family: str, number: int, settings: int
) -> None:
    structure = structure_of(SEED, family, number)
    model = frot.compile(write(structure.scene))
    wrong = {}
    for k in range(settings):
        verdict = try_setting(
            model, structure, setting_of(structure, SEED, family, number, k), k, 20.0
        )
        if verdict.kind not in (EXACT, CONFIRMED):
            wrong[k] = (verdict.kind, verdict.why[:2])
    assert not wrong
