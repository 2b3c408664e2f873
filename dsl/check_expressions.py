"""Expressions: names bound, literals in SI, the dimension of every part checked."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from frot.dsl import checked, tree
from frot.dsl.check_names import kind_of, resolve
from frot.dsl.describe import describe
from frot.dsl.dimensions import BOOLEAN, REAL, STRING, Type
from frot.dsl.scope import Scope
from frot.dsl.source import Span
from frot.dsl.units import Unit, UnknownUnit, parse_unit

NUMERIC = ("real", "integer")


def expression(node: tree.Expression, scope: Scope) -> checked.Expression | None:
    """The checked expression, or None after a message (or where one was already given)."""
    return _CHECKS[type(node)](node, scope)


def expect(
    node: tree.Expression, kind: Type, scope: Scope, *, others: tuple[Type, ...] = ()
) -> checked.Expression | None:
    """The checked expression if it is of this type (or of one of `others`)."""
    found = expression(node, scope)
    if found is None:
        return None
    if any(agrees(found.type, k) for k in (kind, *others)):
        return found
    wanted = " or ".join(describe(k) for k in (kind, *others))
    help_text = ""
    if isinstance(node, tree.Number) and not node.unit and kind.is_scalar:
        help_text = f"write the unit: '{node.span.text} {kind.dimension.unit}'"
    elif isinstance(node, tree.Tuple) and not node.unit and found.type.dimension.is_one:
        help_text = f"write the unit after the tuple: '{node.span.text} {kind.dimension.unit}'"
    scope.log.report(
        "E0301",
        f"expected {wanted}, found {describe(found.type)}",
        node.span,
        caret=describe(found.type),
        help=help_text if kind.base in NUMERIC and not kind.dimension.is_one else "",
    )
    return None


def agrees(found: Type, wanted: Type) -> bool:
    """Whether a value of one type can stand where the other is wanted."""
    if found.base in NUMERIC and wanted.base in NUMERIC:
        if wanted.base == "integer" and found.base != "integer":
            return False
        return found.dimension == wanted.dimension and found.shape == wanted.shape
    return found.base == wanted.base and found.shape == wanted.shape


# ------------------------------------------------------------------ literals


def unit_of(text: str, span: Span, scope: Scope) -> Unit | None:
    """The unit written at a place; an unknown one is told."""
    try:
        return parse_unit(text)
    except UnknownUnit as error:
        help_text = f"did you mean {error.near!r}?" if error.near else ""
        if "/" in text and not help_text and str(error).startswith("unknown"):
            help_text = "to divide by a variable leave spaces: 'a / b'"
        scope.log.report("E0302", str(error), span, help=help_text)
        return None


def _number(node: tree.Number, scope: Scope) -> checked.Expression | None:
    value, kind = node.value, REAL
    if node.unit:
        assert node.unit_span is not None
        unit = unit_of(node.unit, node.unit_span, scope)
        if unit is None:
            return None
        value = value * unit.factor + unit.offset
        kind = Type(dimension=unit.dimension)
    if not math.isfinite(value):
        scope.log.report("E0403", f"the number {node.span.text!r} is too large", node.span)
        return None
    return checked.Literal(value, kind, node.span, node.unit)


def _text(node: tree.Text, scope: Scope) -> checked.Expression | None:
    return checked.Literal(node.value, STRING, node.span)


def _truth(node: tree.Truth, scope: Scope) -> checked.Expression | None:
    return checked.Literal(node.value, BOOLEAN, node.span)


def _tuple(node: tree.Tuple, scope: Scope) -> checked.Expression | None:
    items = [expression(i, scope) for i in node.items]
    unit = None
    if node.unit:
        assert node.unit_span is not None
        unit = unit_of(node.unit, node.unit_span, scope)
        if unit is not None and unit.offset:
            scope.log.report("E0302", "degrees Celsius cannot multiply a tuple", node.unit_span)
            return None
        if unit is None:
            return None
    found = []
    for written, item in zip(node.items, items, strict=True):
        if item is not None and unit is not None:
            item = _with_unit(item, unit, node.unit, written, scope)
        if item is None:
            return None
        found.append(item)
    if len(found) == 1:
        return found[0]
    first = found[0].type
    for written, item in zip(node.items, found, strict=True):
        if item.type.base not in NUMERIC:
            scope.log.report("E0303", f"a tuple cannot hold {describe(item.type)}", written.span)
            return None
        if item.type.dimension != first.dimension or item.type.shape != first.shape:
            scope.log.report(
                "E0303",
                f"the items of a tuple differ: {describe(first)}, then {describe(item.type)}",
                written.span,
                caret=describe(item.type),
                help="give each item its unit, or one unit after the tuple: '(0, 1) m'",
            )
            return None
    kind = Type("real", first.dimension, (len(found), *first.shape))
    return checked.Vector(tuple(found), kind, node.span)


def _with_unit(
    item: checked.Expression, unit: Unit, text: str, written: tree.Expression, scope: Scope
) -> checked.Expression | None:
    if item.type.base not in NUMERIC or not item.type.dimension.is_one:
        scope.log.report(
            "E0303",
            f"expected a number before the unit {text!r}, found {describe(item.type)}",
            written.span,
        )
        return None
    kind = Type("real", unit.dimension, item.type.shape)
    if isinstance(item, checked.Vector):
        inner = [
            checked.Binary(
                "*", i, _factor(unit, i.span, text), Type("real", unit.dimension), i.span
            )
            for i in item.items
        ]
        return checked.Vector(tuple(inner), kind, item.span)
    if isinstance(item, checked.Literal):
        return checked.Literal(float(item.value) * unit.factor, kind, item.span, text)
    if isinstance(item, checked.Unary) and isinstance(item.operand, checked.Literal):
        value = float(item.operand.value) * unit.factor
        inside = checked.Literal(value, kind, item.operand.span, text)
        return checked.Unary(item.op, inside, kind, item.span)
    return checked.Binary("*", item, _factor(unit, item.span, text), kind, item.span)


def _factor(unit: Unit, span: Span, text: str) -> checked.Literal:
    return checked.Literal(unit.factor, Type(dimension=unit.dimension), span, text)


# ------------------------------------------------------------------ names


def _name(node: tree.Name | tree.Member, scope: Scope) -> checked.Expression | None:
    thing = resolve(node, scope, "value")
    if thing is None:
        return None
    if isinstance(
        thing,
        checked.Body
        | checked.Frame
        | checked.Curve
        | checked.Liaison
        | checked.Force
        | checked.BodyPoint
        | checked.BodyGeometry
        | checked.CurvePlace,
    ):
        help_text = ""
        if isinstance(thing, checked.Body | checked.Frame | checked.BodyPoint):
            help_text = f"name one of its variables, as '{node.span.text}.position'"
        scope.log.report(
            "E0205", f"{kind_of(thing)} stands where a value is needed", node.span, help=help_text
        )
        return None
    return thing


def _index(node: tree.Index, scope: Scope) -> checked.Expression | None:
    operand = expression(node.operand, scope)
    if operand is None:
        return None
    subscript = node.subscripts[0]
    if len(node.subscripts) > 1 or isinstance(subscript, tree.Range):
        scope.log.report("E0701", "slices and matrices are not supported yet", node.span)
        return None
    if len(operand.type.shape) != 1:
        scope.log.report("E0304", f"{describe(operand.type)} has no index", node.span)
        return None
    size = operand.type.shape[0]
    if not isinstance(subscript, tree.Number) or not subscript.integer or subscript.unit:
        scope.log.report("E0304", "an index is a whole number", subscript.span)
        return None
    if not 1 <= subscript.value <= size:
        scope.log.report("E0304", f"the index must be from 1 to {size}", subscript.span)
        return None
    kind = Type(operand.type.base, operand.type.dimension)
    return checked.Element(operand, int(subscript.value) - 1, kind, node.span)


# ------------------------------------------------------------------ operators


def _prefix(node: tree.Prefix, scope: Scope) -> checked.Expression | None:
    operand = expression(node.operand, scope)
    if operand is None:
        return None
    good = operand.type == BOOLEAN if node.op == "not" else operand.type.base in NUMERIC
    if not good:
        scope.log.report(
            "E0304", f"{node.op!r} cannot be applied to {describe(operand.type)}", node.span
        )
        return None
    if node.op == "+":
        return operand
    return checked.Unary(node.op, operand, operand.type, node.span)


def _infix(node: tree.Infix, scope: Scope) -> checked.Expression | None:
    left, right = expression(node.left, scope), expression(node.right, scope)
    if left is None or right is None:
        return None
    kind = _infix_type(node, left, right, scope)
    if kind is None:
        return None
    return checked.Binary(node.op, left, right, kind, node.span)


def _infix_type(
    node: tree.Infix, left: checked.Expression, right: checked.Expression, scope: Scope
) -> Type | None:
    op, a, b = node.op, left.type, right.type
    if op in ("and", "or"):
        if a == BOOLEAN and b == BOOLEAN:
            return BOOLEAN
        return _refuse(node, f"{op!r} joins two conditions", a, b, scope, "E0301")
    if op in ("==", "<>") and a.base == b.base and a.base in ("boolean", "string"):
        return BOOLEAN
    if a.base not in NUMERIC or b.base not in NUMERIC:
        return _refuse(node, f"{op!r} cannot be applied here", a, b, scope)
    if op in ("+", "-", "<", "<=", ">", ">=", "==", "<>"):
        word = {"+": "add", "-": "subtract"}.get(op, "compare")
        if a.dimension != b.dimension or a.shape != b.shape:
            return _refuse(node, f"cannot {word} these", a, b, scope, "E0301")
        if word == "compare":
            return BOOLEAN if a.is_scalar else _refuse(node, "vectors have no order", a, b, scope)
        return Type("real", a.dimension, a.shape)
    if op == "*":
        if not a.is_scalar and not b.is_scalar:
            return _refuse(node, "two vectors: write 'dot(a, b)' or 'cross(a, b)'", a, b, scope)
        return Type("real", a.dimension * b.dimension, a.shape or b.shape)
    if not b.is_scalar:
        return _refuse(node, f"the right side of {op!r} is a scalar", a, b, scope)
    if op == "/":
        return Type("real", a.dimension / b.dimension, a.shape)
    return _power_type(node, a, right, scope)


def _power_type(
    node: tree.Infix, base: Type, right: checked.Expression, scope: Scope
) -> Type | None:
    if not base.is_scalar or not right.type.dimension.is_one:
        return _refuse(node, "a power is of a scalar, to a number", base, right.type, scope)
    if base.dimension.is_one:
        return REAL
    power = _known(right)
    if power is None or abs(power) > 100:
        scope.log.report(
            "E0304",
            f"the power of {describe(base)} must be written as a number",
            node.right.span,
            help="its dimension depends on the power",
        )
        return None
    return Type("real", base.dimension ** Fraction(power).limit_denominator(12))


def _known(node: checked.Expression) -> float | None:
    """The value of a number, its opposite, or a quotient of numbers."""
    match node:
        case checked.Literal(value=value):
            return float(value)
        case checked.Unary(op="-", operand=checked.Literal(value=value)):
            return -float(value)
        case checked.Binary(
            op="/", left=checked.Literal(value=above), right=checked.Literal(value=below)
        ):
            return float(above) / float(below) if below else None
    return None


def _refuse(
    node: tree.Infix, message: str, a: Type, b: Type, scope: Scope, code: str = "E0304"
) -> Type | None:
    """Report operands that do not fit; there is then no type."""
    operands = f"{describe(a)} {node.op} {describe(b)}"
    scope.log.report(code, f"{message}: {operands}", node.span, caret=operands)
    return None


def _conditional(node: tree.Conditional, scope: Scope) -> checked.Expression | None:
    condition = expect(node.condition, BOOLEAN, scope)
    yes, no = expression(node.yes, scope), expression(node.no, scope)
    if condition is None or yes is None or no is None:
        return None
    if not (agrees(no.type, yes.type) or agrees(yes.type, no.type)):
        scope.log.report(
            "E0301",
            f"the branches differ: {describe(yes.type)}, then {describe(no.type)}",
            node.no.span,
            caret=describe(no.type),
        )
        return None
    return checked.If(condition, yes, no, yes.type, node.span)


def _range(node: tree.Range, scope: Scope) -> None:
    scope.log.report("E0701", "ranges are not supported yet", node.span)


def _call(node: tree.Call, scope: Scope) -> checked.Expression | None:
    from frot.dsl.check_calls import call

    return call(node, scope)


_CHECKS: dict[type, Callable[[Any, Scope], checked.Expression | None]] = {
    tree.Number: _number,
    tree.Text: _text,
    tree.Truth: _truth,
    tree.Tuple: _tuple,
    tree.Name: _name,
    tree.Member: _name,
    tree.Index: _index,
    tree.Prefix: _prefix,
    tree.Infix: _infix,
    tree.Conditional: _conditional,
    tree.Range: _range,
    tree.Call: _call,
}
