"""Declarations of a model by name and type: parameters, inputs, outputs, variables.

`bounds` are the attributes `min` and `max` with their values, as far as they are given.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.checked.expressions import Expression
    from frot.dsl.messages.source import Span
    from frot.dsl.quantities.dimensions import Type


@dataclass(frozen=True, slots=True, eq=False)
class Parameter:
    """A parameter (tunable) or a constant; `value` may depend on other parameters.

    `unit` is the unit of the author's default (`mm`), for display; values are SI.
    `quantity` is the name of its type (`Angle`). `structural` says what the parameter decides (`the
    size of 'r' (ladder.frot:4:3)`), and is empty for others: such a parameter is a constant too.
    """

    name: str
    type: Type
    value: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    constant: bool = False
    quantity: str = ""
    structural: str = ""
    bounds: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Input:
    """A value given from outside, held between communication points."""

    name: str
    type: Type
    start: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""
    bounds: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Output:
    """A declared output with its expression. `unit` as the author wrote it, if anywhere."""

    name: str
    type: Type
    value: Expression
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""
    bounds: tuple[tuple[str, Expression], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Variable:
    """An unknown of the equations, a scalar or an array; `name` is dotted, as `r[2].p.i`.

    `discrete`: it changes at events only, by a `when` (or it is an integer, a condition or an
    enumeration that a `when` sets). `start` is `(start = ...)`, a guess for what `initial` leaves
    open and the first value of a discrete variable. `output`: declared so in the model itself.
    `nominal` is its usual size, by which its error is measured while it is smaller.
    """

    name: str
    type: Type
    span: Span
    doc: str = ""
    unit: str = ""
    quantity: str = ""
    start: Expression | None = None
    discrete: bool = False
    output: bool = False
    nominal: Expression | None = None
    bounds: tuple[tuple[str, Expression], ...] = ()
