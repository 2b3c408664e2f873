"""Outlines of curves and surfaces: one row for each kind, in the axes of their owner."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import casadi as ca
import numpy as np

from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.spatial import whole
from frot.dsl.checked import Curve, CurvePlace, Frame, Surface, SurfacePlace
from frot.dsl.messages.source import Source, Span
from frot.view.numbers import Numbers
from frot.view.outline import Array, Outline, along, chain, closed, over_grid, sheet, together

NOWHERE = Span(Source("", ""), 0, 0)
LONG = 121  # points of a curve
ACROSS = 33  # points along each parameter of a surface
LINES = 9  # lines of its own that a surface shows, each way
MOST_LINES = 80  # strokes below a line of the ground, or lines of a plane


class Scope:
    """Where the endless is cut: `centre` (3) and `reach` (m) of all that moves, ground axes."""

    def __init__(self, centre: Array, reach: float, size: float, planar: bool) -> None:
        """The half of a line or a plane that is drawn is `reach` long; `size` of the mechanism."""
        self.centre, self.reach, self.planar = np.asarray(centre, dtype=float), reach, planar
        self.step = max(size / 6, 2 * reach / MOST_LINES)


def curve_outline(curve: Curve, numbers: Numbers, scope: Scope, time: float) -> Outline | None:
    """A curve at a time; None where nothing can be drawn of it."""
    placed = figure_of(CurvePlace(curve, NOWHERE), scope.planar)
    if placed is None:
        return None
    return CURVES[curve.kind](curve, placed, numbers, scope, time)


def surface_outline(surface: Surface, numbers: Numbers, scope: Scope, time: float) -> Outline:
    """A surface at a time."""
    placed = figure_of(SurfacePlace(surface, NOWHERE), scope.planar)
    assert placed is not None
    return SURFACES[surface.kind](surface, placed, numbers, scope, time)


def changes(figure: Curve | Surface, numbers: Numbers) -> bool:
    """Whether time changes what is drawn, beside the motion of its owner."""
    return any(
        numbers.changes(numbers.lower(value))
        for value in figure.arguments.values()
        if not isinstance(getattr(value, "value", None), str)
    )


def _origin(placed: Placed, numbers: Numbers, time: float) -> Array:
    point = placed.point
    if not isinstance(point, Frame) or point.origin is None:
        return np.zeros(3)
    return np.ravel(numbers.evaluate(ca.densify(whole(numbers.lower(point.origin))), time))


def _line(curve: Curve, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    """As long as what moves needs it; below a line of the ground the usual strokes."""
    origin = _origin(placed, n, time)
    way = np.ravel(n.of(curve.arguments["direction"], time))
    way = np.append(way, np.zeros(3 - len(way)))
    way = way / np.linalg.norm(way)
    on_ground = curve.owner.name == "ground"
    middle = origin + way * np.dot(scope.centre - origin, way) if on_ground else origin
    line = chain([middle - scope.reach * way, middle + scope.reach * way])
    if not (scope.planar and on_ground):
        return line
    right = np.array((way[1], -way[0], 0.0))
    ways = np.arange(-scope.reach + scope.step, scope.reach, scope.step)
    starts = middle + np.outer(ways, way)
    strokes = [chain([p, p + 0.5 * scope.step * (right - way)]) for p in starts]
    return together((line, *strokes))


def _round(curve: Curve, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    return _by_parameter(placed, n, (0.0, 2 * np.pi), time)


def _parametric(curve: Curve, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    low, high = sorted(float(x) for x in np.ravel(n.of(curve.arguments["u"], time)))
    return _by_parameter(placed, n, (low, high), time)


def _by_parameter(placed: Placed, n: Numbers, ends: tuple[float, float], time: float) -> Outline:
    u = ca.SX.sym("u")
    points = n.along(placed.figure.point(u, n.lower), u, np.linspace(*ends, LONG), time)
    return chain([]) if points is None else chain(points + _origin(placed, n, time))


_Curve = Callable[[Curve, Placed, Numbers, Scope, float], Outline]
CURVES: Mapping[str, _Curve] = {
    "circle": _round,
    "ellipse": _round,
    "line": _line,
    "parametric": _parametric,
}


def _plane(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    """A square with a grid, as large as what moves needs it."""
    axis = placed.figure.plane
    assert axis is not None
    origin = _origin(placed, n, time)
    axes = along(np.ravel(n.evaluate(ca.densify(axis.unit(n.lower)), time)))
    normal = axes[:, 2]
    middle = origin
    if surface.owner.name == "ground":
        middle = scope.centre - normal * np.dot(scope.centre - origin, normal)
    lines = max(round(scope.reach / scope.step), 4)
    ways = np.linspace(-scope.reach, scope.reach, lines)
    grid = over_grid(lambda u, v: np.array((u, v, 0 * u)), ways, ways)
    return sheet(grid, lines).moved(axes, middle)


def _sphere(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    radius = float(np.ravel(n.of(surface.arguments["radius"], time))[0])
    grid = over_grid(
        lambda u, v: radius * np.array((np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v))),
        np.linspace(0, 2 * np.pi, ACROSS),
        np.linspace(0, np.pi, ACROSS),
    )
    return sheet(grid, LINES).moved(np.eye(3), _origin(placed, n, time))


def _ellipsoid(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    a, b, c = (float(x) for x in np.ravel(n.of(surface.arguments["semi_axes"], time)))
    grid = over_grid(
        lambda u, v: np.array(
            (a * np.cos(u) * np.sin(v), b * np.sin(u) * np.sin(v), c * np.cos(v))
        ),
        np.linspace(0, 2 * np.pi, ACROSS),
        np.linspace(0, np.pi, ACROSS),
    )
    return sheet(grid, LINES).moved(np.eye(3), _origin(placed, n, time))


def _cylinder(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    """As long as what moves needs it."""
    tube = placed.figure.tube
    assert tube is not None
    axes = along(np.ravel(n.evaluate(ca.densify(tube[0].unit(n.lower)), time)))
    radius = float(np.ravel(n.of(tube[1], time))[0])
    grid = over_grid(
        lambda u, v: np.array((radius * np.cos(u), radius * np.sin(u), v)),
        np.linspace(0, 2 * np.pi, ACROSS),
        np.array((-scope.reach, scope.reach)),
    )
    return sheet(grid, LINES).moved(axes, _origin(placed, n, time))


def _sheet(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    ends = [np.ravel(n.of(surface.arguments[k], time)) for k in "uv"]
    ways = [np.linspace(float(min(x)), float(max(x)), ACROSS) for x in ends]
    both = np.stack(np.meshgrid(*ways, indexing="ij")).reshape(2, -1)
    w = ca.SX.sym("w", 2)
    points = n.along(placed.figure.point(w, n.lower), w, both, time)
    if points is None:
        return chain([])
    grid = points.reshape(ACROSS, ACROSS, 3) + _origin(placed, n, time)
    return sheet(grid, LINES)


def _implicit(surface: Surface, placed: Placed, n: Numbers, scope: Scope, time: float) -> Outline:
    """Lines in which planes across x, y and z meet it."""
    import contourpy

    x, origin = ca.SX.sym("x", 3), _origin(placed, n, time)
    value = placed.figure.function(x, n.lower)
    centre = scope.centre - origin if surface.owner.name == "ground" else np.zeros(3)
    ways = np.linspace(-scope.reach, scope.reach, 2 * ACROSS)
    found = []
    for axis in range(3):
        first, second = (k for k in range(3) if k != axis)
        for at in np.linspace(-scope.reach, scope.reach, LINES):
            u, v = np.meshgrid(ways + centre[first], ways + centre[second])
            places = np.empty((3, u.size))
            places[axis], places[first], places[second] = at + centre[axis], u.ravel(), v.ravel()
            values = n.along(value, x, places, time)
            if values is None:
                continue
            cut = contourpy.contour_generator(u, v, values.reshape(u.shape))
            for points in cut.lines(0.0):
                line = np.empty((len(points), 3))
                line[:, axis], line[:, [first, second]] = at + centre[axis], points
                found.append(chain(line + origin))
    return together(found)


_Surface = Callable[[Surface, Placed, Numbers, Scope, float], Outline]
SURFACES: Mapping[str, _Surface] = {
    "cylinder": _cylinder,
    "ellipsoid": _ellipsoid,
    "implicit": _implicit,
    "parametric": _sheet,
    "plane": _plane,
    "sphere": _sphere,
}

__all__ = ["CURVES", "SURFACES", "Scope", "changes", "closed", "curve_outline", "surface_outline"]
