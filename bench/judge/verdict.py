"""What a run was: exact, refused and confirmed, refused and refuted, a silent fault, too slow.

A stop is judged at the state it was told at: every combination of modes is looked at. Where one is
admissible clearly, or stays so a little later along its own motion, the stop is refuted.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from judge.check import Judge
from judge.family import Setting
from judge.following import lasts, still_of
from judge.mechanics import Floats, Joint, Mechanics
from judge.motions import CLEAR, Motion, accelerations, count, distinct, motions
from judge.scene import Contact, Scene
from judge.seen import OPEN, Outcome

EXACT, CONFIRMED, REFUTED, SILENT, SLOW, UNCLEAR = (
    "exact",
    "refused, confirmed",
    "refused, refuted",
    "silent fault",
    "too slow",
    "unclear",
)
VERDICTS = (EXACT, CONFIRMED, REFUTED, SILENT, SLOW, UNCLEAR)
MOST = 4000
BUDGET = 15.0
HUGE = 1e4


@dataclass(slots=True)
class Verdict:
    """`kind` of VERDICTS, and why; `counts` of what was examined."""

    kind: str
    why: list[str] = field(default_factory=list)
    worst: dict[str, float] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)


class Start:
    """The start a scene states in its parameters x0_, y0_, a0_, u0_, v0_, w0_, as an outcome."""

    def __init__(self, scene: Scene, values: Mapping[str, float], span: float) -> None:
        self.time, self.events = np.array([0.0, span]), ()
        self._row = {}
        for b in scene.bodies:
            words = ("position.x", "position.y", "angle", "velocity.x", "velocity.y")
            for key, word in zip("xyauvw", (*words, "angular_velocity"), strict=True):
                if b.turns or key not in "aw":
                    self._row[f"{b.name}.{word}"] = np.full(2, values[f"{key}0_{b.name}"])

    def at(self, t: Floats) -> Mapping[str, Floats]:
        """The same at all times."""
        return {k: np.full(len(t), x[0]) for k, x in self._row.items()}

    def __getitem__(self, name: str) -> Floats:
        return self._row[name]

    def __contains__(self, name: object) -> bool:
        return name in self._row


# Part of the speeds there by which a start enters a contact, above rounding.
ENTERS = 1e-9


def _enters(scene: Scene, setting: Setting, known: bool) -> bool:
    """Whether stated speeds enter a contact; guessed ones are corrected where it is closed."""
    if not known:
        return False
    start = Start(scene, setting.values, setting.stop)
    judge = Judge(scene, setting.values, start, setting.tolerance)  # type: ignore[arg-type]
    now = judge.mechanics(0.0)
    rows = (j.rows["n"] for j in now.joints.values() if "n" in j.rows)
    return any(r.rate < -ENTERS * judge.usual(r) for r in rows)


def judge_start(
    scene: Scene, setting: Setting, code: str, text: str, begun: Outcome | None
) -> Verdict:
    """A run that does not start: E0601 is never right where the scene knows its start.

    Where it does not, that of the same scene without friction is taken, `begun`.
    """
    if not code.startswith("E09"):
        return Verdict(REFUTED, [f"no start: {text}"])
    try:
        known = setting.start_known
        known = known and all(f"x0_{b.name}" in setting.values for b in scene.bodies)
        if code == "E0905" and not _enters(scene, setting, known):
            return Verdict(REFUTED, [f"no start: {text}"])
        start = begun if begun and not known else Start(scene, setting.values, setting.stop)
        return judge_stop(Judge(scene, setting.values, start, setting.tolerance), code, text, 0.0)
    except KeyError:
        return Verdict(UNCLEAR, [f"no start: {text}"])


# Part of its size within which a slip is none where a run stopped. Whatever the tolerance of the
# run, what it holds is zero there, and so is what an event was located at: a slip beyond that is
# one, and whether a motion follows is asked of the place as it is.
NEAR = 1e-6


def judge_stop(judge: Judge, code: str, text: str, t: float) -> Verdict:
    """Is there truly no admissible motion where a run stopped?"""
    now = judge.mechanics(t)
    loose = min(max(10 * judge.tol, 1e-9), NEAR)
    if code == "E0905":
        for name, joint in now.joints.items():
            if (
                f"'{name}'" in text
                and joint.rows["n"].rate < 0
                and abs(joint.gap) <= loose * max(judge.length, joint.size)
            ):
                return Verdict(CONFIRMED, [code])
        return Verdict(REFUTED, [f"{code}: no body meets another at t = {t!r}"])
    still = still_of(judge, now, loose)
    impacts = [
        n for n, j in now.joints.items() if still[n].touching and _approaches(judge, now, j, loose)
    ]
    if impacts:
        return Verdict(CONFIRMED, [f"{code}, impact at {', '.join(impacts)}"])
    good: list[Motion] = []
    deadline = time.process_time() + BUDGET
    for m in motions(now, still):
        # a motion that ends is there at its end, as where pins' friction folds it: not beyond
        clear = m.margin > CLEAR and code != "E0901"
        if clear or (m.margin > -CLEAR and lasts(judge, now, m, still, t)):
            good.append(m)
            if len(good) > 3:
                break
        if time.process_time() > deadline:
            if not good:
                return Verdict(UNCLEAR, [f"{code} at t = {t!r}: {count(now, still)} combinations"])
            break
    if not good:
        return Verdict(CONFIRMED, [code])
    usual = np.max(now.mass * accelerations(now))
    bursts = code == "E0901" and (
        _largest_load(judge, now, t) > HUGE * usual or _grows_without_bound(judge, t)
    )
    if bursts or all(m.size > HUGE * usual for m in good):
        return Verdict(CONFIRMED, [f"{code}, reactions grow without bound"])
    many = len(distinct(good, now))
    told = "; ".join(_modes(m) for m in distinct(good, now)[:3])
    return Verdict(REFUTED, [f"{code} at t = {t!r}: {many} admissible: {told}; {text}"])


def _largest_load(judge: Judge, now: Mechanics, t: float) -> float:
    """Mass times acceleration as the run tells it: near a pole it outgrows all that loads make.

    Another motion may be admissible there from the start on: the one that ends is the one taken.
    """
    row = judge.result.at(np.array([t]))
    return max(
        float(now.mass[now.at[b.name] + k]) * abs(float(row[f"{b.name}.acceleration.{axis}"][0]))
        for b in judge.scene.bodies
        for k, axis in enumerate("xy")
    )


# How near its end, in parts of its time in one mode, a run that ends at a pole is near it.
NEAR_POLE = 1e-3


def _grows_without_bound(judge: Judge, t: float) -> bool:
    """Whether the reactions as the run tells them outgrow what they were a little before its end.

    Those of a light body do, though a heavy one beside it weighs more than they reach.
    """
    times = [float(judge.result.time[0]), *(e.time for e in judge.result.events)]
    begin = max(at for at in times if at < t or at == times[0])
    row = judge.result.at(np.array([t - NEAR_POLE * (t - begin), t]))
    names = [
        f"{c.name}.{word}"
        for c in (*judge.scene.contacts, *judge.scene.pins)
        for word in ("normal_force", "force.x", "force.y")
    ]
    told = [np.abs(row[name]) for name in names if name in row]
    if not told:
        return False
    before, end = np.max(told, axis=0)
    return bool(end > HUGE * before > 0)


def _approaches(judge: Judge, now: Mechanics, joint: Joint, loose: float) -> bool:
    """Whether a contact that can part is about to be hit."""
    c, row = joint.liaison, joint.rows.get("n")
    if not isinstance(c, Contact) or c.bilateral or row is None:
        return False
    return row.rate < -loose * judge.usual(row)


def _modes(m: Motion) -> str:
    words = []
    for name, c in m.modes.items():
        words.append(
            f"{name} "
            + (
                "open"
                if not c.closed
                else ("stick" if c.slip == 0 else f"slip{c.slip:+d}")
                + (f" roll{c.roll:+d}" if c.roll else "")
                + ("" if c.side > 0 else " side-")
            )
        )
    return ", ".join(words) + f" (margin {m.margin:.1e})"


def judge_several(judge: Judge, most: int = 3) -> list[str]:
    """Instants told to have several motions must have several that differ.

    What is told to be open has parted a little before the instant, or does at it.
    """
    wrong = []
    for e in [e for e in judge.result.events if e.kind == "several"][:most]:
        now = judge.mechanics(e.time)
        touching = still_of(judge, now, min(max(1e3 * judge.tol, 1e-9), NEAR))
        if count(now, touching) > MOST:
            continue
        before = math.nextafter(e.time, -math.inf)
        row = judge.row(max(before, float(judge.result.time[0])))
        parted = {
            name: replace(s, touching=s.touching and row.get(f"{name}.mode", 1) != OPEN)
            for name, s in touching.items()
        }
        found = [
            len(distinct([m for m in motions(now, still) if m.margin > -CLEAR], now))
            for still in (touching, parted)
        ]
        if max(found) < 2:
            wrong.append(f"several: '{e.text}', but {max(found)} differ in their accelerations")
    return wrong
