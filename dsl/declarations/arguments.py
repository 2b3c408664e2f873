"""Arguments of shapes, liaisons, laws and forces, bound to the names of the catalogue."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from frot.dsl import checked
from frot.dsl.catalogue import Argument, vector
from frot.dsl.checked.describe import listed
from frot.dsl.declarations.argument_values import Bound, argument_value
from frot.dsl.messages.source import Span
from frot.dsl.names.near import did_you_mean
from frot.dsl.names.scope import Scope
from frot.dsl.quantities.dimensions import STRING
from frot.dsl.text import tree


@dataclass(slots=True)
class Arguments:
    """The bound arguments; `complete` is False if one is missing or wrong (it was reported)."""

    values: dict[str, Bound]
    complete: bool


def bind(
    given: Sequence[tree.Argument],
    wanted: Sequence[Argument],
    what: str,
    span: Span,
    scope: Scope,
    *,
    constants: bool = False,
) -> Arguments:
    """Bind the arguments of `what` (`ring`, `coulomb`, ...) and fill the defaults.

    `constants` asks that expressions depend on parameters only.
    """
    by_name = {a.name: a for a in wanted}
    usable = [a for a in wanted if not (a.space_only and scope.planar)]
    result = Arguments({}, True)
    written: dict[str, tree.Argument] = {}
    found: list[Argument] = []
    position = 0
    for before, item in pairwise(given):
        if _is_decimal_comma(before, item):
            number = f"{before.value.span.text}.{item.span.text}"
            whole = Span(item.span.source, before.value.span.start, item.span.end)
            help_text = f"the decimal sign is a point: '{number}'"
            scope.log.report("E0101", "a comma in a number", whole, help=help_text)
            return Arguments({}, False)
    for item in given:
        if isinstance(item.value, tree.Call) and item.value.callee.span.text == "driven":
            told = f"write '{what}(...) {item.value.span.text}'"
            scope.log.report("E0204", "'driven' stands behind the bracket", item.span, help=told)
            return Arguments({}, False)
        argument = _which(item, position, usable, by_name, what, scope)
        if item.name is None:
            position += 1
        if argument is None:
            result.complete = False
            continue
        if argument.name in written:
            message = f"{argument.name!r} of {what!r} is given twice"
            scope.log.report("E0204", message, item.span)
            result.complete = False
            continue
        written[argument.name] = item
        found.append(argument)
    for argument in sorted(found, key=lambda a: a.kind == "couple"):
        node = written[argument.name].value
        if argument.kind == "couple" and not scope.planar:
            argument = _couple(argument, result.values.get("holder"))
        value = argument_value(argument, node, what, scope, constants)
        if value is None:
            result.complete = False
        else:
            result.values[argument.name] = value
    _fill(usable, written, what, span, scope, result)
    return result


def _couple(argument: Argument, holder: Bound | None) -> Argument:
    """In space: a vector on a body, a scalar about the axis of a liaison."""
    kind = "vector" if isinstance(holder, checked.BodyPoint) else "expression"
    return replace(argument, kind=kind)


def _is_decimal_comma(before: tree.Argument, item: tree.Argument) -> bool:
    """Whether two arguments are one number written with a comma: `mass = 0,5 kg`."""
    first, second = before.value, item.value
    numbers = isinstance(first, tree.Number) and isinstance(second, tree.Number)
    glued = item.span.start == before.span.end + 1 and item.name is None
    return numbers and glued and before.name is not None and first.span.text.isdigit()


def _which(
    item: tree.Argument,
    position: int,
    usable: Sequence[Argument],
    by_name: dict[str, Argument],
    what: str,
    scope: Scope,
) -> Argument | None:
    if item.name is None:
        if position < len(usable):
            return usable[position]
        if position > len(usable):
            return None
        scope.log.report(
            "E0204",
            f"too many arguments for {what!r}",
            item.span,
            notes=(f"its arguments are: {', '.join(a.name for a in usable)}",),
        )
        return None
    name = item.name.text if isinstance(item.name, tree.Name) else item.name.span.text
    found = by_name.get(name)
    if found is not None and found in usable:
        return found
    if found is not None:
        message = f"{name!r} of {what!r} has a meaning in space models only"
        scope.log.report("E0204", message, item.name.span)
        return None
    help_text = did_you_mean(name, [a.name for a in usable])
    notes = () if help_text else (f"its arguments are: {', '.join(a.name for a in usable)}",)
    message = f"{what!r} has no argument {name!r}"
    scope.log.report("E0204", message, item.name.span, notes=notes, help=help_text)
    return None


def _fill(
    usable: Sequence[Argument],
    written: dict[str, tree.Argument],
    what: str,
    span: Span,
    scope: Scope,
    result: Arguments,
) -> None:
    missing = [a for a in usable if a.required and a.name not in written]
    if missing and result.complete:
        names = listed([a.name for a in missing], "and")
        kinds = "; ".join(f"{a.name}: {a.doc}" for a in missing if a.doc)
        scope.log.report("E0204", f"{what!r} needs {names}", span, notes=(kinds,) if kinds else ())
    result.complete = result.complete and not missing
    for argument in usable:
        if argument.name in written or argument.required:
            continue
        if argument.default_of:
            if argument.default_of in result.values:
                result.values[argument.name] = result.values[argument.default_of]
        elif argument.default is not None:
            result.values[argument.name] = _default(argument, span, scope)


def _default(argument: Argument, span: Span, scope: Scope) -> checked.Expression:
    value = argument.default
    assert value is not None
    if isinstance(value, str):
        return checked.Literal(value, STRING, span)
    if argument.kind == "vector":
        item = checked.Literal(value, argument.type, span)
        return checked.Vector((item,) * scope.size, vector(argument.type, scope.planar), span)
    return checked.Literal(value, argument.type, span)
