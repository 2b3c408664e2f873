"""Calls of functions: the number of operands, and the type that the function's rule gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from frot.dsl import checked
from frot.dsl.catalogue import FUNCTIONS, LATER, TYPES, Function
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.expressions.array_calls import array_call
from frot.dsl.expressions.events import event_call
from frot.dsl.expressions.expression import NUMERIC, expression, is_whole
from frot.dsl.expressions.rates import all_alike
from frot.dsl.expressions.records import construct
from frot.dsl.expressions.user_functions import expand
from frot.dsl.names.declared_types import find_class
from frot.dsl.names.near import unknown_kind
from frot.dsl.names.scope import Record, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.quantities.dimensions import REAL, Type
from frot.dsl.text import tree


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
    function = FUNCTIONS.get(name)
    if function is None:
        _tell_unknown(name, node, scope)
        return None
    if not _positional(node, name, scope):
        return None
    special = _SPECIAL.get(function.place)
    if special is not None:
        return special(node, scope) if _fits(function, node, scope) else None
    if function.switch == "order" and len(node.arguments) == 1:
        return array_call(node, scope)
    operands = [expression(a.value, scope) for a in node.arguments]
    if not _fits(function, node, scope):
        return None
    known = [o for o in operands if o is not None]
    if len(known) < len(operands):
        return None
    kind = _call_type(function, node, known, scope)
    if kind is None:
        return None
    alike = all_alike(known, scope) if function.rule is not None and function.rule.alike else known
    return None if alike is None else checked.Call(name, tuple(alike), kind, node.span)


def _knows(node: tree.Member, scope: Scope) -> bool:
    head: tree.Expression = node
    while isinstance(head, tree.Member):
        head = head.operand
    return not isinstance(head, tree.Name) or scope.knows(head.text)


def _tell_unknown(name: str, node: tree.Call, scope: Scope) -> None:
    if not scope.knows(name):
        return
    functions = [n for n in scope.space.visible() if n not in scope.instance.names]
    product = f"{name!r} is not a function; for a product write '{name}*(...)'"
    unknown_kind(
        "function",
        name,
        (*FUNCTIONS, *functions),
        node.callee.span,
        scope.log,
        usable=FUNCTIONS,
        help=product if scope.find(name) is not None else "",
    )


def _positional(node: tree.Call, name: str, scope: Scope) -> bool:
    """Whether all operands are without names; the first one that is not is reported."""
    for argument in node.arguments:
        if argument.name is not None:
            message = f"{name!r} takes its operands without names"
            scope.log.report("E0204", message, argument.name.span)
            return False
    return True


def _fits(function: Function, node: tree.Call, scope: Scope) -> bool:
    """Whether a function takes so many operands; it is reported if not."""
    if function.takes(len(node.arguments)):
        return True
    ends = "" if function.count.endswith("1") else "s"
    message = f"{function.name!r} takes {function.count} operand{ends}"
    scope.log.report("E0204", f"{message}, found {len(node.arguments)}", node.span)
    return False


def _derivative(node: tree.Call, scope: Scope) -> checked.Expression | None:
    operand = expression(node.arguments[0].value, scope)
    if operand is None:
        return None
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
    rule = function.rule
    assert rule is not None
    first = operands[0].type
    for argument, operand in zip(node.arguments, operands, strict=True):
        numeric = operand.type.base in NUMERIC and operand.type.enumeration is None
        if not numeric or (len(operand.type.shape) == 1) != rule.vectors:
            what = "vectors" if rule.vectors else "numbers"
            scope.log.report(
                "E0304",
                f"{function.name!r} takes {what}, found {describe(operand.type)}",
                argument.span,
            )
            return None
        wanted = REAL if rule.plain else first
        if (rule.plain or rule.alike) and operand.type.dimension != wanted.dimension:
            unit = "" if rule.plain else written_unit(operands[0])
            expected, found = pair(wanted, operand.type, unit, written_unit(operand))
            scope.log.report(
                "E0301",
                f"{function.name!r} expected {expected}, found {found}",
                argument.span,
                caret=found,
            )
            return None
        if rule.vectors and operand.type.shape != first.shape:
            scope.log.report("E0304", "the vectors have different sizes", argument.span)
            return None
    if rule.sizes and first.shape[0] not in rule.sizes:
        sizes = " or ".join(map(str, rule.sizes))
        message = f"{function.name!r} takes vectors of {sizes} items"
        scope.log.report("E0304", message, node.span)
        return None
    given = rule.gives(tuple(o.type for o in operands))
    kept = all(is_whole(o) for o in operands) and any(o.type.base == "integer" for o in operands)
    whole = function.whole == "always" or (function.whole == "kept" and kept)
    return Type("integer", given.dimension, given.shape) if whole else given


# Those whose operands are not simply numbers or vectors, by where their meaning lies.
_SPECIAL: Mapping[str, Callable[[tree.Call, Scope], checked.Expression | None]] = {
    "array": array_call,
    "event": event_call,
    "rate": _derivative,
}
