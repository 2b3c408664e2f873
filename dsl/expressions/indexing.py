"""Items and slices of arrays, and values that must be known before the run."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.checked.evaluation import NotConstant, constant, evaluate, nodes
from frot.dsl.messages.source import Span
from frot.dsl.names.names import Thing, as_thing, gathered, kind_of, resolve
from frot.dsl.names.scope import Array, Scope
from frot.dsl.text import tree


def element(operand: checked.Expression, index: int, span: Span) -> checked.Expression:
    """One item of an array, `index` from 0; that of a tuple is the item itself."""
    if isinstance(operand, checked.Vector):
        return operand.items[index]
    return checked.Element(operand, index, operand.type.item, span)


def items_of(operand: checked.Expression) -> list[checked.Expression]:
    """All items of an array."""
    return [element(operand, k, operand.span) for k in range(operand.type.shape[0])]


def index(node: tree.Index, scope: Scope) -> Thing | None:
    """`operand[subscripts]`: an item, or an array of those of a range."""
    from frot.dsl.expressions.expressions import value_of

    found: Thing | None
    if isinstance(node.operand, tree.Name | tree.Member | tree.Index):
        whole = Scope(scope.build, scope.instance, scope.space, scope.local, None, scope.in_when)
        found = resolve(node.operand, whole, "value")
    else:
        found = value_of(node.operand, scope)
    return None if found is None else _items(found, list(node.subscripts), node, scope)


def _items(
    thing: Thing, subscripts: list[tree.Expression], node: tree.Index, scope: Scope
) -> Thing | None:
    if not subscripts:
        return thing
    first, *rest = subscripts
    if isinstance(thing, Array):
        size = len(thing.items)
    elif isinstance(thing, checked.Expression) and thing.type.shape:
        size = thing.type.shape[0]
    else:
        shown = describe(thing.type) if isinstance(thing, checked.Expression) else kind_of(thing)
        scope.log.report("E0304", f"{shown} has no index", node.span)
        return None
    chosen = _chosen(first, size, scope)
    if chosen is None:
        return None
    found = []
    for k in chosen:
        if isinstance(thing, Array):
            part: Thing = as_thing(thing.items[k], node, scope)
        else:
            assert isinstance(thing, checked.Expression)
            part = element(thing, k, node.span)
        one = _items(part, rest, node, scope)
        if one is None:
            return None
        found.append(one)
    if not isinstance(first, tree.Range):
        return found[0]
    if not found:
        scope.log.report("E0306", "the range is empty", first.span)
        return None
    return gathered(found, node.span.text, node)


def _chosen(node: tree.Expression, size: int, scope: Scope) -> list[int] | None:
    """The indices of a subscript, from 0."""
    if isinstance(node, tree.Range):
        found = span_of(node, scope, "an index")
        values = None if found is None else list(found)
    else:
        one = whole_number(node, scope, "an index")
        values = None if one is None else [one]
    for value in values or ():
        if not 1 <= value <= size:
            message = f"the index must be from 1 to {size}"
            shown = f"it is {value}" if not isinstance(node, tree.Number) else ""
            scope.log.report("E0304", message, node.span, caret=shown)
            return None
    return None if values is None else [v - 1 for v in values]


# ------------------------------------------------------------------ known before the run


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
    from frot.dsl.expressions.expressions import expression

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
