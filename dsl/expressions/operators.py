"""Operators: the dimension and the type of what they give."""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction

from frot.dsl import checked
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.checked.walk import nodes
from frot.dsl.expressions.array_calls import product
from frot.dsl.expressions.expression import NUMERIC, agrees, expect, expression, is_whole
from frot.dsl.expressions.known import known
from frot.dsl.expressions.rates import all_alike
from frot.dsl.expressions.seconds import seconds_missing
from frot.dsl.names.scope import Rule, Scope
from frot.dsl.quantities.dimensions import BOOLEAN, REAL, Type
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.units import parse_unit
from frot.dsl.text import tree


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
        return product(node, left, right, scope)
    kind = _infix_type(node, left, right, scope)
    if kind is None:
        return None
    if node.op not in ("*", "/", "^"):
        sides = all_alike((left, right), scope)
        if sides is None:
            return None
        left, right = sides
    return checked.Binary(node.op, left, right, kind, node.span)


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
            remedy = _power_meant(node) or _unit_missing(node, a, b)
            remedy = remedy or seconds_missing(a, right, left) or seconds_missing(b, left, right)
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


def _power_meant(node: tree.Infix) -> str:
    """The remedy where a power of a unit is written without its sign: `3 m.s-1`."""
    last = node.left
    while isinstance(last, tree.Infix | tree.Prefix):
        last = last.right if isinstance(last, tree.Infix) else last.operand
    if not isinstance(last, tree.Number | tree.Tuple) or not last.unit or last.unit_span is None:
        return ""
    end = last.unit_span.end
    power = re.compile(r"-\d+").match(node.span.source.text, end)
    if power is None or node.op_span.start != end or not (meant := corrected(last.unit + power[0])):
        return ""
    value = node.span.source.text[last.span.start : last.unit_span.start]
    return f"in a unit a power is written with '^': '{value}{meant}'"


def _unit_missing(node: tree.Infix, a: Type, b: Type) -> str:
    """The remedy where one side is a bare number and the other has a dimension."""
    for side, other in ((node.left, b), (node.right, a)):
        if isinstance(side, tree.Number) and not side.unit and not other.dimension.is_one:
            return f"write the unit: '{side.span.text} {other.dimension.unit}'"
    return ""


def _conditional(node: tree.Conditional, scope: Scope) -> checked.Expression | None:
    condition = expect(node.condition, BOOLEAN, scope)
    holds = None if condition is None else _never_changes(condition, scope)
    (yes, beyond), (no, behind) = (
        _branch(branch, holds in (None, which), scope)
        for branch, which in ((node.yes, True), (node.no, False))
    )
    if beyond or behind:
        return no if beyond else yes
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
    branches = all_alike((yes, no), scope)
    if branches is None:
        return None
    yes, no = branches
    return checked.If(condition, yes, no, kind, node.span)


def _branch(
    node: tree.Expression, counts: bool, scope: Scope
) -> tuple[checked.Expression | None, bool]:
    """A branch, and whether it is none: one that does not count may ask for an item that is not.

    In a loop: `if i > 1 then x[i - 1] else 0`.
    """
    if counts:
        return expression(node, scope), False
    faults, asked = len(scope.log.diagnostics), scope.build.items_beyond
    scope.build.unused += 1
    found = expression(node, scope)
    scope.build.unused -= 1
    beyond = scope.build.items_beyond > asked and len(scope.log.diagnostics) == faults
    return found, found is None and beyond


def _never_changes(condition: checked.Expression, scope: Scope) -> bool | None:
    """Whether a condition of numbers, constants and loops holds; None if a run may change it."""
    for part in nodes(condition):
        if isinstance(part, checked.Reference) and not (
            isinstance(part.target, checked.Parameter) and part.target.constant
        ):
            return None
    value = known(condition, scope)
    return value if isinstance(value, bool) else None


OPERATORS: Mapping[type, Rule] = {
    tree.Prefix: _prefix,
    tree.Infix: _infix,
    tree.Conditional: _conditional,
}
