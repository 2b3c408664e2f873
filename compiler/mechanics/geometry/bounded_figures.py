"""Where a point or a ball is nearest to a figure in space that ends: a face, a tube, a segment.

The nearest place of a rectangle is the foot of the perpendicular, or on an edge, or a corner: each
coordinate of the foot goes no further than its end. Distance and normal are continuous where a
coordinate passes its end, but for a point that slides over an edge: it separates. That it passes
is an event.
"""

from __future__ import annotations

import math

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.geometry.curves_with_ends import AT_END, Ending, away, between
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.spatial import Pose, nowhere
from frot.compiler.mechanics.values import Lower, rate_by_time

# Distance, unit normal towards the place, height that has the sign of the side, size of lengths.
_Nearest = tuple[ca.SX, ca.SX, ca.SX, ca.SX]


def ends(figure: Figure) -> bool:
    """Whether a figure is a curve or a surface that ends somewhere."""
    return figure.has_ends or bool(figure.borders)


def has_nearest_ball(a: Figure, b: Figure) -> bool:
    """Whether `nearest_ball` knows the place of b on the bounded figure a.

    A side within a bowl touches it with its rims, which are contacts of their own.
    """
    known = a.straight is not None or a.plane is not None
    return ends(a) and known and (b.is_point or (b.is_round and not is_bowl(a, b)))


def is_bowl(a: Figure, b: Figure) -> bool:
    """Whether the side of a cylinder a may be inside of b."""
    return a.tube is not None and b.is_hollow


def nearest_ball(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending
) -> Touch:
    """How a point or a ball stands to a bounded figure, which no time changes."""
    pa, pb = at
    rule = _on_face if a.plane is not None else _on_segment if a.tube is None else _on_tube
    gap, normal, witness, size = rule(a, pb.origin - pa.origin, pa, lower, ending)
    radius = b.radius_in(lower)
    own = -rate_by_time(radius, lower)
    drift = own * normal if own.nnz() else nowhere()
    return Touch(
        gap - radius, normal, pb.origin - radius * normal, witness, size + radius, own, drift
    )


def _on_face(a: Figure, apart: ca.SX, pa: Pose, lower: Lower, ending: Ending) -> _Nearest:
    """Above the face its height, beyond edges the way from them."""
    assert a.plane is not None
    up = pa.direction(a.plane.unit(lower))
    height = ca.dot(up, apart)
    beyond, outwards, ended, size = height * up, nowhere(), ca.SX(0), ca.SX(0)
    over = ca.SX(1)
    for axis, long in a.borders:
        way, length = pa.direction(axis.unit(lower)), lower(long)
        along = ca.dot(way, apart)
        one = between(-length / 2, length / 2, along, ending)
        over = ca.logic_and(over, ca.fabs(along) < length / 2)
        beyond += ca.if_else(one.ended, along - one.inside, 0) * way
        outwards, ended, size = outwards + one.out * way, ended + one.ended, size + length
    outwards = outwards / ca.if_else(ended > 1, math.sqrt(2), 1)
    far, normal = away(beyond, AT_END * size, outwards)
    gap = ca.if_else(ended, far, ending.side * height)
    witness = height
    if a.depth is not None:  # what begins inside of the body is meant to be outside
        within = ca.logic_and(height < 0, height > -lower(a.depth))
        within = ca.logic_and(within, over)
        witness = ca.if_else(within, size, height)
    return gap, ca.if_else(ended, normal, ending.side * up), witness, size


def _on_tube(a: Figure, apart: ca.SX, pa: Pose, lower: Lower, ending: Ending) -> _Nearest:
    """Beside a tube the distance from its axis, beyond its ends that from the circles there."""
    assert a.tube is not None and a.long is not None
    way, radius = pa.direction(a.tube[0].unit(lower)), lower(a.tube[1])
    long, along = lower(a.long), ca.dot(way, apart)
    one = between(-long / 2, long / 2, along, ending)
    across = apart - along * way
    wide = ca.sqrt(ca.sumsqr(across))
    out = across / ca.if_else(wide > 0, wide, 1)
    beyond = (along - one.inside) * way + (wide - radius) * out
    far, normal = away(beyond, AT_END * (long + radius), one.out * way)
    gap = ca.if_else(one.ended, far, ending.side * (wide - radius))
    normal = ca.if_else(one.ended, normal, ending.side * out)
    return gap, normal, wide - radius, long + radius


def _on_segment(a: Figure, apart: ca.SX, pa: Pose, lower: Lower, ending: Ending) -> _Nearest:
    """The way from the foot of the perpendicular, or from an end; a segment has no sides."""
    assert a.line is not None and a.long is not None
    way = pa.direction(a.line.unit(lower))
    long, along = lower(a.long), ca.dot(way, apart)
    one = between(-long / 2, long / 2, along, ending)
    foot = ca.if_else(one.ended, one.inside, along) * way
    far, normal = away(apart - foot, AT_END * long, one.out * way)
    return far, normal, ca.SX(1), long
