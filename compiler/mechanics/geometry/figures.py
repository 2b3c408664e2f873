"""Places of liaisons as figures: points, planes, round and elliptic things, as plain data.

A figure is given in the axes of a point of its body, which is its centre, or a point of it where it
has none. How figures touch stands in `touches.py`.
"""

from __future__ import annotations

from frot.compiler.lowering.walk import has_time, subexpressions
from frot.compiler.mechanics.liaisons.motions import Axis
from frot.dsl.checked import (
    Binary,
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
from frot.dsl.checked.arrays import element
from frot.dsl.data.classes import dataclass
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
    """A curve of points that depend on the parameter `u`, None where it does not occur.

    `bounds` are the two ends of the parameter.
    """

    point: Expression
    u: Expression | None
    bounds: Expression


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """A surface of points that depend on `u` and `v`, None for one that does not occur."""

    point: Expression
    unknowns: tuple[Expression | None, ...]
    bounds: tuple[Expression, Expression]


Figure = Dot | Flat | Ball | Straight | Ring | Oval | Egg | Implicit | Path | Sheet


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
        # one that turns as time tells has material elements, which move along it
        flat = planar and not has_time(given["direction"])
        line = Flat(axis, True) if flat else Straight(axis, None)
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
        return Placed(centre, Path(given["point"], u, given["u"]))
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
        case "parametric":
            sheet = Sheet(given["point"], _unknowns(given["point"], "uv"), (given["u"], given["v"]))
            return Placed(_at(surface, "centre", span), sheet)
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
        case ("cylinder", "rims[1]" | "rims[2]" as rim):
            end = BodyPoint(body, "bottom" if rim == "rims[1]" else "top", place.span)
            return Placed(end, Ring(Axis("z"), given["radius"]))
        case ("box", name) if name in _FACES:
            face = _SIDES[name] if planar else _FACES[name]
            return Placed(BodyPoint(body, name, place.span), Flat(Axis(face), planar))
        case ("polygon", name) if name.startswith("sides["):
            first, second = corners_of(place)
            vertices, span = given["vertices"], place.span
            ends = [element(vertices, corner_number(x) - 1, span) for x in (second, first)]
            along = Binary("-", ends[0], ends[1], ends[0].type, span)
            return Placed(first, Flat(Axis(along), True))
    return None


def corners_of(face: BodyGeometry) -> tuple[BodyPoint, ...]:
    """The corners of a face of a box, or of a side of a polygon; none of what is neither."""
    shape, given = face.body.shape, face.body.arguments
    assert shape is not None
    numbers: tuple[int, ...] = ()
    if shape.name == "box" and face.name in _FACES:
        planar = given["size"].type.shape[0] == 2
        numbers = (_ENDS if planar else _CORNERS)[face.name]
    elif face.name.startswith("sides["):
        number, count = int(face.name[6:-1]), given["vertices"].type.shape[0]
        numbers = (number, number % count + 1)
    return tuple(BodyPoint(face.body, f"corners[{k}]", face.span) for k in numbers)


def corner_number(corner: BodyPoint) -> int:
    """The number of a corner, from 1."""
    return int(corner.name[8:-1])


# Normals of the faces of a box; in the plane the directions whose left they are.
_FACES = {"left": "-x", "right": "x", "bottom": "-z", "top": "z", "front": "-y", "back": "y"}
_SIDES = {"left": "y", "right": "-y", "bottom": "-x", "top": "x", "front": "-x", "back": "x"}
# Corners of each face, in the order of shapes/blocks.py.
_ENDS = {
    "bottom": (1, 2),
    "right": (2, 3),
    "top": (3, 4),
    "left": (4, 1),
    "front": (1, 2),
    "back": (3, 4),
}
_CORNERS = {
    "bottom": (1, 2, 3, 4),
    "top": (5, 6, 7, 8),
    "left": (1, 4, 5, 8),
    "right": (2, 3, 6, 7),
    "front": (1, 2, 5, 6),
    "back": (3, 4, 7, 8),
}


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

# Figures that are where a function is zero, first those whose function is the distance.
LEVELS = (Flat, Ball, Straight, Egg, Implicit)


def is_level(figure: Figure) -> bool:
    """Whether a figure is where a function of places is zero."""
    return isinstance(figure, LEVELS) and not _is_line(figure)


def count_parameters(figure: Figure) -> int:
    """The number of parameters of a figure's points, -1 for one given otherwise."""
    if isinstance(figure, Dot):
        return 0
    if isinstance(figure, Ring | Oval | Path) or _is_line(figure):
        return 1
    return 2 if isinstance(figure, Sheet) else -1


def can_touch(a: Figure, b: Figure, planar: bool) -> bool:
    """Whether one relation says that they touch, in this order."""
    return is_closed(a, b) or is_tracked(a, b, planar)


def is_closed(a: Figure, b: Figure) -> bool:
    """Whether there is a closed form, in this order; curves that time bends have none."""
    if is_bent_by_time(a) or is_bent_by_time(b):
        return False
    return (type(a), type(b)) in CLOSED_FORMS and not (_is_thin(a) and _is_thin(b))


def is_tracked(a: Figure, b: Figure, planar: bool) -> bool:
    """Whether the places where they are nearest are followed, in this order.

    Between levels the first is the one whose function tells most. A point and a curve in space, and
    what touches along a line, meet by more than one relation.
    """
    if is_closed(b, a):
        return False
    first, second = count_parameters(a), count_parameters(b)
    if is_level(a):
        if is_level(b):
            flat = isinstance(a, Flat) and isinstance(b, Flat | Straight)
            return not flat and LEVELS.index(type(a)) <= LEVELS.index(type(b))
        return second >= 0 and not (isinstance(a, Flat) and _is_line(b))
    if first < 0 or second < 0 or second > first:
        return False
    return first == 2 or (first == 1 and (planar or second == 1))


def _is_line(figure: Figure) -> bool:
    return isinstance(figure, Straight) and figure.radius is None


def is_bent_by_time(figure: Figure) -> bool:
    """Whether the material elements of a curve move along it as time tells."""
    match figure:
        case Straight(radius=None, axis=axis):
            return not isinstance(axis.given, str) and has_time(axis.given)
        case Oval(a=a, b=b):
            return has_time(a) or has_time(b)
    return False


def _is_thin(figure: Figure) -> bool:
    """A point or a line: two of them meet by more than one relation, or cross."""
    return isinstance(figure, Dot | Ring | Oval) or _is_line(figure)
