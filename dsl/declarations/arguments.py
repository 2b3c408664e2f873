"""Arguments of shapes, liaisons, laws and forces, bound to the names of the catalogue."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from frot.dsl import checked
from frot.dsl.catalogue import Argument, vector
from frot.dsl.checked.describe import describe, listed
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.expression import agrees, expect, expression
from frot.dsl.expressions.known import check_bounds
from frot.dsl.expressions.names import place, resolve
from frot.dsl.messages.source import Span
from frot.dsl.names.entities import Array
from frot.dsl.names.near import did_you_mean, near
from frot.dsl.names.scope import Scope
from frot.dsl.names.things import kind_of
from frot.dsl.quantities.dimensions import BOOLEAN, STRING, Type
from frot.dsl.text import tree

Bound = checked.Expression | checked.Place | checked.SurfacePlace | checked.Liaison


@dataclass(slots=True)
class Arguments:
    """The bound arguments; `complete` is False if one is missing or wrong (it was told)."""

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
    position = 0
    for before, item in pairwise(given):
        if _is_decimal_comma(before, item):
            number = f"{before.value.span.text}.{item.span.text}"
            whole = Span(item.span.source, before.value.span.start, item.span.end)
            help_text = f"the decimal sign is a point: '{number}'"
            scope.log.report("E0101", "a comma in a number", whole, help=help_text)
            return Arguments({}, False)
    for item in given:
        argument = _which(item, position, usable, by_name, what, bool(written), scope)
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
        value = _value(argument, item.value, what, scope, constants)
        if value is None:
            result.complete = False
        else:
            result.values[argument.name] = value
    _fill(usable, written, what, span, scope, result)
    return result


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
    after: bool,
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


# ------------------------------------------------------------------ one argument


def _value(
    argument: Argument, node: tree.Expression, what: str, scope: Scope, constants: bool
) -> Bound | None:
    match argument.kind:
        case "place":
            return _place(argument, node, what, scope)
        case "point":
            return _point(argument, node, what, scope)
        case "holder":
            return _holder(node, scope)
        case "word":
            return _word(argument, node, scope)
        case "axis":
            return _axis(argument, node, scope)
        case "vertices":
            found = _vertices(argument, node, scope)
        case "vector":
            found = expect(node, vector(argument.type, scope.planar), scope)
        case _:
            kind = BOOLEAN if argument.kind == "boolean" else argument.type
            found = expect(node, kind, scope, others=argument.others)
    if found is None:
        return None
    moving = constant(found)
    if moving is not None and (constants or argument.kind == "boolean"):
        scope.log.report(
            "E0305",
            f"{argument.name!r} of {what!r} must depend on parameters only",
            moving.span,
            caret="this varies",
        )
        return None
    check_bounds(argument, found, scope)
    return found


def _nature(found: checked.Place | checked.SurfacePlace) -> str:
    """`point`, `curve` or `surface`, or a plural of them."""
    match found:
        case checked.CurvePlace():
            return "curve"
        case checked.SurfacePlace():
            return "surface"
        case checked.BodyGeometry(body=body, name=name):
            assert body.shape is not None
            return body.shape.geometry[name]
    return "point"


def _place(
    argument: Argument, node: tree.Expression, what: str, scope: Scope
) -> checked.Place | checked.SurfacePlace | None:
    found = place(node, scope)
    if found is None:
        return None
    nature = _nature(found)
    allowed = argument.places
    if nature not in allowed and nature.removesuffix("s") not in allowed:
        scope.log.report(
            "E0205",
            f"{argument.name!r} of {what!r} is {_or(allowed)}, found {kind_of(found)}",
            node.span,
            caret=f"a {nature}",
        )
        return None
    return found


def _or(words: Sequence[str]) -> str:
    return " or ".join(f"a {w}" for w in words)


def _point(argument: Argument, node: tree.Expression, what: str, scope: Scope) -> Bound | None:
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        thing = resolve(node, scope, "place")
        if thing is None:
            return None
        if isinstance(thing, checked.Expression):
            kind = vector(argument.type, scope.planar)
            if agrees(thing.type, kind):
                return thing
            scope.log.report("E0301", f"expected a point, found {describe(thing.type)}", node.span)
            return None
        return _place(argument, node, what, scope)
    return expect(node, vector(argument.type, scope.planar), scope)


def _holder(node: tree.Expression, scope: Scope) -> Bound | None:
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        thing = resolve(node, scope, "place")
        if thing is None:
            return None
        one: object = thing
        if isinstance(thing, Array) and scope.element is not None:
            index, size = scope.element
            one = thing.items[index] if len(thing.items) == size else thing
        if isinstance(one, checked.Liaison):
            return one
        if isinstance(one, checked.Body):
            return checked.BodyPoint(one, "G", node.span)
    scope.log.report("E0205", "expected the name of a liaison or of a body", node.span)
    return None


def _word(argument: Argument, node: tree.Expression, scope: Scope) -> checked.Expression | None:
    found = word(node, argument.words, argument.name, scope)
    return None if found is None else checked.Literal(found, STRING, node.span)


def word(node: tree.Expression, words: Sequence[str], name: str, scope: Scope) -> str | None:
    """The option word written at a place; another one is told."""
    if isinstance(node, tree.Name) and node.text in words:
        return node.text
    close = near(node.span.text, words)
    scope.log.report(
        "E0404",
        f"{name!r} is {listed(list(words))}, found {node.span.text!r}",
        node.span,
        help=f"did you mean {close!r}?" if close else "",
    )
    return None


def _axis(argument: Argument, node: tree.Expression, scope: Scope) -> checked.Expression | None:
    if isinstance(node, tree.Name) and node.text in ("x", "y", "z")[: scope.size]:
        return checked.Literal(node.text, STRING, node.span)
    return expect(node, vector(argument.type, scope.planar), scope)


def _vertices(argument: Argument, node: tree.Expression, scope: Scope) -> checked.Expression | None:
    found = expression(node, scope)
    if found is None:
        return None
    shape = found.type.shape
    if len(shape) != 2 or shape[0] < 3 or shape[1] != 2:
        message = "vertices are at least three points: '((0, 0), (1, 0), (0, 1)) m'"
        scope.log.report("E0301", message, node.span)
        return None
    if found.type.dimension != argument.type.dimension:
        wanted = describe(Type(dimension=argument.type.dimension))
        message = f"expected {wanted}, found {describe(found.type)}"
        scope.log.report("E0301", message, node.span)
        return None
    return found
