"""Unknowns of the core, rows and elements that act on each other, found at compile time.

Two unknowns belong together when an entry of the core's matrix joins them, a row and an unknown
when the row moves with it or its reaction drives it, rows of one law always. Groups share no
matrix, no scale and no search: what does not touch costs what it costs alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.trees import TreeTable, make_tree
from frot.compiler.mechanics.dynamics import speeds_by_tree
from frot.compiler.mechanics.laws.elements import Element, link_elements, text_element
from frot.compiler.symbolic.columns import dense
from frot.compiler.symbolic.random_tests import at_positive, at_random
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """One group: places in z (speeds, auxiliary, algebraic), rows, contacts, elements.

    `entries`: where its rows of J, one after the other, are not zero in every posture. `general`:
    its part of the matrix is no mass matrix, or E is not J'. `tree`: its mass matrix is given by
    the steps of large trees. `composite`: it is one in whose entries inertias of bodies add up, so
    that those of light ones may lose their digits beside heavy ones.
    """

    unknowns: tuple[int, ...]
    n_speeds: int
    n_auxiliary: int
    rows: tuple[int, ...]
    contacts: tuple[int, ...]
    elements: tuple[int, ...]
    entries: tuple[int, ...]
    general: bool
    tree: TreeTable | None
    composite: bool


@dataclass(frozen=True, slots=True, eq=False)
class Grouping:
    """All groups, the elements, and what the kernel's functions give of them, packed.

    `row_reads` is, for a row that is read off a liaison kept by coordinates, the place of its
    auxiliary unknown in its group, else -1. `prescribed`: rows that no speed moves.
    """

    groups: tuple[Group, ...]
    elements: tuple[Element, ...]
    row_reads: tuple[int, ...]
    prescribed: frozenset[int]
    matrix: ca.SX
    metric: ca.SX
    rows: ca.SX
    spread: ca.SX

    @property
    def is_mass_matrix(self) -> bool:
        """Whether every group's is."""
        return not any(g.general for g in self.groups)


class Sets:
    """Sets of items that are joined pair by pair."""

    def __init__(self, count: int) -> None:
        """Each item alone."""
        self._of = list(range(count))

    def find(self, item: int) -> int:
        """The item that stands for the set."""
        while self._of[item] != item:
            self._of[item] = self._of[self._of[item]]
            item = self._of[item]
        return item

    def join(self, a: int, b: int) -> None:
        """Make the sets of both one."""
        self._of[self.find(a)] = self.find(b)


def elements_of(system: Assembled) -> list[Element]:
    """Those of the liaisons, then those of the text."""
    reduced = system.reduced
    links = enumerate(zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True))
    found = [e for i, (link, rows) in links for e in link_elements(i, link, rows)]
    count, first = len(reduced.mechanism.contacts), system.lam.numel() - len(system.elements)
    return found + [text_element(count + k, first + k) for k in range(len(system.elements))]


def make_groups(system: Assembled) -> Grouping:
    """Divide the core into its groups."""
    reduced = system.reduced
    joints, n_rows = reduced.mechanism.contacts, int(system.lam.numel())
    planar = reduced.mechanism.model.planar
    nw, nv, na = int(system.z.numel()), system.nv, system.na
    elements, first = elements_of(system), n_rows - len(system.elements)
    matrix, rows, spread = (
        ca.sparsify(x)
        for x in (system.matrices.matrix, system.matrices.rows, system.matrices.spread)
    )
    moved: dict[int, list[int]] = {}
    for r, k in _entries(rows):
        moved.setdefault(r, []).append(k)
    _share_entries(moved, elements)
    sets, tree = _joined(system, matrix, rows, spread), system.tree
    owners = {r: i for i, found in enumerate(reduced.contact_rows) for r in found.all}
    owners.update({first + k: len(joints) + k for k in range(len(system.elements))})
    members: dict[int, list[int]] = {}
    for item in range(nw + n_rows):
        members.setdefault(sets.find(item), []).append(item)
    groups: list[Group] = []
    for items in members.values():
        unknowns = tuple(i for i in items if i < nw)
        own = tuple(i - nw for i in items if i >= nw)
        steps = not tree.large.isdisjoint(unknowns)
        local = {z: k for k, z in enumerate(unknowns)}
        speeds = [i for i in unknowns if i < nv]
        general = not steps and _is_general(system, unknowns, own)
        groups.append(
            Group(
                unknowns=unknowns,
                n_speeds=len(speeds),
                n_auxiliary=sum(nv <= i < nv + na for i in unknowns),
                rows=own,
                contacts=tuple(sorted({owners[r] for r in own})),
                elements=tuple(k for k, e in enumerate(elements) if e.row in own),
                entries=tuple(
                    i * len(unknowns) + k
                    for i, r in enumerate(own)
                    for k in sorted(local[z] for z in moved.get(r, ()))
                ),
                general=general,
                tree=make_tree(tree.steps, unknowns, nv, planar) if steps else None,
                composite=steps or not (general or matrix[speeds, speeds].sparsity().is_diag()),
            )
        )
    return _grouping(system, groups, elements, frozenset(range(n_rows)) - moved.keys())


def _share_entries(moved: dict[int, list[int]], elements: list[Element]) -> None:
    """Give the rows of one law the entries of them all: the kernel turns them among each other."""
    for e in elements:
        if e.part == 0 and e.parts > 1:
            rows = range(e.row, e.row + e.parts)
            both = sorted({k for r in rows for k in moved.get(r, ())})
            moved.update(dict.fromkeys(rows, both))


def _joined(system: Assembled, matrix: ca.SX, rows: ca.SX, spread: ca.SX) -> Sets:
    """Unknowns, then rows, in sets of those that act on each other."""
    nw = int(system.z.numel())
    sets = Sets(nw + int(system.lam.numel()))
    for i, j in _entries(matrix):
        sets.join(i, j)
    for places in speeds_by_tree([step.node for step in system.tree.steps]):
        for place in places[1:]:
            sets.join(places[0], place)
    for r, k in _entries(rows):
        sets.join(nw + r, k)
    for k, r in _entries(spread):
        sets.join(nw + r, k)
    for found in system.reduced.contact_rows:
        for r in found.all[1:]:
            sets.join(nw + found.all[0], nw + r)
    return sets


def reorder_groups(system: Assembled, grouping: Grouping, order: Sequence[int]) -> Grouping:
    """The same groups in another order."""
    groups = [grouping.groups[k] for k in order]
    return _grouping(system, groups, grouping.elements, grouping.prescribed)


def _grouping(
    system: Assembled,
    groups: Sequence[Group],
    elements: Sequence[Element],
    prescribed: frozenset[int],
) -> Grouping:
    spread, metric = pack_spread(system, groups)
    return Grouping(
        groups=tuple(groups),
        elements=tuple(elements),
        row_reads=_readings(system, groups),
        prescribed=prescribed,
        matrix=pack_matrix(system, groups),
        metric=metric,
        rows=pack_rows(system, groups),
        spread=spread,
    )


def pack_matrix(system: Assembled, groups: Sequence[Group]) -> ca.SX:
    """Their parts of A, one after the other by columns."""
    return _pack(_matrix(system, g) for g in groups)


def pack_rows(system: Assembled, groups: Sequence[Group]) -> ca.SX:
    """Their entries of J."""
    entries = [(g, *divmod(at, len(g.unknowns))) for g in groups for at in g.entries]
    return _pack(system.matrices.rows[g.rows[i], g.unknowns[k]] for g, i, k in entries)


def pack_spread(system: Assembled, groups: Sequence[Group]) -> tuple[ca.SX, ca.SX]:
    """Their columns of E, and their metrics."""
    return (
        _pack(system.matrices.spread[list(g.unknowns), r] for g in groups for r in g.rows),
        _pack(_metric(system, g) for g in groups),
    )


def _matrix(system: Assembled, g: Group) -> ca.SX:
    """Of a mass matrix the columns of speeds, of readings, which do not move, the diagonal."""
    if g.tree:
        return g.tree.data
    whole = system.matrices.matrix[list(g.unknowns), list(g.unknowns)]
    if g.general:
        return whole
    return _pack([whole[:, : g.n_speeds], ca.diag(whole)[g.n_speeds :]])


def _metric(system: Assembled, g: Group) -> ca.SX:
    """That of the speeds; nobody reads it where the kernel goes along a tree."""
    speeds = list(g.unknowns[: g.n_speeds])
    return ca.SX.zeros(g.tree.factor) if g.tree else system.matrices.metric[speeds, speeds]


def _entries(matrix: ca.SX) -> Iterable[tuple[int, int]]:
    pattern = matrix.sparsity()
    return zip(pattern.row(), pattern.get_col(), strict=True)


def _pack(parts: Iterable[ca.SX]) -> ca.SX:
    """The parts by columns below one another, dense."""
    items = [ca.vec(dense(part)) for part in parts if part.numel()]
    return ca.vertcat(*items) if items else ca.SX.zeros(0)


def _readings(system: Assembled, groups: Sequence[Group]) -> tuple[int, ...]:
    """The auxiliary unknowns in the order of the liaisons kept by coordinates, and their rows."""
    reduced = system.reduced
    reads = [-1] * int(system.lam.numel())
    place = {unknown: k for g in groups for k, unknown in enumerate(g.unknowns)}
    at = system.nv
    for link, rows in zip(reduced.mechanism.contacts, reduced.contact_rows, strict=True):
        for row in rows.reaction if link.reduced else ():
            reads[row] = place[at]
            at += 1
    return tuple(reads)


def _is_general(system: Assembled, unknowns: tuple[int, ...], rows: tuple[int, ...]) -> bool:
    """Whether this is no mass matrix with reactions along the rows: at a few random places.

    It is to be symmetric, whatever parameters and conditions are, and positive at positive ones.

    Auxiliary speeds are never solved for: that of the spin of a slender rod moves no mass.
    """
    places, own = list(unknowns), list(rows)
    if any(k >= system.nv + system.na for k in unknowns):
        return True
    matrix, effect = system.matrices.matrix[places, places], system.matrices.spread[places, own]
    moved = system.matrices.rows[own, places].T
    if not places:
        return False
    own_speeds = [i for i, k in enumerate(places) if k < system.nv]
    drawn = at_random(ca.veccat(matrix, effect, moved))
    inertias = at_positive(matrix[own_speeds, own_speeds]) if own_speeds else []
    if not drawn or (own_speeds and not inertias):
        return True
    return not (
        all(_is_symmetric(numbers.ravel(), len(places), len(own)) for numbers in drawn)
        and all(np.linalg.eigvalsh((a + a.T) / 2)[0] > 0 for a in inertias)
    )


def _is_symmetric(numbers: NDArray[np.floating], n: int, rows: int) -> bool:
    """Whether A (n x n) is, and E (n x rows) what moves the rows, one after the other."""
    a, e, j = np.split(numbers, [n * n, n * (n + rows)])
    a = a.reshape(n, n)
    small = 1e-12 * np.abs(a).max()
    return bool(np.all(np.abs(a - a.T) <= small) and np.allclose(e, j, 1e-12, 0))
