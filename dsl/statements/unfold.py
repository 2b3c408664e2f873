"""Loops, and branches that parameters choose, unfolded to the statements in them."""

from __future__ import annotations

from collections.abc import Iterator

from frot.dsl import checked
from frot.dsl.checked.evaluation import constant
from frot.dsl.checked.walk import nodes
from frot.dsl.expressions.expression import expect
from frot.dsl.expressions.structure import settle, span_of
from frot.dsl.messages.diagnostics import LIMIT
from frot.dsl.names.scope import Scope
from frot.dsl.names.sections import ITEMWISE
from frot.dsl.quantities.dimensions import BOOLEAN, INTEGER
from frot.dsl.text import tree

Leaf = tuple[tree.Equation | tree.When | tree.IfEquation, Scope]


def unfold(element: tree.Element, scope: Scope) -> Iterator[Leaf]:
    """The statements of loops, and of the branch of an `if` that parameters choose."""
    match element:
        case tree.For():
            for inner in loop(element, scope):
                for part in element.elements:
                    yield from unfold(part, inner)
        case tree.IfEquation():
            chosen = _chosen(element, scope)
            if chosen is None:
                yield element, scope
            else:
                for part in chosen:
                    yield from unfold(part, scope)
        case tree.Equation() | tree.When():
            yield element, scope
        case _:
            what = "a declaration" if not isinstance(element, tree.Section) else "a section"
            message = f"{what} inside of a block of equations"
            remedy = "put it before 'equation'"
            if isinstance(element, tree.Liaison | tree.Force | tree.Body):
                remedy += f"; of several declare an array: {ITEMWISE}"
            scope.log.report("E0501", message, element.span, help=remedy)


def loop(element: tree.For, scope: Scope) -> Iterator[Scope]:
    """The scope of each round of a loop."""
    over = span_of(element.range, scope, "the range of 'for'")
    name = element.variable
    if scope.find(name.text) is not None:
        message = f"{name.text!r} is a name of the model; choose another for the loop"
        scope.log.report("E0502", message, name.span)
    for number in over or ():
        scope.build.grow(1, element.span)
        # The rounds of a loop repeat their faults, which are reported once.
        if scope.log.repeated > LIMIT:
            return
        literal = checked.Literal(float(number), INTEGER, name.span)
        yield scope.inside(**{name.text: literal})


def _chosen(element: tree.IfEquation, scope: Scope) -> tuple[tree.Element, ...] | None:
    """The branch that parameters of the structure choose; None where it can change."""
    for branch in element.branches:
        if branch.condition is None:
            return branch.elements
        condition = expect(branch.condition, BOOLEAN, scope)
        if condition is None:
            return ()
        if not _is_structural(condition):
            return None
        value = settle(condition, scope, "the condition of 'if'")
        if value is None:
            return ()
        if value:
            return branch.elements
    return ()


def _is_structural(condition: checked.Expression) -> bool:
    """Whether a condition is known before the run: Boolean and Integer parameters, constants."""
    if constant(condition) is not None:
        return False
    return all(
        node.target.constant or node.target.type.base != "real"
        for node in nodes(condition)
        if isinstance(node, checked.Reference) and isinstance(node.target, checked.Parameter)
    )
