"""Isostatic replacements in a loop: liaisons that lock less with the same mobility."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from frot.compiler.mechanics.constraint import Constraint, JointParts
from frot.compiler.mechanics.liaisons.joints import JOINTS, Pairing, make_joint
from frot.compiler.mechanics.liaisons.translations import LEFT, FixedAlong
from frot.compiler.mechanics.values import Axis
from frot.compiler.report.redundancy import Loop
from frot.compiler.report.relations import Floats, Posture, Relations, make_relations, rank
from frot.dsl.catalogue import Softer
from frot.dsl.checked import Expression, Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Change:
    """A liaison to be replaced: by `kind`, or to be left out where that is empty."""

    liaison: Liaison
    kind: str


@dataclass(frozen=True, slots=True, eq=False)
class Cure:
    """Changes that take away redundant relations and no others; `left` are still too many."""

    changes: tuple[Change, ...]
    left: int


# Replacements examined; then the best of them is reported.
_TRIES = 300


def find_cure(relations: Relations, posture: Posture, loop: Loop) -> Cure:
    """Liaisons of the loop that may lock less, one after another, until nothing is too much.

    A change counts where the relations that are left still make up all that the loop keeps.
    """
    inside = set(loop.liaisons)
    rows = {k: x.liaison for k, x in enumerate(relations.links) if x.liaison in inside}
    offered = [
        (x, kind, locks)
        for x in sorted(loop.liaisons, key=lambda one: bool(one.laws))
        for kind, locks in _offers(x, relations)
    ]
    extra = tuple(lock for _, _, locks in offered for lock in locks)
    more = replace(relations.mechanism, contacts=(*relations.links, *extra))
    whole = make_relations(more, dict.fromkeys(more.contacts, False))
    whole = replace(whole, size=relations.size)
    sides = np.concatenate([posture.sides, np.ones(len(extra))])
    values = whole.scaled(whole.at(replace(posture, sides=sides)).rows)
    count = len(relations.links)
    own = {x: [k for k, y in rows.items() if y is x] for x in loop.liaisons}
    needed = rank(values[list(rows)])
    left = len(rows) - needed
    options: dict[Liaison, list[tuple[str, list[int]]]] = {x: [] for x, _, _ in offered}
    for liaison, kind, locks in offered:
        options[liaison].append((kind, list(range(count, count + len(locks)))))
        count += len(locks)
    found = _Soften(values, own, options, needed).found(left)
    return Cure(tuple(Change(x, kind) for x, kind in found[0]), found[1])


class _Soften:
    """Looks for the first way to lock less, liaison after liaison, that leaves nothing too much."""

    def __init__(
        self,
        values: Floats,
        own: Mapping[Liaison, list[int]],
        options: Mapping[Liaison, list[tuple[str, list[int]]]],
        needed: int,
    ) -> None:
        self.values, self.own, self.options, self.needed = values, own, options, needed
        self.tries = _TRIES
        self.best: tuple[list[tuple[Liaison, str]], int] = ([], 0)

    def found(self, left: int) -> tuple[list[tuple[Liaison, str]], int]:
        """The changes of the first way that leaves least, and how much that is."""
        self.best = ([], left)
        self._go(list(self.options), dict(self.own), [], left)
        return self.best

    def _go(
        self,
        open_: list[Liaison],
        rows: dict[Liaison, list[int]],
        changes: list[tuple[Liaison, str]],
        left: int,
    ) -> None:
        if left < self.best[1]:
            self.best = (changes, left)
        if not open_ or not self.best[1]:
            return
        first, others = open_[0], open_[1:]
        for kind, places in self.options[first]:
            saved = len(self.own[first]) - len(places)
            if not 0 < saved <= left or not self.tries:
                continue
            self.tries -= 1
            after = {**rows, first: places}
            if rank(self.values[[k for some in after.values() for k in some]]) < self.needed:
                continue
            self._go(others, after, [*changes, (first, kind)], left - saved)
            if not self.best[1]:
                return
        self._go(others, rows, changes, left)


def _offers(liaison: Liaison, relations: Relations) -> Iterator[tuple[str, list[Constraint]]]:
    """Replacements of a liaison, best first, with their relations."""
    link = next(x for x in relations.links if x.liaison is liaison)
    joint, planar = link.joint, relations.mechanism.model.planar
    if liaison.driven or joint is None:
        if not liaison.driven:
            yield "", []
        return
    for option in liaison.kind.softer_in_plane if planar else liaison.kind.softer:
        yield option.kind, _relations(joint, _pairing(option, liaison.options, planar))
    if len(joint.locks) == 1:
        yield "", []


def _pairing(option: Softer, given: Mapping[str, Expression], planar: bool) -> Pairing:
    axes = {new: given.get(old, default) for new, old, default in option.axes}
    axis = Axis(axes.get("axis", "z"))
    match option.kind.split(" "):
        case ["lineaire_annulaire"]:
            return Pairing((), (FixedAlong(axis, 0), FixedAlong(axis, 1)))
        case ["point_surface"]:
            return Pairing((), (FixedAlong(axis),))
        case ["point_courbe", _, way]:
            return Pairing((), (FixedAlong(Axis(way), LEFT),))
    return JOINTS[option.kind](axes, planar)  # type: ignore[arg-type]


def _relations(joint: JointParts, pairing: Pairing) -> list[Constraint]:
    other = make_joint(joint.liaison, joint.a, joint.b, replace(pairing, motions=()), {})
    return list(other.rows(True))
