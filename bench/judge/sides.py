"""The side on which each contact starts, by the rules of the language, and that of a record."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from judge.mechanics import Joint, Mechanics, left
from judge.scene import Contact, Scene

if TYPE_CHECKING:
    from judge.seen import Seen

# A distance, in parts of its size, that says on which side of a line a body is.
CLEARLY = 1e-6


def start_sides(scene: Scene, now: Mechanics) -> dict[str, int]:
    """The side each contact starts on, seen along its line's direction: 1 is the left."""
    sides = {}
    places = [np.max(np.abs(now.origin(b))) for b in scene.bodies]
    lengths = [b.size.at(now.look) for b in scene.bodies if b.size is not None]
    wide = max(float(x) for x in (*places, *lengths, *(j.size for j in now.joints.values())))
    for c in scene.contacts:
        joint = now.joints[c.name]
        up = left(joint.direction)
        height = joint.gap if c.rim is None else joint.gap + c.rim.size.at(now.look)  # type: ignore[union-attr]
        if c.kind == "point_courbe" and c.bilateral:
            sides[c.name] = 1
        elif abs(height) > 1e-9 * wide:
            sides[c.name] = 1 if height > 0 else -1
        else:  # on the line: against gravity, else where G is, else the left
            g = 9.81 if scene.gravity is None else scene.gravity.at(now.look)
            middle = (now.origin(c.body) - joint.touching) @ up
            above = -float(up @ now.down())
            if g > 0 and abs(above) > 1e-9:
                sides[c.name] = 1 if above > 0 else -1
            else:
                sides[c.name] = -1 if middle < -1e-9 * wide else 1
    return sides


def recorded_sides(seen: Seen) -> None:
    """Note contacts whose record is on another side than the start says; judge them there.

    Where places are guessed in part, a contact that comes to be closed may be on either side.
    """
    for c in seen.scene.contacts:
        if c.kind == "point_courbe" and c.bilateral:
            continue
        if _on_other_side(seen, c):
            side = {1: "left", -1: "right"}
            rule = seen.sides[c.name]
            t = float(seen.result.time[0])
            if seen.placed:
                seen.found.fault(
                    f"side: {c.name} starts on its {side[rule]} at t = {t!r}, is {side[-rule]}"
                )
            seen.sides[c.name] = -rule


def _on_other_side(seen: Seen, c: Contact) -> bool:
    """Whether forces or gaps of the record are those of the other side."""
    for t in np.linspace(float(seen.result.time[0]), float(seen.result.time[-1]), 6):
        row = seen.row(float(t))
        joint = seen.mechanics_of(row, float(t)).joints[c.name]
        gap = row.get(f"{c.name}.gap")
        size = max(seen.length, joint.size)
        if gap is not None and not c.bilateral and c.rim is None and gap > CLEARLY * size:
            return bool(abs(gap + joint.gap) < CLEARLY * gap)
        if c.bilateral and c.rim is None and _pushes(c, row, joint):
            return True
    return False


def _pushes(c: Contact, row: Mapping[str, float], joint: Joint) -> bool:
    """Whether a normal force has the sign of the other side."""
    if f"{c.name}.force.x" not in row or f"{c.name}.normal_force" not in row:
        return False
    sign = 1.0 if c.swapped else -1.0
    force = sign * np.array([row[f"{c.name}.force.{a}"] for a in "xy"])
    n = row[f"{c.name}.normal_force"]
    along = float(force @ joint.normal)
    return bool(abs(n) > 0 and abs(along + n) < CLEARLY * abs(n))
