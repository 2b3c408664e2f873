"""Bodies locked to each other by a loop move as one body, at the speed that is given."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import frot

pytestmark = pytest.mark.finding

TEXT = (Path(__file__).parents[2] / "scenes" / "locked_bodies.frot").read_text(encoding="utf-8")
STATED = re.sub(r"  guess\(b\d\.\w+ = .*\n", "", TEXT).replace(
    "initial\n", "initial\n  J0.speed = 0.7 rad/s;\n"
)
WELDED = re.sub(r".*helicoidale.*\n|.*oJ1.*\n|  J1\.angle = .*\n", "", STATED)
WELDED = re.sub(r"J2: rotoide\(f6, f5, .*", "J2: encastrement(f6, f5);", WELDED)


def test_rounding_of_a_lock_is_no_posture():
    """One motion begins: that about the hinge, near the speeds that are guessed."""
    run = frot.compile(TEXT).simulate()

    assert 0.3 < run["J0.speed"][0] < 0.8
    assert run["J1.angle"] == pytest.approx(-2.7115789192759543, abs=1e-9)


@pytest.mark.parametrize("gravity", ["4.591872302227323", "0"])
def test_locked_bodies_move_as_one(gravity):
    """They do what the same bodies do that are welded."""
    texts = (x.replace("4.591872302227323", gravity) for x in (STATED, WELDED))
    locked, welded = (frot.compile(x).simulate() for x in texts)
    assert locked["J0.speed"][0] == pytest.approx(0.7, rel=1e-12)
    for at in (0.2, 0.5):
        for name in ("J0.angle", "J0.speed"):
            found, wanted = locked.at(at)[name], welded.at(at)[name]
            assert found == pytest.approx(wanted, abs=1e-7)
