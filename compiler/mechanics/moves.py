"""How the elementary motions move axes: the new pose, and what one unit of each speed does.

The columns of a motion are the velocities that one unit of each of its speeds gives to the axes and
to their origin before the motion. What does not move has no entry.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
from frot.compiler.mechanics.motions import (
    Attitude,
    Axis,
    Heading,
    Motion,
    Pointing,
    Screw,
    Slide,
    Steady,
    Turn,
)
from frot.compiler.mechanics.spatial import (
    GROUND,
    Moving,
    Pose,
    X,
    Y,
    Z,
    about_z,
    axes_of,
    beside,
    cross,
    nowhere,
    product,
    turn_about,
    turn_in_plane,
    turning,
    whole,
)
from frot.dsl.checked import Expression, Literal

Lower = Callable[[Expression], ca.SX]


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """What one unit of a speed does: angular velocity of the axes, velocity of their origin."""

    angular: ca.SX
    linear: ca.SX


Moved = tuple[Moving, tuple[Column, ...]]


def unit_vector(given: Expression | str, lower: Lower) -> ca.SX:
    """The unit vector of `x`, `y`, `z` or of a vector of the text."""
    name = given.value if isinstance(given, Literal) else given
    if isinstance(name, str):
        return {"x": X, "y": Y, "z": Z}[name]
    assert not isinstance(given, str)
    vector = whole(lower(given))
    return ca.sparsify(vector / ca.norm_2(vector))


def move(motion: Motion, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """The axes after the motion, and the columns of its speeds."""
    return _MOVES[type(motion)](motion, base, q, v, lower)


def seen(motion: Motion, a: Moving, b: Moving, lower: Lower) -> tuple[ca.SX, ca.SX]:
    """The coordinate of a motion and its rate from the postures of a and b alone.

    Angles count the turns in the plane; in space they are within half a revolution.
    """
    return _SEEN[type(motion)](motion, a, b, lower)


def rates(motion: Motion, q: ca.SX, v: ca.SX) -> ca.SX:
    """Q' of a motion: 2 r' = (0, omega) r, or r (0, 0, v) where the speeds are along own axes."""
    turns = motion.quaternion
    if turns is None:
        return v
    if turns.own_axes:
        return product(q, ca.vertcat(0, 0, v)) / 2
    return product(ca.vertcat(0, v), q) / 2


def turned_pose(pose: Pose, local: ca.SX, angle: ca.SX) -> Pose:
    """Axes turned about a unit vector of their own."""
    if local is Z and pose.axes[2, 2].is_one():
        total = pose.angle + angle
        return Pose(pose.origin, turn_in_plane(total), turning(Z, total), total)
    axes = ca.sparsify(pose.axes @ turn_about(local, angle))
    return Pose(pose.origin, axes, product(pose.quaternion, turning(local, angle)), ca.SX(0))


def angle_about(axis: Axis, a: Pose, b: Pose, lower: Lower) -> ca.SX:
    """The angle by which b is turned from a about an axis of both."""
    local = unit_vector(axis.given, lower)
    if local is Z and a.axes[2, 2].is_one() and b.axes[2, 2].is_one():
        return b.angle - a.angle
    first, second = (a.direction(e) for e in beside(local))
    turned = b.direction(beside(local)[0])
    return ca.atan2(ca.dot(turned, second), ca.dot(turned, first))


def _turned(base: Moving, local: ca.SX, angle: ca.SX, rate: ca.SX, along: ca.SX) -> Moving:
    """The angular velocity along the axis turns with the base: bias omega x (e q')."""
    return Moving(
        turned_pose(base.pose, local, angle),
        base.angular + along * rate,
        base.linear,
        base.angular_bias + cross(base.angular, along * rate),
        base.linear_bias,
    )


def _slid(base: Moving, along: ca.SX, length: ca.SX, rate: ca.SX) -> Moving:
    """Coriolis' acceleration is 2 omega x (e q')."""
    there = base.shifted(along * length)
    return Moving(
        there.pose,
        there.angular,
        there.linear + along * rate,
        there.angular_bias,
        there.linear_bias + 2 * cross(base.angular, along * rate),
    )


def _placed(base: Moving, pose: Pose, angular: ca.SX) -> Moving:
    """Axes placed relative to the ground: nothing of the base's turning is left, nor any bias."""
    return Moving(pose, angular, base.linear, nowhere(), base.linear_bias)


def _move_turn(motion: Turn, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    local = unit_vector(motion.axis.given, lower)
    along = motion.sign * base.pose.direction(local)
    return _turned(base, local, motion.sign * q, v, along), (Column(along, nowhere()),)


def _move_slide(motion: Slide, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    along = motion.sign * base.pose.direction(_way(motion, lower))
    return _slid(base, along, q, v), (Column(nowhere(), along),)


def _move_screw(motion: Screw, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """First along, then about the axis: they commute."""
    local = unit_vector(motion.axis.given, lower)
    advance = lower(motion.pitch) / (2 * ca.pi)
    along = motion.sign * base.pose.direction(local)
    slid = _slid(base, along, advance * q, advance * v)
    turned = _turned(slid, local, motion.sign * q, v, along)
    return turned, (Column(along, advance * along),)


def _move_heading(motion: Heading, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, turn_in_plane(q), turning(Z, q), q)
    return _placed(base, pose, about_z(v)), (Column(Z, nowhere()),)


def _move_attitude(motion: Attitude, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, axes_of(q), q, ca.SX(0))
    return _placed(base, pose, v), tuple(Column(e, nowhere()) for e in (X, Y, Z))


def _move_pointing(motion: Pointing, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """(R u)' = R u' + omega x (R u), and omega is R u: no bias."""
    axes = axes_of(q)
    pose = Pose(base.pose.origin, axes, q, ca.SX(0))
    columns = tuple(Column(axes[:, k], nowhere()) for k in (1, 2))
    return _placed(base, pose, axes[:, 1:] @ v), columns


def _move_steady(motion: Steady, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, GROUND.axes, GROUND.quaternion, GROUND.angle)
    return _placed(base, pose, nowhere()), ()


def _way(motion: Slide, lower: Lower) -> ca.SX:
    local = unit_vector(motion.axis.given, lower)
    return local if motion.side is None else beside(local)[motion.side]


def _see_turn(motion: Turn, a: Moving, b: Moving, lower: Lower) -> tuple[ca.SX, ca.SX]:
    along = a.pose.direction(unit_vector(motion.axis.given, lower))
    return angle_about(motion.axis, a.pose, b.pose, lower), ca.dot(along, b.angular - a.angular)


def _see_slide(motion: Slide, a: Moving, b: Moving, lower: Lower) -> tuple[ca.SX, ca.SX]:
    along, there = a.pose.direction(_way(motion, lower)), b.pose.origin
    rate = ca.dot(along, b.linear - a.velocity_of(there))
    return ca.dot(along, there - a.pose.origin), rate


_MOVES: dict[type, Callable[..., Moved]] = {
    Turn: _move_turn,
    Slide: _move_slide,
    Screw: _move_screw,
    Heading: _move_heading,
    Attitude: _move_attitude,
    Pointing: _move_pointing,
    Steady: _move_steady,
}
_SEEN: dict[type, Callable[..., tuple[Any, Any]]] = {
    Turn: _see_turn,
    Slide: _see_slide,
    Screw: _see_turn,
}
