"""How the elementary motions move axes: the new pose, and what one unit of each speed does.

The columns of a motion are the velocities that one unit of each of its speeds gives to the axes and
to their origin before the motion. What does not move has no entry.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.mechanics.liaisons.motions import (
    Attitude,
    Driven,
    Follow,
    Heading,
    Motion,
    Pointing,
    Screw,
    Slide,
    Spot,
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
    cross,
    nowhere,
    product,
    turn_about,
    turn_in_plane,
    turning,
)
from frot.compiler.mechanics.values import Lower, rate_by_time, unit_vector
from frot.dsl.checked import Expression
from frot.dsl.data.classes import dataclass, field, replace


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """What one unit of a speed does: angular velocity of the axes, velocity of their origin."""

    angular: ca.SX
    linear: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Moved:
    """Axes after a motion, the columns of its speeds, and the way (3) that their origin went.

    The way begins where the columns are taken, the vector `back` from the origin before.

    `tangent`: of a motion along a curve, the derivative of its point by the parameter.
    """

    moving: Moving
    columns: tuple[Column, ...]
    way: ca.SX
    tangent: ca.SX | None = None
    back: ca.SX = field(default_factory=nowhere)


def move(motion: Motion, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """The axes after the motion, the columns of its speeds, the way of their origin."""
    return _MOVES[type(motion)](motion, base, q, v, lower)


def carried(local: ca.SX, base: Moving, lower: Lower) -> Moving:
    """The same axes at a place given in them, which time may move."""
    way, speed = base.pose.direction(local), rate_by_time(local, lower)
    if not speed.nnz():
        return base.shifted(way)
    push = base.pose.direction(rate_by_time(speed, lower))
    return _slid(base, way, base.pose.direction(speed), push)


def turned_by_time(axis: Expression | str, angle: ca.SX, base: Moving, lower: Lower) -> Moving:
    """Axes turned about one of their own by an angle; time may change both."""
    local, rate = unit_vector(axis, lower), rate_by_time(angle, lower)
    if not (rate.nnz() or rate_by_time(local, lower).nnz()):
        return replace(base, pose=turned_pose(base.pose, local, angle))
    turned = _turned(base, local, angle, rate, base.pose.direction(local), lower)
    push = base.pose.direction(local * rate_by_time(rate, lower))
    return replace(turned, angular_bias=turned.angular_bias + push)


def rates(motion: Motion, q: ca.SX, v: ca.SX) -> ca.SX:
    """Q' of a motion: 2 r' = (0, omega) r, or r (0, 0, v) where the speeds are along own axes."""
    turns = motion.quaternion
    if isinstance(motion, Spot):
        return ca.SX.zeros(len(motion.coordinates))  # what takes it along knows better
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


def _turned(
    base: Moving, local: ca.SX, angle: ca.SX, rate: ca.SX, along: ca.SX, lower: Lower
) -> Moving:
    """The angular velocity along the axis turns with the base: bias omega x (e q').

    Where time turns the axis e in the base too, that adds sin q e' + (1 - cos q) e x e'
    (by the formula of O. Rodrigues).
    """
    turns, pushes = along * rate, nowhere()
    swept, pushed = _swept(local, angle, rate, lower)
    if swept.nnz():
        turns = turns + base.pose.direction(swept)
        pushes = base.pose.direction(pushed)
    return Moving(
        turned_pose(base.pose, local, angle),
        base.angular + turns,
        base.linear,
        base.angular_bias + cross(base.angular, turns) + pushes,
        base.linear_bias,
    )


def _swept(local: ca.SX, angle: ca.SX, rate: ca.SX, lower: Lower) -> tuple[ca.SX, ca.SX]:
    """What an axis that time turns adds to the angular velocity, and to its rate in the base."""
    moves = rate_by_time(local, lower)
    if not moves.nnz():
        return nowhere(), nowhere()
    sine, versine = ca.sin(angle), 1 - ca.cos(angle)
    beside, bends = cross(local, moves), rate_by_time(moves, lower)
    pushed = rate * ((2 - versine) * moves + sine * beside)
    return (
        ca.sparsify(sine * moves + versine * beside),
        ca.sparsify(pushed + sine * bends + versine * cross(local, bends)),
    )


def _slid(base: Moving, way: ca.SX, moves: ca.SX, bends: ca.SX | None = None) -> Moving:
    """The axes at the end of a way that changes in them at the rate `moves` (3).

    `bends`: what accelerates it but for speeds; Coriolis' acceleration is 2 omega x moves.
    """
    there = base.shifted(way)
    bias = there.linear_bias if bends is None else there.linear_bias + bends
    return replace(
        there,
        linear=there.linear + moves,
        linear_bias=bias + 2 * cross(base.angular, moves),
    )


def _placed(base: Moving, pose: Pose, angular: ca.SX) -> Moving:
    """Axes placed relative to the ground: nothing of the base's turning is left, nor any bias."""
    return Moving(pose, angular, base.linear, nowhere(), base.linear_bias)


def _move_turn(motion: Turn, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    local = motion.axis.unit(lower)
    along = motion.sign * base.pose.direction(local)
    angle, rate = motion.sign * q, motion.sign * v
    turned = _turned(base, local, angle, rate, base.pose.direction(local), lower)
    return Moved(turned, (Column(along, nowhere()),), nowhere())


def _move_slide(motion: Slide, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    along, slid, way = _along_way(motion.sign * way_of(motion, lower), base, q, v, lower)
    return Moved(slid, (Column(nowhere(), along),), way)


def _along_way(
    local: ca.SX, base: Moving, q: ca.SX, v: ca.SX, lower: Lower
) -> tuple[ca.SX, Moving, ca.SX]:
    """Axes at the end of the way e q, with e given in those of the base, and e and the way there.

    Time may change e: e' q is no speed, 2 e' q' + e'' q bias.
    """
    along, turns = base.pose.direction(local), rate_by_time(local, lower)
    way, moves, bends = along * q, along * v, None
    if turns.nnz():
        moves = moves + base.pose.direction(turns) * q
        bends = base.pose.direction(2 * turns * v + rate_by_time(turns, lower) * q)
    return along, _slid(base, way, moves, bends), way


def _move_screw(motion: Screw, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """First along, then about the axis: they commute."""
    local = motion.axis.unit(lower)
    advance = lower(motion.pitch) / (2 * ca.pi) * motion.sign * local
    way, slid, far = _along_way(advance, base, q, v, lower)
    angle, rate = motion.sign * q, motion.sign * v
    turned = _turned(slid, local, angle, rate, base.pose.direction(local), lower)
    return Moved(turned, (Column(motion.sign * base.pose.direction(local), way),), far)


def _move_driven(motion: Driven, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """As its motion goes by itself, with the acceleration that its value has."""
    value = lower(motion.value)
    speed = rate_by_time(value, lower)
    moved = move(motion.motion, base, value, speed, lower)
    (column,), push = moved.columns, rate_by_time(speed, lower)
    there = moved.moving
    there = replace(
        there,
        angular_bias=there.angular_bias + column.angular * push,
        linear_bias=there.linear_bias + column.linear * push,
    )
    return Moved(there, (), moved.way, moved.tangent)


def _move_follow(motion: Follow, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """The material element of the curve may move too: its parameter stays with it."""
    u = ca.SX.sym("u")
    point = motion.sign * motion.curve.point(u, lower)
    along, drift = ca.jacobian(point, u), rate_by_time(point, lower)
    bends = ca.jacobian(along, u) * v**2 + 2 * rate_by_time(along, lower) * v
    bends += rate_by_time(drift, lower)
    local = [ca.SX(x) for x in ca.substitute([point, along, drift, bends], [u], [q])]
    way, along, drift, bends = (base.pose.direction(ca.sparsify(x)) for x in local)
    moving = _slid(base, way, along * v + drift, bends)
    return Moved(moving, (Column(nowhere(), along),), way, along)


def _move_heading(motion: Heading, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, turn_in_plane(q), turning(Z, q), q)
    return Moved(_placed(base, pose, about_z(v)), (Column(Z, nowhere()),), nowhere())


def _move_attitude(motion: Attitude, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, axes_of(q), q, ca.SX(0))
    columns = tuple(Column(e, nowhere()) for e in (X, Y, Z))
    return Moved(_placed(base, pose, v), columns, nowhere())


def _move_pointing(motion: Pointing, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    """(R u)' = R u' + omega x (R u), and omega is R u: no bias."""
    axes = axes_of(q)
    pose = Pose(base.pose.origin, axes, q, ca.SX(0))
    columns = tuple(Column(axes[:, k], nowhere()) for k in (1, 2))
    return Moved(_placed(base, pose, axes[:, 1:] @ v), columns, nowhere())


def _move_steady(motion: Steady, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    pose = Pose(base.pose.origin, GROUND.axes, GROUND.quaternion, GROUND.angle)
    return Moved(_placed(base, pose, nowhere()), (), nowhere())


def _move_spot(motion: Spot, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
    first, second = motion.axis.beside(lower)
    way = base.pose.direction(first * q[0] + second * q[1])
    return Moved(base.shifted(way), (), way)


def way_of(motion: Slide, lower: Lower) -> ca.SX:
    """The unit vector of a slide in the axes of its base."""
    if motion.side is None:
        return motion.axis.unit(lower)
    return motion.axis.beside(lower)[motion.side]


_MOVES: dict[type, Callable[..., Moved]] = {
    Turn: _move_turn,
    Slide: _move_slide,
    Screw: _move_screw,
    Driven: _move_driven,
    Follow: _move_follow,
    Spot: _move_spot,
    Heading: _move_heading,
    Attitude: _move_attitude,
    Pointing: _move_pointing,
    Steady: _move_steady,
}
