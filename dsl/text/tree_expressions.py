"""The expressions of the tree, as they were written (`tree.py`)."""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True)
class Word:
    """An identifier where it stands."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Number:
    """`12 mm`: the number as written, `unit` the text after it or empty."""

    value: float
    integer: bool
    unit: str
    unit_span: Span | None
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Text:
    """A string, its escapes resolved."""

    value: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Name:
    """An identifier used as an expression."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """`operand.name`."""

    operand: Expression
    name: Word
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Index:
    """`operand[subscripts]`."""

    operand: Expression
    subscripts: tuple[Expression, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Argument:
    """`value` or `name = value`; the name of a guess or of a modifier may have members.

    `final` is written before a modifier that nobody may override.
    """

    name: Expression | None
    value: Expression
    span: Span
    final: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """`callee(arguments)`: a function, shape, liaison type, law, force or statement."""

    callee: Expression
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Tuple:
    """`(a, b) unit`; a parenthesised scalar with a unit has one item."""

    items: tuple[Expression, ...]
    unit: str
    unit_span: Span | None
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Prefix:
    """`-x`, `+x`, `not x`."""

    op: str
    operand: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Infix:
    """Two operands and one of `+ - * / ^ < <= > >= == <> and or`."""

    op: str
    left: Expression
    right: Expression
    op_span: Span
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Conditional:
    """`if condition then yes else no`."""

    condition: Expression
    yes: Expression
    no: Expression
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Range:
    """`first:last` or `first:step:last`."""

    items: tuple[Expression, ...]
    span: Span


Expression = (
    Number
    | Text
    | Truth
    | Name
    | Member
    | Index
    | Call
    | Tuple
    | Prefix
    | Infix
    | Conditional
    | Range
)
