"""Frobenius' test on all relations of a mechanism together.

Where the relations between velocities leave the motions D, those that brackets of fields in D reach
as well are the directions in which the mechanism can get by going to and fro. A relation that they
satisfy too keeps something at a value: it is the derivative of a relation between places. One that
they break is not holonomic (G. Frobenius 1877; P. Appell 1899). Brackets are taken again until
nothing new comes (a coin that rolls upright needs two), time going along as a coordinate.
"""

from __future__ import annotations

from itertools import product

import casadi as ca
import numpy as np
from frot.compiler.report.relations import (
    Floats,
    Posture,
    Relations,
    null_space,
    rank,
)
from frot.dsl.checked import Liaison
from numpy.typing import NDArray

Places = NDArray[np.intp]

# Brackets of more than so many fields are not formed.
_MOST_FIELDS = 12
_ROUNDS = 4
# Of a direction of one size: what breaks a relation, and what is new in it.
_NEW = 1e-6


def non_holonomic(relations: Relations, posture: Posture) -> dict[Liaison, bool | None]:
    """For each liaison with relations between velocities, whether some are not holonomic.

    None where there are too many freedoms to tell. Each is examined at a posture in general
    position.
    """
    held = np.flatnonzero(relations.holds)
    kinematic = [int(k) for k in held if relations.links[k].kinematic]
    if not kinematic:
        return {}
    liaisons = dict.fromkeys(relations.links[k].liaison for k in kinematic)
    reached = _reached(relations, posture, held)
    if reached is None:
        return dict.fromkeys(liaisons)
    now = relations.at(posture)
    rows = np.hstack([relations.scaled(now.rows), _own(relations, posture)])
    return {
        x: bool(
            np.any(
                [
                    np.max(np.abs(rows[k] @ reached), initial=0.0) > _NEW
                    for k in kinematic
                    if relations.links[k].liaison is x
                ]
            )
        )
        for x in liaisons
    }


def _own(relations: Relations, posture: Posture) -> Floats:
    """The contribution of a unit of time to the rates of rows of unit size."""
    now = relations.at(posture)
    even = now.rows / np.where(relations.turning, relations.size, 1.0)
    sizes = np.linalg.norm(even, axis=1)
    return np.asarray((now.own / np.where(sizes > 0, sizes, 1.0))[:, None])


def _reached(relations: Relations, posture: Posture, held: Places) -> Floats | None:
    """Orthonormal directions (scaled speeds, then time) that D and its brackets span."""
    now = relations.at(posture)
    whole = np.hstack([relations.scaled(now.rows), _own(relations, posture)])[held]
    independent, dependent = _pivots(whole)
    others = [k for k in range(whole.shape[1]) if k not in dependent]
    if len(others) > _MOST_FIELDS:
        return None
    fields, state = _fields(relations, posture, held[independent], dependent, others)
    found: list[ca.MX] = [fields[:, k] for k in range(len(others))]
    newest = list(range(len(found)))
    most = whole.shape[1] - _geometric_rank(relations, whole, held)
    span = null_space(whole)
    for _ in range(_ROUNDS):
        if span.shape[1] >= most:
            break
        pairs = [(i, j) for i, j in product(range(len(others)), newest) if i < j]
        brackets = [_bracket(found[i], found[j], state) for i, j in pairs]
        values = _directions(relations, posture, brackets, state)
        newest = []
        for bracket, value in zip(brackets, values.T, strict=True):
            rest = value - span @ (span.T @ value)
            rest -= span @ (span.T @ rest)
            if np.linalg.norm(rest) > _NEW * max(float(np.linalg.norm(value)), 1e-3):
                span = np.hstack([span, (rest / np.linalg.norm(rest))[:, None]])
                newest.append(len(found))
                found.append(bracket)
        if not newest:
            break
    return span


def _geometric_rank(relations: Relations, whole: Floats, held: Places) -> int:
    return rank(whole[relations.geometric[held]])


def _pivots(rows: Floats) -> tuple[list[int], list[int]]:
    """Independent rows and the columns in which they are best solved."""
    from scipy.linalg import qr

    count = rows.shape[1] - null_space(rows).shape[1]
    _, _, order = qr(rows.T, mode="economic", pivoting=True)
    chosen = sorted(int(k) for k in order[:count])
    _, _, columns = qr(rows[chosen], mode="economic", pivoting=True)
    return chosen, sorted(int(k) for k in columns[:count])


def _fields(
    relations: Relations, posture: Posture, rows: Places, dependent: list[int], others: list[int]
) -> tuple[ca.MX, ca.MX]:
    """Fields that span D near a posture, and the state they hang on: q, time, followed places.

    One of the `others` of the speeds is one, the rest of them zero; the `dependent` follow.
    """
    symbols = relations.symbols
    nq, nv = symbols.q.numel(), symbols.v.numel()
    state = ca.MX.sym("state", nq + 1 + relations.followed.unknowns.numel())
    q, t, places = state[:nq], state[nq], state[nq + 1 :]
    _, jacobian, own, moves, follow, drift = relations.function(
        t, q, posture.u, posture.p, posture.sides, places
    )
    pick = [int(k) for k in rows]
    whole = ca.horzcat(jacobian, own)[pick, :]
    solved = -ca.solve(whole[:, dependent], whole[:, others], "symbolicqr")
    speeds = ca.MX.zeros(nv + 1, len(others))
    for k, place in enumerate(dependent):
        speeds[place, :] = solved[k, :]
    for k, place in enumerate(others):
        speeds[place, k] = 1
    goes = follow @ speeds[:nv, :] + drift @ speeds[nv, :]
    return ca.vertcat(moves @ speeds[:nv, :], speeds[nv, :], goes), state


def _bracket(a: ca.MX, b: ca.MX, state: ca.MX) -> ca.MX:
    return ca.jtimes(b, state, a) - ca.jtimes(a, state, b)


def _directions(
    relations: Relations, posture: Posture, fields: list[ca.MX], state: ca.MX
) -> Floats:
    """Fields in scaled speeds (columns), of size one."""
    if not fields:
        return np.zeros((relations.turning.size + 1, 0))
    here = np.concatenate([posture.q, [posture.t], relations.places(posture)])
    values = np.array(ca.Function("fields", [state], [ca.horzcat(*fields)])(here))
    moves, count = relations.at(posture).moves, posture.q.size
    speeds = np.linalg.lstsq(moves, values[:count], rcond=None)[0]
    even = speeds * np.where(relations.turning, relations.size, 1.0)[:, None]
    whole = np.vstack([even, values[count : count + 1]])
    sizes = np.linalg.norm(whole, axis=0)
    return np.asarray(whole / np.where(sizes > 1e-9, sizes, 1.0))
