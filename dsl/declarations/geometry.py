"""Bodies, frames, curves and surfaces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast

from frot.dsl import checked
from frot.dsl.catalogue import SHAPES, Argument, find, spellings, vector
from frot.dsl.catalogue.figures import CURVES, SURFACES, FigureKind
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.checked.arrays import vector as checked_vector
from frot.dsl.checked.describe import describe
from frot.dsl.checked.evaluation import constant
from frot.dsl.declarations.arguments import bind
from frot.dsl.declarations.bounds import keep_positive
from frot.dsl.declarations.user_kinds import stated_shape
from frot.dsl.expressions.expression import agrees, expect, expression, fitting
from frot.dsl.expressions.known import known, out_of_bounds
from frot.dsl.expressions.names import resolve
from frot.dsl.expressions.structure import settle
from frot.dsl.names.declared_types import find_class
from frot.dsl.names.near import did_you_mean, unknown_kind
from frot.dsl.names.scope import Array, Scope
from frot.dsl.names.things import kind_of
from frot.dsl.quantities.dimensions import BOOLEAN, REAL, Type
from frot.dsl.text import tree


def _spelled(kinds: Mapping[str, FigureKind]) -> dict[str, tuple[Argument, ...]]:
    """The arguments of each spelling of the kinds that no function gives."""
    plain = [kind for kind in kinds.values() if not kind.form]
    return {name: kind.arguments for kind in plain for name in (kind.name, *kind.aliases)}


_CURVES = _spelled(CURVES)
_SURFACES = _spelled(SURFACES)
_FRENCH = {
    alias: kind.name for kind in (*CURVES.values(), *SURFACES.values()) for alias in kind.aliases
}
_ROTATION = (
    Argument("axis", REAL, "axis", required=False, default="z", space_only=True),
    Argument("angle", REAL, doc="angle"),
)


def called(
    node: tree.Expression, what: str, scope: Scope
) -> tuple[str, tree.Expression, tuple[tree.Argument, ...]] | None:
    """Name, place and arguments of `ring(...)`; a bare name has no arguments."""
    callee = node.callee if isinstance(node, tree.Call) else node
    arguments = node.arguments if isinstance(node, tree.Call) else ()
    if isinstance(callee, tree.Name):
        return callee.text, callee, arguments
    if isinstance(callee, tree.Member) and find_class(callee, scope) is not None:
        return callee.span.text, callee, arguments
    scope.log.report("E0202", f"expected the name of a {what}", callee.span)
    return None


def body(node: tree.Body, name: str, scope: Scope) -> checked.Body | None:
    """The checked body `name`; None after a message."""
    call = called(node.shape, "shape", scope)
    if call is None:
        return None
    kind, callee, arguments = call
    shape = find(SHAPES, kind)
    if shape is None:
        defined = find_class(callee, scope)
        if defined is not None and defined.kind == "shape":
            given = stated_shape(defined, arguments, node.shape.span, scope)
            if given is None:
                return None
            return checked.Body(name, SHAPES["solid"], given, node.span, node.doc)
        if scope.knows(kind):
            usable = [k for k, s in SHAPES.items() if (s.planar if scope.planar else s.space)]
            unknown_kind("shape", kind, spellings(SHAPES), callee.span, scope.log, usable=usable)
        return None
    if not (shape.planar if scope.planar else shape.space):
        here, there = ("planar", "space") if scope.planar else ("space", "planar")
        scope.log.report(
            "E0506", f"{kind!r} is a shape of {there} models; this model is {here}", callee.span
        )
        return None
    found = bind(arguments, shape.arguments, kind, node.shape.span, scope, constants=True)
    if not found.complete:
        return None
    values = cast("dict[str, checked.Expression]", found.values)
    return checked.Body(name, shape, values, node.span, node.doc)


def _owner(node: tree.Expression, scope: Scope) -> checked.Body | checked.Frame | None:
    if isinstance(node, tree.Name | tree.Member | tree.Index):
        thing = resolve(node, scope, "place")
        if thing is None or isinstance(thing, checked.Body | checked.Frame):
            return thing
        message = f"expected a body or a frame, found {kind_of(thing)}"
        if isinstance(thing, Array):
            message += f"; name one of it, as '{node.span.text}[1]'"
    else:
        message = "expected a body or a frame"
    scope.log.report("E0205", message, node.span)
    return None


def frame(node: tree.Frame, name: str, scope: Scope) -> checked.Frame | None:
    """The checked frame `name`; None after a message."""
    owner = _owner(node.owner, scope)
    origin = angle = None
    axis: checked.Expression | str = "z"
    failed = owner is None
    if node.origin is not None:
        origin = expect(node.origin, vector(LENGTH, scope.planar), scope)
        failed = failed or origin is None
    if node.rotation is not None:
        found = bind(node.rotation, _ROTATION, "rotated", node.span, scope)
        failed = failed or not found.complete
        angle = cast("checked.Expression | None", found.values.get("angle"))
        axis = cast("checked.Expression", found.values.get("axis", axis))
    if failed or owner is None:
        return None
    return checked.Frame(name, owner, origin, angle, axis, node.span, node.doc)


def curve(node: tree.Curve, name: str, scope: Scope) -> checked.Curve | None:
    """The checked curve `name`; None after a message."""
    owner = _owner(node.owner, scope)
    call = called(node.kind, "curve", scope)
    if owner is None or call is None:
        return None
    kind, callee, arguments = call
    values: dict[str, checked.Expression] | None
    if kind == "parametric":
        values = _parametric(node.kind, arguments, ("u",), scope)
    elif kind not in _CURVES:
        known_names = (*_CURVES, "parametric")
        usable = [name for name in known_names if name not in _FRENCH]
        unknown_kind("curve", kind, known_names, callee.span, scope.log, usable=usable)
        return None
    else:
        found = bind(arguments, _CURVES[kind], kind, node.kind.span, scope)
        values = cast("dict[str, checked.Expression]", found.values) if found.complete else None
        keep_positive(values or {}, _CURVES[kind], f"curve '{name}'", scope)
    if values is None:
        return None
    kind = _FRENCH.get(kind, kind)
    if kind != "line":
        return checked.Curve(name, owner, kind, values, node.span, node.doc)
    direction = values["direction"]
    value = known(direction, scope)
    if isinstance(value, tuple) and all(v == 0 for v in value):
        out_of_bounds("the direction of the line is zero", direction.span, scope)
    return checked.Curve(name, owner, "line", values, node.span, node.doc)


def surface(node: tree.Surface, name: str, scope: Scope) -> checked.Surface | None:
    """The checked surface `name`; None after a message."""
    owner = _owner(node.owner, scope)
    call = called(node.kind, "surface", scope)
    if owner is None or call is None:
        return None
    kind, callee, arguments = call
    if scope.planar:
        message = f"{kind!r} is a surface of space models; this model is planar"
        scope.log.report("E0506", message, callee.span, help="in the plane take a curve")
        return None
    values: dict[str, checked.Expression] | None
    if kind == "parametric":
        values = _parametric(node.kind, arguments, ("u", "v"), scope)
    elif kind == "implicit":
        values = _implicit(node.kind, arguments, scope)
    elif kind not in _SURFACES:
        known_names = (*_SURFACES, "parametric", "implicit")
        usable = [name for name in known_names if name not in _FRENCH]
        unknown_kind("surface", kind, known_names, callee.span, scope.log, usable=usable)
        return None
    else:
        found = bind(arguments, _SURFACES[kind], kind, node.kind.span, scope)
        values = cast("dict[str, checked.Expression]", found.values) if found.complete else None
        keep_positive(values or {}, _SURFACES[kind], f"surface '{name}'", scope)
    kind = _FRENCH.get(kind, kind)
    return None if values is None else checked.Surface(name, owner, kind, values, node.span)


def _parametric(
    node: tree.Expression,
    arguments: tuple[tree.Argument, ...],
    names: tuple[str, ...],
    scope: Scope,
) -> dict[str, checked.Expression] | None:
    """`parametric((x(u), y(u)), u = (from, to), periodic = true)`; None after a message.

    Of a surface `periodic = (true, false)` is said of each parameter, `true` of both.
    """
    plain = [a for a in arguments if a.name is None]
    named = {a.name.span.text: a.value for a in arguments if a.name is not None}
    wrong = [n for n in named if n not in (*names, "periodic")]
    if len(plain) != 1 or wrong or any(n not in named for n in names):
        ranges = ", ".join(f"{n} = (from, to)" for n in names)
        variables = ", ".join(names)
        message = f"'parametric' needs a point that depends on {variables}, and {ranges}"
        help_text = did_you_mean(wrong[0], (*names, "periodic")) if wrong else ""
        scope.log.report("E0204", message, node.span, help=help_text)
        return None
    values: dict[str, checked.Expression] = {}
    local: dict[str, checked.Variable] = {}
    for name in names:
        bounds = expression(named[name], scope)
        if bounds is None:
            return None
        if bounds.type.base != "real" or bounds.type.shape != (2,):
            message = f"{name!r} has two bounds, (from, to), found {describe(bounds.type)}"
            scope.log.report("E0301", message, named[name].span)
            return None
        values[name] = bounds
        local[name] = checked.Variable(name, bounds.type.item, named[name].span)
    periodic = _periodic(named.get("periodic"), node, names, scope)
    point = expect(plain[0].value, vector(LENGTH, scope.planar), scope.inside(**local))
    if point is None or periodic is None:
        return None
    first = values[names[0]]
    start = checked.Element(first, 0, first.type.item, first.span)
    return {"point": point, "from": start, "periodic": periodic, **values}


def _periodic(
    given: tree.Expression | None, node: tree.Expression, names: tuple[str, ...], scope: Scope
) -> checked.Expression | None:
    """Whether the function continues beyond its bounds, as parameters say; None after a message."""
    if given is None:
        given_here: object | None = False
    else:
        found = expression(given, scope)
        shape = () if found is None or len(names) == 1 or not found.type.shape else (len(names),)
        wanted = BOOLEAN.of_shape(shape)
        found = None if found is None else fitting(found, given, wanted, scope)
        given_here = None if found is None else settle(found, scope, "what is periodic")
    if given_here is None:
        return None
    values = given_here if isinstance(given_here, tuple) else (given_here,) * len(names)
    each: list[checked.Expression] = [
        checked.Literal(value is True, BOOLEAN, node.span) for value in values
    ]
    return each[0] if len(each) == 1 else checked_vector(each, node.span)


def _implicit(
    node: tree.Expression, arguments: tuple[tree.Argument, ...], scope: Scope
) -> dict[str, checked.Expression] | None:
    """`implicit(F(x, y, z))`, zero on the surface; None after a message."""
    if len(arguments) != 1 or arguments[0].name is not None:
        scope.log.report("E0204", "'implicit' needs one expression of x, y, z", node.span)
        return None
    local = {n: checked.Variable(n, LENGTH, node.span) for n in "xyz"}
    written = arguments[0].value
    found = expression(written, scope.inside(**local))
    if found is None:
        return None
    kind = Type("real", found.type.dimension)
    if constant(found) is None or not agrees(found.type, kind):
        return None if fitting(found, written, kind, scope) is None else {"value": found}
    return {"value": found}
