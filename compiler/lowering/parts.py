"""Parts: what is put together at the start without regard to the rest of a scene."""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.groups import Grouping, Sets
from frot.compiler.lowering.initial_values import Initial
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True)
class Parts:
    """The part of each coordinate, contact, statement on positions and guess of a place.

    `direct` and `vectors` are those of `Initial`.
    """

    count: int
    coordinates: tuple[int, ...]
    contacts: tuple[int, ...]
    statements: tuple[int, ...]
    guesses: tuple[int, ...]
    direct: tuple[bool, ...]
    vectors: tuple[int, ...]


def make_parts(system: Assembled, grouping: Grouping, initial: Initial) -> Parts:
    """Join the coordinates whose speeds act on each other, or that a relation binds together."""
    nq = int(system.q.numel())
    reduced = system.reduced
    own = [[k] for k in range(nq)]
    places: dict[int, set[int]] = {}
    for k, speed in enumerate(system.q_speed):
        if speed >= 0:
            places.setdefault(speed, set()).add(k)
    for turn in reduced.symbols.turns:
        four = range(turn.coordinate, turn.coordinate + 4)
        own[turn.coordinate] = list(four)
        for speed in turn.speeds:
            if speed >= 0:
                places.setdefault(speed, set()).update(four)
    of_contacts: list[set[int]] = [set() for _ in (*reduced.contact_rows, *system.elements)]
    joined: list[Iterable[int]] = list(own)
    for group in grouping.groups:
        found = {k for z in group.unknowns for k in places.get(z, ())}
        joined.append(found)
        for contact in group.contacts:
            of_contacts[contact] |= found
    through = _through_blocks(system)
    for contact, gap in enumerate(ca.vertsplit(system.gap) if system.gap.numel() else ()):
        of_contacts[contact] |= _read(gap, system, through)
    values = initial.position[0]  # of a counter the slopes say less
    stated = _rows(ca.jacobian(values, system.q).T, initial.position[3], through)
    guessed = _rows(initial.guessed[1], None, through) if initial.guessed else []
    sets = Sets(nq + 1)
    for own_row, first in zip(guessed, initial.vectors, strict=True):
        guessed[first] |= own_row
    for bound in (*joined, *of_contacts, *stated, *guessed):
        items = list(bound)
        for k in items[1:]:
            sets.join(items[0], k)
    names = {k: i for i, k in enumerate(dict.fromkeys(sets.find(k) for k in range(nq)))}

    def part_of(bound: Iterable[int]) -> int:
        return names.get(sets.find(next(iter(bound), nq)), 0)

    return Parts(
        max(len(names), 1),
        tuple(names[sets.find(k)] for k in range(nq)),
        tuple(part_of(x) for x in of_contacts),
        tuple(part_of(x) for x in stated),
        tuple(part_of(x) for x in guessed),
        initial.direct,
        initial.vectors,
    )


def _columns(slopes: ca.SX) -> list[set[int]]:
    """Of each column the rows that are not zero in every posture."""
    found: list[set[int]] = [set() for _ in range(slopes.shape[1])]
    for row, column in zip(*(list(x) for x in slopes.sparsity().get_triplet()), strict=True):
        found[column].add(row)
    return found


def _through_blocks(system: Assembled) -> list[set[int]]:
    """The coordinates on which each unknown of the early blocks depends."""
    of_blocks: list[set[int]] = [set() for _ in range(system.y.numel())]
    y, early = system.y, [b for b in system.blocks if not b.late]
    for block in early:
        count = int(block.residual.numel())
        found: set[int] = set()
        for by_q in _columns(ca.jacobian(block.residual, system.q).T):
            found |= by_q
        for by_y in _columns(ca.jacobian(block.residual, y).T):
            for k in by_y:
                found |= of_blocks[k]
        for k in range(block.first, block.first + count):
            of_blocks[k] = found
    return of_blocks


def _rows(slopes: ca.SX, by_blocks: ca.SX | None, through: list[set[int]]) -> list[set[int]]:
    """The coordinates that each equation reads, given its slopes, transposed."""
    found = _columns(slopes)
    for own, read in zip(found, _columns(by_blocks) if by_blocks is not None else (), strict=False):
        for k in read:
            own |= through[k]
    return found


def _read(value: ca.SX, system: Assembled, through: list[set[int]]) -> set[int]:
    """The coordinates that a value reads."""
    by_q = ca.jacobian(value, system.q).T if system.q.numel() else ca.SX(0, 1)
    by_y = ca.jacobian(value, system.y).T if system.y.numel() else ca.SX(0, 1)
    (found,) = _rows(by_q, by_y, through)
    return found
