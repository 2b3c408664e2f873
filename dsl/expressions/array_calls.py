"""Functions of arrays, unfolded into scalars: sums stay shallow, so that walks through them do."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.arrays import element, items_of, scalars, total, vector
from frot.dsl.checked.describe import describe
from frot.dsl.expressions.expression import NUMERIC, expression
from frot.dsl.expressions.structure import whole_number
from frot.dsl.names.scope import Scope
from frot.dsl.quantities.dimensions import INTEGER, REAL, Type
from frot.dsl.text import tree


def array_call(node: tree.Call, scope: Scope) -> checked.Expression | None:
    """The checked call of a function of arrays; None after a message."""
    assert isinstance(node.callee, tree.Name)
    name = node.callee.text
    if name in ("zeros", "ones", "fill"):
        return _filled(name, node, scope)
    operand = expression(node.arguments[0].value, scope)
    if operand is None:
        return None
    if name == "size":
        return _size(node, operand, scope)
    if not operand.type.shape or operand.type.base not in NUMERIC:
        message = f"{name!r} takes an array, found {describe(operand.type)}"
        scope.log.report("E0304", message, node.arguments[0].span)
        return None
    if name == "transpose":
        return _transposed(node, operand, scope)
    flat = scalars(operand)
    scope.build.grow(len(flat), node.span)
    if name == "sum":
        return total(flat, node.span)
    kind = operand.type.of_shape(())
    return checked.Call(name, tuple(flat), kind, node.span)


def _filled(name: str, node: tree.Call, scope: Scope) -> checked.Expression | None:
    arguments = list(node.arguments)
    found: checked.Expression | None
    if name == "fill":
        found = expression(arguments.pop(0).value, scope)
    else:
        found = checked.Literal(0.0 if name == "zeros" else 1.0, REAL, node.span)
    counts = [whole_number(a.value, scope, "a size") for a in arguments]
    if found is None:
        return None
    for count, argument in zip(reversed(counts), reversed(arguments), strict=True):
        if count is None:
            return None
        if count < 1:
            message = f"a size must be at least 1; it is {count}"
            scope.log.report("E0402", message, argument.span)
            return None
        scope.build.grow(count, node.span)
        found = vector([found] * count, node.span)
    return found


def _size(node: tree.Call, operand: checked.Expression, scope: Scope) -> checked.Expression | None:
    shape = operand.type.shape
    if len(node.arguments) == 2:
        axis = whole_number(node.arguments[1].value, scope, "the index of a size")
        if axis is None:
            return None
        if not 1 <= axis <= len(shape):
            message = f"{describe(operand.type)} has no size {axis}"
            scope.log.report("E0304", message, node.span)
            return None
        return checked.Literal(float(shape[axis - 1]), INTEGER, node.span)
    if len(shape) != 1:
        message = f"'size' of {describe(operand.type)}"
        help_text = "say which: 'size(a, 1)'" if shape else ""
        scope.log.report("E0304", message, node.span, help=help_text)
        return None
    return checked.Literal(float(shape[0]), INTEGER, node.span)


def _transposed(
    node: tree.Call, operand: checked.Expression, scope: Scope
) -> checked.Expression | None:
    if len(operand.type.shape) != 2:
        message = f"'transpose' takes a matrix, found {describe(operand.type)}"
        scope.log.report("E0304", message, node.span)
        return None
    rows = [items_of(row) for row in items_of(operand)]
    return vector(
        [vector(list(column), node.span) for column in zip(*rows, strict=True)], node.span
    )


def product(
    node: tree.Infix, left: checked.Expression, right: checked.Expression, scope: Scope
) -> checked.Expression | None:
    """The product of a matrix and a vector or a matrix, unfolded; None after a message."""
    a, b = left.type, right.type
    numeric = a.base in NUMERIC and b.base in NUMERIC
    if not numeric or len(a.shape) > 2 or len(b.shape) > 2 or a.shape[-1] != b.shape[0]:
        sizes = " and ".join("x".join(str(n) for n in t.shape) for t in (a, b))
        message = f"the sizes of this product do not fit: {sizes}"
        scope.log.report("E0304", message, node.span)
        return None
    kind = Type("real", a.dimension * b.dimension)
    scope.build.grow(a.count * b.count // b.shape[0], node.span)

    def times(
        row: list[checked.Expression], column: list[checked.Expression]
    ) -> checked.Expression:
        terms: list[checked.Expression] = [
            checked.Binary("*", x, y, kind, node.span) for x, y in zip(row, column, strict=True)
        ]
        return total(terms, node.span)

    rows = [items_of(r) for r in items_of(left)] if len(a.shape) == 2 else [items_of(left)]
    if len(b.shape) == 1:
        columns = [items_of(right)]
    else:
        inner = items_of(right)
        columns = [[element(r, k, node.span) for r in inner] for k in range(b.shape[1])]
    found = [[times(row, column) for column in columns] for row in rows]
    if len(b.shape) == 1:
        return vector([row[0] for row in found], node.span)
    whole = [vector(row, node.span) for row in found]
    return whole[0] if len(a.shape) == 1 else vector(list(whole), node.span)
