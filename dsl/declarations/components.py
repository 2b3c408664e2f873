"""Values that are declared: parameters, constants, inputs, outputs and variables."""

from __future__ import annotations

from dataclasses import replace

from frot.dsl import checked
from frot.dsl.checked.arrays import zero
from frot.dsl.checked.describe import pair, written_unit
from frot.dsl.checked.evaluation import constant
from frot.dsl.declarations.bounds import Bounds, hold
from frot.dsl.declarations.given import (
    Declared,
    author_unit,
    bound_value,
    given_value,
    stretched,
    stretches,
    written_value,
)
from frot.dsl.expressions.expression import (
    agrees,
    as_integer,
    expression,
    is_whole,
)
from frot.dsl.expressions.known import computed
from frot.dsl.expressions.rates import as_rate
from frot.dsl.expressions.seconds import seconds_missing
from frot.dsl.expressions.structure import sizes
from frot.dsl.names.declared_types import Kind, modified
from frot.dsl.names.scope import Modifier, Scope

Value = checked.Parameter | checked.Input | checked.Output | checked.Variable


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
    is_top = _is_of_model(scope)
    if what.role in ("parameter", "constant"):
        return _parameter(what, kind, scope)
    if what.role == "input" and is_top:
        return _input(what, kind, scope)
    if what.role == "output" and is_top and item.value is not None:
        return _output(what, kind, scope)
    return _variable(what, kind, is_top and what.role == "output", scope)


def _is_of_model(scope: Scope) -> bool:
    """Whether what is declared is the model's own, perhaps as a member of its records."""
    return all(of.kind == "record" for of in scope.instance.around[1:])


def _parameter(what: Declared, kind: Kind, scope: Scope) -> checked.Parameter | None:
    item, is_constant = what.item, what.role == "constant"
    value, unit, given = bound_value(what, kind, scope)
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
    bounds = _bounds(kind, scope)
    if bounds is None:
        return None
    result = computed(value, scope)
    found = checked.Parameter(
        scope.dotted(item.name.text),
        kind.type,
        value,
        item.span,
        item.doc,
        unit or kind.unit,
        is_constant,
        kind.name,
        bounds=bounds,
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
    if given.parts or not given.has_value:
        name, _, inside = given.span.text.partition("(")
        if given.parts or inside.strip(" )") == "":  # what is no modifier was reported
            help_text = f"write '{name.strip()} = ...'"
            scope.log.report("E0204", f"{what} in brackets", given.span, help=help_text)
        return None, "", False
    _spread(given, kind)
    value, node = given_value(given, kind)
    if value is None:
        return None, "", False
    moving = constant(value)
    if moving is not None:
        message = f"{what} must depend on parameters only"
        scope.log.report("E0305", message, moving.span, caret="this varies")
        return None, "", False
    return value, author_unit(node, value), True


def _bounds(kind: Kind, scope: Scope) -> Bounds | None:
    """`min` and `max`, as far as they are given; None after a message."""
    found = []
    for name, given in kind.bounds:
        value, _, good = _attribute(given, f"a value of {name!r}", kind, scope)
        if not good or value is None:
            return None
        found.append((name, value))
    return tuple(found)


def _spread(given: Modifier, kind: Kind) -> None:
    """The items of an array; one number may stand for all of them."""
    if given.value is None or not kind.type.shape or "spread" in given.memo:
        return
    found = given.memo["spread"] = expression(given.value, given.scope)
    if found is not None and stretches(found, kind):
        given.memo["value"] = stretched(found, kind)


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
    bounds = _bounds(kind, scope)
    if bounds is None:
        return None
    name, own_unit = scope.dotted(item.name.text), unit or kind.unit
    found = checked.Input(name, kind.type, value, item.span, item.doc, own_unit, kind.name, bounds)
    hold(checked.Reference(found, found.type, item.name.span), name, bounds, kind, scope)
    return found


def _output(what: Declared, kind: Kind, scope: Scope) -> checked.Output | None:
    item = what.item
    assert item.value is not None
    value = written_value(item.value, kind, scope)
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
            help=seconds_missing(kind.type, value),
        )
        return None
    unit = author_unit(item.value, value) or kind.unit
    of_rate = as_rate(value, kind.rate, scope)
    bounds = _bounds(replace(kind, type=whole), scope)
    if of_rate is None or bounds is None:
        return None
    name = item.name.text
    hold(of_rate, name, bounds, kind, scope)
    return checked.Output(name, whole, of_rate, item.span, item.doc, unit, kind.name, bounds)


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
    bounds = _bounds(kind, scope)
    if not good or not right or bounds is None:
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
        bounds=bounds,
    )
    hold(checked.Reference(found, found.type, item.name.span), name, bounds, kind, scope)
    modifier = what.modifier
    node = item.value
    if modifier is not None and modifier.has_value:
        node = modifier.value
    elif node is None:
        return found
    span = node.span if node is not None else modifier.span if modifier is not None else item.span

    def bind() -> None:
        value, _, _ = bound_value(what, kind, scope)
        if value is not None:
            left = checked.Reference(found, found.type, item.name.span)
            scope.build.equations.append(checked.Equation(left, value, span, scope.instance.name))

    scope.build.bindings.append(bind)
    return found
