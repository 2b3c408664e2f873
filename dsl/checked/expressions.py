"""Expressions of the checked model: typed, in SI; one object may stand at several places."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.checked.declared import Input, Output, Parameter, Variable
    from frot.dsl.checked.mechanics import Body, BodyPoint, Frame, Liaison
    from frot.dsl.messages.source import Span
    from frot.dsl.quantities.dimensions import Type


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

    owner: Body | Frame | BodyPoint | Liaison
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
