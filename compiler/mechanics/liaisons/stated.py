"""Liaisons of the user: relations between places and velocities as the text states them.

What a relation does to b is found by moving b alone: its wrench is the slope of the relation's rate
by the velocity of the place b and by the angular velocity of its body.
"""

from __future__ import annotations

import copy

import casadi as ca
from frot.compiler.lowering.expressions import Lowering
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.locks import Stated
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.wrenches import Action
from frot.compiler.mechanics.mechanism import Joint, Mechanism, point_body
from frot.compiler.mechanics.spatial import Moving, Pose, cross, nowhere, product
from frot.dsl import Log
from frot.dsl.checked import Liaison, Quantity
from frot.dsl.data.classes import replace


def value_of(lock: Stated, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
    """Left side less right side of a relation, and the size of both."""

    def quantity(node: Quantity) -> ca.SX:
        assert not isinstance(node.owner, Liaison)
        value = _read(node, kinematics)
        return ca.densify(value[:2]) if kinematics.planar and value.numel() == 3 else value

    lowering = Lowering(kinematics.symbols, quantity, _unrated, Log())
    left, right = lowering.lower(lock.left), lowering.lower(lock.right)
    return left - right, ca.fabs(left) + ca.fabs(right)


def _unrated(value: ca.SX) -> ca.SX:
    raise TypeError("a derivative in a relation")


def refuse_bent(mechanism: Mechanism, kinematics: Kinematics, log: Log) -> None:
    """Report relations between velocities that are not linear in them."""
    for link in mechanism.contacts:
        lock = getattr(link, "lock", None)
        if not isinstance(lock, Stated) or not lock.kinematic:
            continue
        value, _ = value_of(lock, kinematics)
        if _is_bent(value, kinematics.symbols.v):
            log.report(
                "E0701",
                "a relation that is not linear in velocities is not supported yet",
                lock.left.span,
            )


def _is_bent(value: ca.SX, speeds: ca.SX) -> bool:
    slope = ca.jacobian(value, speeds)
    return bool(slope.nnz() and speeds.numel() and ca.depends_on(slope, speeds))


def _read(node: Quantity, kinematics: Kinematics) -> ca.SX:
    assert not isinstance(node.owner, Liaison)
    moving = kinematics.moving(node.owner)
    match node.name:
        case "position":
            return ca.densify(moving.pose.origin)
        case "velocity":
            return ca.densify(moving.linear)
        case "angular_velocity":
            return ca.densify(moving.angular[2] if kinematics.planar else moving.angular)
        case "angle":
            return moving.pose.angle
        case "orientation":
            return moving.pose.quaternion
    return ca.densify(moving.pose.axes[:, "xyz".index(node.name[1])])


def state(lock: Stated, joint: Joint, kinematics: Kinematics) -> Action:
    """The wrench and the gap of a relation; of one between velocities there is no gap."""
    body, there = point_body(joint.b), kinematics.position(joint.b)
    way, turn = ca.SX.sym("way", 3), ca.SX.sym("turn", 3)
    moved = copy.copy(kinematics)
    own = kinematics.bodies[body]
    linear = way + cross(turn, own.pose.origin - there)
    other = _faster(own, linear, turn) if lock.kinematic else _displaced(own, linear, turn)
    moved.bodies = {**kinematics.bodies, body: other}
    value, _ = value_of(lock, moved)
    slopes = [ca.jacobian(value, x).T for x in (way, turn)]
    zero = ca.SX.zeros(3)
    force, couple = ca.substitute(slopes, [way, turn], [zero, zero])
    gap = ca.SX(0) if lock.kinematic else value_of(lock, kinematics)[0]
    return Action(force, couple, Column(nowhere(), nowhere()), gap)


def _faster(own: Moving, linear: ca.SX, turn: ca.SX) -> Moving:
    return replace(own, linear=own.linear + linear, angular=own.angular + turn)


def _displaced(own: Moving, linear: ca.SX, turn: ca.SX) -> Moving:
    """By a little, so that slopes at zero are right."""
    pose = own.pose
    half = ca.vertcat(0, turn / 2)
    turned = Pose(
        pose.origin + linear,
        pose.axes + ca.skew(turn) @ pose.axes,
        pose.quaternion + product(half, ca.densify(pose.quaternion)),
        pose.angle + turn[2],
    )
    return replace(own, pose=turned)
