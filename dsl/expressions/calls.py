"""Calls of functions: the number of operands, and the type that the function's rule gives."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from frot.dsl import checked
from frot.dsl.catalogue import FUNCTIONS, LATER, TYPES, Function
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.expressions.array_calls import ARRAYS, array_call
from frot.dsl.expressions.events import EVENTS, event_call
from frot.dsl.expressions.expression import NUMERIC, expression, is_whole, positional, wrong_count
from frot.dsl.expressions.functions import expand
from frot.dsl.expressions.records import construct
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Record, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.names.types import find_class
from frot.dsl.quantities.dimensions import REAL, Type
from frot.dsl.text import tree

_KEEPS_WHOLE = ("abs", "min", "max", "mod")
_GIVES_WHOLE = ("floor", "ceil", "sign")


def call(node: tree.Call, scope: Scope) -> checked.Expression | Record | None:
    """The checked call of a function, of `der` or of a record; None after a message."""
    name = node.callee.text if isinstance(node.callee, tree.Name) else ""
    of = None
    if isinstance(node.callee, tree.Name | tree.Member):
        of = find_class(node.callee, scope)
    if of is not None and of.kind == "function":
        return expand(of, node, scope)
    if of is not None and of.kind == "record":
        return construct(of, node, scope)
    if of is not None and name not in FUNCTIONS:
        scope.log.report("E0202", f"{kind_of(of)} cannot be called", node.callee.span)
        return None
    if not name:
        if isinstance(node.callee, tree.Member) and not _knows(node.callee, scope):
            return None
        scope.log.report("E0202", "this cannot be called", node.callee.span)
        return None
    if name in LATER:
        scope.log.report("E0701", f"{name!r} is not supported yet", node.span)
        return None
    special: dict[str, Callable[[tree.Call, Scope], checked.Expression | None]] = {}
    special.update(dict.fromkeys(ARRAYS, array_call))
    special.update(dict.fromkeys(EVENTS, event_call))
    function = FUNCTIONS.get(name)
    if function is None and name != "der" and name not in special:
        _tell_unknown(name, node, (*FUNCTIONS, "der", *special), scope)
        return None
    if not positional(node, name, scope):
        return None
    if name in special:
        return special[name](node, scope)
    operands = [expression(a.value, scope) for a in node.arguments]
    least, most = (1, 1) if function is None else (function.least, function.most)
    if name in ("min", "max") and len(operands) == 1:
        return array_call(node, scope)
    if len(operands) < least or (most is not None and len(operands) > most):
        wrong_count(node, name, f"{least}" if least == most else f"at least {least}", scope)
        return None
    known = [o for o in operands if o is not None]
    if len(known) < len(operands):
        return None
    if function is None:
        return _derivative(node, known[0], scope)
    kind = _call_type(function, node, known, scope)
    return None if kind is None else checked.Call(name, tuple(known), kind, node.span)


def _knows(node: tree.Member, scope: Scope) -> bool:
    head: tree.Expression = node
    while isinstance(head, tree.Member):
        head = head.operand
    return not isinstance(head, tree.Name) or scope.knows(head.text)


def _tell_unknown(name: str, node: tree.Call, known: tuple[str, ...], scope: Scope) -> None:
    if not scope.knows(name):
        return
    functions = [n for n in scope.space.visible() if n not in scope.instance.names]
    help_text = did_you_mean(name, (*known, *functions), scope.log)
    if scope.find(name) is not None:
        help_text = f"{name!r} is not a function; for a product write '{name}*(...)'"
    scope.log.report("E0202", f"unknown function {name!r}", node.callee.span, help=help_text)


def _derivative(
    node: tree.Call, operand: checked.Expression, scope: Scope
) -> checked.Expression | None:
    if operand.type.base not in NUMERIC or operand.type.enumeration is not None:
        scope.log.report("E0304", f"'der' of {describe(operand.type)}", node.span)
        return None
    if operand.type.base == "integer":
        message = "'der' of a whole number: it changes at events only"
        scope.log.report("E0304", message, node.span)
        return None
    rate = operand.type.dimension / TYPES["Time"].dimension
    return checked.Derivative(operand, Type("real", rate, operand.type.shape), node.span)


def _call_type(
    function: Function, node: tree.Call, operands: list[checked.Expression], scope: Scope
) -> Type | None:
    first = operands[0].type
    vectors = function.rule in ("dot", "cross", "norm")
    for argument, operand in zip(node.arguments, operands, strict=True):
        numeric = operand.type.base in NUMERIC and operand.type.enumeration is None
        if not numeric or (len(operand.type.shape) == 1) != vectors:
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
            unit = "" if function.rule == "number" else written_unit(operands[0])
            expected, found = pair(wanted, operand.type, unit, written_unit(operand))
            scope.log.report(
                "E0301",
                f"{function.name!r} expected {expected}, found {found}",
                argument.span,
                caret=found,
            )
            return None
        if vectors and operand.type.shape != first.shape:
            scope.log.report("E0304", "the vectors have different sizes", argument.span)
            return None
    if function.rule == "cross" and first.shape not in ((2,), (3,)):
        scope.log.report("E0304", "'cross' takes vectors of 2 or 3 items", node.span)
        return None
    whole = function.name in _KEEPS_WHOLE and all(is_whole(o) for o in operands)
    whole = whole and any(o.type.base == "integer" for o in operands)
    base = "integer" if whole or function.name in _GIVES_WHOLE else "real"
    match function.rule:
        case "number" | "ratio" | "sign":
            return Type(base)
        case "root":
            return Type("real", first.dimension ** Fraction(1, 2))
        case "norm":
            return Type("real", first.dimension)
        case "dot" | "cross":
            product = first.dimension * operands[1].type.dimension
            flat = function.rule == "dot" or first.shape == (2,)
            return Type("real", product, () if flat else first.shape)
    return Type(base, first.dimension)
