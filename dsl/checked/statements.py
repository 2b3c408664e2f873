"""Equations and events of the checked model, with the places they are written at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.checked.expressions import Expression, Variable
    from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """`left = right`, scalars or arrays of one shape (or conditions, for a Boolean variable).

    `span` is where it is written, in the class of the component; `owner` is the component's dotted
    name, empty in the model itself. A connection gives equations with the span of its `connect`;
    `connection` is then its text for messages (`connect(r.n, l.p)`, or `flows of r.n, l.p`).
    `drives`: it prescribes a coordinate, and inputs in it rest between their changes.
    """

    left: Expression
    right: Expression
    span: Span
    owner: str = ""
    connection: str = ""
    drives: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class IfEquations:
    """`if` equations whose condition can change: every branch has as many scalar equations.

    `branches` are conditions with their equations; the last condition is None (`else`). Where the
    conditions are parameters of the structure the checker has chosen the branch already.
    """

    branches: tuple[tuple[Expression | None, tuple[Equation | IfEquations, ...]], ...]
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Assign:
    """`variable = value;` inside `when`: the discrete variable's new value.

    `item` are the indices, from 0, of the one item that is set, none where all are.
    """

    variable: Variable
    value: Expression
    span: Span
    item: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Reinit:
    """`reinit(target, value);` inside `when`; `target` is a variable or a coordinate or speed."""

    target: Expression
    value: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Terminate:
    """`terminate("why");` inside `when`: the run ends well."""

    message: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Assertion:
    """`assert(condition, "message", level = error | warning)`, anywhere among the equations."""

    condition: Expression
    message: str
    level: str
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class When:
    """`when` with its `elsewhen`s: the first branch one of whose conditions comes to hold fires."""

    branches: tuple[
        tuple[tuple[Expression, ...], tuple[Assign | Reinit | Terminate | Assertion, ...]], ...
    ]
    span: Span
    owner: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class InitialEquation:
    """`left = right` of the `initial` section; `guess` marks those that only guide.

    `place` tells it from others of the same span: the round of its loop and its component.
    """

    left: Expression
    right: Expression
    span: Span
    guess: bool = False
    place: str = ""
