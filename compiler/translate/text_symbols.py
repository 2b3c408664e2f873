"""Symbols for the variables that a text declares, and the friction elements of its equations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.translate.derivative_chains import Chains
from frot.compiler.translate.symbols import shaped
from frot.dsl.checked import Variable
from frot.dsl.checked.arrays import component_names
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import Dimension


@dataclass(frozen=True, slots=True, eq=False)
class FrictionElement:
    """Set-valued dry friction of the equations: `force` opposes `slip` and is bounded.

    `bound` holds while it slips, `bound_at_rest` at rest. `force` and `acceleration`, the rate of
    the slip, are symbols. `dimensions` of slip and force.
    """

    name: str
    span: Span
    force: ca.SX
    acceleration: ca.SX
    slip: ca.SX
    bound: ca.SX
    bound_at_rest: ca.SX
    dimensions: tuple[Dimension, Dimension]


@dataclass(frozen=True, slots=True, eq=False)
class Discrete:
    """A value that changes at events only: its symbol and its value at the start."""

    name: str
    symbol: ca.SX
    start: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """What `value` was in the last round at an event: its symbol, and its value at the start."""

    name: str
    symbol: ca.SX
    start: ca.SX
    value: ca.SX
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class TextSymbols:
    """`values` gives the symbols of each variable, in the shape of its type.

    `discrete` is what a `when` sets, `held` what values were before.
    """

    chains: Chains
    values: Mapping[Variable, ca.SX]
    discrete: tuple[Discrete, ...]
    held: tuple[Held, ...]
    elements: tuple[FrictionElement, ...]

    @property
    def memory(self) -> tuple[Discrete | Held, ...]:
        """All that changes at events only, in the order of the kernel."""
        return (*self.discrete, *self.held)


@dataclass(slots=True, eq=False)
class TextTable:
    """The symbols of a text while its equations are translated: see `TextSymbols`."""

    chains: Chains
    values: dict[Variable, ca.SX] = field(default_factory=dict)
    discrete: list[Discrete] = field(default_factory=list)
    held: list[Held] = field(default_factory=list)
    elements: list[FrictionElement] = field(default_factory=list)

    def add_discrete(self, name: str, symbol: ca.SX, start: ca.SX) -> None:
        """A discrete value, one of the text or one the compiler counts with."""
        self.discrete.append(Discrete(name, symbol, start))

    def finish(self) -> TextSymbols:
        """The symbols collected."""
        return TextSymbols(
            self.chains,
            dict(self.values),
            tuple(self.discrete),
            tuple(self.held),
            tuple(self.elements),
        )


def make_text_symbols(variables: tuple[Variable, ...], chains: Chains) -> TextTable:
    """A chain for every scalar of every continuous variable; symbols for the discrete ones."""
    text = TextTable(chains)
    for variable in variables:
        names = component_names(variable.name, variable.type.shape)
        symbols = [ca.SX.sym(name) for name in names]
        if not variable.discrete:
            for name, symbol in zip(names, symbols, strict=True):
                chains.add(name, variable.span, variable, (symbol,))
        text.values[variable] = shaped(symbols, variable.type.shape)
    return text


def scalars(value: ca.SX) -> list[ca.SX]:
    """The items of a scalar, a column or a matrix, by rows."""
    if value.is_scalar():
        return [value]
    return list(ca.vertsplit(ca.vec(value.T))) if value.numel() else []
