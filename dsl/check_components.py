"""Parameters, constants, inputs and outputs."""

from __future__ import annotations

from frot.dsl import checked, tree
from frot.dsl.catalogue import TYPES
from frot.dsl.check_expressions import agrees, expect, expression, unit_of
from frot.dsl.check_values import computed
from frot.dsl.describe import describe
from frot.dsl.dimensions import STRING, Type
from frot.dsl.evaluation import constant
from frot.dsl.scope import Scope, did_you_mean

Component = checked.Parameter | checked.Input | checked.Output
_ROLES = ("parameter", "constant", "input", "output")


def role(clause: tree.Component) -> str:
    """`parameter`, `constant`, `input` or `output`; empty for a plain component."""
    return next((w.text for w in clause.prefixes if w.text in _ROLES), "")


def refused(clause: tree.Component, scope: Scope, defined: frozenset[str]) -> bool:
    """Report a clause that cannot be kept: an unknown type, a component, a plain variable."""
    log = scope.log
    names = ", ".join(d.name.text for d in clause.declared)
    written = clause.type.span.text
    if isinstance(clause.type, tree.Index) or any(d.subscripts for d in clause.declared):
        log.report("E0701", f"arrays are not supported yet ({names!r})", clause.span)
        return True
    simple = isinstance(clause.type, tree.Name) and clause.type.text in TYPES
    if not simple:
        head = written.split(".")[0]
        if head in defined or "Flange" in written or not scope.knows(head):
            if scope.knows(head) or head in defined:
                message = f"components are not supported yet ({names!r} of type {written!r})"
                log.report("E0701", message, clause.span)
            return True
        log.report(
            "E0206",
            f"unknown type {written!r}",
            clause.type.span,
            help=did_you_mean(written, (*TYPES, *defined)),
        )
        return True
    for prefix in clause.prefixes:
        if prefix.text in ("flow", "final"):
            log.report("E0701", f"{prefix.text!r} is not supported yet here", prefix.span)
            return True
    if not role(clause):
        log.report(
            "E0701",
            f"plain variables are not supported yet ({names!r})",
            clause.span,
            help=f"for a value that is computed write 'output {written} {names} = ...;'",
        )
        return True
    return False


def component(clause: tree.Component, item: tree.Declared, scope: Scope) -> Component | None:
    """The checked parameter, constant, input or output; None after a message."""
    assert isinstance(clause.type, tree.Name)
    kind = TYPES[clause.type.text]
    modifiers = _modifiers(item, scope)
    if modifiers is None:
        return None
    factor: float | None = None
    if "unit" in modifiers:
        given = modifiers["unit"]
        if not isinstance(given.value, tree.Text):
            scope.log.report("E0302", "a unit is given as a text: 'unit = \"N.m\"'", given.span)
            return None
        unit = unit_of(given.value.value, given.value.span, scope)
        if unit is None:
            return None
        kind, factor = Type("real", unit.dimension), unit.factor
    match role(clause):
        case "input":
            return _input(item, kind, clause.type.text, modifiers.get("start"), scope)
        case "output":
            return _output(item, kind, clause.type.text, scope)
        case word:
            return _parameter(item, kind, clause.type.text, factor, word == "constant", scope)


def _modifiers(item: tree.Declared, scope: Scope) -> dict[str, tree.Argument] | None:
    found: dict[str, tree.Argument] = {}
    for argument in item.modifiers:
        name = argument.name.text if isinstance(argument.name, tree.Name) else ""
        if name not in ("start", "unit"):
            message = f"the modifier {argument.span.text!r} is not supported yet"
            scope.log.report("E0701", message, argument.span)
            return None
        found[name] = argument
    return found


def _written_unit(node: tree.Expression | None) -> str:
    while isinstance(node, tree.Prefix):
        node = node.operand
    return node.unit if isinstance(node, tree.Number | tree.Tuple) else ""


def _typed(
    node: tree.Expression, kind: Type, factor: float | None, scope: Scope
) -> checked.Expression | None:
    """The value of a declaration; a bare number under `unit = "..."` is taken in that unit."""
    if kind.base == "integer":
        return _integer(node, scope)
    number = node.operand if isinstance(node, tree.Prefix) else node
    if factor is None or not isinstance(number, tree.Number) or number.unit:
        return expect(node, kind, scope)
    value = number.value * factor * (-1 if isinstance(node, tree.Prefix) and node.op == "-" else 1)
    return checked.Literal(value, kind, node.span)


def _integer(node: tree.Expression, scope: Scope) -> checked.Expression | None:
    found = expect(node, TYPES["Real"], scope, others=(TYPES["Integer"],))
    if found is None:
        return None
    value = computed(found, scope)
    if isinstance(value, float) and not value.is_integer():
        scope.log.report("E0301", f"expected a whole number, found {value:g}", node.span)
        return None
    return found


def _parameter(
    item: tree.Declared,
    kind: Type,
    quantity: str,
    factor: float | None,
    is_constant: bool,
    scope: Scope,
) -> checked.Parameter | None:
    word = "constant" if is_constant else "parameter"
    if item.value is None:
        scope.log.report(
            "E0504",
            f"{word} {item.name.text!r} has no value",
            item.name.span,
            help=f"write '{item.name.text} = ...'",
        )
        return None
    value = _typed(item.value, kind, factor, scope)
    if value is None:
        return None
    moving = constant(value)
    if moving is not None:
        scope.log.report(
            "E0305",
            f"{word} {item.name.text!r} must depend on parameters only",
            moving.span,
            caret="this varies",
        )
        return None
    unit = _written_unit(item.value)
    found = checked.Parameter(
        item.name.text, kind, value, item.span, item.doc, unit, is_constant, quantity
    )
    result = computed(value, scope)
    if result is not None:
        scope.values[found] = result
    return found


def _input(
    item: tree.Declared,
    kind: Type,
    quantity: str,
    start: tree.Argument | None,
    scope: Scope,
) -> checked.Input | None:
    if item.value is not None:
        scope.log.report(
            "E0505",
            f"input {item.name.text!r} is given from outside: it has no equation",
            item.value.span,
            help=f"its first value is written '{item.name.text}(start = ...)'",
        )
        return None
    if start is None:
        zeros: dict[str, bool | str] = {"boolean": False, "string": ""}
        zero = zeros.get(kind.base, 0.0)
        first = checked.Literal(zero, kind, item.span)
        return checked.Input(item.name.text, kind, first, item.span, item.doc, "", quantity)
    value = expect(start.value, kind, scope)
    if value is None:
        return None
    moving = constant(value)
    if moving is not None:
        scope.log.report("E0305", "a start value must depend on parameters only", moving.span)
        return None
    unit = _written_unit(start.value)
    return checked.Input(item.name.text, kind, value, item.span, item.doc, unit, quantity)


def _output(item: tree.Declared, kind: Type, quantity: str, scope: Scope) -> checked.Output | None:
    if item.value is None:
        scope.log.report(
            "E0504",
            f"output {item.name.text!r} has no value",
            item.name.span,
            help=f"write '{item.name.text} = ...'",
        )
        return None
    value = expression(item.value, scope)
    if value is None:
        return None
    whole = Type(kind.base, kind.dimension, value.type.shape)
    if kind == STRING or not agrees(value.type, whole):
        scope.log.report(
            "E0301",
            f"expected {describe(kind)}, found {describe(value.type)}",
            item.value.span,
            caret=describe(value.type),
        )
        return None
    unit = _written_unit(item.value)
    return checked.Output(item.name.text, whole, value, item.span, item.doc, unit, quantity)
