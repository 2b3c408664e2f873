"""`when ... then ... end when`: discrete variables, reinit, assert, terminate."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.describe import describe, written_unit
from frot.dsl.expressions.expression import expect, expression, fitting
from frot.dsl.expressions.names import resolve
from frot.dsl.expressions.rates import rate_of
from frot.dsl.messages.diagnostics import Label
from frot.dsl.messages.source import Span
from frot.dsl.names.scope import Scope
from frot.dsl.names.sections import called_name
from frot.dsl.quantities.dimensions import BOOLEAN, Type
from frot.dsl.quantities.turns import rate_of_kind
from frot.dsl.statements.equations import assertion
from frot.dsl.statements.unfold import unfold
from frot.dsl.text import tree

# A variable with the indices of the item that is set, none where all of it is.
Target = tuple[checked.Variable, tuple[int, ...]]
Setters = dict[Target, Span]
Action = checked.Assign | checked.Reinit | checked.Terminate | checked.Assertion


def mark_discrete(element: tree.When, scope: Scope) -> None:
    """Say of the variables that a `when` sets that they change at events only."""
    for branch in element.branches:
        for part in branch.elements:
            for leaf, inner in unfold(part, scope):
                if isinstance(leaf, tree.Equation) and leaf.right is not None:
                    found = _assigned(leaf.left, inner)
                    if found is not None:
                        object.__setattr__(found[0], "discrete", True)


def _assigned(
    node: tree.Expression, scope: Scope
) -> tuple[checked.Variable, tuple[int, ...], Type] | None:
    """The variable left of an assignment and the indices of its item; None after a message."""
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        found = resolve(node, scope, "value")
        if found is None:
            return None
        indices: list[int] = []
        inner = found
        while isinstance(inner, checked.Element):
            indices.insert(0, inner.index)
            inner = inner.operand
        if isinstance(inner, checked.Reference) and isinstance(inner.target, checked.Variable):
            assert isinstance(found, checked.Reference | checked.Element)
            return inner.target, tuple(indices), found.type
    scope.log.report(
        "E0518",
        "in 'when' a variable is set: 'name = value;'",
        node.span,
        help="the left side is the name of a variable",
    )
    return None


def when(element: tree.When, scope: Scope, setters: Setters) -> None:
    """Check a `when`; `setters` tells where each discrete variable is set already."""
    inner = Scope(scope.build, scope.instance, scope.space, scope.local, None, True)
    branches = []
    mine: Setters = {}
    for branch in element.branches:
        conditions = _conditions(branch.condition, inner)
        here: Setters = {}
        actions: list[Action] = []
        for part in branch.elements:
            for leaf, at in unfold(part, inner):
                action = _action(leaf, at)
                if action is None:
                    continue
                if isinstance(action, checked.Assign):
                    key = action.variable, action.item
                    other = _set_before(key, here) or _set_before(key, setters)
                    if other is not None:
                        _tell_twice(action, other, scope)
                        continue
                    here[key] = action.span
                actions.append(action)
        mine.update(here)
        branches.append((conditions, tuple(actions)))
    setters.update(mine)
    scope.build.grow(1, element.span)
    scope.build.whens.append(checked.When(tuple(branches), element.span, scope.instance.name))


def _set_before(key: Target, setters: Setters) -> Span | None:
    """Where a variable, or what overlaps with its item, is set already."""
    variable, item = key
    for (other, part), span in setters.items():
        depth = min(len(part), len(item))
        if other is variable and part[:depth] == item[:depth]:
            return span
    return None


def _tell_twice(action: checked.Assign, other: Span, scope: Scope) -> None:
    scope.log.report(
        "E0517",
        f"{action.variable.name!r} is set by two 'when's",
        action.span,
        labels=(Label(other, "set here too"),),
        help="join them with 'elsewhen', which says which of the two comes first",
    )


def _conditions(node: tree.Expression | None, scope: Scope) -> tuple[checked.Expression, ...]:
    """The conditions of a `when`: one, or those of a tuple `(a, b)`."""
    assert node is not None
    items = node.items if isinstance(node, tree.Tuple) and not node.unit else (node,)
    found = [expect(item, BOOLEAN, scope) for item in items]
    return tuple(f for f in found if f is not None)


def _action(leaf: tree.Equation | tree.When | tree.IfEquation, scope: Scope) -> Action | None:
    if isinstance(leaf, tree.When | tree.IfEquation):
        word = "when" if isinstance(leaf, tree.When) else "if"
        scope.log.report(
            "E0518",
            f"{word!r} inside of 'when'",
            leaf.span,
            help="choose the value: 'x = if condition then a else pre(x);'",
        )
        return None
    if leaf.right is not None:
        return _assign(leaf, scope)
    name = called_name(leaf)
    call = leaf.left
    if isinstance(call, tree.Call):
        match name:
            case "reinit":
                return _reinit(call, scope)
            case "terminate":
                return _terminate(call, scope)
            case "assert":
                return assertion(call, scope)
    if name == "experiment" and scope.log.failed:
        return None  # the 'end when' that is missing before it was reported
    what = f"{name!r}" if name else "this"
    scope.log.report(
        "E0518",
        f"{what} is not a statement of 'when'",
        leaf.span,
        help="there are: 'x = value;', 'reinit(x, value);', 'assert(...);', 'terminate(...);'",
    )
    return None


def _assign(leaf: tree.Equation, scope: Scope) -> checked.Assign | None:
    assert leaf.right is not None
    found = _assigned(leaf.left, scope)
    value = expression(leaf.right, scope)
    if found is None or value is None:
        return None
    variable, item, kind = found
    rate = rate_of_kind(variable.quantity, variable.unit, variable.type.dimension)
    fitted = fitting(value, leaf.right, kind, scope, unit=variable.unit, rate=rate)
    return None if fitted is None else checked.Assign(variable, fitted, leaf.span, item)


def _reinit(call: tree.Call, scope: Scope) -> checked.Reinit | None:
    if len(call.arguments) != 2 or any(a.name is not None for a in call.arguments):
        scope.log.report("E0204", "write 'reinit(x, value)'", call.span)
        return None
    node = call.arguments[0].value
    target = expression(node, scope)
    if target is None:
        return None
    inner = target
    while isinstance(inner, checked.Element | checked.Derivative):
        inner = inner.operand
    good = isinstance(inner, checked.Quantity) or (
        isinstance(inner, checked.Reference)
        and isinstance(inner.target, checked.Variable)
        and not inner.target.discrete
        and inner.target.type.base == "real"
    )
    if not good:
        message = f"'reinit' is of a variable that moves, not of {_said(inner)}"
        help_text = "a variable that 'when' sets is written 'x = value;'"
        scope.log.report("E0518", message, node.span, help=help_text)
        return None
    value = expression(call.arguments[1].value, scope)
    if value is None:
        return None
    unit, rate = written_unit(target), rate_of(target)
    fitted = fitting(value, call.arguments[1].value, target.type, scope, unit=unit, rate=rate)
    return None if fitted is None else checked.Reinit(target, fitted, call.span)


def _said(node: checked.Expression) -> str:
    if isinstance(node, checked.Reference):
        kind = type(node.target).__name__.lower()
        if isinstance(node.target, checked.Variable) and node.target.discrete:
            kind = "discrete variable"
        return f"the {kind} {node.target.name!r}"
    return describe(node.type)


def _terminate(call: tree.Call, scope: Scope) -> checked.Terminate | None:
    only = call.arguments[0] if len(call.arguments) == 1 else None
    if only is None or only.name is not None or not isinstance(only.value, tree.Text):
        scope.log.report("E0204", "write 'terminate(\"why\")'", call.span)
        return None
    return checked.Terminate(only.value.value, call.span)
