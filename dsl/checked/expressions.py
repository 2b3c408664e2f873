"""Expressions of the checked model and the values that they name: typed, in SI.

One object may stand at several places.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.messages.source import Span
    from frot.dsl.quantities.dimensions import Type


class Owner:
    """A body, a frame, a point of a body or a liaison: it has quantities of its own."""

    __slots__ = ()
    name: str


@dataclass(frozen=True, slots=True, eq=False)
class Literal:
    """A value known from the text, in SI: `12 mm` is 0.012. `unit` is as the author wrote it."""

    value: float | int | bool | str
    type: Type
    span: Span
    unit: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Reference:
    """A parameter, constant, input, declared output or variable of the equations, named."""

    target: Parameter | Input | Output | Variable
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Time:
    """The independent variable."""

    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Quantity:
    """A variable of a body, frame, place or liaison: `hoop.position`, `support.abscissa`.

    `owner` of `rod.start.velocity` is the `BodyPoint` (rod, "start"); of `hoop.position`, the
    `Body`.
    """

    owner: Owner
    name: str
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Derivative:
    """`der(operand)`: derivative with respect to time."""

    operand: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """One component of a vector, `index` from 0: `.x` is 0."""

    operand: Expression
    index: int
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Vector:
    """A tuple `(x, y)`; a unit after it is already applied to the items."""

    items: tuple[Expression, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Unary:
    """`-x` or `not x`; `op` is that text."""

    op: str
    operand: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Binary:
    """Two operands; `op` is one of `+ - * / ^ < <= > >= == <> and or`."""

    op: str
    left: Expression
    right: Expression
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A function of the language by its name.

    The usual ones (`sin sqrt atan2 dot norm min max abs sign exp log ...`), and those of events:
    `pre(x)` and `change(x)` of a discrete variable, `edge(b)` of a condition, `sample(start,
    interval)`, `initial()`; `friction(slip, bound, bound_s)` is set-valued dry friction: the force
    or couple opposed to `slip`, of size `bound` while it slips and at most `bound_s` at rest.
    Functions of the user are expanded: their expressions stand where they are called, and one
    object may then stand at several places of a tree.
    """

    function: str
    arguments: tuple[Expression, ...]
    type: Type
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class If:
    """`if condition then yes else no`."""

    condition: Expression
    yes: Expression
    no: Expression
    type: Type
    span: Span


Expression = (
    Literal
    | Reference
    | Time
    | Quantity
    | Derivative
    | Element
    | Vector
    | Unary
    | Binary
    | Call
    | If
)


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
