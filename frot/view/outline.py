"""Outlines: triangles and lines in the axes of what they belong to; how the usual ones are made.

Lengths are in m; arrays of points have three columns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = Any
ROUND = 48  # sides of what is round
NO_FACES = np.zeros((0, 3), dtype=np.uint32)
NO_POINTS = np.zeros((0, 3))


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """`faces` are triples of rows of `points`; `lines` are chains of points."""

    points: Array
    faces: Array
    lines: tuple[Array, ...] = ()

    def moved(self, axes: Array, origin: Array) -> Outline:
        """The same in other axes: x' = axes x + origin."""

        def there(points: Array) -> Array:
            return points @ np.asarray(axes).T + np.asarray(origin)

        return Outline(there(self.points), self.faces, tuple(map(there, self.lines)))


def together(outlines: Iterable[Outline]) -> Outline:
    """One outline of several."""
    points, faces, count = [NO_POINTS], [NO_FACES], 0
    lines: list[Array] = []
    for one in outlines:
        points.append(one.points)
        faces.append(one.faces + np.uint32(count))
        lines.extend(one.lines)
        count += len(one.points)
    return Outline(np.vstack(points), np.vstack(faces), tuple(lines))


def chain(points: Array) -> Outline:
    """A line through points."""
    return Outline(NO_POINTS, NO_FACES, (np.asarray(points, dtype=float).reshape(-1, 3),))


def around(radius: float, second: float | None = None, count: int = ROUND) -> Array:
    """Points of a circle or an ellipse in the x-y plane, the first not repeated."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    other = radius if second is None else second
    return np.column_stack((radius * np.cos(angle), other * np.sin(angle), 0 * angle))


def closed(points: Array) -> Array:
    """The points with the first once more at the end."""
    return np.vstack((points, points[:1]))


def plate(rim: Array) -> Outline:
    """The inside of a closed chain that is seen whole from its centroid, with its border."""
    count = len(rim)
    middle = rim.mean(axis=0, keepdims=True)
    k = np.arange(count, dtype=np.uint32)
    fan = np.column_stack((np.full(count, count, dtype=np.uint32), k, (k + 1) % count))
    return Outline(np.vstack((rim, middle)), fan, (closed(rim),))


def lamina(corners: Array) -> Outline:
    """The inside of a polygon in the x-y plane that need not be convex, with its border."""
    from matplotlib.path import Path
    from scipy.spatial import Delaunay

    rim = np.asarray(corners, dtype=float)[:, :2]
    pieces = 24
    parts = np.linspace(0, 1, pieces, endpoint=False)[:, None]
    dense = np.vstack(
        [a + parts * (b - a) for a, b in zip(rim, np.roll(rim, -1, axis=0), strict=True)]
    )
    faces = Delaunay(dense).simplices
    inside = Path(rim).contains_points(dense[faces].mean(axis=1))
    flat = np.column_stack((dense, np.zeros(len(dense))))
    border = closed(np.column_stack((rim, np.zeros(len(rim)))))
    return Outline(flat, faces[inside].astype(np.uint32), (border,))


def band(outer: Array, inner: Array) -> Outline:
    """The band between two closed chains of as many points."""
    k = np.arange(len(outer), dtype=np.uint32)
    after, count = (k + 1) % len(outer), np.uint32(len(outer))
    first = np.column_stack((k, after, k + count))
    second = np.column_stack((after, after + count, k + count))
    return Outline(
        np.vstack((outer, inner)), np.vstack((first, second)), (closed(outer), closed(inner))
    )


def sheet(points: Array, lines: int = 0) -> Outline:
    """A surface of a grid of points (m x n x 3), with so many of its own lines each way."""
    m, n = points.shape[:2]
    first = (np.arange(m - 1)[:, None] * n + np.arange(n - 1)).ravel().astype(np.uint32)
    corners = np.vstack(
        (
            np.column_stack((first, first + 1, first + n)),
            np.column_stack((first + 1, first + n + 1, first + n)),
        )
    )
    shown: list[Array] = []
    if lines:
        shown += [points[k] for k in np.unique(np.linspace(0, m - 1, lines).astype(int))]
        shown += [points[:, k] for k in np.unique(np.linspace(0, n - 1, lines).astype(int))]
    return Outline(points.reshape(-1, 3), corners.astype(np.uint32), tuple(shown))


def over_grid(point: Callable[[Array, Array], Array], first: Array, second: Array) -> Array:
    """The points (m x n x 3) of a surface at all pairs of two parameters."""
    u, v = np.meshgrid(first, second, indexing="ij")
    return np.moveaxis(np.asarray(point(u, v)), 0, -1)


def ellipsoid(semi: tuple[float, float, float], sides: int = ROUND) -> Outline:
    """An ellipsoid with semi-axes along x, y, z; three great circles show how it turns."""
    a, b, c = semi
    grid = over_grid(
        lambda u, v: np.array(
            (a * np.cos(u) * np.sin(v), b * np.sin(u) * np.sin(v), c * np.cos(v))
        ),
        np.linspace(0, 2 * np.pi, 3 * sides // 4 + 1),
        np.linspace(0, np.pi, 3 * sides // 8 + 1),
    )
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    one, two, none = np.cos(turn), np.sin(turn), 0 * turn
    circles = (
        np.column_stack((a * one, b * two, none)),
        np.column_stack((none, b * one, c * two)),
        np.column_stack((a * one, none, c * two)),
    )
    whole = sheet(grid)
    return Outline(whole.points, whole.faces, circles)


def tube(radius: float, long: float, ends: bool = True, sides: int = ROUND) -> Outline:
    """A round cylinder about z, its middle in the origin; two lines on it show how it turns."""
    ring = closed(around(radius, count=sides))
    half = np.array((0, 0, long / 2))
    low, high = ring - half, ring + half
    side = sheet(np.stack((low, high)))
    marks = tuple(np.stack((low[k], high[k])) for k in (0, sides // 2))
    wall = Outline(side.points, side.faces, (low, high, *marks))
    if not ends:
        return wall
    caps = [plate(x[:-1]) for x in (low, high)]
    return together((wall, *(Outline(x.points, x.faces) for x in caps)))


def torus(radius: float, thick: float) -> Outline:
    """A thin ring about z, with a spoke that shows how it turns."""
    grid = over_grid(
        lambda u, v: np.array(
            (
                (radius + thick * np.cos(v)) * np.cos(u),
                (radius + thick * np.cos(v)) * np.sin(u),
                thick * np.sin(v),
            )
        ),
        np.linspace(0, 2 * np.pi, ROUND + 1),
        np.linspace(0, 2 * np.pi, 9),
    )
    return together((sheet(grid), chain([(0, 0, 0), (radius, 0, 0)])))


_CUBE = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_EDGES = [(i, j) for i in range(8) for j in range(i) if np.sum(_CUBE[i] != _CUBE[j]) == 1]


def box(size: Array) -> Outline:
    """A box with edges along x, y, z, its middle in the origin."""
    points = _CUBE * np.asarray(size, dtype=float)
    faces = [(a, b, c) for a, b, c, _ in _SIDES] + [(a, c, d) for a, _, c, d in _SIDES]
    edges = tuple(points[[i, j]] for i, j in _EDGES)
    return Outline(points, np.array(faces, dtype=np.uint32), edges)


def along(direction: Array) -> Array:
    """Axes (3 x 3) the third of which has a direction."""
    n = np.asarray(direction, dtype=float)
    n = n / np.linalg.norm(n)
    start = np.eye(3)[int(np.argmin(np.abs(n)))]
    first = np.cross(start, n)
    first = first / np.linalg.norm(first)
    return np.column_stack((first, np.cross(n, first), n))


def bar(end: Array, thick: float, planar: bool) -> Outline:
    """A thin bar from the origin to a place; nothing where that is the origin."""
    end = np.asarray(end, dtype=float)
    long = float(np.linalg.norm(end))
    if long < 1e-3 * thick:
        return chain([])
    if not planar:
        return tube(thick, long, ends=False).moved(along(end), end / 2)
    across = thick * np.array((-end[1], end[0], 0)) / long
    return plate(np.array([-across, end - across, end + across, across]))


def fan(apex: Array, rim: Array) -> Outline:
    """The surface from a point to a chain of points, with some of its straight lines."""
    k = np.arange(len(rim) - 1, dtype=np.uint32)
    faces = np.column_stack((k, k + 1, np.full(len(k), len(rim), dtype=np.uint32)))
    apex = np.asarray(apex, dtype=float)
    lines = tuple(np.stack((apex, point)) for point in rim[:: max(len(rim) // 8, 1)])
    return Outline(np.vstack((rim, apex[None])), faces, lines)


def cone(radius: float, long: float) -> Outline:
    """A cone along z, its base in the origin."""
    rim = around(radius, count=20)
    top = np.array([(0.0, 0.0, long)])
    k = np.arange(20, dtype=np.uint32)
    side = np.column_stack((k, (k + 1) % 20, np.full(20, 20, dtype=np.uint32)))
    base = plate(rim)
    return together((Outline(np.vstack((rim, top)), side), Outline(base.points, base.faces)))
