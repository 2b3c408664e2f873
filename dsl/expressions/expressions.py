"""Expressions: names bound, literals in SI, the dimension of every part checked."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from frot.dsl import checked
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.expressions.turns import as_rate, rates_alike
from frot.dsl.messages.source import Span
from frot.dsl.names.names import kind_of, resolve
from frot.dsl.names.scope import Instance, Record, Scope
from frot.dsl.quantities.dimensions import BOOLEAN, INTEGER, REAL, STRING, Type
from frot.dsl.quantities.units import Unit, UnknownUnit, parse_unit
from frot.dsl.text import tree

NUMERIC = ("real", "integer")


def expression(node: tree.Expression, scope: Scope) -> checked.Expression | None:
    """The checked expression, or None after a message (or where one was already given)."""
    found = value_of(node, scope)
    if isinstance(found, Record):
        _not_a_value(f"a record {found.of.name!r}", node, "name one of its members", scope)
        return None
    return found


def value_of(node: tree.Expression, scope: Scope) -> checked.Expression | Record | None:
    """As `expression`, where a whole record may stand too."""
    return _CHECKS[type(node)](node, scope)


def expect(
    node: tree.Expression, kind: Type, scope: Scope, *, others: tuple[Type, ...] = ()
) -> checked.Expression | None:
    """The checked expression if it is of this type (or of one of `others`)."""
    found = expression(node, scope)
    return None if found is None else fitting(found, node, kind, scope, others=others)


def fitting(
    found: checked.Expression,
    node: tree.Expression,
    kind: Type,
    scope: Scope,
    *,
    others: tuple[Type, ...] = (),
    unit: str = "",
    rate: str = "",
    remedy: str = "",
) -> checked.Expression | None:
    """The expression, or its item for one of an array declaration; None after a message.

    `unit` is the one the author wrote for what is expected, `rate` the kind of rate it is, `remedy`
    the help where nothing better is known.
    """
    if any(agrees(found.type, k) for k in (kind, *others)):
        return as_rate(found, rate, scope)
    by_form = found.type.base != "integer" and is_whole(found)
    if kind.base == "integer" and kind.enumeration is None and by_form:
        whole = as_integer(found)
        return fitting(whole, node, kind, scope, others=others, unit=unit, remedy=remedy)
    if scope.element is not None and found.type.shape[:1] == scope.element[1:]:
        from frot.dsl.expressions.indexing import element

        item = element(found, scope.element[0], found.span)
        if any(agrees(item.type, k) for k in (kind, *others)):
            return as_rate(item, rate, scope)
    is_number = kind.base == "integer" and agrees(found.type, Type(shape=kind.shape))
    wanted, shown = pair(kind, found.type, unit, written_unit(found))
    wanted = " or ".join((wanted, *(describe(k) for k in others)))
    if is_number and kind.enumeration is None:
        wanted, shown = "a whole number", "a number that may be none"
    help_text = ""
    if kind.base not in NUMERIC:
        pass
    elif isinstance(node, tree.Number) and not node.unit and kind.is_scalar:
        help_text = f"write the unit: '{node.span.text} {unit or kind.dimension.unit}'"
    elif found.type.is_scalar and found.type.dimension == kind.dimension and kind.shape == (2,):
        zero = f"0 {kind.dimension.unit}".removesuffix(" 1")
        help_text = f"a vector is written '(x, y)': '({node.span.text}, {zero})'"
    elif isinstance(node, tree.Tuple) and not node.unit and found.type.dimension.is_one:
        help_text = f"write the unit after the tuple: '{node.span.text} {kind.dimension.unit}'"
    scope.log.report(
        "E0301",
        f"expected {wanted}, found {shown}",
        node.span,
        caret=shown,
        help=help_text if help_text and not kind.dimension.is_one else remedy,
    )
    return None


def agrees(found: Type, wanted: Type) -> bool:
    """Whether a value of one type can stand where the other is wanted."""
    if wanted.enumeration is not None:
        return found == wanted
    if found.base in NUMERIC and wanted.base in NUMERIC:
        if found.enumeration is not None or (wanted.base == "integer" and found.base != "integer"):
            return False
        return found.dimension == wanted.dimension and found.shape == wanted.shape
    return found.base == wanted.base and found.shape == wanted.shape


def is_whole(node: checked.Expression) -> bool:
    """Whether an expression is a whole number by its form: `2`, `-n`, `(1, 2)`."""
    match node:
        case checked.Literal(value=value, type=kind):
            written_plain = kind.dimension.is_one and not node.unit
            return written_plain and isinstance(value, float) and value.is_integer()
        case checked.Unary(op="-", operand=operand):
            return is_whole(operand)
        case checked.Vector(items=items):
            return all(is_whole(i) for i in items)
        case checked.If(yes=yes, no=no):
            return is_whole(yes) and is_whole(no)
    return node.type.base == "integer" and node.type.enumeration is None


def as_integer(node: checked.Expression) -> checked.Expression:
    """A whole number by its form, typed so."""
    return replace(node, type=Type("integer", node.type.dimension, node.type.shape))


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
        if item.type.base != first.base and item.type.base not in NUMERIC:
            scope.log.report("E0303", f"a tuple cannot hold {describe(item.type)}", written.span)
            return None
        alike = item.type.enumeration == first.enumeration and item.type.shape == first.shape
        if item.type.dimension != first.dimension or not alike:
            units = written_unit(found[0]), written_unit(item)
            before, now = pair(first, item.type, *units)
            scope.log.report(
                "E0303",
                f"the items of a tuple differ: {before}, then {now}",
                written.span,
                caret=now,
                help="give each item its unit, or one unit after the tuple: '(0, 1) m'",
            )
            return None
    base = "real" if any(i.type.base == "real" for i in found) else first.base
    kind = Type(base, first.dimension, (len(found), *first.shape), first.enumeration)
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


def _name(
    node: tree.Name | tree.Member | tree.Index, scope: Scope
) -> checked.Expression | Record | None:
    thing = resolve(node, scope, "value")
    if thing is None or isinstance(thing, checked.Reference):
        return thing
    if isinstance(thing, checked.Expression | Record):
        return thing
    if isinstance(thing, Instance) and thing.of.kind == "record":
        from frot.dsl.expressions.records import record_of

        return record_of(thing, node.span, scope)
    help_text = ""
    if isinstance(thing, checked.Body | checked.Frame | checked.BodyPoint):
        help_text = f"name one of its variables, as '{node.span.text}.position'"
    elif isinstance(thing, Instance):
        help_text = "name one of its variables"
    _not_a_value(kind_of(thing), node, help_text, scope)
    return None


def _not_a_value(what: str, node: tree.Expression, help_text: str, scope: Scope) -> None:
    message = f"{what} stands where a value is needed"
    scope.log.report("E0205", message, node.span, help=help_text)


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
    if _is_celsius(operand):
        # `-5 degC` is a temperature of its own, not the opposite of 5 degC.
        assert isinstance(operand, checked.Literal)
        unit = parse_unit(operand.unit)
        value = 2 * unit.offset - float(operand.value)
        return checked.Literal(value, operand.type, node.span, operand.unit)
    return checked.Unary(node.op, operand, operand.type, node.span)


def _infix(node: tree.Infix, scope: Scope) -> checked.Expression | None:
    left, right = expression(node.left, scope), expression(node.right, scope)
    if left is None or right is None or not _temperatures_fit(node, left, right, scope):
        return None
    if node.op == "*" and left.type.shape and right.type.shape and _are_matrices(left, right):
        from frot.dsl.expressions.arrays import product

        return product(node, left, right, scope)
    kind = _infix_type(node, left, right, scope)
    if kind is None:
        return None
    sides = rates_alike(left, right, scope) if node.op not in ("*", "/", "^") else (left, right)
    return None if sides is None else checked.Binary(node.op, *sides, kind, node.span)


def _is_celsius(node: checked.Expression) -> bool:
    return isinstance(node, checked.Literal) and node.unit in ("degC", "°C")


def _temperatures_fit(
    node: tree.Infix, left: checked.Expression, right: checked.Expression, scope: Scope
) -> bool:
    """Whether no temperature in degrees Celsius stands where a difference is needed."""
    if node.op not in ("*", "/", "^", "+"):
        return True
    for operand in (left, right):
        if _is_celsius(operand):
            scope.log.report(
                "E0302",
                f"{operand.span.text!r} is an absolute temperature; here a difference is needed",
                operand.span,
                help="write a difference of temperatures in K",
            )
            return False
    return True


def _are_matrices(left: checked.Expression, right: checked.Expression) -> bool:
    return len(left.type.shape) == 2 or len(right.type.shape) == 2


def _infix_type(
    node: tree.Infix, left: checked.Expression, right: checked.Expression, scope: Scope
) -> Type | None:
    op, a, b = node.op, left.type, right.type
    if op in ("and", "or"):
        if a == BOOLEAN and b == BOOLEAN:
            return BOOLEAN
        return _refuse(node, f"{op!r} joins two conditions", a, b, scope, "E0301")
    named = a.base in ("boolean", "string") or a.enumeration is not None
    if op in ("==", "<>") and a == b and a.is_scalar and named:
        return BOOLEAN
    if a.enumeration is not None or b.enumeration is not None:
        return _refuse(node, f"{op!r} cannot be applied here", a, b, scope, "E0301")
    if a.base not in NUMERIC or b.base not in NUMERIC:
        return _refuse(node, f"{op!r} cannot be applied here", a, b, scope)
    # Whole numbers written without a unit do not make a sum of whole numbers a real one.
    both = is_whole(left) and is_whole(right) and "integer" in (a.base, b.base)
    base = "integer" if both else "real"
    if op in ("+", "-", "<", "<=", ">", ">=", "==", "<>"):
        word = {"+": "add", "-": "subtract"}.get(op, "compare")
        if a.dimension != b.dimension or a.shape != b.shape:
            units = written_unit(left), written_unit(right)
            remedy = _unit_missing(node, a, b)
            return _refuse(node, f"cannot {word} these", a, b, scope, "E0301", units, remedy)
        if word == "compare":
            return BOOLEAN if a.is_scalar else _refuse(node, "vectors have no order", a, b, scope)
        return Type(base, a.dimension, a.shape)
    if op == "*":
        if not a.is_scalar and not b.is_scalar:
            return _refuse(node, "two vectors: write 'dot(a, b)' or 'cross(a, b)'", a, b, scope)
        return Type(base, a.dimension * b.dimension, a.shape or b.shape)
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
    node: tree.Infix,
    message: str,
    a: Type,
    b: Type,
    scope: Scope,
    code: str = "E0304",
    units: tuple[str, str] = ("", ""),
    remedy: str = "",
) -> Type | None:
    """Report operands that do not fit; there is then no type."""
    left, right = pair(a, b, *units)
    operands = f"{left} {node.op} {right}"
    scope.log.report(code, f"{message}: {operands}", node.span, caret=operands, help=remedy)
    return None


def _unit_missing(node: tree.Infix, a: Type, b: Type) -> str:
    """The remedy where one side is a bare number and the other has a dimension."""
    for side, other in ((node.left, b), (node.right, a)):
        if isinstance(side, tree.Number) and not side.unit and not other.dimension.is_one:
            return f"write the unit: '{side.span.text} {other.dimension.unit}'"
    return ""


def _conditional(node: tree.Conditional, scope: Scope) -> checked.Expression | None:
    condition = expect(node.condition, BOOLEAN, scope)
    yes, no = expression(node.yes, scope), expression(node.no, scope)
    if condition is None or yes is None or no is None:
        return None
    if not (agrees(no.type, yes.type) or agrees(yes.type, no.type)):
        first, second = pair(yes.type, no.type, written_unit(yes), written_unit(no))
        scope.log.report(
            "E0301",
            f"the branches differ: {first}, then {second}",
            node.no.span,
            caret=second,
        )
        return None
    kind = yes.type if yes.type.base != "integer" else no.type
    return checked.If(condition, yes, no, kind, node.span)


def _range(node: tree.Range, scope: Scope) -> checked.Expression | None:
    from frot.dsl.expressions.indexing import span_of

    found = span_of(node, scope, "a range")
    if found is None:
        return None
    items = tuple(checked.Literal(float(n), INTEGER, node.span) for n in found)
    return checked.Vector(items, Type("integer", shape=(len(items),)), node.span)


def _call(node: tree.Call, scope: Scope) -> checked.Expression | Record | None:
    from frot.dsl.expressions.calls import call

    return call(node, scope)


_CHECKS: dict[type, Callable[[Any, Scope], checked.Expression | Record | None]] = {
    tree.Number: _number,
    tree.Text: _text,
    tree.Truth: _truth,
    tree.Tuple: _tuple,
    tree.Name: _name,
    tree.Member: _name,
    tree.Index: _name,
    tree.Prefix: _prefix,
    tree.Infix: _infix,
    tree.Conditional: _conditional,
    tree.Range: _range,
    tree.Call: _call,
}
