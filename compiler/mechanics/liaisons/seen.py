"""Coordinates of the elementary motions, and their rates, from the postures of what they join.

Where a liaison carries no body its coordinates are seen from the bodies that it joins.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
from frot.compiler.mechanics.geometry.paths import slope_at
from frot.compiler.mechanics.liaisons.motions import (
    Driven,
    Follow,
    Motion,
    Reach,
    Screw,
    Slide,
    Turn,
)
from frot.compiler.mechanics.liaisons.moves import way_of
from frot.compiler.mechanics.spatial import Moving, Pose, Z, beside, cross
from frot.compiler.mechanics.values import Axis, Lower, Moments, rate_by_time
from frot.dsl.data.classes import dataclass

Seen = tuple[ca.SX, ca.SX]


def seen(motion: Motion, a: Moving, b: Moving, lower: Lower) -> Seen:
    """The coordinate of a motion and its rate from the postures of a and b alone.

    Angles count the turns in the plane; in space they are within half a revolution (`counted`).
    """
    moments = Moments(lower)
    value, rate = _SEEN[type(motion)](motion, a, b, moments)
    if not moments.met:
        return value, rate
    if not _keeps_axis(motion):
        rate = rate + ca.jacobian(value, moments.symbol)
    value, rate = moments.back(value, rate)
    return value, rate


def _keeps_axis(motion: Motion) -> bool:
    """Whether the rate by the velocities is the whole one, though time may change the motion.

    Of a turn about an axis n(time) of both bodies it is: what n' adds to omega is across n.
    """
    return isinstance(motion, Driven | Screw) or (isinstance(motion, Turn) and motion.mark is None)


def counted(angle: ca.SX, about: ca.SX) -> ca.SX:
    """An angle known but for whole turns: the one that is less than half a turn from `about`."""
    apart = angle - about
    return about + ca.atan2(ca.sin(apart), ca.cos(apart))


def angle_about(axis: Axis, a: Pose, b: Pose, lower: Lower) -> ca.SX:
    """The angle by which b is turned from a about an axis of both."""
    local = axis.unit(lower)
    if local is Z and a.axes[2, 2].is_one() and b.axes[2, 2].is_one():
        return b.angle - a.angle
    found = arc(Turn(axis), a, b, lower)
    return ca.atan2(found.sine, found.cosine)


@dataclass(frozen=True, slots=True, eq=False)
class Arc:
    """The angle of a turn: its sine and cosine, and the vector whose part of omega is its rate."""

    about: ca.SX
    sine: ca.SX
    cosine: ca.SX


def arc(motion: Turn | Screw, a: Pose, b: Pose, lower: Lower) -> Arc:
    """The angle by which b is turned from a.

    Of a universal joint with the axes e and f, the part of omega along e beside f is wanted: it is
    omega . (x x f)/|x|^2 with x = f x e.
    """
    local = motion.axis.unit(lower)
    if isinstance(motion, Screw) or motion.mark is None:
        first, second = (a.direction(e) for e in beside(local))
        turned = b.direction(beside(local)[0])
        return Arc(a.direction(local), ca.dot(turned, second), ca.dot(turned, first))
    mark = motion.mark.unit(lower)
    own = (b if motion.on_b else a).direction(local)
    other = (a if motion.on_b else b).direction(mark)
    start, end, normal = a.direction(mark), b.direction(mark), cross(other, own)
    return Arc(
        cross(normal, other) / ca.sumsqr(normal),
        ca.dot(own, cross(start, end)),
        ca.dot(start, end) - ca.dot(own, start) * ca.dot(own, end),
    )


def _see_turn(motion: Turn | Screw, a: Moving, b: Moving, lower: Lower) -> Seen:
    if isinstance(motion, Turn) and motion.mark is not None:
        found = arc(motion, a.pose, b.pose, lower)
        rate = ca.dot(found.about, b.angular - a.angular)
        return ca.atan2(found.sine, found.cosine), rate
    along = a.pose.direction(motion.axis.unit(lower))
    return angle_about(motion.axis, a.pose, b.pose, lower), ca.dot(along, b.angular - a.angular)


def _see_follow(motion: Follow, a: Moving, b: Moving, lower: Lower) -> Seen:
    """By the place of b, whose way along the curve has the rate v . c_u/|c_u|^2."""
    there = b.pose.origin
    at = motion.curve.parameter(there - a.pose.origin, a.pose, lower)
    along = a.pose.direction(slope_at(motion.curve, at, lower))
    moves = b.linear - a.velocity_of(there)
    return at, ca.dot(moves, along) / ca.sumsqr(along)


def _see_driven(motion: Driven, a: Moving, b: Moving, lower: Lower) -> Seen:
    value = lower(motion.value)
    return value, rate_by_time(value, lower)


def _see_slide(motion: Slide, a: Moving, b: Moving, lower: Lower) -> Seen:
    along, there = a.pose.direction(way_of(motion, lower)), b.pose.origin
    rate = ca.dot(along, b.linear - a.velocity_of(there))
    return ca.dot(along, there - a.pose.origin), rate


def _see_reach(motion: Reach, a: Moving, b: Moving, lower: Lower) -> Seen:
    way = b.pose.origin - a.pose.origin
    long = ca.sqrt(ca.sumsqr(way))
    return long, ca.dot(way / long, b.linear - a.linear)


_SEEN: dict[type, Callable[..., tuple[Any, Any]]] = {
    Turn: _see_turn,
    Slide: _see_slide,
    Screw: _see_turn,
    Driven: _see_driven,
    Follow: _see_follow,
    Reach: _see_reach,
}
