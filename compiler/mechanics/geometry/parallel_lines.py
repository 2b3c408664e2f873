"""Where thin figures in space meet while nothing determines their common normal.

Two lines that cross touch along the normal of both. Two that are parallel are two points in their
cross-section. Which way these act on each other depends on how they are moved apart: across, or by
a turn. Such a meeting ends the run. So does that of curves with parallel tangents, and of a line
that lies in the plane of a rim.

Near such a place figures may be in each other for a moment only. A sign of the way between them
that changes there ends the step, so that no step passes over it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import casadi as ca
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.mechanics.geometry.crossing_edges import (
    ALIKE,
    PARALLEL,
    are_curves,
    are_straight,
    direction_of,
    length_of,
    pierces,
)
from frot.compiler.mechanics.geometry.curves_with_ends import AT_END
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.parametric_figures import trace
from frot.compiler.mechanics.geometry.vanishing import COUNT, Vanishing
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.spatial import Pose, beside_moving, cross
from frot.compiler.mechanics.values import Lower
from frot.compiler.mechanics.variables import Variables
from frot.dsl.checked import Liaison

# Part of the lengths of figures below which they meet: lines that are parallel to rounding differ
# by as much along these.
MET = 2e-9
# The square of the sine of the angle up to which the sign of the way between figures is followed.
NEARLY = 1e-2
# The square of the sine of the angle to the plane of a rim below which a line lies flat on it: what
# meets one side of the rim meets the other too before a step can tell them apart.
FLAT = 1e-6
# Directions of two signs: no symmetry of a scene has the golden section.
GOLDEN = 0.6180339887498949

LINES = "its lines meet while they are parallel, and have no common normal"
TANGENTS = "its curves are nearest where their tangents are parallel, and have no common normal"
RIMS = "it meets a rim in which a side ends, which it does not touch"
IN_PLANE = "its line meets the rim in the plane of that, at no single place"


@dataclass(frozen=True, slots=True, eq=False)
class Meeting:
    """That the figures of a liaison meet without a common normal, once `value` (m) is positive.

    `signs` (m) change where they come near to that: a step ends there. `distance`: how far they are
    from losing their normal, as an angle and in parts of their lengths. `only`: they meet where the
    value comes to be positive while this is.
    """

    text: str
    value: ca.SX
    signs: tuple[ca.SX, ...] = ()
    distance: ca.SX | None = None
    only: ca.SX | None = None


def find_meetings(variables: Variables) -> Iterator[tuple[Liaison, Meeting]]:
    """Of each contact of lines, curves or rims that stands alone.

    Where one liaison stands for several contacts the others carry what is parallel, and no rim of
    two sides touches another.
    """
    kinematics, lower = variables.kinematics, variables.kinematics.fixed.lower
    parts = {part for parts in variables.corners.values() for part in parts}
    if kinematics.planar:
        return
    for liaison, link in variables.links.items():
        if not link.opens or not is_unilateral(liaison):
            continue
        at = tuple(kinematics.pose(point) for point in link.ends)
        for a, b in link.pairs:
            both = (at[0], at[1])
            if liaison not in parts:
                found = _meetings(a, b, both, kinematics.tracks.get(liaison), lower)
            elif _is_side(a) and _is_side(b):
                found = _of_rims(a, b, both, lower)
            else:
                continue
            for one in found:
                yield liaison, replace(one, text=f"liaison '{liaison.name}': {one.text}")


def find_lost_normals(variables: Variables) -> Iterator[Vanishing]:
    """What these contacts lose, where the evaluation fails."""
    for liaison, one in find_meetings(variables):
        if one.distance is not None:
            yield Vanishing(liaison, one.text, (), one.distance, ca.SX.zeros(COUNT))


def _meetings(
    a: Figure, b: Figure, at: tuple[Pose, Pose], track: Track | None, lower: Lower
) -> Iterator[Meeting]:
    if are_straight(a, b) and a.tube is b.tube is None:
        yield _of_lines(a, b, at, lower)
    elif pierces(a, b):
        yield _in_plane(a, b, at, lower)
    elif are_curves(a, b) and not are_straight(a, b) and track is not None:
        yield from _of_curves(a, b, at, track, lower)
    else:
        yield from _of_rims(a, b, at, lower)


def _is_side(figure: Figure) -> bool:
    """Whether it is a cylinder that ends in two rims."""
    return figure.tube is not None and bool(figure.borders)


def _of_lines(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Meeting:
    """By the way between the middles of what lies side by side."""
    (pa, pb), size = at, length_of(a, lower) + length_of(b, lower)
    first, second = (p.direction(direction_of(x, lower)) for x, p in ((a, pa), (b, pb)))
    apart = pb.origin - pa.origin
    along = ca.dot(first, apart)
    halves = [(m, lower(x.long) / 2) for x, m in ((a, 0), (b, along)) if x.long is not None]
    least, largest = halves[0][0] - halves[0][1], halves[0][0] + halves[0][1]
    for middle, half in halves[1:]:
        least, largest = ca.fmax(least, middle - half), ca.fmin(largest, middle + half)
    place = (least + largest) / 2
    way = apart + (place - along) * ca.dot(first, second) * second - place * first
    square = ca.sumsqr(cross(first, second))
    assert a.straight is not None
    ways = tuple(pa.direction(e) for e in a.straight.beside(lower))
    beside = largest - least - AT_END * size
    value = _while(square, 2 * PARALLEL, ca.fmin(MET * size - _long(way), beside), size)
    far = ca.fmax(ca.sqrt(square), _long(way) / size)
    return Meeting(LINES, value, _signs(way, ways, square, size), far)


def _of_curves(
    a: Figure, b: Figure, at: tuple[Pose, Pose], track: Track, lower: Lower
) -> Iterator[Meeting]:
    """By the way between the places that are nearest."""
    size, first = length_of(a, lower) + length_of(b, lower), track.trace
    if first is None:
        return
    second = trace(b, track.unknowns[a.parameters :], at[1], lower)
    (along,), (other,), way = first.slopes, second.slopes, second.point - first.point
    square = ca.sumsqr(cross(along, other)) / (ca.sumsqr(along) * ca.sumsqr(other))
    value = _while(square, ALIKE, MET * size - _long(way), size)
    signs = _signs(way, beside_moving(along / _long(along)), square, size)
    yield Meeting(TANGENTS, value, signs, ca.sqrt(square))


def _in_plane(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Meeting:
    """The line has places within the oval and without, all in its plane.

    On the line F(w) = A w^2 + 2 B w + C, zero on the oval: least where w = -B/A, or at an end.
    """
    assert a.oval is not None
    (pa, pb), size = at, length_of(a, lower) + length_of(b, lower)
    axis, way = pa.direction(a.oval.unit(lower)), pb.direction(direction_of(b, lower))
    apart, slope = pb.origin - pa.origin, ca.dot(axis, way)
    steep = below = ca.SX(0)
    value = ca.SX(-1)
    for long, e in a.semi_axes(lower):
        x, d = (ca.dot(pa.direction(e), vector) / long for vector in (apart, way))
        steep, below, value = steep + d**2, below + x * d, value + x**2
    place, most = -below / ca.fmax(steep, PARALLEL / size**2), size
    if b.long is not None:
        half = lower(b.long) / 2
        place = ca.fmin(ca.fmax(place, -half), half)
        most = size * (value + steep * half**2 + 2 * ca.fabs(below) * half)
    least = size * (value + 2 * below * place + steep * place**2)
    height = ca.dot(axis, apart + place * way)
    met = ca.fmin(MET * size - ca.fabs(height), ca.fmin(-least, most))
    signs = _signs(height * axis, (axis,), slope**2, size)
    far = ca.fmax(ca.fabs(slope), ca.fabs(height) / size)
    return Meeting(IN_PLANE, _while(slope**2, FLAT, met, size), signs, far)


def _of_rims(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Iterator[Meeting]:
    """Each rim of a side with an oval, or with each rim of the other side.

    An oval passes through the plane of the rim at two points, which come to be within the rim.
    """
    if not _is_side(a):
        a, b, at = b, a, (at[1], at[0])
    if not _is_side(a) or not (_is_side(b) or (b.oval is not None and not b.bends)):
        return
    ovals = list(_rims(b, at[1], lower)) if _is_side(b) else [_oval(b, at[1], lower)]
    size = length_of(a, lower) + length_of(b, lower)
    for rim, oval in product(_rims(a, at[0], lower), ovals):
        inner, outer, exists = _inside(rim, oval)
        for deep in (inner, -outer):
            value = ca.fmin(deep - MET / 2 * size, size * exists)
            yield Meeting(RIMS, value, only=MET * size - deep)


# The centre of an oval, and its semi-axes.
_Oval = tuple[ca.SX, ca.SX, ca.SX]


def _oval(b: Figure, pose: Pose, lower: Lower) -> _Oval:
    (long, first), (wide, second) = b.semi_axes(lower)
    return pose.origin, long * pose.direction(first), wide * pose.direction(second)


def _rims(side: Figure, pose: Pose, lower: Lower) -> Iterator[_Oval]:
    assert side.tube is not None and side.long is not None
    axis, radius = side.tube[0], lower(side.tube[1])
    first, second = (radius * pose.direction(e) for e in axis.beside(lower))
    for sign in (-1, 1):
        middle = sign * lower(side.long) / 2 * axis.unit(lower)
        yield pose.point(middle), first, second


def _inside(rim: _Oval, oval: _Oval) -> tuple[ca.SX, ca.SX, ca.SX]:
    """How far (m) the inner and the outer of these points are within a rim; > 0: they exist.

    The height h + A cos u + B sin u over the plane is zero there. Where it is not, it is the place
    of the oval that is next to the plane.
    """
    (centre, one, other), (middle, first, second) = rim, oval
    axis = cross(one, other) / ca.sumsqr(one)
    height, a, b = (ca.dot(axis, x) for x in (middle - centre, first, second))
    wide = ca.fmax(a**2 + b**2, FLAT * ca.sumsqr(first))
    exists = ca.fmax(1 - height**2 / wide, -1)
    within = ca.fmax(ca.fmin(height, ca.sqrt(wide)), -ca.sqrt(wide))
    apart = ca.sqrt(ca.fmax(wide - within**2, 0))
    deep = []
    for sign in (-1, 1):
        cosine = (-within * a + sign * b * apart) / wide
        sine = (-within * b - sign * a * apart) / wide
        way = middle + cosine * first + sine * second - centre
        deep.append(_long(one) - _long(way - ca.dot(axis, way) * axis))
    return ca.fmax(*deep), ca.fmin(*deep), exists


def _long(way: ca.SX) -> ca.SX:
    return ca.sqrt(ca.sumsqr(way))


def _while(square: ca.SX, largest: float, value: ca.SX, size: ca.SX) -> ca.SX:
    """The value while a square of a sine is not larger; it has no jump, for its sign is located."""
    return ca.fmin(value, size * ca.fmax(1 - square / largest, -1))


def _signs(way: ca.SX, ways: tuple[ca.SX, ...], square: ca.SX, size: ca.SX) -> tuple[ca.SX, ...]:
    """Parts of a way along these directions, negative where figures are not nearly parallel.

    They change where the figures have met, not where they are zero: what lies in one plane stays
    there to rounding.
    """
    if len(ways) > 1:
        one, other = ways
        ways = one + GOLDEN * other, other - GOLDEN * one
    beyond = size * (MET / 2 + ca.fmax(square / NEARLY - 1, 0))
    return tuple(ca.dot(way, e) - beyond for e in ways)
