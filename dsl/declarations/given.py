"""The value a declaration is given: where it is declared or from outside, in its unit."""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl import checked
from frot.dsl.checked.arrays import element
from frot.dsl.checked.describe import describe, written_unit
from frot.dsl.expressions.expression import agrees, as_integer, fitting, is_whole, value_of
from frot.dsl.names.declared_types import Kind
from frot.dsl.names.scope import Modifier, Record, Scope
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree


@dataclass(frozen=True, slots=True)
class Declared:
    """One name with its type, its role and what is said of it from outside."""

    item: tree.Declared
    kind: Kind
    role: str
    modifier: Modifier | None
    type_sizes: tuple[tree.Expression, ...] = ()


def given_value(
    modifier: Modifier | None, kind: Kind
) -> tuple[checked.Expression | None, tree.Expression | None]:
    """The value a modifier gives, for this item of an array, and its text; None after a message."""
    if modifier is None:
        return None, None
    if modifier.known is not None:
        return (modifier.known if not isinstance(modifier.known, Record) else None), None
    node, there = modifier.value, modifier.scope
    assert node is not None
    if "value" not in modifier.memo:
        modifier.memo["value"] = written_value(node, kind, there)
    found = modifier.memo["value"]
    if found is None:
        return None, node
    assert not isinstance(found, Record)
    outer = tuple(size for _, size in modifier.picks)
    whole = found.type.shape
    for depth in range(len(outer), 0, -1):
        if whole == (*outer[-depth:], *kind.type.shape):
            for index, _ in modifier.picks[-depth:]:
                found = element(found, index, found.span)
            break
    return fitting(found, node, kind.type, there, unit=kind.unit, rate=kind.rate), node


def written_value(node: tree.Expression, kind: Kind, scope: Scope) -> checked.Expression | None:
    """The expression; a bare number where the type has a unit is taken in that unit."""
    found = value_of(node, scope)
    if isinstance(found, Record):
        message = f"expected {describe(kind.type)}, found a record {found.of.name!r}"
        scope.log.report("E0205", message, node.span)
        return None
    if found is not None and kind.factor is not None:
        return _in_unit(found, kind)
    return found


def _in_unit(found: checked.Expression, kind: Kind) -> checked.Expression:
    match found:
        case checked.Literal(value=float() as value, unit="") if found.type.dimension.is_one:
            assert kind.factor is not None
            one = Type("real", kind.type.dimension)
            # The factor of a rate is already that of its kind.
            unit = "" if kind.rate else kind.unit
            return checked.Literal(value * kind.factor, one, found.span, unit)
        case checked.Unary(op="-", operand=checked.Literal() as inner):
            made = _in_unit(inner, kind)
            return checked.Unary("-", made, made.type, found.span)
        case checked.Vector(items=items) if found.type.dimension.is_one:
            whole = [_in_unit(item, kind) for item in items]
            if all(item.type.dimension == kind.type.dimension for item in whole):
                one = Type("real", kind.type.dimension, found.type.shape)
                return checked.Vector(tuple(whole), one, found.span)
    return found


def bound_value(
    what: Declared, kind: Kind, scope: Scope
) -> tuple[checked.Expression | None, str, bool]:
    """The value of a declaration, the unit it is written in, and whether there is one at all."""
    modifier = what.modifier
    if modifier is not None and modifier.has_value:
        value, node = given_value(modifier, kind)
        return value, author_unit(node, value), True
    if what.item.value is None:
        return None, "", False
    found = written_value(what.item.value, kind, scope)
    if found is not None and stretches(found, kind):
        found = stretched(found, kind)
    if found is not None:
        found = fitting(found, what.item.value, kind.type, scope, unit=kind.unit, rate=kind.rate)
    return found, author_unit(what.item.value, found), True


def stretches(found: checked.Expression, kind: Kind) -> bool:
    """Whether one number stands for all items of an array that is declared."""
    one = kind.type.of_shape(())
    whole = one.base == "integer" and one.enumeration is None and is_whole(found)
    return bool(kind.type.shape) and (agrees(found.type, one) or (whole and not found.type.shape))


def stretched(found: checked.Expression, kind: Kind) -> checked.Expression:
    """The array of which one number stands for all items."""
    if kind.type.base == "integer" and found.type.base != "integer":
        found = as_integer(found)
    for size in reversed(kind.type.shape):
        inner = found.type
        found = checked.Vector((found,) * size, inner.of_shape((size, *inner.shape)), found.span)
    return found


def author_unit(node: tree.Expression | None, value: checked.Expression | None) -> str:
    """The unit in which a value is written, or an empty text."""
    while isinstance(node, tree.Prefix):
        node = node.operand
    if isinstance(node, tree.Number | tree.Tuple) and node.unit:
        return node.unit
    return written_unit(value) if isinstance(value, checked.Literal) else ""
