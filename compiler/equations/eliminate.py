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
from frot.compiler.equations.chains import Chains, Resolver
from frot.compiler.equations.origins import Origin
from frot.compiler.lowering.symbols import column

Entries = Mapping[int, int]

# Equations that a removal may lengthen: (terms less one) x (other equations) of the unknown.
MOST_FILL = 12


@dataclass(slots=True, eq=False)
class Residuals:
    """Scalar equations 0 = values[i] with their origins."""

    values: list[ca.SX]
    origins: list[Origin]


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
    entry: int


def eliminate(
    residuals: Residuals,
    may_define: Callable[[int, int, Entries], bool],
    chains: Chains,
    p: ca.SX,
    defaults: ca.DM,
) -> Eliminated:
    """Remove explicit unknowns, a set of independent ones at a time, until none is left.

    `may_define(i, j, entries)`: whether equation i, counted as in `residuals`, may define the
    unknown of chain j; `entries` maps the chains that stand in it to their highest orders. `p` and
    `defaults` are the parameters and their values, by which a divisor is known not to be zero.
    """
    values, origins = list(residuals.values), list(residuals.origins)
    numbers = list(range(len(values)))
    rounds: list[tuple[list[int], ca.SX]] = []
    pivots: list[Pivot] = []
    while values:
        table = _Table(values, chains, p, defaults)
        chosen = _choose(table, numbers, may_define, chains)
        if not chosen:
            break
        definitions = column(
            -ca.substitute(values[c.equation], chains.symbol(c.chain, 0), ca.SX(0))
            / table.coefficients[c.entry]
            for c in chosen
        )
        for c in chosen:
            coefficient = table.coefficients[c.entry]
            if not coefficient.is_constant():
                name = chains.items[c.chain].name
                pivots.append(Pivot(coefficient, name, origins[c.equation]))
        removed = [c.chain for c in chosen]
        rounds.append((removed, definitions))
        used = {c.equation for c in chosen}
        kept = [i for i in range(len(values)) if i not in used]
        origins = [origins[i] for i in kept]
        numbers = [numbers[i] for i in kept]
        left = column(values[i] for i in kept)
        values = ca.vertsplit(_replace(left, removed, definitions, chains)) if kept else []
    removed_at_all = {chain for removed, _ in rounds for chain in removed}
    return Eliminated(
        Residuals(values, origins), numbers, removed_at_all, _resolver(rounds, chains), pivots
    )


class _Table:
    """Which unknown occurs in which equation, and with what coefficient."""

    def __init__(self, values: list[ca.SX], chains: Chains, p: ca.SX, defaults: ca.DM) -> None:
        whole = column(values)
        everything = ca.symvar(whole)
        own = [s for s in everything if s.element_hash() in chains.place]
        parameters = {s.element_hash() for s in ca.vertsplit(p)} if p.numel() else set()
        varying = [s for s in everything if s.element_hash() not in parameters]
        jacobian = ca.jacobian(whole, column(own)) if own else ca.SX(len(values), 0)
        self.coefficients = jacobian.nz[:] if jacobian.nnz() else ca.SX.zeros(0)
        rows, columns = jacobian.sparsity().get_triplet()
        self.orders: list[dict[int, int]] = [{} for _ in values]
        self.equations: dict[int, set[int]] = defaultdict(set)
        self.differentiated: set[int] = set()
        self.entries: list[tuple[int, int, int]] = []
        for entry, (row, at) in enumerate(zip(rows, columns, strict=True)):
            chain, order = chains.place[own[at].element_hash()]
            self.orders[row][chain] = max(order, self.orders[row].get(chain, 0))
            self.equations[chain].add(row)
            if order:
                self.differentiated.add(chain)
            else:
                self.entries.append((entry, row, chain))
        self.unrated = {i for i, value in enumerate(values) if chains.without_rate(value)}
        self.kinds = self._kinds(column(varying), p, defaults)

    def _kinds(self, varying: ca.SX, p: ca.SX, defaults: ca.DM) -> list[int]:
        """0 for a coefficient +-1, 1 for another constant, 2 for a parameter, -1 unusable."""
        count = self.coefficients.numel()
        if not count:
            return []
        moving: set[int] = set()
        if varying.numel():
            moving = set(ca.jacobian_sparsity(self.coefficients, varying).row())
        fixed = [k for k in range(count) if k not in moving]
        kinds = [-1] * count
        values = ca.Function("coefficients", [p], [column(self.coefficients[k] for k in fixed)])(
            defaults
        )
        for k, value in zip(fixed, values.full().ravel() if fixed else (), strict=True):
            if value == 0 or value != value or abs(value) == float("inf"):
                continue
            if self.coefficients[k].is_constant():
                kinds[k] = 0 if abs(value) == 1 else 1
            else:
                kinds[k] = 2
        return kinds


def _choose(
    table: _Table,
    numbers: Sequence[int],
    may_define: Callable[[int, int, Entries], bool],
    chains: Chains,
) -> list[_Candidate]:
    """Definitions none of which holds an unknown that another defines; algebraic ones first."""
    candidates = [
        c
        for entry in table.entries
        if may_define(numbers[entry[1]], entry[2], table.orders[entry[1]])
        and (c := _candidate(entry, table, chains))
    ]
    if any(c.rank[0] == 0 for c in candidates):
        candidates = [c for c in candidates if c.rank[0] == 0]
    chosen: list[_Candidate] = []
    defined: set[int] = set()
    locked: set[int] = set()  # unknowns of the equations chosen
    taken: set[int] = set()
    for c in sorted(candidates, key=lambda c: (c.rank, c.equation, c.chain)):
        inside = table.orders[c.equation]
        if c.equation in taken or c.chain in locked or any(j in defined for j in inside):
            continue
        chosen.append(c)
        defined.add(c.chain)
        taken.add(c.equation)
        locked.update(inside)
    return chosen


def _candidate(entry: tuple[int, int, int], table: _Table, chains: Chains) -> _Candidate | None:
    at, row, chain = entry
    kind = table.kinds[at]
    if kind < 0 or chains.items[chain].fixed or table.orders[row][chain] > 0:
        return None
    terms, others = len(table.orders[row]) - 1, len(table.equations[chain]) - 1
    if terms > 1 and others > 1 and terms * others > MOST_FILL:
        return None
    differentiated = chain in table.differentiated
    if differentiated and row in table.unrated:
        return None
    return _Candidate((int(differentiated), kind, terms * others), row, chain, at)


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
    for symbol in ca.symvar(value):
        _learn_rates(symbol, chains, resolver)
    return resolver.resolve(value)
