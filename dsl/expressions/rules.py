"""How each kind of expression is checked: the table that every part of a text is looked up in."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl import checked
from frot.dsl.expressions.calls import call
from frot.dsl.expressions.expression import tell_no_value
from frot.dsl.expressions.literals import LITERALS
from frot.dsl.expressions.names import resolve
from frot.dsl.expressions.operators import OPERATORS
from frot.dsl.expressions.records import record_of
from frot.dsl.names.scope import Instance, Record, Rule, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.text import tree


def _named(
    node: tree.Name | tree.Member | tree.Index, scope: Scope
) -> checked.Expression | Record | None:
    thing = resolve(node, scope, "value")
    if thing is None or isinstance(thing, checked.Expression | Record):
        return thing
    if isinstance(thing, Instance) and thing.of.kind == "record":
        return record_of(thing, node.span, scope)
    help_text = ""
    if isinstance(thing, checked.Body | checked.Frame | checked.BodyPoint):
        help_text = f"name one of its variables, as '{node.span.text}.position'"
    elif isinstance(thing, Instance):
        help_text = "name one of its variables"
    tell_no_value(kind_of(thing), node, help_text, scope)
    return None


RULES: Mapping[type, Rule] = {
    **LITERALS,
    **OPERATORS,
    tree.Name: _named,
    tree.Member: _named,
    tree.Index: _named,
    tree.Call: call,
}
