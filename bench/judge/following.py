"""Which liaisons touch and slip in a state, and whether a motion is still admissible after it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from judge.mechanics import Joint, Mechanics
from judge.motions import Motion, Still, accelerations, motion
from judge.scene import Contact, Pin
from judge.seen import Seen


def still_of(seen: Seen, now: Mechanics, loose: float) -> dict[str, Still]:
    """Which liaisons touch and which slips are zero, to `loose` of their sizes."""
    still = {}
    for name, joint in now.joints.items():
        word = "c" if isinstance(joint.liaison, Pin) else "t"
        touching = abs(joint.gap) <= loose * max(seen.length, joint.size)
        if touching and isinstance(joint.liaison, Contact) and not joint.liaison.bilateral:
            rate = joint.rows["n"].rate
            touching = rate <= loose * seen.usual(joint.rows["n"])
        slip = sense(seen, now, joint, word, loose)
        roll = sense(seen, now, joint, "r", loose) if word == "t" else 0
        still[name] = Still(touching, slip, roll)
    return still


def sense(seen: Seen, now: Mechanics, joint: Joint, word: str, loose: float) -> int:
    r = joint.rows[word]
    if abs(r.rate) <= loose * seen.usual(r):
        return 0
    return 1 if r.rate > 0 else -1


# How far a motion is followed, in parts of its pace, and what of a margin is no fault then.
SOON = 1e-4
SLIGHT = 1e-9


def lasts(
    seen: Seen,
    now: Mechanics,
    found: Motion,
    still: Mapping[str, Still],
    t: float,
    most: float = math.inf,
) -> bool:
    """Whether the modes are admissible after a short step too; `most` bounds the pace.

    What is slightly wrong, and ten times so after ten times as long, is no rounding, nor what
    following the motion roughly makes of it.
    """
    soon = later(seen, now, found, still, t, SOON, most)
    if soon <= -SLIGHT or soon >= -1e-3 * SLIGHT:
        return soon > -SLIGHT
    return not 5 < later(seen, now, found, still, t, 10 * SOON, most) / soon < 20


def later(
    seen: Seen,
    now: Mechanics,
    found: Motion,
    still: Mapping[str, Still],
    t: float,
    part: float,
    most: float,
) -> float:
    """The margin of the same modes a part of their pace later, along the motion they give."""
    quick = accelerations(now)
    pace = most
    for k in range(now.n):
        if abs(found.acceleration[k]) > 1e-9 * quick[k] or abs(now.speed[k]) > 0:
            length = 1.0 if k % 3 == 2 else seen.length
            speed, a = abs(now.speed[k]), abs(found.acceleration[k])
            pace = min(
                pace,
                length / speed if speed > 0 else math.inf,
                math.sqrt(length / a) if a > 0 else math.inf,
            )
    end = float(seen.result.time[-1]) - float(seen.result.time[0])
    h = part * (pace if math.isfinite(pace) else max(end, 1e-300))
    place = now.place + h * now.speed + h * h / 2 * found.acceleration
    speed = now.speed + h * found.acceleration
    state = {}
    for b in seen.scene.bodies:
        k = now.at[b.name]
        state[b.name] = (*place[k : k + 3], *speed[k : k + 3])

    def look(word: str) -> float:
        if word == "time":
            return t + h
        if word in seen.values:
            return seen.values[word]
        body, what, axis = word.split(".")
        return float(state[body][(0 if what == "position" else 3) + "xy".index(axis)])

    then = Mechanics(seen.scene, look, state, now.sides)
    moved = {}
    for name, joint in then.joints.items():
        mode, before = found.modes[name], still[name]
        word = "c" if isinstance(joint.liaison, Pin) else "t"
        slip = before.slip or (mode.slip and (1 if joint.rows[word].rate > 0 else -1))
        roll = before.roll
        if word == "t" and not roll:
            roll = mode.roll and (1 if joint.rows["r"].rate > 0 else -1)
        if mode.slip and slip != mode.slip:
            return -1.0
        moved[name] = replace(before, slip=slip, roll=roll)
    again = motion(then, found.modes, moved)
    return -1.0 if again is None or again.sign * found.sign < 0 else again.margin
