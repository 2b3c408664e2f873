"""Arrays of expressions: their items, sums of them, zeros."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import Type


def element(operand: checked.Expression, index: int, span: Span) -> checked.Expression:
    """One item of an array, `index` from 0; that of a tuple is the item itself."""
    if isinstance(operand, checked.Vector):
        return operand.items[index]
    return checked.Element(operand, index, operand.type.item, span)


def items_of(operand: checked.Expression) -> list[checked.Expression]:
    """All items of an array."""
    return [element(operand, k, operand.span) for k in range(operand.type.shape[0])]


def scalars(operand: checked.Expression) -> list[checked.Expression]:
    """All scalars of an array, row by row."""
    if not operand.type.shape:
        return [operand]
    return [scalar for item in items_of(operand) for scalar in scalars(item)]


def total(terms: list[checked.Expression], span: Span) -> checked.Expression:
    """The sum, as a tree as low as can be."""
    kind = terms[0].type
    while len(terms) > 1:
        pairs = [
            checked.Binary("+", terms[k], terms[k + 1], kind, span)
            for k in range(0, len(terms) - 1, 2)
        ]
        terms = [*pairs, *terms[len(pairs) * 2 :]]
    return terms[0]


def vector(items: list[checked.Expression], span: Span) -> checked.Vector:
    """An array of expressions of one type."""
    first = items[0].type
    return checked.Vector(tuple(items), first.of_shape((len(items), *first.shape)), span)


def zero(kind: Type, span: Span) -> checked.Expression:
    """The value of a type where nothing is said: 0, false, an empty text."""
    zeros: dict[str, bool | str | float] = {"boolean": False, "string": ""}
    found: checked.Expression = checked.Literal(
        zeros.get(kind.base, 1.0 if kind.enumeration is not None else 0.0), kind.of_shape(()), span
    )
    for size in reversed(kind.shape):
        inner = found.type
        found = checked.Vector((found,) * size, inner.of_shape((size, *inner.shape)), span)
    return found


def component_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """The names of all scalars: `x`, or `x[1]`, `x[2]`, or `x[1,1]`, `x[1,2]`: by rows."""
    names = [""]
    for size in shape:
        names = [f"{n},{k + 1}" if n else f"{k + 1}" for n in names for k in range(size)]
    return [f"{name}[{n}]" if n else name for n in names]


def bounds_of(
    bounds: tuple[tuple[str, checked.Expression], ...], count: int
) -> list[tuple[tuple[str, checked.Expression], ...]]:
    """`min` and `max` of each of `count` scalars."""
    items = [(name, scalars(bound)) for name, bound in bounds]
    return [tuple((name, limits[k]) for name, limits in items) for k in range(count)]
