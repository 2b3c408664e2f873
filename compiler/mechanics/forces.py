"""Applied forces: what they drive, and their potential where they have one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.expressions import Lowering
from frot.compiler.lowering.walk import is_fixed
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.mechanism import Joint
from frot.compiler.mechanics.motions import name_of
from frot.compiler.mechanics.spatial import nowhere, whole
from frot.dsl.checked import BodyPoint, Expression, Force, Frame, Liaison, Literal, Place

Argument = Expression | Place | Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A force (3) and the velocity of its point, or a couple and the angular velocity it drives.

    `velocity` is linear in the speeds and `force` times it is the power.
    """

    velocity: ca.SX
    force: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """What a force does: its actions, and its potential energy or None if it has none."""

    actions: tuple[Action, ...]
    potential: ca.SX | None


def _point(argument: Argument, kinematics: Kinematics, lowering: Lowering) -> tuple[ca.SX, ca.SX]:
    """Where a point is, and its velocity."""
    if isinstance(argument, (BodyPoint, Frame)):
        moving = kinematics.moving(argument)
        return moving.pose.origin, moving.linear
    return whole(lowering.lower(_value(argument))), nowhere()


def load(
    force: Force,
    kinematics: Kinematics,
    lowering: Lowering,
    joints: Mapping[Liaison, Joint],
) -> Load:
    """Lower one force. `lowering` is that of the motion, so that its switches are located."""
    arguments = force.arguments
    if force.kind.name == "on":
        _, velocity = _point(arguments["frame"], kinematics, lowering)
        push = whole(lowering.lower(_value(arguments["value"])))
        return Load((Action(velocity, push),), None)
    if force.kind.name == "couple":
        turning = _turning(arguments["holder"], kinematics, joints)
        return Load((Action(turning, lowering.lower(_value(arguments["value"]))),), None)
    if force.kind.name == "drag":
        return _drag(arguments, kinematics, lowering)
    ends = ("centre", "point") if force.kind.name == "attraction" else ("a", "b")
    start, first = _point(arguments[ends[0]], kinematics, lowering)
    end, second = _point(arguments[ends[1]], kinematics, lowering)
    speeds = (second, first)
    if force.kind.name == "damper":
        damping = lowering.lower(_value(arguments["c"]))
        along = _unit(end - start)
        pull = -damping * ca.dot(speeds[0] - speeds[1], along) * along
        return Load((Action(speeds[0], pull), Action(speeds[1], -pull)), None)
    stiffness = lowering.lower(_value(arguments["k"]))
    apart = end - start
    if force.kind.name == "attraction":
        pull, energy = -stiffness * apart, stiffness * ca.sumsqr(apart) / 2
    else:
        rest = lowering.lower(_value(arguments["length"]))
        length = ca.sqrt(ca.sumsqr(apart))
        # Where the ends meet a spring has no direction: the limit of the part without one is taken.
        slack = (
            ca.SX(0)
            if _literal(arguments["length"]) == 0
            else ca.if_else(length > 0, rest / length, ca.SX(0))
        )
        pull, energy = -stiffness * (1 - slack) * apart, stiffness * (length - rest) ** 2 / 2
    actions = (Action(speeds[0], pull), Action(speeds[1], -pull))
    constant = all(is_fixed(a) for a in arguments.values() if isinstance(a, Expression))
    return Load(actions, energy if constant else None)


def _turning(holder: Argument, kinematics: Kinematics, joints: Mapping[Liaison, Joint]) -> ca.SX:
    """What a couple drives: the angle of a liaison, or a body (about z in the plane)."""
    if isinstance(holder, Liaison):
        joint = joints[holder]
        index = next(k for k, m in enumerate(joint.motions) if name_of(m) == "angle")
        return kinematics.coordinate(joint, index)[1]
    assert isinstance(holder, BodyPoint)
    turning = kinematics.angular_velocity(holder.body)
    return turning[2] if kinematics.planar else turning


def _drag(arguments: Mapping[str, Argument], kinematics: Kinematics, lowering: Lowering) -> Load:
    """A force c |v|^exponent against v; the exponent is 1 or 2."""
    _, velocity = _point(arguments["body"], kinematics, lowering)
    factor = lowering.lower(_value(arguments["c"]))
    if _literal(arguments["exponent"]) == 2:
        factor *= ca.sqrt(ca.sumsqr(velocity))
    return Load((Action(velocity, -factor * velocity),), None)


def _unit(vector: ca.SX) -> ca.SX:
    """The vector's direction; zero where it has none."""
    length = ca.sqrt(ca.sumsqr(vector))
    return ca.if_else(length > 0, vector / length, ca.SX.zeros(3))


def _value(argument: Argument) -> Expression:
    assert isinstance(argument, Expression)
    return argument


def _literal(argument: Argument) -> object:
    return argument.value if isinstance(argument, Literal) else None
