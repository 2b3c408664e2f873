"""Unknown functions of time as chains of symbols: the unknown, its rate, the rate of that, ..."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.symbolic.columns import column
from frot.dsl.checked import Variable
from frot.dsl.messages.source import Span


@dataclass(slots=True, eq=False)
class Chain:
    """One scalar unknown. `symbols[k]` stands for its k-th derivative.

    `variable` is the variable of the text it belongs to; None for a coordinate of the mechanism,
    which is `fixed` (no equation of the text replaces it), and for what the compiler adds.
    """

    name: str
    span: Span | None
    variable: Variable | None
    symbols: list[ca.SX]
    fixed: bool


class Chains:
    """All unknowns of a model, and the derivative with respect to time of what depends on them."""

    def __init__(self, time: ca.SX) -> None:
        """`time` is the symbol of the independent variable."""
        self.items: list[Chain] = []
        self.place: dict[int, tuple[int, int]] = {}
        self._time = time.element_hash()
        self._given: dict[int, ca.SX] = {}
        self._turned_by: dict[int, list[int]] = {}
        self._without_rate: dict[int, tuple[str, bool]] = {}

    def add(
        self,
        name: str,
        span: Span | None,
        variable: Variable | None = None,
        symbols: Iterable[ca.SX] = (),
        fixed: bool = False,
    ) -> int:
        """A new chain, beginning with these symbols; returns its index."""
        index = len(self.items)
        self.items.append(Chain(name, span, variable, [], fixed))
        for symbol in symbols or (ca.SX.sym(name),):
            self._append(index, symbol)
        return index

    def _append(self, index: int, symbol: ca.SX) -> None:
        chain = self.items[index]
        self.place[symbol.element_hash()] = (index, len(chain.symbols))
        chain.symbols.append(symbol)

    def symbol(self, index: int, order: int) -> ca.SX:
        """The symbol of a derivative of this order."""
        chain = self.items[index]
        while len(chain.symbols) <= order:
            self._append(index, ca.SX.sym(f"der({chain.symbols[-1].name()})"))
        return chain.symbols[order]

    def give_rates(self, symbols: list[ca.SX], rates: list[ca.SX], chains: list[int]) -> None:
        """Symbols that are no unknowns but have known rates, and the chains whose rates these hold.

        The four components of a quaternion follow three angular velocities: they stand for the
        lowest order of these chains.
        """
        for symbol, rate in zip(symbols, rates, strict=True):
            self._given[symbol.element_hash()] = rate
            self._turned_by[symbol.element_hash()] = chains

    def involved(self, symbol: ca.SX) -> list[tuple[int, int]]:
        """The chains that a symbol belongs to, with its order there; none if it is no unknown."""
        key = symbol.element_hash()
        if key in self.place:
            return [self.place[key]]
        return [(chain, 0) for chain in self._turned_by.get(key, ())]

    def forbid_rate(self, symbols: ca.SX, what: str, rest: bool = False) -> None:
        """Note symbols whose derivative nobody knows; `what` names them: `the input`.

        `rest`: they are constant between events.
        """
        for symbol in ca.vertsplit(symbols) if symbols.numel() else ():
            self._without_rate[symbol.element_hash()] = f"{what} '{symbol.name()}'", rest

    def without_rate(self, value: ca.SX, inputs_rest: bool = False) -> list[str]:
        """What in a value has no derivative: inputs and reactions, in words.

        `inputs_rest`: what is constant between events has the derivative zero.
        """
        found = (self._without_rate.get(s.element_hash()) for s in ca.symvar(value))
        return [x[0] for x in found if x is not None and not (x[1] and inputs_rest)]

    def is_unrated(self, symbol: ca.SX) -> bool:
        """Whether a symbol is one whose derivative nobody knows."""
        return symbol.element_hash() in self._without_rate

    def rate(self, value: ca.SX) -> ca.SX:
        """d/dt by the chain rule; what is neither an unknown nor time is taken as constant."""
        symbols: list[ca.SX] = []
        rates: list[ca.SX] = []
        for symbol in ca.symvar(value):
            key = symbol.element_hash()
            if key == self._time:
                symbols.append(symbol)
                rates.append(ca.SX(1))
            elif key in self._given:
                symbols.append(symbol)
                rates.append(self._given[key])
            elif key in self.place:
                index, order = self.place[key]
                symbols.append(symbol)
                rates.append(self.symbol(index, order + 1))
        if not symbols:
            return ca.SX.zeros(*value.shape)
        if value.is_scalar() and value.is_symbolic():
            return rates[0]
        return ca.jtimes(value, column(symbols), column(rates))


def replace_known(value: ca.SX, known: Mapping[int, ca.SX]) -> ca.SX:
    """The value with known symbols replaced.

    `known` maps hashes of symbols to their values, which hold no such symbol.
    """
    if not known or value.is_constant():
        return value
    found = [s for s in ca.symvar(value) if s.element_hash() in known]
    if not found:
        return value
    return ca.substitute(value, column(found), column(known[s.element_hash()] for s in found))


@dataclass(slots=True)
class Resolver:
    """Replaces symbols by what they are known to be: expressions that hold no such symbol."""

    known: dict[int, ca.SX] = field(default_factory=dict)

    def learn(self, symbol: ca.SX, value: ca.SX) -> None:
        """From now on `symbol` is `value`."""
        self.known[symbol.element_hash()] = value

    def resolve(self, value: ca.SX) -> ca.SX:
        """The value with every known symbol replaced."""
        return replace_known(value, self.known)
