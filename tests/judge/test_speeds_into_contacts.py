"""The judge knows how guessed speeds into contacts are corrected, and that stated are refused."""

from __future__ import annotations

import numpy as np
import pytest
from judge.check import Judge
from judge.family import Setting, Structure
from judge.scene import Contact, Scene
from judge.speeds import Speeds, judge_refusal, judge_speeds
from judge.trial import try_setting
from judge.verdict import CONFIRMED, EXACT, REFUTED, Start, judge_start
from judge.write import write

import frot

AT = {"x0_bar": 0.0, "y0_bar": 0.1, "a0_bar": 0.0}
VALUES = {
    "m_bar": 2.0,
    "l_bar": 1.0,
    "x_floor": 0.0,
    "y_floor": 0.0,
    "a_floor": 0.0,
    "x_f0": -0.5,
    "y_f0": -0.1,
    "x_f1": 0.5,
    "y_f1": -0.1,
    **AT,
}


def bar(how: str) -> Scene:
    """A rod on two feet whose gaps are stated to be zero."""
    s = Scene("Bar")
    rod = s.body("bar", "rod")
    floor = s.line("floor", None)
    for i in range(2):
        s.contacts.append(Contact(f"c{i}", floor, s.frame(f"f{i}", rod)))
    words = ("position.x", "position.y", "angle", "velocity.x", "velocity.y", "angular_velocity")
    kinds = ("Length", "Length", "Angle", "Velocity", "Velocity", "AngularVelocity")
    for key, word, kind in zip("xyauvw", words, kinds, strict=True):
        text = f"bar.{word} = {s.parameter(f'{key}0_bar', kind).text}"
        s.statements.append(text if how == "stated" and key in "uvw" else f"guess({text})")
    s.statements += ["c0.gap = 0 m", "c1.gap = 0 m"]
    return s


# guessed (vx, vy, w), and the nearest that enters no foot: the feet have vy -+ w/2; one foot alone
# is left with 0 by a percussion there, of m/4 effective mass at the end of a rod
SPEEDS = (
    ((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
    ((1.0, 2.0, 1.0), (1.0, 2.0, 1.0)),
    ((1.0, -2.0, 0.0), (1.0, 0.0, 0.0)),
    ((0.5, 1.0, 3.0), (0.5, 1.125, 2.25)),
    ((0.5, -1.0, 8.0), (0.5, 0.25, 0.5)),
)


def values(speed: tuple[float, ...]) -> dict[str, float]:
    return VALUES | {f"{k}0_bar": x for k, x in zip("uvw", speed, strict=True)}


@pytest.mark.parametrize(("guess", "right"), SPEEDS)
def test_the_nearest_speeds_are_known(guess: tuple[float, ...], right: tuple[float, ...]) -> None:
    """Percussions at the feet alone: m v' = m v + P, I w' = I w + arm P."""
    found = Speeds(bar("guessed"), values(guess), 1.0).corrected()
    assert found == pytest.approx(np.array(right), abs=1e-12)


@pytest.mark.parametrize(("guess", "right"), SPEEDS)
def test_a_run_takes_the_nearest_speeds(guess: tuple[float, ...], right: tuple[float, ...]) -> None:
    scene = bar("guessed")
    setting = Setting(values(guess), 0.01)
    structure = Structure(scene, lambda _: setting, speeds="guessed")
    verdict = try_setting(frot.compile(write(scene)), structure, setting, 1, 20.0)
    assert verdict.kind == EXACT, verdict.why


class Moving(Start):
    """A record of a start with other speeds."""

    def __init__(self, speed: tuple[float, ...]) -> None:
        super().__init__(bar("guessed"), values(speed), 1.0)


@pytest.mark.parametrize("speed", [(1.0, -2.0, 0.0), (1.0, 1e-6, 0.0), (1.0 + 1e-6, 0.0, 0.0)])
def test_other_speeds_are_refuted(speed: tuple[float, ...]) -> None:
    """Not corrected, corrected too much, or changed along the floor."""
    given = values((1.0, -2.0, 0.0))
    judge = Judge(bar("guessed"), given, Moving(speed), 1e-9)  # type: ignore[arg-type]
    assert judge_speeds(bar("guessed"), given, 1.0, "guessed", judge)


def test_a_stated_speed_into_a_contact_is_an_impact_at_the_start() -> None:
    into, along = values((1.0, -2.0, 0.0)), values((1.0, 0.0, 0.0))
    scene = bar("stated")
    judge = Judge(scene, into, Moving((1.0, 0.0, 0.0)), 1e-9)  # type: ignore[arg-type]
    assert judge_speeds(scene, into, 1.0, "stated", judge)
    refused = judge_refusal(scene, into, 1.0, "stated", "E0601: contradict")
    assert refused is not None and refused.kind == REFUTED
    assert judge_refusal(scene, along, 1.0, "stated", "E0601: contradict") is None
    result = frot.compile(write(scene)).simulate(parameters=into, stop=0.01)
    assert {(e.kind, e.time) for e in result.events if e.kind == "impact"} == {("impact", 0.0)}


def test_sizes_of_speeds_are_those_of_the_feet() -> None:
    """A speed of 1e-12 m/s into a contact is rounding beside one of 1 m/s along it."""
    slow, fast = (
        Speeds(bar("guessed"), values((1.0, v, 0.0)), 1.0).enters() for v in (-1e-12, -1e-3)
    )
    assert slow < 1e-9 < fast


@pytest.mark.parametrize(
    ("speed", "known", "kind"),
    [
        ((1.0, -2.0, 0.0), True, CONFIRMED),
        ((1.0, 0.0, 0.0), True, REFUTED),
        ((1.0, -2.0, 0.0), False, REFUTED),
    ],
)
def test_bodies_meet_at_the_start_by_stated_speeds_alone(
    speed: tuple[float, ...], known: bool, kind: str
) -> None:
    """E0905 at the start is right where a stated speed enters a contact, never for guesses."""
    setting = Setting(values(speed), 1.0, start_known=known)
    text = "E0905: liaison 'c0': the bodies meet"
    assert judge_start(bar("stated"), setting, "E0905", text, None).kind == kind
