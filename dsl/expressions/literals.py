"""Numbers with their units, texts, truth values, tuples and ranges."""

from __future__ import annotations

import math
from collections.abc import Mapping

from frot.dsl import checked
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.expressions.expression import NUMERIC, expression
from frot.dsl.expressions.rates import all_alike
from frot.dsl.expressions.structure import span_of
from frot.dsl.messages.source import Span
from frot.dsl.names.declared_types import unit_of
from frot.dsl.names.scope import Rule, Scope
from frot.dsl.quantities.dimensions import BOOLEAN, INTEGER, REAL, STRING, Type
from frot.dsl.quantities.units import Unit
from frot.dsl.text import tree


def _number(node: tree.Number, scope: Scope) -> checked.Expression | None:
    value, kind = node.value, REAL
    if node.unit:
        assert node.unit_span is not None
        unit = unit_of(node.unit, node.unit_span, scope)
        if unit is None:
            return None
        value = value * unit.factor + unit.offset
        kind = Type(dimension=unit.dimension)
    if not math.isfinite(value):
        scope.log.report("E0403", f"the number {node.span.text!r} is too large", node.span)
        return None
    return checked.Literal(value, kind, node.span, node.unit)


def _text(node: tree.Text, scope: Scope) -> checked.Expression | None:
    return checked.Literal(node.value, STRING, node.span)


def _truth(node: tree.Truth, scope: Scope) -> checked.Expression | None:
    return checked.Literal(node.value, BOOLEAN, node.span)


def _tuple(node: tree.Tuple, scope: Scope) -> checked.Expression | None:
    items = [expression(i, scope) for i in node.items]
    unit = None
    if node.unit:
        assert node.unit_span is not None
        unit = unit_of(node.unit, node.unit_span, scope)
        if unit is not None and unit.offset:
            scope.log.report("E0302", "degrees Celsius cannot multiply a tuple", node.unit_span)
            return None
        if unit is None:
            return None
    found = []
    for written, item in zip(node.items, items, strict=True):
        if item is not None and unit is not None:
            item = _with_unit(item, unit, node.unit, written, scope)
        if item is None:
            return None
        found.append(item)
    if len(found) == 1:
        return found[0]
    first = found[0].type
    for written, item in zip(node.items, found, strict=True):
        if item.type.base != first.base and item.type.base not in NUMERIC:
            scope.log.report("E0303", f"a tuple cannot hold {describe(item.type)}", written.span)
            return None
        same = item.type.enumeration == first.enumeration and item.type.shape == first.shape
        if item.type.dimension != first.dimension or not same:
            units = written_unit(found[0]), written_unit(item)
            before, now = pair(first, item.type, *units)
            scope.log.report(
                "E0303",
                f"the items of a tuple differ: {before}, then {now}",
                written.span,
                caret=now,
                help="give each item its unit, or one unit after the tuple: '(0, 1) m'",
            )
            return None
    alike = all_alike(found, scope)
    if alike is None:
        return None
    base = "real" if any(i.type.base == "real" for i in found) else first.base
    kind = Type(base, first.dimension, (len(found), *first.shape), first.enumeration)
    return checked.Vector(tuple(alike), kind, node.span)


def _with_unit(
    item: checked.Expression, unit: Unit, text: str, written: tree.Expression, scope: Scope
) -> checked.Expression | None:
    if item.type.base not in NUMERIC or not item.type.dimension.is_one:
        scope.log.report(
            "E0303",
            f"expected a number before the unit {text!r}, found {describe(item.type)}",
            written.span,
        )
        return None
    kind = Type("real", unit.dimension, item.type.shape)
    if isinstance(item, checked.Vector):
        inner = [
            checked.Binary(
                "*", i, _factor(unit, i.span, text), Type("real", unit.dimension), i.span
            )
            for i in item.items
        ]
        return checked.Vector(tuple(inner), kind, item.span)
    if isinstance(item, checked.Literal):
        return checked.Literal(float(item.value) * unit.factor, kind, item.span, text)
    if isinstance(item, checked.Unary) and isinstance(item.operand, checked.Literal):
        value = float(item.operand.value) * unit.factor
        inside = checked.Literal(value, kind, item.operand.span, text)
        return checked.Unary(item.op, inside, kind, item.span)
    return checked.Binary("*", item, _factor(unit, item.span, text), kind, item.span)


def _factor(unit: Unit, span: Span, text: str) -> checked.Literal:
    return checked.Literal(unit.factor, Type(dimension=unit.dimension), span, text)


def _range(node: tree.Range, scope: Scope) -> checked.Expression | None:
    found = span_of(node, scope, "a range")
    if found is None:
        return None
    items = tuple(checked.Literal(float(n), INTEGER, node.span) for n in found)
    return checked.Vector(items, Type("integer", shape=(len(items),)), node.span)


LITERALS: Mapping[type, Rule] = {
    tree.Number: _number,
    tree.Text: _text,
    tree.Truth: _truth,
    tree.Tuple: _tuple,
    tree.Range: _range,
}
