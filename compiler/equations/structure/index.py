"""Which equations must be differentiated, and how often; a matching with highest derivatives.

Where there is none: which unknowns nothing determines and which equations are too many.

The algorithm is that of C. Pantelides (SIAM J. Sci. Stat. Comput. 9, 1988).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from frot.compiler.equations.structure.sparse import match, pattern
from frot.compiler.translate.origins import Origin, Unknown
from frot.dsl import Label, Log

MOST_NAMED = 8


@dataclass(frozen=True, slots=True)
class Index:
    """Equation i is differentiated `equations[i]` times.

    Unknown j is determined by its derivative of order `unknowns[j]`, from equation `solver[j]`.
    """

    equations: tuple[int, ...]
    unknowns: tuple[int, ...]
    solver: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Unbalanced:
    """Unknowns that nothing determines, and equations that are too many, by index."""

    unknowns: tuple[int, ...]
    equations: tuple[int, ...]


def find_unbalanced(incidence: Sequence[Sequence[int]], count: int) -> Unbalanced | None:
    """None where every unknown can have an equation of its own (derivatives stand for unknowns).

    `incidence[i]` are the unknowns of equation i, `count` the number of unknowns. The parts named
    are those of A. Dulmage, N. Mendelsohn (1958): all that shares the lack or the excess.
    """
    rows = len(incidence)
    if rows == 0 and count == 0:
        return None
    of_row = match(incidence, count)
    row_of = [-1] * count
    for i, j in enumerate(of_row):
        if j >= 0:
            row_of[j] = i
    free_rows = [i for i in range(rows) if of_row[i] < 0]
    free_columns = [j for j in range(count) if row_of[j] < 0]
    if not free_rows and not free_columns:
        return None
    by_column = pattern(incidence, count).tocsc()
    too_many: set[int] = set(free_rows)
    pending = list(free_rows)
    while pending:
        for j in incidence[pending.pop()]:
            i = row_of[j]
            if i >= 0 and i not in too_many:
                too_many.add(i)
                pending.append(i)
    lacking: set[int] = set(free_columns)
    pending = list(free_columns)
    while pending:
        at = pending.pop()
        for i in by_column.indices[by_column.indptr[at] : by_column.indptr[at + 1]]:
            j = of_row[i]
            if j >= 0 and j not in lacking:
                lacking.add(j)
                pending.append(j)
    return Unbalanced(tuple(sorted(lacking)), tuple(sorted(too_many)))


def reduce_index(incidence: Sequence[dict[int, int]], count: int) -> Index:
    """The differentiations of a system that `find_unbalanced` found nothing against.

    `incidence[i]` maps each unknown of equation i to the highest order it has there.
    """
    differentiated = [0] * len(incidence)
    highest = [0] * count
    for row in incidence:
        for j, order in row.items():
            highest[j] = max(highest[j], order)
    solver, solves = _match_highest(incidence, highest)
    for equation in (i for i, j in enumerate(solves) if j < 0):
        while True:
            path, equations, unknowns = _augment(
                equation, incidence, differentiated, highest, solver, solves
            )
            if path:
                break
            for j in unknowns:
                highest[j] += 1
            for i in equations:
                differentiated[i] += 1
    return Index(tuple(differentiated), tuple(highest), tuple(solver))


def _match_highest(
    incidence: Sequence[dict[int, int]], highest: Sequence[int]
) -> tuple[list[int], list[int]]:
    """The most pairs of equations with highest derivatives in them, before any differentiation.

    Gives the equation of each unknown and the unknown of each equation, or -1.
    """
    solver, solves = [-1] * len(highest), [-1] * len(incidence)
    rows = [[j for j, order in row.items() if order == highest[j]] for row in incidence]
    for i, j in enumerate(match(rows, len(highest))):
        if j >= 0:
            solver[j], solves[i] = i, j
    return solver, solves


def _augment(
    start: int,
    incidence: Sequence[dict[int, int]],
    differentiated: list[int],
    highest: list[int],
    solver: list[int],
    solves: list[int],
) -> tuple[bool, set[int], set[int]]:
    """Give `start` a highest derivative of its own, moving others if need be (`solver` changes).

    Where there is none: False, with the equations and unknowns that were reached.
    """
    seen_equations, seen_unknowns = {start}, set()
    reached_from: dict[int, int] = {}
    pending = [start]
    while pending:
        i = pending.pop()
        for j, order in incidence[i].items():
            if order + differentiated[i] != highest[j] or j in seen_unknowns:
                continue
            seen_unknowns.add(j)
            reached_from[j] = i
            if solver[j] < 0:
                _shift(j, start, reached_from, solver, solves)
                return True, seen_equations, seen_unknowns
            seen_equations.add(solver[j])
            pending.append(solver[j])
    return False, seen_equations, seen_unknowns


def _shift(
    j: int, start: int, reached_from: dict[int, int], solver: list[int], solves: list[int]
) -> None:
    """Hand the unknowns along the path over, from its end to its start."""
    while True:
        i = reached_from[j]
        before = solves[i]
        solver[j], solves[i] = i, j
        if i == start:
            return
        j = before


def report_unbalanced(
    found: Unbalanced,
    unknowns: Sequence[Unknown],
    origins: Sequence[Origin],
    log: Log,
) -> None:
    """Report E0603 for the unknowns and E0604 for the equations, each with its places."""
    if found.unknowns and all(unknowns[j].span is None for j in found.unknowns):
        moved = _listed([unknowns[j].name for j in found.unknowns])
        log.report(
            "E0603",
            f"too few equations: nothing determines the acceleration of {moved}, for forces that "
            "follow accelerations take its inertia away",
            origins[found.equations[0]].span if found.equations else None,
            help="let such a force act through a state, or give the body another mass",
        )
        return
    names = [unknowns[j].name for j in found.unknowns]
    if found.unknowns and not found.equations:
        spans = {unknowns[j].span: unknowns[j].name for j in found.unknowns}
        first, *others = [(s, n) for s, n in spans.items() if s is not None]
        one = len(names) == 1
        log.report(
            "E0603",
            f"too few equations: nothing determines {_listed(names)}"
            if one
            else f"too few equations for the unknowns {_listed(names)}",
            first[0],
            labels=tuple(Label(s, f"{n!r}") for s, n in others[:MOST_NAMED]),
            help="write an equation for it, connect it or give it a value"
            if one
            else "write equations for them, connect them or give them values",
        )
    if found.equations:
        texts = [_named(origins[i]) for i in found.equations]
        places = list(dict.fromkeys(origins[i].span for i in found.equations))
        log.report(
            "E0604",
            "too many equations: "
            + (
                f"{texts[0]} determines nothing that is left open"
                if len(texts) == 1
                else f"one of these {len(texts)} has no unknown of its own: {_listed(texts, '')}"
            ),
            places[0],
            labels=tuple(Label(s, "one of them") for s in places[1:MOST_NAMED]),
            notes=(f"nothing is left to determine {_listed(names)}",) if names else (),
            help="leave one out, or declare what it should determine as a variable",
        )


def _named(origin: Origin) -> str:
    return f"`{origin.text}`" + (f" of {origin.owner}" if origin.owner else "")


def _listed(names: Sequence[str], quote: str = "'") -> str:
    shown = [f"{quote}{n}{quote}" for n in names[:MOST_NAMED]]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")
