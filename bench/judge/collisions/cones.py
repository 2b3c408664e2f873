"""Momenta or forces as sums of reactions of contacts and joints, by least squares in cones."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.optimize import nnls

from judge.collisions.rows import Bodies, Floats, Meeting

TOUCH = 1e-8  # a gap below this part of the size may carry a reaction
AROUND = 32  # directions of friction in space


def left_over(
    now: Bodies,
    length: float,
    wanted: Floats,
    size: Floats,
    impulses: Mapping[str, float] | None,
) -> tuple[float, float]:
    """What reactions within their cones leave of momenta (or forces), and the size of these.

    With `impulses` the contacts named there take part, with these sums along their normals.
    """
    weight = np.zeros(now.n)
    for b in now.scene.bodies:
        k = now.at[b.name]
        weight[k : k + 3] = 1 / np.sqrt(now.values[f"m_{b.name}"])
        turning = float(np.max(np.diag(now.mass)[k + 3 : k + 6]))
        weight[k + 3 : k + 6] = 1 / np.sqrt(turning) if turning > 0 else 0.0
    columns: list[Floats] = []
    sums: list[tuple[float, range]] = []
    for name, m in now.meetings.items():
        if impulses is None and abs(m.gap) > TOUCH * unit_of(m, length):
            continue
        if impulses is not None and name not in impulses:
            continue
        cone = generators(m)
        if impulses is not None:
            sums.append((impulses[name], range(len(columns), len(columns) + len(cone))))
        columns += list(cone)
    for j in now.scene.joints:
        both = list(now.joints[j.name]) + ([now.dry(j)] if j.dry else [])
        columns += [sign * r for r in both for sign in (1.0, -1.0)]
    scaled = np.array(columns).reshape(-1, now.n).T * weight[:, None]
    lengths = np.linalg.norm(scaled, axis=0)
    lengths[lengths == 0] = 1.0
    matrix, right = scaled / lengths, wanted * weight
    whole = float(np.linalg.norm(size * weight))
    for total, which in sums:
        extra = np.zeros(matrix.shape[1])
        unit = float(np.mean(lengths[list(which)]))
        extra[list(which)] = unit / lengths[list(which)]
        matrix, right = np.vstack([matrix, extra]), np.append(right, total * unit)
    left = float(np.linalg.norm(right))
    if matrix.shape[1]:
        left = float(nnls(matrix, right, maxiter=100 * matrix.shape[1])[1])
    return left, whole


def unit_of(m: Meeting, length: float) -> float:
    """The size of a gap: of an angle one radian."""
    return 1.0 if m.touch.of and m.touch.of.kind == "rotoide" else length


def generators(m: Meeting) -> Floats:
    """Reactions at the edge of the cone of a contact, each with the normal part one."""
    normal, across = m.rows[0], m.rows[1:]
    mu = max(m.mu, m.mu_s)
    if not len(across) or mu == 0:
        return normal[None]
    if len(across) == 1:
        return np.array([normal + mu * across[0], normal - mu * across[0]])
    angles = np.arange(AROUND) * 2 * np.pi / AROUND
    outer = mu / np.cos(np.pi / AROUND)
    return np.array(
        [normal + outer * (np.cos(a) * across[0] + np.sin(a) * across[1]) for a in angles]
    )
