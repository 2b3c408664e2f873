"""Where curves and surfaces in space touch an edge, or curves cross: along a common normal.

They touch there only while the feet of the normal are between the ends of both, and the normal
points out of the faces that meet in the edge. Elsewhere a face or a corner is nearer, which is a
contact of its own (`faces.py`). The gap that the kernel follows is a constant then. Parallel lines
do not cross: sides touch by their rims and ends there (`split_contacts.py`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.geometry.closest_guess import nearest_pair
from frot.compiler.mechanics.geometry.closest_solved import (
    Track,
    far_of,
    long_of,
    parameter_names,
    symbols_of,
)
from frot.compiler.mechanics.geometry.curves_with_ends import AT_END, Ending, away, between
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.parametric_figures import slope_at, trace
from frot.compiler.mechanics.spatial import Pose, cross
from frot.compiler.mechanics.values import Lower

# The square of the sine of the angle below which directions are parallel.
PARALLEL = 1e-18
# Part of their lengths by which gaps of sides in each other are none: they touch along a line then.
SAG = 3e-11
# The same of tangents of curves, whose place is known to rounding.
ALIKE = 1e-8
# Cosine to a face's normal within which a normal of its edge is beside the face.
BESIDE = 1e-9
# Part of the lengths below which a gap of solids is that of sides turned away from each other.
BEHIND = 1e-3


def are_straight(a: Figure, b: Figure) -> bool:
    """Whether both are straight lines or round cylinders, of which one at least ends."""
    both = a.straight is not None and b.straight is not None and not (a.bends or b.bends)
    return both and (a.long is not None or b.long is not None)


def are_curves(a: Figure, b: Figure) -> bool:
    """Whether both are curves."""
    return a.parameters == 1 and b.parameters == 1


def cross_straight(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending
) -> Touch:
    """How b stands to a: its gap along the common normal of the axes."""
    pa, pb = at
    first, second = (pose.direction(direction_of(x, lower)) for x, pose in ((a, pa), (b, pb)))
    apart, both = pb.origin - pa.origin, cross(first, second)
    square, size = ca.sumsqr(both), length_of(a, lower) + length_of(b, lower)
    ra, rb = radius_of(a, lower), radius_of(b, lower)
    least = _least_square(ra + rb, size)
    crossing = square > 2 * least
    safe = ca.if_else(crossing, square, 1)
    parts = [ca.dot(cross(apart, x), both) for x in (second, first)]
    ended = sum(
        (_beyond(part, square, lower(x.long), least, ending)
         for x, part in zip((a, b), parts, strict=True) if x.long is not None), ca.SX(0),
    )  # fmt: skip
    ended += _off_faces(a, b, at, both, apart, lower, ending)
    normal = both / ca.sqrt(safe)
    height = ca.dot(normal, apart)
    if any(x.tube is not None and x.long is None for x in (a, b)):  # what is inside has no crossing
        deep = ca.fabs(ra - rb) - ca.fabs(height)
        ended += ending.beyond(ca.if_else(crossing, deep, 0) / size)
    witness, side = height, ending.side
    if not (ra.is_zero() and rb.is_zero()) or a.outwards or b.outwards:
        normal, witness, side = _turned_out(a, b, at, normal, height, lower), ca.SX(1), ca.SX(1)
    gap, normal = side * ca.dot(normal, apart) - ra - rb, side * normal
    place = pb.origin + ca.if_else(ended, 0, parts[1] / safe * second - rb * normal)
    return while_inside(Touch(gap, normal, place, witness, size), ended, size)


def _least_square(radii: ca.SX, size: ca.SX) -> ca.SX:
    """Half the square of the sine of the angle below which straight figures are parallel.

    Where cylinders touch at both ends of a length l, they are in each other by the sag
    l^2 sin^2/(8 (r1 + r2)) in the middle.
    """
    return ca.SX(PARALLEL) if radii.is_zero() else 8 * SAG * radii / size


def _beyond(part: ca.SX, square: ca.SX, long: ca.SX, least: ca.SX, ending: Ending) -> ca.SX:
    """A flag: the foot part/square from the middle of an edge is beyond its ends.

    By (u^2 - h^2)/(u^2 + h^2), which has no pole where lines become parallel, and is 1 where the
    square is at most twice the `least`.
    """
    foot, half, small = part**2, (long * square / 2) ** 2, (least * long) ** 2
    return ending.beyond((foot - half + small) / (foot + half + small) - AT_END)


def pierces(a: Figure, b: Figure) -> bool:
    """Whether b is a straight line that may pass through the plane of the oval a."""
    return a.oval is not None and b.line is not None and not (a.bends or b.bends)


def pierce(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending) -> Touch:
    """How a line stands to an oval by the place P where it passes through the plane of that.

    An edge is outside of it, a rod may be inside too. The distance of P to the oval, times the
    cosine between it and the common normal, is the gap to first order where it is zero, and exact
    there.
    """
    assert a.oval is not None
    pa, pb = at
    way, axis = pb.direction(direction_of(b, lower)), pa.direction(a.oval.unit(lower))
    slope, apart = ca.dot(axis, way), pb.origin - pa.origin
    safe = ca.if_else(slope**2 > PARALLEL, slope, 1)
    part = -ca.dot(axis, apart)
    across = slope * apart + part * way  # slope P
    value, steep = ca.SX(-0.5), ca.SX.zeros(3)
    for long, e in a.semi_axes(lower):
        ratio = ca.dot(pa.direction(e), across) / long
        value, steep = value + (ratio / safe) ** 2 / 2, steep + ratio / long * pa.direction(e)
    out = slope * steep - ca.dot(steep, way) * axis
    ended, length = _into_faces(b, pb, out, lower, ending), length_of(a, lower)
    if b.long is not None:
        ended += _beyond(part * slope, slope**2, lower(b.long), ca.SX(PARALLEL), ending)
        length += lower(b.long)
    steep = steep / safe
    size, wide = ca.sumsqr(steep), ca.sumsqr(out)
    normal = out / ca.sqrt(ca.if_else(wide > 0, wide, 1))
    gap = value / ca.if_else(size > 0, size, 1) * ca.dot(normal, steep)
    side, witness = (ca.SX(1), ca.SX(1)) if b.outwards else (ending.side, gap)
    place = pb.origin + ca.if_else(ended, 0, part / safe * way)
    found = Touch(side * gap, side * normal, place, witness, length)
    return while_inside(found, ended, length)


def cross_curves(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending
) -> Track:
    """How the curve b stands to the curve a: the way between them is across both."""
    (pa, pb), names = at, (*parameter_names(a, False), *parameter_names(b, True))
    s = symbols_of(names)
    first, second = trace(a, s[0], pa, lower), trace(b, s[1], pb, lower)
    (along,), (other,), way = first.slopes, second.slopes, second.point - first.point
    far = far_of(pa.origin, pb.origin, first.point - pa.origin, second.point - pb.origin)
    long, wide = long_of(along), long_of(other)
    both = cross(along, other) / (long * wide)
    square, ended = ca.sumsqr(both), ca.SX(0)
    size = length_of(a, lower) + length_of(b, lower)
    for one, u in ((a, s[0]), (b, s[1])):
        if one.has_ends:
            ended += between(*one.ends(lower), u, ending).ended
    crossing = square > ALIKE
    normal = both / ca.sqrt(ca.if_else(crossing, square, 1))
    middle, side = ca.dot(normal, pb.point(b.middle(lower)) - first.point), ending.side
    if a.outwards or b.outwards:  # tangents that are parallel say nothing of the faces
        ended += ending.beyond(ALIKE - square) + _off_faces(a, b, at, both, way, lower, ending)
        normal = _turned_out(a, b, at, normal, ca.SX(1), lower)
        middle = side = ca.SX(1)
    else:
        _, straight = away(way, AT_END * size, normal)
        normal = ca.if_else(crossing, normal, straight)
    drift = second.drift - first.drift
    seen = side * normal
    found = Touch(ca.dot(seen, way), seen, second.point, middle, far, ca.dot(seen, drift), drift)
    residual = ca.vertcat(ca.dot(way, along), ca.dot(way, other))
    start, elsewhere = (nearest_pair(a, b, at, lower, x) for x in (None, s[0]))
    return Track(
        s, names, residual, ca.vertcat(far * long, far * wide), start,
        while_inside(found, ended, size), first, sided=True, elsewhere=elsewhere,
    )  # fmt: skip


def beside_edge(
    a: Figure, b: Figure, at: tuple[Pose, Pose], found: Touch, lower: Lower, ending: Ending
) -> Touch:
    """The touch of a surface and an edge while the normal points out of the faces of the edge."""
    ended = _into_faces(b, at[1], found.normal, lower, ending)
    return while_inside(found, ended, length_of(b, lower))


def _turned_out(
    a: Figure, b: Figure, at: tuple[Pose, Pose], normal: ca.SX, height: ca.SX, lower: Lower
) -> ca.SX:
    """A common normal turned out of the faces of a and into those of b; of none, along `height`."""
    out = ca.SX.zeros(3)
    for one, pose, sign in ((a, at[0], 1), (b, at[1], -1)):
        for axis in one.outwards:
            out += sign * pose.direction(axis.unit(lower))
    way = ca.dot(normal, out) if a.outwards or b.outwards else height
    return ca.if_else(way < 0, -1, 1) * normal


def _into_faces(b: Figure, pb: Pose, normal: ca.SX, lower: Lower, ending: Ending) -> ca.SX:
    """Positive where a vector that should point into the body of an edge points out of a face."""
    size = BESIDE * ca.sqrt(ca.sumsqr(normal) + PARALLEL**2)
    faces = (ca.dot(normal, pb.direction(axis.unit(lower))) for axis in b.outwards)
    return sum((ending.beyond(out - size) for out in faces), ca.SX(0))


def _off_faces(
    a: Figure,
    b: Figure,
    at: tuple[Pose, Pose],
    both: ca.SX,
    apart: ca.SX,
    lower: Lower,
    ending: Ending,
) -> ca.SX:
    """Positive where the common normal of edges does not point out of one body into the other.

    It points out of both faces of an edge, or with the other sign into both. Solids of which no
    other features touch are in each other where the gap is negative. Where it is far below zero
    they are beside each other, the faces of both in one plane. All is said by even functions of the
    product `both` of the directions, which is zero where these are parallel.
    """
    square, ended, outs = ca.sumsqr(both), ca.SX(0), []
    for one, pose in ((a, at[0]), (b, at[1])):
        faces = [ca.dot(both, pose.direction(axis.unit(lower))) for axis in one.outwards]
        if faces:
            outs.append((sum(faces, ca.SX(0)), 1 if one is a else -1))
            ended += ending.beyond(PARALLEL - BESIDE * square - math.prod(faces, start=ca.SX(1)))
    if len(outs) > 1:
        ended += ending.beyond(PARALLEL - BESIDE * square + outs[0][0] * outs[1][0])
    if outs:
        out = sum((sign * x for x, sign in outs), ca.SX(0)) / len(outs)
        size = length_of(a, lower) + length_of(b, lower)
        ended += ending.beyond(PARALLEL - BEHIND * square - out * ca.dot(both, apart) / size)
    return ended


def while_inside(found: Touch, ended: ca.SX, length: ca.SX) -> Touch:
    """The touch, or where it has `ended` a gap that keeps the same `length`."""

    def kept(value: ca.SX) -> ca.SX:
        return ca.if_else(ended, 0, value)

    return replace(
        found,
        gap=ca.if_else(ended, length, found.gap),
        normal=kept(found.normal),
        size=found.size + length,
        own=kept(found.own),
        drift=kept(found.drift),
    )


def direction_of(figure: Figure, lower: Lower) -> ca.SX:
    """The direction (3) of a line, or of the axis of a cylinder, in its axes."""
    assert figure.straight is not None
    return figure.straight.unit(lower)


def radius_of(figure: Figure, lower: Lower) -> ca.SX:
    """The radius of a cylinder, zero of a line."""
    return ca.SX(0) if figure.tube is None else lower(figure.tube[1])


def length_of(figure: Figure, lower: Lower) -> ca.SX:
    """A length of the size of a figure, which no motion changes; none of a point."""
    if figure.straight is not None:
        return radius_of(figure, lower) + (0 if figure.long is None else lower(figure.long))
    if figure.is_point:
        return ca.SX(0)
    if figure.parameters == 1 and figure.has_ends:
        least, largest = figure.ends(lower)
        return (largest - least) * long_of(slope_at(figure, (least + largest) / 2, lower))
    places = [figure.point(u, lower) for u in figure.beginnings(lower)]
    if figure.parameters == 1 and places:  # once round a closed curve
        return sum((long_of(x - y) for x, y in pairwise((*places, places[0]))), ca.SX(0))
    return figure.reach(lower)


def distance_of_ends(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> ca.SX:
    """The least distance of an end of one line from the other line."""
    return ca.mmin(ca.vertcat(*_distances(a, b, at, lower)))


def _distances(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Iterator[ca.SX]:
    for (one, pose), (other, base) in (((a, at[0]), (b, at[1])), ((b, at[1]), (a, at[0]))):
        if one.long is None:
            continue
        for sign in (-1, 1):
            end = pose.origin + sign * lower(one.long) / 2 * pose.direction(
                direction_of(one, lower)
            )
            way = base.direction(direction_of(other, lower))
            along = ca.dot(way, end - base.origin)
            if other.long is not None:
                half = lower(other.long) / 2
                along = ca.fmin(ca.fmax(along, -half), half)
            yield ca.norm_2(end - base.origin - along * way)
