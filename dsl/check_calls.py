"""Calls of functions: the number of operands, and the type that the function's rule gives."""

from __future__ import annotations

from fractions import Fraction

from frot.dsl import checked, tree
from frot.dsl.catalogue import FUNCTIONS, LATER, TYPES, Function
from frot.dsl.check_expressions import NUMERIC, expression
from frot.dsl.describe import describe
from frot.dsl.dimensions import REAL, Type
from frot.dsl.scope import Scope, did_you_mean


def call(node: tree.Call, scope: Scope) -> checked.Expression | None:
    """The checked call of a function or of `der`; None after a message."""
    name = node.callee.text if isinstance(node.callee, tree.Name) else ""
    if not name:
        scope.log.report("E0202", "this cannot be called", node.callee.span)
        return None
    if name in LATER:
        scope.log.report("E0701", f"{name!r} is not supported yet", node.span)
        return None
    function = FUNCTIONS.get(name)
    if function is None and name != "der":
        if scope.knows(name):
            help_text = did_you_mean(name, (*FUNCTIONS, "der"))
            if name in scope.names:
                help_text = f"{name!r} is not a function; for a product write '{name}*(...)'"
            scope.log.report(
                "E0202", f"unknown function {name!r}", node.callee.span, help=help_text
            )
        return None
    for argument in node.arguments:
        if argument.name is not None:
            scope.log.report(
                "E0204", f"{name!r} takes its operands without names", argument.name.span
            )
            return None
    operands = [expression(a.value, scope) for a in node.arguments]
    least, most = (1, 1) if function is None else (function.least, function.most)
    if len(operands) < least or (most is not None and len(operands) > most):
        count = f"{least}" if least == most else f"at least {least}"
        scope.log.report(
            "E0204",
            f"{name!r} takes {count} operand{'s' if least > 1 else ''}, found {len(operands)}",
            node.span,
        )
        return None
    known = [o for o in operands if o is not None]
    if len(known) < len(operands):
        return None
    if function is None:
        return _derivative(node, known[0], scope)
    kind = _call_type(function, node, known, scope)
    return None if kind is None else checked.Call(name, tuple(known), kind, node.span)


def _derivative(
    node: tree.Call, operand: checked.Expression, scope: Scope
) -> checked.Expression | None:
    if operand.type.base != "real":
        scope.log.report("E0304", f"'der' of {describe(operand.type)}", node.span)
        return None
    rate = operand.type.dimension / TYPES["Time"].dimension
    return checked.Derivative(operand, Type("real", rate, operand.type.shape), node.span)


def _call_type(
    function: Function, node: tree.Call, operands: list[checked.Expression], scope: Scope
) -> Type | None:
    first = operands[0].type
    vectors = function.rule in ("dot", "cross", "norm")
    for argument, operand in zip(node.arguments, operands, strict=True):
        if operand.type.base not in NUMERIC or (len(operand.type.shape) == 1) != vectors:
            what = "vectors" if vectors else "numbers"
            scope.log.report(
                "E0304",
                f"{function.name!r} takes {what}, found {describe(operand.type)}",
                argument.span,
            )
            return None
        wanted = REAL if function.rule == "number" else first
        alike = function.rule in ("number", "alike", "ratio")
        if alike and operand.type.dimension != wanted.dimension:
            scope.log.report(
                "E0301",
                f"{function.name!r} expected {describe(wanted)}, found {describe(operand.type)}",
                argument.span,
                caret=describe(operand.type),
            )
            return None
        if vectors and operand.type.shape != first.shape:
            scope.log.report("E0304", "the vectors have different sizes", argument.span)
            return None
    match function.rule:
        case "number" | "ratio" | "sign":
            return REAL
        case "root":
            return Type("real", first.dimension ** Fraction(1, 2))
        case "norm":
            return Type("real", first.dimension)
        case "dot" | "cross":
            product = first.dimension * operands[1].type.dimension
            flat = function.rule == "dot" or first.shape == (2,)
            return Type("real", product, () if flat else first.shape)
    return Type("real", first.dimension)
