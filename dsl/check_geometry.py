"""Bodies, frames and curves."""

from __future__ import annotations

from typing import cast

from frot.dsl import checked, tree
from frot.dsl.catalogue import SHAPES, Argument, find, spellings, vector
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.check_arguments import bind
from frot.dsl.check_expressions import expect
from frot.dsl.check_names import kind_of, resolve
from frot.dsl.check_values import known, out_of_bounds
from frot.dsl.dimensions import REAL
from frot.dsl.scope import Scope, did_you_mean

_LINE = (
    Argument("through", LENGTH, "vector", doc="a point of it"),
    Argument("direction", REAL, "vector", doc="its direction"),
)
_OTHER_CURVES = ("circle", "ellipse", "parametric")
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
    scope.log.report("E0202", f"expected the name of a {what}", callee.span)
    return None


def body(node: tree.Body, scope: Scope, defined: frozenset[str]) -> checked.Body | None:
    """The checked body; None after a message."""
    if node.subscripts:
        scope.log.report("E0701", "arrays of bodies are not supported yet", node.span)
        return None
    call = called(node.shape, "shape", scope)
    if call is None:
        return None
    name, callee, arguments = call
    shape = find(SHAPES, name)
    if shape is None:
        if name in defined:
            scope.log.report("E0701", "user-defined shapes are not supported yet", callee.span)
        elif scope.knows(name):
            help_text = did_you_mean(name, spellings(SHAPES))
            scope.log.report("E0202", f"unknown shape {name!r}", callee.span, help=help_text)
        return None
    if not (shape.planar if scope.planar else shape.space):
        here, there = ("planar", "space") if scope.planar else ("space", "planar")
        scope.log.report(
            "E0506", f"{name!r} is a shape of {there} models; this model is {here}", callee.span
        )
        return None
    found = bind(arguments, shape.arguments, name, node.shape.span, scope, constants=True)
    if not found.complete:
        return None
    values = cast("dict[str, checked.Expression]", found.values)
    return checked.Body(node.name.text, shape, values, node.span, node.doc)


def _owner(node: tree.Expression, scope: Scope) -> checked.Body | checked.Frame | None:
    if isinstance(node, tree.Name | tree.Member):
        thing = resolve(node, scope, "place")
        if thing is None or isinstance(thing, checked.Body | checked.Frame):
            return thing
        message = f"expected a body or a frame, found {kind_of(thing)}"
    else:
        message = "expected a body or a frame"
    scope.log.report("E0205", message, node.span)
    return None


def frame(node: tree.Frame, scope: Scope) -> checked.Frame | None:
    """The checked frame; None after a message."""
    owner = _owner(node.owner, scope)
    origin = angle = None
    failed = owner is None
    if node.origin is not None:
        origin = expect(node.origin, vector(LENGTH, scope.planar), scope)
        failed = failed or origin is None
    if node.rotation is not None:
        found = bind(node.rotation, _ROTATION, "rotated", node.span, scope)
        failed = failed or not found.complete
        angle = cast("checked.Expression | None", found.values.get("angle"))
    if failed or owner is None:
        return None
    return checked.Frame(node.name.text, owner, origin, angle, node.span, node.doc)


def curve(node: tree.Curve, scope: Scope) -> checked.Curve | None:
    """The checked curve; None after a message. Lines only."""
    owner = _owner(node.owner, scope)
    call = called(node.kind, "curve", scope)
    if owner is None or call is None:
        return None
    name, callee, arguments = call
    if name in _OTHER_CURVES:
        scope.log.report("E0701", f"{name!r} curves are not supported yet", callee.span)
        return None
    if name not in ("line", "droite"):
        help_text = did_you_mean(name, ("line", *_OTHER_CURVES))
        scope.log.report("E0202", f"unknown curve {name!r}", callee.span, help=help_text)
        return None
    found = bind(arguments, _LINE, name, node.kind.span, scope)
    if not found.complete:
        return None
    values = cast("dict[str, checked.Expression]", found.values)
    direction = values["direction"]
    value = known(direction, scope)
    if isinstance(value, tuple) and all(v == 0 for v in value):
        out_of_bounds("the direction of the line is zero", direction.span, scope)
    return checked.Curve(node.name.text, owner, "line", values, node.span, node.doc)
