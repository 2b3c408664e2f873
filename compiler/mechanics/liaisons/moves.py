"""What the elementary motions are made of: turning and sliding axes, which time may do too.

The columns of a motion are the velocities that one unit of each of its speeds gives to the axes and
to their origin before the motion. What does not move has no entry.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import casadi as ca
from frot.compiler.mechanics.spatial import (
    Moving,
    Pose,
    Z,
    cross,
    nowhere,
    product,
    turn_about,
    turn_in_plane,
    turning,
)
from frot.compiler.mechanics.values import Lower, rate_by_time, unit_vector
from frot.dsl.checked import Expression


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """What one unit of a speed does: angular velocity of the axes, velocity of their origin."""

    angular: ca.SX
    linear: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class AlongCurve:
    """The parameter of a curve, its rate, and the derivative (3) of the point by it."""

    parameter: ca.SX
    rate: ca.SX
    tangent: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Moved:
    """Axes after a motion, the columns of its speeds, and the way (3) that their origin went.

    The way begins where the columns are taken, the vector `back` from the origin before.

    `along`: of a motion along a curve, where it is on it.
    """

    moving: Moving
    columns: tuple[Column, ...]
    way: ca.SX
    along: AlongCurve | None = None
    back: ca.SX = field(default_factory=nowhere)


def carried(local: ca.SX, base: Moving, lower: Lower) -> Moving:
    """The same axes at a place given in them, which time may move."""
    way, speed = base.pose.direction(local), rate_by_time(local, lower)
    if not speed.nnz():
        return base.shifted(way)
    push = base.pose.direction(rate_by_time(speed, lower))
    return slid(base, way, base.pose.direction(speed), push)


def turned_by_time(axis: Expression | str, angle: ca.SX, base: Moving, lower: Lower) -> Moving:
    """Axes turned about one of their own by an angle; time may change both."""
    local, rate = unit_vector(axis, lower), rate_by_time(angle, lower)
    if not (rate.nnz() or rate_by_time(local, lower).nnz()):
        return replace(base, pose=turned_pose(base.pose, local, angle))
    there = turned(base, local, angle, rate, base.pose.direction(local), lower)
    push = base.pose.direction(local * rate_by_time(rate, lower))
    return replace(there, angular_bias=there.angular_bias + push)


def turned_pose(pose: Pose, local: ca.SX, angle: ca.SX) -> Pose:
    """Axes turned about a unit vector of their own."""
    if local is Z and pose.axes[2, 2].is_one():
        total = pose.angle + angle
        return Pose(pose.origin, turn_in_plane(total), turning(Z, total), total)
    axes = ca.sparsify(pose.axes @ turn_about(local, angle))
    return Pose(pose.origin, axes, product(pose.quaternion, turning(local, angle)), ca.SX(0))


def turned(
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


def slid(base: Moving, way: ca.SX, moves: ca.SX, bends: ca.SX | None = None) -> Moving:
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


def along_way(
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
    return along, slid(base, way, moves, bends), way
