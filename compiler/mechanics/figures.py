"""Places of liaisons as figures: points, planes, round and elliptic things, as plain data.

A figure is given in the axes of a point of its body, which is its centre, or a point of it where it
has none. How figures touch stands in `touches.py`.
"""

from __future__ import annotations

from dataclasses import dataclass

from frot.compiler.lowering.walk import subexpressions
from frot.compiler.mechanics.motions import Axis
from frot.dsl.checked import (
    BodyGeometry,
    BodyPoint,
    Curve,
    CurvePlace,
    Expression,
    Frame,
    Place,
    Reference,
    Surface,
    SurfacePlace,
    Variable,
)
from frot.dsl.messages.source import Span

Point = BodyPoint | Frame


@dataclass(frozen=True, slots=True, eq=False)
class Dot:
    """A point."""


@dataclass(frozen=True, slots=True, eq=False)
class Flat:
    """A plane with its normal; in the plane a line with its direction, whose left is the normal."""

    axis: Axis
    in_plane: bool


@dataclass(frozen=True, slots=True, eq=False)
class Ball:
    """A sphere, and everything round in the plane."""

    radius: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Straight:
    """A line in space, or with a radius a round cylinder about it."""

    axis: Axis
    radius: Expression | None


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """A circle in space about an axis."""

    axis: Axis
    radius: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Oval:
    """An ellipse with semi-axes along two of the axes of its point, or beside its normal."""

    axis: Axis
    a: Expression
    b: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Egg:
    """An ellipsoid with semi-axes along the axes of its point."""

    semi_axes: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Implicit:
    """A surface F(x, y, z) = 0; `unknowns` are x, y, z in it, None where one does not occur."""

    value: Expression
    unknowns: tuple[Expression | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A curve of points that depend on the parameter `u`, None where it does not occur."""

    point: Expression
    u: Expression | None


Figure = Dot | Flat | Ball | Straight | Ring | Oval | Egg | Implicit | Path


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A figure at a point of a body."""

    point: Point
    figure: Figure


def figure_of(place: Place | SurfacePlace, planar: bool) -> Placed | None:
    """The figure of a place; None for one that has no figure yet."""
    match place:
        case CurvePlace(curve=curve):
            return _curve(curve, place.span, planar)
        case SurfacePlace(surface=surface):
            return _surface(surface, place.span)
        case BodyGeometry():
            return _geometry(place, planar)
    return Placed(place, Dot())


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
        line = Flat(axis, True) if planar else Straight(axis, None)
        return Placed(_at(curve, "through", span), line)
    centre = _at(curve, "centre", span)
    if curve.kind == "circle":
        if planar:
            return Placed(centre, Ball(given["radius"]))
        return Placed(centre, Ring(Axis(given["normal"]), given["radius"]))
    if curve.kind == "ellipse":
        normal = Axis("z") if planar else Axis(given["normal"])
        return Placed(centre, Oval(normal, given["a"], given["b"]))
    if curve.kind == "parametric":
        (u,) = _unknowns(given["point"], "u")
        return Placed(centre, Path(given["point"], u))
    return None


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
            return Placed(_at(surface, "through", span), Flat(Axis(given["normal"]), False))
        case "sphere":
            return Placed(_at(surface, "centre", span), Ball(given["radius"]))
        case "cylinder":
            tube = Straight(Axis(given["axis"]), given["radius"])
            return Placed(_at(surface, "through", span), tube)
        case "implicit":
            return Placed(
                _at(surface, "through", span),
                Implicit(given["value"], _unknowns(given["value"], "xyz")),
            )
    return None


def _geometry(place: BodyGeometry, planar: bool) -> Placed | None:
    body, given = place.body, place.body.arguments
    assert body.shape is not None
    at = BodyPoint(body, "G", place.span)
    match (body.shape.name, place.name):
        case ("disc" | "ring", "rim"):
            round_ = Ball(given["radius"]) if planar else Ring(Axis("z"), given["radius"])
            return Placed(at, round_)
        case ("ellipse", "rim"):
            return Placed(at, Oval(Axis("z"), given["a"], given["b"]))
        case ("sphere" | "shell", "surface"):
            return Placed(at, Ball(given["radius"]))
        case ("ellipsoid", "surface"):
            return Placed(at, Egg(given["semi_axes"]))
        case ("cylinder", "side"):
            return Placed(at, Straight(Axis("z"), given["radius"]))
        case ("rod", "axis"):
            return Placed(at, Straight(Axis("x"), None))
        case ("box", name) if not planar and name in _FACES:
            return Placed(BodyPoint(body, name, place.span), Flat(Axis(_FACES[name]), False))
    return None


_FACES = {"left": "-x", "right": "x", "bottom": "-z", "top": "z", "front": "-y", "back": "y"}


# Pairs that touch in closed form (touches.py), in this order.
CLOSED_FORMS = frozenset(
    {
        (Flat, Dot),
        (Flat, Ball),
        (Flat, Ring),
        (Flat, Oval),
        (Flat, Egg),
        (Ball, Dot),
        (Ball, Ball),
        (Straight, Dot),
        (Straight, Ball),
        (Straight, Straight),
        (Ring, Ball),
        (Implicit, Dot),
        (Oval, Dot),
    }
)


def can_touch(a: Figure, b: Figure) -> bool:
    """Whether there is a closed form, in this order, and one relation says that they touch."""
    return (type(a), type(b)) in CLOSED_FORMS and not (_is_thin(a) and _is_thin(b))


def _is_thin(figure: Figure) -> bool:
    """A point or a line: two of them meet by more than one relation."""
    thin = isinstance(figure, Dot | Ring | Oval)
    return thin or (isinstance(figure, Straight) and figure.radius is None)
