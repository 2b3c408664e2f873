"""What is said to be at rest has no velocity at all: zeros, not small numbers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

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
        held = np.array([r for j in joints for r in _held(seen, j, row)])
        for k in _resting(now, places, held):
            body = now.scene.bodies[k]
            names = ["velocity.x", "velocity.y"] + (["angular_velocity"] if body.turns else [])
            for name in names:
                seen.found.hold("rest", row[f"{body.name}.{name}"], 0.0, t, f"{body.name}.{name}")


def _resting(now: Mechanics, places: NDArray[np.intp], rows: Floats) -> list[int]:
    """Bodies that rows among them and the ground leave no velocity.

    Where a body that moves is in a dead centre another one may have no velocity for an instant.
    """
    resting = [int(k) for k in places[:, 0] // 3]
    while resting:
        own = [3 * k + i for k in resting for i in range(3 if now.scene.bodies[k].turns else 2)]
        others = np.setdiff1d(np.arange(now.n), own)
        among = rows[np.all(rows[:, others] == 0, axis=1)][:, own] / np.sqrt(now.mass[own])
        lengths = np.linalg.norm(among, axis=1)
        among = among[lengths > 0] / lengths[lengths > 0][:, None]
        if not len(among):
            return []
        _, s, vt = np.linalg.svd(among)
        if np.any((s > NONE) & (s < SOME)):
            return []
        free = np.max(np.abs(vt[int(np.sum(s >= SOME)) :]), axis=0, initial=0.0)
        left = [k for k in resting if np.max(free[np.array(own) // 3 == k]) <= NONE]
        if left == resting:
            return resting
        resting = left
    return []


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
