"""Records: whole values of several members, unfolded member by member."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from frot.dsl import checked
from frot.dsl.expressions.expression import expression, fitting, value_of
from frot.dsl.expressions.structure import sizes
from frot.dsl.messages.source import Span
from frot.dsl.names.classes import Class
from frot.dsl.names.declared_types import Kind, find_class, find_type, split_call, split_type
from frot.dsl.names.imports import enter
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Array, Instance, Modifier, Record, Scope, settled
from frot.dsl.text import tree

__all__ = ["binding", "construct", "members_of", "pairs", "record_of"]


def record_of(instance: Instance, span: Span, scope: Scope) -> Record | None:
    """The value of a component that is a record; None where a member was refused."""
    members: dict[str, checked.Expression | Record] = {}
    for name in instance.names:
        found = settled(instance.names[name], name, instance, scope.build)
        match found:
            case checked.Parameter() | checked.Input() | checked.Output() | checked.Variable():
                scope.build.used.add(id(found))
                members[name] = checked.Reference(found, found.type, span)
            case Instance():
                inner = record_of(found, span, scope)
                if inner is None:
                    return None
                members[name] = inner
            case Array():
                scope.log.report("E0701", "arrays of records in records as values", span)
                return None
            case _:
                return None
    return Record(instance.of, members, span)


def members_of(of: Class, scope: Scope) -> Iterator[tuple[tree.Declared, Kind | Class, Scope]]:
    """The members of a record with their types, those of its bases first."""
    yield from _members(of, scope, ())


def _members(
    of: Class, scope: Scope, around: tuple[Class, ...]
) -> Iterator[tuple[tree.Declared, Kind | Class, Scope]]:
    if any(of is c for c in around):
        return
    here = Scope(
        scope.build, Instance("", of, of.definition.span), enter(of, scope.build.libraries)
    )
    for element in of.elements:
        if isinstance(element, tree.Extends):
            node, _ = split_call(element.base)
            base = find_class(node, here)
            if base is not None:
                yield from _members(base, scope, (*around, of))
        elif isinstance(element, tree.Component):
            node, type_sizes = split_type(element)
            kind = find_type(node, here, True)
            for item in element.declared:
                if kind is not None:
                    yield replace(item, subscripts=(*type_sizes, *item.subscripts)), kind, here


def construct(of: Class, node: tree.Call, scope: Scope) -> Record | None:
    """The record that a call `Name(1, y = 2)` makes; None after a message."""
    wanted = {item.name.text: (item, kind, here) for item, kind, here in members_of(of, scope)}
    given: dict[str, tree.Argument] = {}
    order = list(wanted)
    for position, argument in enumerate(node.arguments):
        if argument.name is None:
            name = order[position] if position < len(order) else ""
        else:
            name = argument.name.span.text
        if name not in wanted:
            message = f"record {of.name!r} has no member {name!r}"
            if not name:
                message = f"too many values for record {of.name!r}"
            help_text = did_you_mean(name, order, scope.log)
            notes = () if help_text else (f"its members are: {', '.join(order)}",)
            scope.log.report("E0204", message, argument.span, notes=notes, help=help_text)
            return None
        if name in given:
            scope.log.report("E0204", f"{name!r} is given twice", argument.span)
            return None
        given[name] = argument
    members: dict[str, checked.Expression | Record] = {}
    for name, (item, kind, here) in wanted.items():
        argument_value = given[name].value if name in given else item.value
        there = scope if name in given else here.inside(**members)
        if argument_value is None:
            message = f"record {of.name!r} needs {name!r}"
            scope.log.report("E0204", message, node.span)
            return None
        value = _member(kind, item, argument_value, here, there)
        if value is None:
            return None
        members[name] = value
    scope.build.grow(1, node.span)
    return Record(of, members, node.span)


def _member(
    kind: Kind | Class, item: tree.Declared, node: tree.Expression, here: Scope, there: Scope
) -> checked.Expression | Record | None:
    if isinstance(kind, Class):
        return as_record(value_of(node, there), kind, node, there)
    shape = sizes(item.subscripts, item.name, here)
    found = expression(node, there)
    if found is None or shape is None:
        return None
    return fitting(found, node, kind.type.of_shape(shape), there, unit=kind.unit, rate=kind.rate)


def as_record(
    found: checked.Expression | Record | None, of: Class, node: tree.Expression, scope: Scope
) -> Record | None:
    """The value if it is a record of this class; None after a message."""
    if found is None:
        return None
    if isinstance(found, Record) and found.of.definition is of.definition:
        return found
    shown = f"a record {found.of.name!r}" if isinstance(found, Record) else "a value"
    scope.log.report("E0301", f"expected a record {of.name!r}, found {shown}", node.span)
    return None


def binding(
    of: Class, item: tree.Declared, modifier: Modifier | None, scope: Scope
) -> dict[str, Modifier] | None:
    """The modifiers by which the value of a whole record reaches its members."""
    node, there = item.value, scope
    if modifier is not None and modifier.has_value:
        if isinstance(modifier.known, Record):
            return _spread(modifier.known, modifier.span, scope)
        node, there = modifier.value, modifier.scope
    if node is None:
        return {}
    record = as_record(value_of(node, there), of, node, there)
    return None if record is None else _spread(record, node.span, there)


def _spread(record: Record, span: Span, scope: Scope) -> dict[str, Modifier]:
    return {name: Modifier(span, scope, known=value) for name, value in record.members.items()}


def pairs(left: Record, right: Record) -> Iterator[tuple[checked.Expression, checked.Expression]]:
    """The members of two records of one class, side by side."""
    for name, first in left.members.items():
        second = right.members.get(name)
        if isinstance(first, Record) and isinstance(second, Record):
            yield from pairs(first, second)
        elif isinstance(first, checked.Expression) and isinstance(second, checked.Expression):
            yield first, second
