"""One argument: a value, a place, a word, an axis, as its kind asks."""

from __future__ import annotations

from collections.abc import Sequence

from frot.dsl import checked
from frot.dsl.catalogue import Argument, vector
from frot.dsl.checked.describe import describe, listed
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.expression import NUMERIC, agrees, expect, expression
from frot.dsl.expressions.known import check_bounds
from frot.dsl.expressions.names import place, resolve
from frot.dsl.names.near import near
from frot.dsl.names.scope import Array, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.quantities.dimensions import BOOLEAN, STRING, Type
from frot.dsl.text import tree

Bound = checked.Expression | checked.Place | checked.SurfacePlace | checked.Liaison


def argument_value(
    argument: Argument, node: tree.Expression, what: str, scope: Scope, constants: bool
) -> Bound | None:
    """The value written for an argument of `what`; None after a message.

    `constants` asks that it depends on parameters only.
    """
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
        case "inertia" if not scope.planar:
            three = vector(argument.type, False)
            matrix = Type("real", argument.type.dimension, (3, 3))
            found = expect(node, three, scope, others=(matrix,))
        case "vector":
            found = expect(node, vector(argument.type, scope.planar), scope)
        case "number":
            found = expression(node, scope)
            if found is not None and not (found.type.is_scalar and found.type.base in NUMERIC):
                found = expect(node, argument.type, scope)
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


def nature_of(found: checked.Place | checked.SurfacePlace) -> str:
    """`point`, `curve` or `surface`, or a plural of them."""
    match found:
        case checked.CurvePlace():
            return "curve"
        case checked.SurfacePlace():
            return "surface"
        case checked.BodyGeometry(body=body, name=name):
            assert body.shape is not None
            item = name.split("[")
            nature = body.shape.geometry[item[0]]
            return nature.removesuffix("s") if len(item) > 1 else nature
    return "point"


def _place(
    argument: Argument, node: tree.Expression, what: str, scope: Scope
) -> checked.Place | checked.SurfacePlace | None:
    found = place(node, scope)
    if found is None:
        return None
    nature = nature_of(found)
    allowed = argument.places
    if isinstance(found, checked.BodyGeometry) and nature not in allowed and "point" in allowed:
        found = found.centre or found
        nature = nature_of(found)
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
    """The option word written at a place; another one is reported."""
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
