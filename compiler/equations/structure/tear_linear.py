"""Solves a linear component by formulas where no digits are lost, and leaves the rest as a block.

A formula put into the others is a step of Gauss' elimination whose pivot is chosen now, for all
values of the parameters. Steps one after the other multiply what they lose: of a ladder of
resistors taken cell by cell, nothing is left after some dozen. So no formula here holds an unknown
that another one gives, and what is left is solved with pivots chosen in the run.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from itertools import permutations

import casadi as ca
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.slopes import (
    CANCELS,
    size_of_sum,
    slopes,
    without_what_cancels,
)
from frot.compiler.translate.derivative_chains import replace_known

# A pivot's size at least, in that of the largest factor of its unknown, at the defaults.
_PIVOT = 0.1
# Unknowns that are solved by formulas (CasADi's minors), not as a block.
_FEW = 3


@dataclass(frozen=True, slots=True, eq=False)
class Torn:
    """`explicit` unknowns with their formulas in order, `iterated` ones with their `residual`.

    `divisors` are (factor, unknown, number of the equation) of what the formulas divide by.
    """

    explicit: tuple[tuple[ca.SX, ca.SX], ...]
    divisors: tuple[tuple[ca.SX, ca.SX, int], ...]
    iterated: tuple[ca.SX, ...]
    residual: tuple[ca.SX, ...]
    linear: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Entry:
    """The factor of an unknown in an equation; its size at the defaults, None if it varies."""

    factor: ca.SX
    size: float | None


def tear_linear(residual: list[ca.SX], unknowns: list[ca.SX], given: Given) -> Torn:
    """Tear a component of as many equations as unknowns, linear in these."""
    table = _entries(residual, unknowns, given)
    pairs = _choose(table, len(unknowns))
    own = column(unknowns[j] for _, j in pairs)
    factors = column(table[i, j].factor for i, j in pairs)
    rest = ca.substitute(column(residual[i] for i, _ in pairs), own, ca.SX.zeros(own.shape))
    if pairs:
        rest = column(without_what_cancels(value) for value in ca.vertsplit(rest))
    formulas = ca.vertsplit(-rest / factors) if pairs else []
    explicit = list(zip(ca.vertsplit(own) if pairs else [], formulas, strict=True))
    taken, given_by = {i for i, _ in pairs}, {j for _, j in pairs}
    kept = [x for j, x in enumerate(unknowns) if j not in given_by]
    known = {symbol.element_hash(): value for symbol, value in explicit}
    left = [replace_known(x, known) for i, x in enumerate(residual) if i not in taken]
    divisors = tuple((table[i, j].factor, unknowns[j], i) for i, j in pairs)
    if len(kept) > _FEW:
        return Torn(tuple(explicit), divisors, tuple(kept), tuple(left), True)
    z, whole = column(kept), column(left)
    constant = ca.substitute(whole, z, ca.SX.zeros(z.shape))
    matrix = ca.jacobian(whole, z)
    solved = z
    if kept:
        last = next(i for i in range(len(residual)) if i not in taken)
        determinant = _determinant(matrix)
        solved = ca.densify(-(ca.adj(matrix) @ constant) / determinant)
        divisors = (*divisors, (determinant, kept[0], last))
    values = {x.element_hash(): solved[k] for k, x in enumerate(kept)}
    return Torn(
        (
            *((x, values[x.element_hash()]) for x in kept),
            *((symbol, replace_known(value, values)) for symbol, value in explicit),
        ),
        divisors,
        (),
        (),
        True,
    )


def _determinant(matrix: ca.SX) -> ca.SX:
    """The determinant; zero where its terms cancel but for rounding."""
    places = range(matrix.size1())
    size = ca.SX(0)
    for order in permutations(places):
        product = ca.SX(1)
        for i in places:
            product *= size_of_sum(matrix[i, order[i]])
        size += product
    value = ca.det(matrix)
    return ca.densify(ca.if_else(ca.fabs(value) > CANCELS * size, value, 0))


def _entries(
    residual: list[ca.SX], unknowns: list[ca.SX], given: Given
) -> dict[tuple[int, int], _Entry]:
    rows, columns, factors = slopes(residual, unknowns)
    fixed = given.fixed(column(factors))
    sizes: list[float | None] = [None] * len(factors)
    for k, number in zip(fixed, given.numbers([factors[k] for k in fixed]), strict=True):
        sizes[k] = abs(number)
    return {
        (i, j): _Entry(factor, size)
        for i, j, factor, size in zip(rows, columns, factors, sizes, strict=True)
    }


def _choose(table: dict[tuple[int, int], _Entry], count: int) -> list[tuple[int, int]]:
    """Equations with the unknown that each gives, none of which stands in another of them.

    The multiples that are subtracted elsewhere are small; those that no parameter changes come
    first, then those that fill in least.
    """
    inside: list[list[int]] = [[] for _ in range(count)]
    holders: dict[int, list[int]] = defaultdict(list)
    for i, j in table:
        inside[i].append(j)
        holders[j].append(i)
    ranked: list[tuple[int, int, int, int]] = []
    for j, equations in holders.items():
        entries = [table[i, j] for i in equations]
        largest = max((e.size for e in entries if e.size is not None), default=0.0)
        if any(e.size is None for e in entries) or not 0 < largest < float("inf"):
            continue
        depends = int(not all(e.factor.is_constant() for e in entries))
        for i, entry in zip(equations, entries, strict=True):
            assert entry.size is not None
            if entry.size >= _PIVOT * largest:
                fill = (len(inside[i]) - 1) * (len(equations) - 1)
                ranked.append((depends, fill, i, j))
    pairs: list[tuple[int, int]] = []
    locked: set[int] = set()
    defined: set[int] = set()
    taken: set[int] = set()
    for _, _, i, j in sorted(ranked):
        if i in taken or j in locked or not defined.isdisjoint(inside[i]):
            continue
        pairs.append((i, j))
        taken.add(i)
        defined.add(j)
        locked.update(inside[i])
    return pairs
