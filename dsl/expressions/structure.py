"""Values that must be known before the run: sizes, bounds, indices."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.checked.evaluation import NotConstant, constant, evaluate
from frot.dsl.checked.walk import nodes
from frot.dsl.expressions.expression import expression
from frot.dsl.names.scope import Scope
from frot.dsl.text import tree


def settle(found: checked.Expression, scope: Scope, what: str) -> object | None:
    """The value of an expression that decides the structure; its parameters become constants.

    `what` says what it decides (`the size of 'r'`). None after a message.
    """
    moving = constant(found)
    if moving is not None:
        scope.log.report(
            "E0305",
            f"{what} must be known before the run",
            moving.span,
            caret="this varies",
            help="use numbers, constants and Integer or Boolean parameters",
        )
        return None
    try:
        value = evaluate(found, scope.values)
    except (NotConstant, KeyError):
        return None
    except ValueError as error:
        scope.log.report("E0403", f"this has no value: {error}", found.span)
        return None
    make_structural(found, f"{what} ({found.span.place})")
    return value


def make_structural(root: checked.Expression, what: str) -> None:
    """Make the parameters of an expression, and those they follow from, constants."""
    pending = [root]
    while pending:
        for node in nodes(pending.pop()):
            if isinstance(node, checked.Reference) and isinstance(node.target, checked.Parameter):
                target = node.target
                if not target.constant:
                    object.__setattr__(target, "constant", True)
                    object.__setattr__(target, "structural", what)
                    pending.append(target.value)


def whole_number(node: tree.Expression, scope: Scope, what: str) -> int | None:
    """The value of a size, a bound or an index; None after a message."""
    found = expression(node, scope)
    if found is None:
        return None
    numeric = found.type.base in ("real", "integer") and found.type.is_scalar
    if not numeric or not found.type.dimension.is_one:
        message = f"{what} is a whole number, not {describe(found.type)}"
        scope.log.report("E0304", message, node.span)
        return None
    value = settle(found, scope, what)
    if value is None:
        return None
    if not isinstance(value, float) or not value.is_integer():
        scope.log.report("E0304", f"{what} is a whole number", node.span)
        return None
    return int(value)


def span_of(node: tree.Expression, scope: Scope, what: str) -> range | None:
    """The numbers of `first:last` or `first:step:last`; of one number `n`, 1 to n."""
    if not isinstance(node, tree.Range):
        last = whole_number(node, scope, what)
        return None if last is None else range(1, last + 1)
    if len(node.items) > 3:
        scope.log.report("E0304", "a range is 'first:last' or 'first:step:last'", node.span)
        return None
    found = [whole_number(item, scope, what) for item in node.items]
    numbers = [n for n in found if n is not None]
    if len(numbers) < len(found):
        return None
    first, last = numbers[0], numbers[-1]
    step = numbers[1] if len(numbers) == 3 else 1
    if step == 0:
        scope.log.report("E0304", "the step of a range is not 0", node.items[1].span)
        return None
    result = range(first, last + (1 if step > 0 else -1), step)
    # A range that is too long is refused before anything is made of it.
    if len(result) > 1000:
        scope.build.grow(len(result), node.span)
    return result


def sizes(
    subscripts: tuple[tree.Expression, ...], name: tree.Word, scope: Scope
) -> tuple[int, ...] | None:
    """The sizes of an array, known before the run; None after a message."""
    found: list[int] = []
    for node in subscripts:
        if isinstance(node, tree.Range):
            scope.log.report("E0304", "a size is one number", node.span)
            return None
        size = whole_number(node, scope, f"the size of {name.text!r}")
        if size is None:
            return None
        if size < 1:
            message = f"the size of {name.text!r} must be at least 1; it is {size}"
            scope.log.report("E0402", message, node.span)
            return None
        found.append(size)
    return tuple(found)
