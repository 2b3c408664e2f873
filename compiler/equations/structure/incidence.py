"""Which unknown stands in which equation and with what factor, kept while equations change."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.slopes import slopes, symbols_inside
from frot.compiler.translate.derivative_chains import Chains

UNIT, CONSTANT, PARAMETER, UNUSABLE = range(4)


@dataclass(frozen=True, slots=True)
class Factor:
    """What an equation that is linear in an unknown has before it; its kind is the first that fits.

    UNIT: 1 or -1, CONSTANT, PARAMETER: of parameters alone; not zero at their defaults, at which
    `size` is its size.
    """

    value: ca.SX
    kind: int
    size: float


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """One equation: the chains in it with their highest orders, the factors of the unknowns.

    `unrated`: it holds something that has no derivative.
    """

    value: ca.SX
    orders: dict[int, int]
    factors: dict[int, Factor]
    unrated: bool


class Table:
    """The equations by their numbers. `equations` are those of a chain."""

    def __init__(self, chains: Chains, given: Given) -> None:
        """An empty table."""
        self.rows: dict[int, Row] = {}
        self.equations: dict[int, set[int]] = defaultdict(set)
        self._differentiated: dict[int, set[int]] = defaultdict(set)
        self._chains, self._given = chains, given

    def is_differentiated(self, chain: int) -> bool:
        """Whether a derivative of the chain stands in any equation."""
        return bool(self._differentiated[chain])

    def largest(self, chain: int) -> float:
        """The size of the largest factor of the chain in any equation."""
        found = (self.rows[i].factors.get(chain) for i in self.equations[chain])
        return max((factor.size for factor in found if factor is not None), default=0.0)

    def remove(self, number: int) -> Row:
        """Take an equation out."""
        row = self.rows.pop(number)
        for chain, order in row.orders.items():
            self.equations[chain].discard(number)
            if order:
                self._differentiated[chain].discard(number)
        return row

    def put(self, values: Mapping[int, ca.SX]) -> None:
        """Put equations in, or others in their places."""
        for number in values:
            if number in self.rows:
                self.remove(number)
        for number, row in zip(values, self._read(list(values.values())), strict=True):
            self.rows[number] = row
            for chain, order in row.orders.items():
                self.equations[chain].add(number)
                if order:
                    self._differentiated[chain].add(number)

    def _read(self, values: list[ca.SX]) -> list[Row]:
        chains = self._chains
        symbols, inside = symbols_inside(values)
        places = [chains.place.get(s.element_hash()) for s in symbols]
        unrated = {k for k, s in enumerate(symbols) if chains.is_unrated(s)}
        direct = [(s, at[0]) for s, at in zip(symbols, places, strict=True) if at and not at[1]]
        rows, columns, found = slopes(values, [s for s, _ in direct])
        factors: list[dict[int, Factor]] = [{} for _ in values]
        kinds, sizes = self._kinds(found)
        for row, at, value, kind, size in zip(rows, columns, found, kinds, sizes, strict=True):
            if kind != UNUSABLE:
                factors[row][direct[at][1]] = Factor(value, kind, size)
        made = []
        for value, own, factor in zip(values, inside, factors, strict=True):
            orders: dict[int, int] = {}
            for chain, order in filter(None, (places[k] for k in own)):
                orders[chain] = max(order, orders.get(chain, 0))
            made.append(Row(value, orders, factor, not unrated.isdisjoint(own)))
        return made

    def _kinds(self, factors: list[ca.SX]) -> tuple[list[int], list[float]]:
        kinds, sizes = [UNUSABLE] * len(factors), [0.0] * len(factors)
        fixed = self._given.fixed(column(factors))
        for k, value in zip(fixed, self._given.numbers([factors[k] for k in fixed]), strict=True):
            if value == 0 or value != value or abs(value) == float("inf"):
                continue
            sizes[k] = abs(value)
            if factors[k].is_constant():
                kinds[k] = UNIT if abs(value) == 1 else CONSTANT
            else:
                kinds[k] = PARAMETER
        return kinds, sizes
