"""Applied forces: what they drive, and their potential where they have one."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import casadi as ca
from frot.compiler.lowering.expressions import Lowering
from frot.compiler.lowering.walk import is_fixed
from frot.compiler.mechanics.dynamics import Push
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.link import point_body
from frot.compiler.mechanics.spatial import about_z, nowhere, whole
from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked import Body, BodyPoint, Expression, Force, Frame, Liaison, Literal, Place
from frot.dsl.data.classes import dataclass

Argument = Expression | Place | Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A force (3) and the velocity of its point, or a couple and the angular velocity it drives.

    `velocity` is linear in the speeds and `force` times it is the power. `push`: the same as it
    acts on one body, where it does. `along`: the slope of the velocity by the speeds, where it is
    more than its factors are (a velocity that is linear with factors that hold speeds).
    """

    velocity: ca.SX
    force: ca.SX
    push: Push | None = None
    along: ca.SX | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """What a force does: its actions, and its potential energy or None if it has none."""

    actions: tuple[Action, ...]
    potential: ca.SX | None


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """Where a point is, its velocity, and its body with the way there from G (None: the ground)."""

    place: ca.SX
    velocity: ca.SX
    body: Body | None
    arm: ca.SX

    def under(self, force: ca.SX) -> Action:
        """A force that acts there."""
        push = None if self.body is None else Push(self.body, self.arm, force, nowhere())
        return Action(self.velocity, force, push)


def _point(argument: Argument, kinematics: Kinematics, lowering: Lowering) -> _End:
    if isinstance(argument, (BodyPoint, Frame)):
        moving, body = kinematics.moving(argument), point_body(argument)
        arm = kinematics.pose(body).direction(kinematics.local_point(argument))
        return _End(moving.pose.origin, moving.linear, body, arm)
    return _End(whole(lowering.lower(_value(argument))), nowhere(), None, nowhere())


def load(
    force: Force,
    kinematics: Kinematics,
    lowering: Lowering,
    effort: Callable[[Liaison, str], Effort],
) -> Load:
    """Lower one force. `lowering` is that of the motion, so that its switches are located."""
    arguments = force.arguments
    if force.kind.name == "on":
        end = _point(arguments["frame"], kinematics, lowering)
        push = whole(lowering.lower(_value(arguments["value"])))
        return Load((end.under(push),), None)
    if force.kind.name == "couple":
        value = lowering.lower(_value(arguments["value"]))
        return Load((_couple(arguments["holder"], kinematics, effort, value),), None)
    if force.kind.name == "drag":
        return _drag(arguments, kinematics, lowering)
    ends = ("centre", "point") if force.kind.name == "attraction" else ("a", "b")
    start = _point(arguments[ends[0]], kinematics, lowering)
    end = _point(arguments[ends[1]], kinematics, lowering)

    def pulls(pull: ca.SX) -> tuple[Action, Action]:
        return end.under(pull), start.under(-pull)

    apart = end.place - start.place
    if force.kind.name == "damper":
        damping = lowering.lower(_value(arguments["c"]))
        along = _unit(apart)
        rate = ca.dot(end.velocity - start.velocity, along)
        return Load(pulls(-damping * rate * along), None)
    stiffness = lowering.lower(_value(arguments["k"]))
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
    constant = all(is_fixed(a) for a in arguments.values() if isinstance(a, Expression))
    return Load(pulls(pull), energy if constant else None)


def _couple(
    holder: Argument,
    kinematics: Kinematics,
    effort: Callable[[Liaison, str], Effort],
    value: ca.SX,
) -> Action:
    """A couple drives the angle of a liaison, or a body (about z in the plane)."""
    if isinstance(holder, Liaison):
        return Action(effort(holder, "angle").rate, value)
    assert isinstance(holder, BodyPoint)
    turning = kinematics.angular_velocity(holder.body)
    if not kinematics.planar:
        return Action(turning, value)
    return Action(turning[2], value, Push(holder.body, nowhere(), nowhere(), about_z(value)))


def _drag(arguments: Mapping[str, Argument], kinematics: Kinematics, lowering: Lowering) -> Load:
    """A force c |v|^exponent against v; the exponent is a number from 1 on."""
    end = _point(arguments["body"], kinematics, lowering)
    velocity = end.velocity
    factor = lowering.lower(_value(arguments["c"]))
    exponent = _literal(arguments["exponent"])
    assert isinstance(exponent, int | float)
    size = FUNCTIONS["norm"].form
    assert size is not None
    if exponent == 2:
        factor *= size(ca, velocity)
    elif exponent != 1:
        speed = size(ca, velocity)  # at rest a root has no slope
        moving = speed > 0
        factor *= ca.if_else(moving, ca.if_else(moving, speed, 1) ** (exponent - 1), 0)
    return Load((end.under(-factor * velocity),), None)


def _unit(vector: ca.SX) -> ca.SX:
    """The vector's direction; zero where it has none."""
    length = ca.sqrt(ca.sumsqr(vector))
    return ca.if_else(length > 0, vector / length, ca.SX.zeros(3))


def _value(argument: Argument) -> Expression:
    assert isinstance(argument, Expression)
    return argument


def _literal(argument: Argument) -> object:
    return argument.value if isinstance(argument, Literal) else None
