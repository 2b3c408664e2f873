"""Removes unknowns that an equation gives explicitly: aliases, ideal gears, what is prescribed.

An equation that is linear in an unknown, with a constant or parameter as coefficient, defines it;
the unknown and its derivatives are replaced everywhere. For an unknown with states this is a choice
of dummy derivatives made beforehand: it needs no state, no index reduction and no projection.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.structure.incidence import PARAMETER, UNIT, Factor, Row, Table
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.slopes import CANCELS
from frot.compiler.translate.derivative_chains import Chains, Resolver
from frot.compiler.translate.origins import Origin

Entries = Mapping[int, int]

# Equations that a removal may lengthen: (terms less one) x (other equations) of the unknown.
MOST_FILL = 12
# A factor that is solved for, in the largest of its unknown: dividing by less costs digits.
LEAST = 0.01


@dataclass(frozen=True, slots=True, eq=False)
class Residuals:
    """Scalar equations 0 = values[i] with their origins."""

    values: Sequence[ca.SX]
    origins: Sequence[Origin]


@dataclass(frozen=True, slots=True, eq=False)
class Pivot:
    """A parameter expression that was divided by: it must not be zero."""

    value: ca.SX
    unknown: str
    origin: Origin


@dataclass(slots=True, eq=False)
class Eliminated:
    """The equations left with the numbers they had, the removed unknowns and what they are.

    `pivots` are the divisors of their definitions.
    """

    residuals: Residuals
    numbers: list[int]
    removed: set[int]
    resolver: Resolver
    pivots: list[Pivot]


@dataclass(frozen=True, slots=True)
class _Candidate:
    rank: tuple[int, int, int]
    equation: int
    chain: int


def eliminate(
    residuals: Residuals,
    may_define: Callable[[int, int, Entries], bool],
    chains: Chains,
    given: Given,
) -> Eliminated:
    """Remove explicit unknowns, a set of independent ones at a time, until none is left.

    `may_define(i, j, entries)`: whether equation i, counted as in `residuals`, may define the
    unknown of chain j; `entries` maps the chains that stand in it to their highest orders.
    """
    table = Table(chains, given)
    table.put(dict(enumerate(residuals.values)))
    rounds: list[tuple[list[int], ca.SX]] = []
    pivots: list[Pivot] = []
    while chosen := _choose(table, may_define, chains):
        removed = [c.chain for c in chosen]
        rows = [table.remove(c.equation) for c in chosen]
        for c, row in zip(chosen, rows, strict=True):
            factor = row.factors[c.chain]
            if factor.kind == PARAMETER:
                name = chains.items[c.chain].name
                pivots.append(Pivot(factor.value, name, residuals.origins[c.equation]))
        # None of these equations holds an unknown that another one defines.
        rests = ca.substitute(
            column(row.value for row in rows),
            column(chains.symbol(chain, 0) for chain in removed),
            ca.SX.zeros(len(removed)),
        )
        factors = column(row.factors[c.chain].value for c, row in zip(chosen, rows, strict=True))
        definitions = -rests / factors
        rounds.append((removed, definitions))
        touched = sorted({i for chain in removed for i in table.equations[chain]})
        if touched:
            values = column(table.rows[i].value for i in touched)
            replaced = ca.vertsplit(_replace(values, removed, definitions, chains))
            by = dict(zip(removed, rows, strict=True))
            left = [
                _without(_cancelled(table.rows[i], by), value, chains)
                for i, value in zip(touched, replaced, strict=True)
            ]
            table.put(dict(zip(touched, left, strict=True)))
    numbers = sorted(table.rows)
    return Eliminated(
        Residuals([table.rows[i].value for i in numbers], [residuals.origins[i] for i in numbers]),
        numbers,
        {chain for removed, _ in rounds for chain in removed},
        _resolver(rounds, chains),
        pivots,
    )


def _choose(
    table: Table, may_define: Callable[[int, int, Entries], bool], chains: Chains
) -> list[_Candidate]:
    """Definitions none of which holds an unknown that another defines; algebraic ones first."""
    candidates = [
        c
        for number, row in table.rows.items()
        for chain, factor in row.factors.items()
        if may_define(number, chain, row.orders)
        and (c := _candidate(number, chain, factor, table, chains))
    ]
    if any(c.rank[0] == 0 for c in candidates):
        candidates = [c for c in candidates if c.rank[0] == 0]
    chosen: list[_Candidate] = []
    defined: set[int] = set()
    locked: set[int] = set()  # unknowns of the equations chosen
    taken: set[int] = set()
    for c in sorted(candidates, key=lambda c: (c.rank, c.equation, c.chain)):
        inside = table.rows[c.equation].orders
        if c.equation in taken or c.chain in locked or not defined.isdisjoint(inside):
            continue
        chosen.append(c)
        defined.add(c.chain)
        taken.add(c.equation)
        locked.update(inside)
    return chosen


def _candidate(
    number: int, chain: int, factor: Factor, table: Table, chains: Chains
) -> _Candidate | None:
    row, kind = table.rows[number], factor.kind
    if chains.items[chain].fixed or row.orders[chain] > 0:
        return None
    variable = chains.items[chain].variable
    if variable is not None and variable.type.base != "real" and kind != UNIT:
        return None  # `b = not b` is 2*b = 1, which no condition or whole number solves
    terms, others = len(row.orders) - 1, len(table.equations[chain]) - 1
    if terms > 1 and others > 1 and terms * others > MOST_FILL:
        return None
    differentiated = table.is_differentiated(chain)
    if differentiated and row.unrated:
        return None
    small = not differentiated and factor.size < LEAST * table.largest(chain)
    if small and (kind != UNIT or _is_difference(row, chains)):
        return None
    return _Candidate((int(differentiated), kind, terms * others), number, chain)


def _is_difference(row: Row, chains: Chains) -> bool:
    """Whether what the equation says of an unknown has several terms, which may cancel."""
    if len(row.orders) != 2:
        return len(row.orders) > 2
    unknowns = [s for s in ca.symvar(row.value) if s.element_hash() in chains.place]
    rest = ca.substitute(row.value, column(unknowns), ca.SX.zeros(len(unknowns)))
    return not rest.is_zero()


def _replace(value: ca.SX, removed: list[int], definitions: ca.SX, chains: Chains) -> ca.SX:
    """The value with the removed unknowns and their derivatives replaced."""
    position = {chain: k for k, chain in enumerate(removed)}
    present: dict[int, list[tuple[int, ca.SX]]] = defaultdict(list)
    for symbol in ca.symvar(value):
        chain, order = chains.place.get(symbol.element_hash(), (-1, 0))
        if chain in position:
            present[order].append((position[chain], symbol))
    symbols: list[ca.SX] = []
    replacements: list[ca.SX] = []
    current = definitions
    for order in range(max(present, default=-1) + 1):
        if order:
            current = chains.rate(current)
        for k, symbol in present[order]:
            symbols.append(symbol)
            replacements.append(current[k])
    if not symbols:
        return value
    return ca.substitute(value, column(symbols), column(replacements))


def _cancelled(row: Row, by: Mapping[int, Row]) -> list[int]:
    """The unknowns that go out of an equation, but for rounding, with those that `by` defines.

    The rounding of 0.3 - 3*0.1 is no factor to solve for.
    """
    sums: dict[int, list[float]] = defaultdict(list)
    unsure: set[int] = set()
    for chain, other in by.items():
        if chain not in row.orders:
            continue
        weight, own = _constant(row, chain), _constant(other, chain)
        for j in other.orders:
            factor = _constant(other, j)
            if weight is None or own is None or factor is None:
                unsure.add(j)
            else:
                sums[j].append(-weight / own * factor)
    gone: list[int] = []
    for j, terms in sums.items():
        before = _constant(row, j) if j in row.orders else 0.0
        if j in by or j in unsure or before is None:
            continue
        terms.append(before)
        if abs(sum(terms)) <= CANCELS * max(map(abs, terms)):
            gone.append(j)
    return gone


def _constant(row: Row, chain: int) -> float | None:
    """The factor of an unknown in an equation, if that is a number."""
    factor = row.factors.get(chain)
    return float(factor.value) if factor is not None and factor.value.is_constant() else None


def _without(gone: list[int], value: ca.SX, chains: Chains) -> ca.SX:
    if not gone:
        return value
    symbols = column(chains.symbol(j, 0) for j in gone)
    return ca.substitute(value, symbols, ca.SX.zeros(len(gone)))


def _resolver(rounds: list[tuple[list[int], ca.SX]], chains: Chains) -> Resolver:
    """What every removed unknown is in terms of those left, from the last round to the first."""
    resolver = Resolver()
    for removed, definitions in reversed(rounds):
        for symbol in ca.symvar(definitions):
            _learn_rates(symbol, chains, resolver)
        values = resolver.resolve(definitions)
        for k, chain in enumerate(removed):
            resolver.learn(chains.symbol(chain, 0), values[k])
    return resolver


def _learn_rates(symbol: ca.SX, chains: Chains, resolver: Resolver) -> None:
    """Let the resolver know a derivative of a removed unknown, from the definition's own."""
    key = symbol.element_hash()
    chain, order = chains.place.get(key, (-1, 0))
    if order == 0 or key in resolver.known:
        return
    if chains.symbol(chain, 0).element_hash() not in resolver.known:
        return
    lower = chains.symbol(chain, order - 1)
    _learn_rates(lower, chains, resolver)
    resolver.learn(symbol, chains.rate(resolver.known[lower.element_hash()]))


def resolve_all(value: ca.SX, chains: Chains, resolver: Resolver) -> ca.SX:
    """The value in terms of the unknowns left, derivatives of removed ones included."""
    if not resolver.known:
        return value
    for symbol in ca.symvar(value):
        _learn_rates(symbol, chains, resolver)
    return resolver.resolve(value)
