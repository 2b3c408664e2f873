"""Values that can be known from the parameters' defaults, against their bounds."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.catalogue import Argument
from frot.dsl.checked.describe import quantity
from frot.dsl.checked.evaluation import NotConstant, Value, evaluate
from frot.dsl.messages.source import Span
from frot.dsl.names.scope import Scope


def known(node: checked.Expression, scope: Scope) -> Value | None:
    """The value with the parameters' defaults; None if it varies or cannot be computed."""
    try:
        return evaluate(node, scope.values)
    except (NotConstant, KeyError, ValueError):
        return None


def computed(node: checked.Expression, scope: Scope) -> Value | None:
    """As `known`, but a division by zero and the like are reported."""
    try:
        return evaluate(node, scope.values)
    except (NotConstant, KeyError):
        return None
    except ValueError as error:
        scope.log.report("E0403", f"this has no value: {error}", node.span)
        return None


def check_bounds(argument: Argument, node: checked.Expression, scope: Scope) -> None:
    """Report a value outside of what the argument allows, where the value is known."""
    value = computed(node, scope)
    items = value if isinstance(value, tuple) else (value,)
    positive = argument.sign == "positive"
    for item in items:
        if not isinstance(item, float):
            return
        shown = quantity(item, node.type)
        if positive and item <= 0:
            out_of_bounds(f"{argument.name} must be positive; it is {shown}", node.span, scope)
        elif argument.sign == "nonnegative" and item < 0:
            out_of_bounds(f"{argument.name} must not be negative; it is {shown}", node.span, scope)
        elif argument.at_most is not None and item > argument.at_most:
            limit = quantity(argument.at_most, node.type)
            message = f"{argument.name} must be at most {limit}; it is {shown}"
            scope.log.report("E0402", message, node.span)


def out_of_bounds(message: str, span: Span, scope: Scope) -> None:
    """Report a value with a wrong sign."""
    scope.log.report("E0401", message, span)
