"""Redundant relations: how many, in which loops, and what would make these isostatic.

A redundant relation is a state of reactions that equilibrate each other: a combination of the rows
of all relations that is zero. It is determined at a posture in general position, for at a singular
one there are more.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice

import numpy as np
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.report.relations import (
    Floats,
    Posture,
    Relations,
    null_space,
    rank,
)
from frot.dsl.checked import Body, Liaison

# Of an orthonormal combination of rows: a relation takes part.
_TAKES_PART = 1e-7
# How far a posture in general position is from the start: radians, or parts of the length.
_FAR = (0.15, 0.05, 0.4, 0.1, 0.015)
_ENOUGH = 2


@dataclass(frozen=True, slots=True, eq=False)
class Loop:
    """Liaisons that keep what others of them keep, `degree` relations too many.

    `undetermined`: of each liaison how many components of its reaction are not determined. `bodies`
    are those they join.
    """

    degree: int
    liaisons: tuple[Liaison, ...]
    undetermined: tuple[int, ...]
    bodies: tuple[Body, ...]
    rows: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Ranks:
    """Independent relations of all that always hold, in general position and at the start.

    `touching` are those of the start with the contacts that touch there, `touching_rank` of them
    independent. `posture` is the one in general position.
    """

    count: int
    general: int
    start: int
    touching: int
    touching_rank: int
    posture: Posture


def find_ranks(
    relations: Relations, start: Posture, touching: Mapping[Constraint, bool], seed: int = 1
) -> Ranks:
    """Ranks at the start and beside it."""
    random = np.random.default_rng(seed)
    now = relations.at(start).rows
    scaled, holds = relations.scaled(now), relations.holds
    here = rank(scaled[holds])
    postures = (relations.beside(start, far, random) for far in _FAR)
    found = list(islice((x for x in postures if x is not None), _ENOUGH))
    best, where = -1, start
    for there in found:
        own = rank(relations.scaled(relations.at(there).rows)[holds])
        if own > best:
            best, where = own, there
    best = max(best, here)
    touch = holds | np.array([touching.get(x, False) for x in relations.links], dtype=bool)
    return Ranks(int(holds.sum()), best, here, int(touch.sum()), rank(scaled[touch]), where)


def find_loops(
    relations: Relations, posture: Posture, used: Floats | None = None
) -> tuple[Loop, ...]:
    """The redundant relations at a posture, those that have to do with each other together.

    So have those of the same liaisons: hinges on one shaft keep each way and turn twice.
    """
    chosen = relations.holds if used is None else used.astype(bool)
    places = np.flatnonzero(chosen)
    rows = relations.scaled(relations.at(posture).rows)[chosen]
    self_stress = null_space(rows.T)
    if self_stress.shape[1] == 0:
        return ()
    projector = self_stress @ self_stress.T
    part = np.abs(projector) > _TAKES_PART
    groups: list[set[int]] = []
    left = {int(k) for k in np.flatnonzero(np.diag(part))}
    while left:
        group: set[int] = set()
        new = {min(left)}
        while new:
            group |= new
            new = {int(j) for i in new for j in np.flatnonzero(part[i])} - group
        left -= group
        groups.append(group)

    def liaisons(group: set[int]) -> set[Liaison]:
        return {relations.links[places[i]].liaison for i in group}

    joined: list[set[int]] = []
    for group in sorted(groups, key=lambda g: (-len(liaisons(g)), min(g))):
        wider = next((x for x in joined if liaisons(group) <= liaisons(x)), None)
        if wider is None:
            joined.append(group)
        else:
            wider |= group
    ordered = sorted(sorted(group) for group in joined)
    return tuple(
        _loop(relations, [int(places[i]) for i in own], self_stress[own]) for own in ordered
    )


def _loop(relations: Relations, rows: list[int], self_stress: Floats) -> Loop:
    by_liaison: dict[Liaison, list[int]] = {}
    for k, row in enumerate(rows):
        by_liaison.setdefault(relations.links[row].liaison, []).append(k)
    ends = {relations.links[row].liaison: relations.links[row].bodies for row in rows}
    ordered, bodies = _walk(ends)
    undetermined = tuple(_rank(self_stress[by_liaison[x]]) for x in ordered)
    return Loop(_rank(self_stress), ordered, undetermined, bodies, tuple(rows))


def _rank(values: Floats) -> int:
    found = np.linalg.svd(values, compute_uv=False)
    return int(np.sum(found > _TAKES_PART))


def _walk(
    ends: Mapping[Liaison, tuple[Body, Body]],
) -> tuple[tuple[Liaison, ...], tuple[Body, ...]]:
    """Liaisons in the order in which one goes round from the ground, and the bodies on the way."""
    left = dict(ends)
    bodies: list[Body] = []
    ordered: list[Liaison] = []
    everyone = [b for pair in ends.values() for b in pair]
    at = next((b for b in everyone if b.shape is None), everyone[0])
    while left:
        if at not in bodies:
            bodies.append(at)
        going = next((x for x, pair in left.items() if at in pair), None)
        if going is None:
            at = next(b for b in bodies if any(b in pair for pair in left.values()))
            continue
        ordered.append(going)
        a, b = left.pop(going)
        at = b if at is a else a
    if at not in bodies:
        bodies.append(at)
    return tuple(ordered), tuple(bodies)
