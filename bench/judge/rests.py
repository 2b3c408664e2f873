"""What is said to be at rest has no velocity at all: zeros, not small numbers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from judge.mechanics import Floats, Joint, Mechanics
from judge.motions import parts
from judge.scene import Pin
from judge.seen import OPEN, SLIP, STICK, Seen

# Singular values of the held rows below the first are zero, above the second they are not.
NONE, SOME = 1e-10, 1e-5


def rest(seen: Seen, now: Mechanics, row: Mapping[str, float], t: float) -> None:
    """Bodies that sticking liaisons leave no velocity have none."""
    for places, joints in parts(now):
        if not any(row.get(f"{j.liaison.name}.mode") == STICK for j in joints):
            continue
        held = [r for j in joints for r in _held(seen, j, row)]
        places_of = places.ravel()
        matrix = np.array(held)[:, places_of] / np.sqrt(now.mass[places_of])
        lengths = np.linalg.norm(matrix, axis=1)
        matrix = matrix[lengths > 0] / lengths[lengths > 0][:, None]
        _, s, vt = np.linalg.svd(matrix)
        if np.any((s > NONE) & (s < SOME)):
            continue
        free = vt[int(np.sum(s >= SOME)) :]
        for k in places[:, 0] // 3:
            body = now.scene.bodies[int(k)]
            mine = np.isin(places_of, 3 * k + np.arange(3 if body.turns else 2))
            if np.max(np.abs(free[:, mine]), initial=0.0) > NONE:
                continue
            names = ["velocity.x", "velocity.y"] + (["angular_velocity"] if body.turns else [])
            for name in names:
                seen.found.hold("rest", row[f"{body.name}.{name}"], 0.0, t, f"{body.name}.{name}")


def _held(seen: Seen, joint: Joint, row: Mapping[str, float]) -> list[Floats]:
    """Jacobians of the relative velocities that a liaison keeps at zero in its mode."""
    name = joint.liaison.name
    pin = isinstance(joint.liaison, Pin)
    mode = row.get(f"{name}.mode", SLIP if seen.kept(joint) else OPEN)
    if not pin and mode == OPEN:
        return []
    words = ["x", "y"] if pin else ["n"]
    if mode == STICK and joint.liaison.mu is not None:
        words.append("c" if pin else "t")
    return [joint.rows[w].jacobian for w in words]
