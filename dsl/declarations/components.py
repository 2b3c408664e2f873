"""Values that are declared: parameters, constants, inputs, outputs and variables."""

from __future__ import annotations

from dataclasses import dataclass, replace

from frot.dsl import checked
from frot.dsl.checked.arrays import element, zero
from frot.dsl.checked.describe import describe, pair, written_unit
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.expression import (
    agrees,
    as_integer,
    expression,
    fitting,
    is_whole,
    value_of,
)
from frot.dsl.expressions.known import computed
from frot.dsl.expressions.rates import as_rate
from frot.dsl.expressions.structure import sizes
from frot.dsl.names.entities import Record
from frot.dsl.names.modifiers import Modifier
from frot.dsl.names.scope import Scope
from frot.dsl.names.types import Kind, modified
from frot.dsl.quantities.dimensions import Type
from frot.dsl.text import tree

Value = checked.Parameter | checked.Input | checked.Output | checked.Variable


@dataclass(frozen=True, slots=True)
class Declared:
    """One name with its type, its role and what is said of it from outside."""

    item: tree.Declared
    kind: Kind
    role: str
    modifier: Modifier | None
    type_sizes: tuple[tree.Expression, ...] = ()


def declare(what: Declared, scope: Scope) -> Value | None:
    """The checked parameter, constant, input, output or variable; None after a message."""
    item = what.item
    parts = {} if what.modifier is None else what.modifier.parts
    kind = modified(what.kind, parts, scope)
    shape = sizes((*what.type_sizes, *item.subscripts), item.name, scope)
    if kind is None or shape is None:
        return None
    if shape:
        for count in shape:
            scope.build.grow(count, item.span)
        kind = replace(kind, type=kind.type.of_shape(shape))
    is_top = scope.instance is scope.build.root
    if what.role in ("parameter", "constant"):
        return _parameter(what, kind, scope)
    if what.role == "input" and is_top:
        return _input(what, kind, scope)
    if what.role == "output" and is_top and item.value is not None:
        return _output(what, kind, scope)
    return _variable(what, kind, is_top and what.role == "output", scope)


def given_value(
    modifier: Modifier | None, kind: Kind, scope: Scope
) -> tuple[checked.Expression | None, tree.Expression | None]:
    """The value a modifier gives, for this item of an array, and its text; None after a message."""
    if modifier is None:
        return None, None
    if modifier.known is not None:
        return (modifier.known if not isinstance(modifier.known, Record) else None), None
    node, there = modifier.value, modifier.scope
    assert node is not None
    if "value" not in modifier.memo:
        modifier.memo["value"] = _raw(node, kind, there)
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


def _raw(node: tree.Expression, kind: Kind, scope: Scope) -> checked.Expression | None:
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


def _bound(what: Declared, kind: Kind, scope: Scope) -> tuple[checked.Expression | None, str, bool]:
    """The value of a declaration, the unit it is written in, and whether there is one at all."""
    modifier = what.modifier
    if modifier is not None and modifier.has_value:
        value, node = given_value(modifier, kind, scope)
        return value, _unit(node, value), True
    if what.item.value is None:
        return None, "", False
    found = _raw(what.item.value, kind, scope)
    if found is not None and _stretches(found, kind):
        found = _stretched(found, kind)
    if found is not None:
        found = fitting(found, what.item.value, kind.type, scope, unit=kind.unit, rate=kind.rate)
    return found, _unit(what.item.value, found), True


def _stretches(found: checked.Expression, kind: Kind) -> bool:
    """Whether one number stands for all items of an array that is declared."""
    return bool(kind.type.shape) and agrees(found.type, kind.type.of_shape(()))


def _stretched(found: checked.Expression, kind: Kind) -> checked.Expression:
    for size in reversed(kind.type.shape):
        inner = found.type
        found = checked.Vector((found,) * size, inner.of_shape((size, *inner.shape)), found.span)
    return found


def _unit(node: tree.Expression | None, value: checked.Expression | None) -> str:
    while isinstance(node, tree.Prefix):
        node = node.operand
    if isinstance(node, tree.Number | tree.Tuple) and node.unit:
        return node.unit
    return written_unit(value) if isinstance(value, checked.Literal) else ""


# ------------------------------------------------------------------ the four roles


def _parameter(what: Declared, kind: Kind, scope: Scope) -> checked.Parameter | None:
    item, is_constant = what.item, what.role == "constant"
    value, unit, given = _bound(what, kind, scope)
    if not given:
        owner = scope.instance.name
        scope.log.report(
            "E0504",
            f"{what.role} {item.name.text!r} has no value",
            scope.instance.span if owner else item.name.span,
            help=f"write '{item.name.text} = ...'"
            if not owner
            else f"give it one: '{owner.rpartition('.')[2]}({item.name.text} = ...)'",
        )
        return None
    if value is None:
        return None
    moving = constant(value)
    if moving is not None:
        scope.log.report(
            "E0305",
            f"{what.role} {item.name.text!r} must depend on parameters only",
            moving.span,
            caret="this varies",
        )
        return None
    result = computed(value, scope)
    name = scope.dotted(item.name.text)
    found = checked.Parameter(
        name, kind.type, value, item.span, item.doc, unit or kind.unit, is_constant, kind.name
    )
    if result is not None:
        scope.values[found] = result
    return found


def _start(kind: Kind, scope: Scope) -> tuple[checked.Expression | None, str, bool]:
    """The value of `start = ...`, its unit, and whether it is without fault."""
    return _attribute(kind.start, "a start value", kind, scope)


def _attribute(
    given: Modifier | None, what: str, kind: Kind, scope: Scope
) -> tuple[checked.Expression | None, str, bool]:
    """The value of an attribute that is of the variable's kind, its unit, whether it is right."""
    if given is None:
        return None, "", True
    _spread(given, kind)
    value, node = given_value(given, kind, scope)
    if value is None:
        return None, "", False
    moving = constant(value)
    if moving is not None:
        message = f"{what} must depend on parameters only"
        scope.log.report("E0305", message, moving.span, caret="this varies")
        return None, "", False
    return value, _unit(node, value), True


def _spread(given: Modifier, kind: Kind) -> None:
    """One number may stand for all items of an array."""
    if given.value is None or not kind.type.shape or "spread" in given.memo:
        return
    found = given.memo["spread"] = expression(given.value, given.scope)
    if found is not None and _stretches(found, kind):
        given.memo["value"] = _stretched(found, kind)


def _input(what: Declared, kind: Kind, scope: Scope) -> checked.Input | None:
    item = what.item
    if item.value is not None:
        scope.log.report(
            "E0505",
            f"input {item.name.text!r} is given from outside: it has no equation",
            item.value.span,
            help=f"its first value is written '{item.name.text}(start = ...)'",
        )
        return None
    value, unit, good = _start(kind, scope)
    if not good:
        return None
    if value is None:
        value = zero(kind.type, item.span)
    return checked.Input(
        item.name.text, kind.type, value, item.span, item.doc, unit or kind.unit, kind.name
    )


def _output(what: Declared, kind: Kind, scope: Scope) -> checked.Output | None:
    item = what.item
    assert item.value is not None
    value = _raw(item.value, kind, scope)
    if value is None:
        return None
    # An output of one number may be given a vector: its shape is that of its value.
    shape = kind.type.shape or value.type.shape
    whole = kind.type.of_shape(shape)
    if whole.base == "integer" and is_whole(value) and whole.enumeration is None:
        value = as_integer(value)
    if kind.type.base == "string" or not agrees(value.type, whole):
        wanted, shown = pair(kind.type, value.type, kind.unit, written_unit(value))
        scope.log.report(
            "E0301",
            f"expected {wanted}, found {shown}",
            item.value.span,
            caret=shown,
        )
        return None
    unit = _unit(item.value, value) or kind.unit
    of_rate = as_rate(value, kind.rate, scope)
    if of_rate is None:
        return None
    return checked.Output(item.name.text, whole, of_rate, item.span, item.doc, unit, kind.name)


def _variable(what: Declared, kind: Kind, is_output: bool, scope: Scope) -> checked.Variable | None:
    item = what.item
    if kind.type.base == "string":
        scope.log.report(
            "E0305",
            f"{item.name.text!r} is a text: only a parameter or constant can be one",
            item.span,
            help=f"write 'parameter String {item.name.text} = ...'",
        )
        return None
    start, start_unit, good = _start(kind, scope)
    nominal, _, right = _attribute(kind.nominal, "a nominal value", kind, scope)
    if not good or not right:
        return None
    name = scope.dotted(item.name.text)
    found = checked.Variable(
        name,
        kind.type,
        item.span,
        item.doc,
        kind.unit or start_unit,
        kind.name,
        start,
        output=is_output,
        nominal=nominal,
    )
    modifier = what.modifier
    node = item.value
    if modifier is not None and modifier.has_value:
        node = modifier.value
    elif node is None:
        return found
    span = node.span if node is not None else modifier.span if modifier is not None else item.span

    def bind() -> None:
        value, _, _ = _bound(what, kind, scope)
        if value is not None:
            left = checked.Reference(found, found.type, item.name.span)
            scope.build.equations.append(checked.Equation(left, value, span, scope.instance.name))

    scope.build.bindings.append(bind)
    return found
