"""The figure of a place that a text names: of a point, a curve, a surface, a part of a body."""

from __future__ import annotations

from frot.compiler.mechanics.geometry.figure import Placed, Point
from frot.compiler.mechanics.geometry.planes import LineOrCylinder, PlaneSurface, PointFigure
from frot.compiler.mechanics.geometry.quadrics import (
    EllipseCurve,
    EllipsoidSurface,
    Ring,
    SphereSurface,
)
from frot.compiler.mechanics.geometry.user_figures import Implicit, Path, Sheet
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.values import Axis
from frot.compiler.translate.walk import has_time, subexpressions
from frot.dsl.checked import (
    BodyGeometry,
    Curve,
    CurvePlace,
    Expression,
    Frame,
    Literal,
    Place,
    Reference,
    Surface,
    SurfacePlace,
    Variable,
)
from frot.dsl.checked.arrays import items_of
from frot.dsl.messages.source import Span


def figure_of(place: Place | SurfacePlace, planar: bool) -> Placed | None:
    """The figure of a place; None for one that has no figure yet."""
    match place:
        case CurvePlace(curve=curve):
            return _curve(curve, place.span, planar)
        case SurfacePlace(surface=surface):
            return _surface(surface, place.span)
        case BodyGeometry():
            return shape_of(place.body).part(place, planar)
    return Placed(place, PointFigure())


def _at(of: Curve | Surface, name: str, span: Span) -> Point:
    """The point of a curve or surface that its argument `name` gives."""
    origin = of.arguments.get(name)
    if origin is not None and not origin.type.shape:
        origin = None  # the plain zero of a default
    return Frame(of.name, of.owner, origin, None, "z", span)


def _curve(curve: Curve, span: Span, planar: bool) -> Placed | None:
    given = curve.arguments
    if curve.kind == "line":
        axis = Axis(given["direction"])
        # one that turns as time tells has material elements, which move along it
        flat = planar and not has_time(given["direction"])
        line = PlaneSurface(axis, True) if flat else LineOrCylinder(axis, None)
        return Placed(_at(curve, "through", span), line)
    centre = _at(curve, "centre", span)
    if curve.kind == "circle":
        if planar:
            return Placed(centre, SphereSurface(given["radius"]))
        return Placed(centre, Ring(Axis(given["normal"]), given["radius"]))
    if curve.kind == "ellipse":
        normal = Axis("z") if planar else Axis(given["normal"])
        return Placed(centre, EllipseCurve(normal, given["a"], given["b"]))
    if curve.kind == "parametric":
        (u,) = _unknowns(given["point"], "u")
        return Placed(centre, Path(given["point"], u, given["u"], _is_true(given["periodic"])))
    return None


def _is_true(given: Expression) -> bool:
    return isinstance(given, Literal) and given.value is True


def _unknowns(value: Expression, names: str) -> tuple[Expression | None, ...]:
    """The variables by which a curve or surface is given, as they stand in its expression."""
    found = {
        node.target.name: node
        for node in subexpressions(value)
        if isinstance(node, Reference) and isinstance(node.target, Variable)
    }
    return tuple(found.get(name) for name in names)


def _surface(surface: Surface, span: Span) -> Placed | None:
    given = surface.arguments
    match surface.kind:
        case "plane":
            return Placed(_at(surface, "through", span), PlaneSurface(Axis(given["normal"]), False))
        case "sphere":
            return Placed(_at(surface, "centre", span), SphereSurface(given["radius"], hollow=True))
        case "ellipsoid":
            return Placed(_at(surface, "centre", span), EllipsoidSurface(given["semi_axes"]))
        case "cylinder":
            tube = LineOrCylinder(Axis(given["axis"]), given["radius"])
            return Placed(_at(surface, "through", span), tube)
        case "implicit":
            return Placed(
                _at(surface, "through", span),
                Implicit(given["value"], _unknowns(given["value"], "xyz")),
            )
        case "parametric":
            u, v = (_is_true(x) for x in items_of(given["periodic"]))
            unknowns, bounds = _unknowns(given["point"], "uv"), (given["u"], given["v"])
            sheet = Sheet(given["point"], unknowns, bounds, (u, v))
            return Placed(_at(surface, "centre", span), sheet)
    return None
