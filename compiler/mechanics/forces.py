"""Applied forces: what they drive, and their potential where they have one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.dynamics import Push
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.spatial import about_z, nowhere, whole
from frot.compiler.mechanics.values import rate_by_time
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.walk import is_fixed
from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked import (
    Body,
    BodyPoint,
    Derivative,
    Expression,
    Force,
    Frame,
    Liaison,
    Literal,
    Place,
)

Argument = Expression | Place | Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A force (3) and the velocity of what it acts on, or a couple and the angular velocity.

    `velocity` is linear in the speeds and `force` times it is the power: that of the material point
    which is where the force acts, though the place may walk along the body as time goes. `walks`:
    how fast the place leaves that point (3), without entries where time does not move it. `place`:
    where a force acts (3), for what rounding of places makes of its work; a couple has none.
    `push`: the same as it acts on one body, where it does. `along`: the slope of the velocity by
    the speeds, where it is more than its factors are (a velocity that is linear with factors that
    hold speeds).
    """

    velocity: ca.SX
    force: ca.SX
    walks: ca.SX = field(default_factory=nowhere)
    place: ca.SX = field(default_factory=nowhere)
    push: Push | None = None
    along: ca.SX | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """What a force does: its actions, and its potential energy or None if it has none."""

    actions: tuple[Action, ...]
    potential: ca.SX | None

    @property
    def power(self) -> ca.SX:
        """What the energy of motion and the potential gain by it together.

        A potential takes F . v from the motion and changes by -F . (v + w), where the places walk
        with w along the bodies: what is left is the work of whatever moves them there.
        """
        if self.potential is None:
            return sum((ca.dot(a.velocity, a.force) for a in self.actions), ca.SX(0))
        return sum((-ca.dot(a.walks, a.force) for a in self.actions if a.walks.nnz()), ca.SX(0))


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """Where a point is, its velocity, and its body with the way there from G (None: the ground).

    `material`: velocity of what is there of the body, from which the place `walks` away.
    """

    place: ca.SX
    velocity: ca.SX
    body: Body | None
    arm: ca.SX
    material: ca.SX
    walks: ca.SX

    def under(self, force: ca.SX) -> Action:
        """A force that acts there."""
        push = None if self.body is None else Push(self.body, self.arm, force, nowhere())
        return Action(self.material, force, self.walks, self.place, push)


def load(
    force: Force,
    kinematics: Kinematics,
    lowering: Lowering,
    effort: Callable[[Liaison, str], Effort],
) -> Load:
    """Lower one force. `lowering` is that of the motion, so that its switches are located."""
    return _LOADS[force.kind.name](_Given(force.arguments, kinematics, lowering, effort))


@dataclass(frozen=True, slots=True, eq=False)
class _Given:
    """The arguments of a force, and what lowers them."""

    arguments: Mapping[str, Argument]
    kinematics: Kinematics
    lowering: Lowering
    effort: Callable[[Liaison, str], Effort]

    def value(self, name: str) -> ca.SX:
        """A number or a vector."""
        return self.lowering.lower(_value(self.arguments[name]))

    def end(self, name: str, rated: bool = False) -> _End:
        """A point of a body, or a place given by its coordinates: `rated` with its velocity."""
        argument = self.arguments[name]
        if not isinstance(argument, (BodyPoint, Frame)):
            place, rest = whole(self.value(name)), nowhere()
            velocity = self.rate(argument) if rated else rest
            return _End(place, velocity, None, rest, rest, rest)
        moving, body = self.kinematics.moving(argument), point_body(argument)
        local, own = self.kinematics.local_point(argument), self.kinematics.bodies[body]
        arm = own.pose.direction(local)
        walks = own.pose.direction(rate_by_time(local, self.kinematics.fixed.lower))
        material = own.shifted(arm).linear
        return _End(moving.pose.origin, moving.linear, body, arm, material, walks)

    def rate(self, argument: Argument) -> ca.SX:
        """The velocity (3) of a place given by its coordinates."""
        if is_fixed(place := _value(argument)):
            return nowhere()
        return whole(self.lowering.lower(Derivative(place, place.type, place.span)))

    @property
    def is_constant(self) -> bool:
        """Whether parameters alone give it."""
        return all(is_fixed(a) for a in self.arguments.values() if isinstance(a, Expression))


def _on(given: _Given) -> Load:
    end = given.end("frame")
    return Load((end.under(whole(given.value("value"))),), None)


def _between(start: _End, end: _End, pull: ca.SX) -> tuple[Action, Action]:
    """A force on the end, and its opposite on the start."""
    return end.under(pull), start.under(-pull)


def _damper(given: _Given) -> Load:
    start, end = given.end("a", rated=True), given.end("b", rated=True)
    damping = given.value("c")
    along = _unit(end.place - start.place)
    rate = ca.dot(end.velocity - start.velocity, along)
    return Load(_between(start, end, -damping * rate * along), None)


def _attraction(given: _Given) -> Load:
    start, end = given.end("centre"), given.end("point")
    apart, stiffness = end.place - start.place, given.value("k")
    energy = stiffness * ca.sumsqr(apart) / 2 if given.is_constant else None
    return Load(_between(start, end, -stiffness * apart), energy)


def _spring(given: _Given) -> Load:
    """Where the ends meet it has no direction: the limit of the part without one is taken."""
    start, end = given.end("a"), given.end("b")
    apart, stiffness = end.place - start.place, given.value("k")
    rest = given.value("length")
    length = ca.sqrt(ca.sumsqr(apart))
    slack = ca.SX(0)
    if _literal(given.arguments["length"]) != 0:
        slack = ca.if_else(length > 0, rest / length, ca.SX(0))
    energy = stiffness * (length - rest) ** 2 / 2 if given.is_constant else None
    return Load(_between(start, end, -stiffness * (1 - slack) * apart), energy)


def _couple(given: _Given) -> Load:
    """It drives the angle of a liaison, or a body (in the plane about z)."""
    holder, kinematics, value = given.arguments["holder"], given.kinematics, given.value("value")
    if isinstance(holder, Liaison):
        return Load((Action(given.effort(holder, "angle").rate, value),), None)
    assert isinstance(holder, BodyPoint)
    turning = kinematics.angular_velocity(holder.body)
    whole_couple = about_z(value) if kinematics.planar else ca.sparsify(value)
    push = Push(holder.body, nowhere(), nowhere(), whole_couple)
    turning = turning[2] if kinematics.planar else turning
    return Load((Action(turning, value, push=push),), None)


def _drag(given: _Given) -> Load:
    """A force c |v|^exponent against v; the exponent is a number from 1 on."""
    end = given.end("body")
    velocity = end.velocity
    factor = given.value("c")
    exponent = _literal(given.arguments["exponent"])
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


_LOADS: Mapping[str, Callable[[_Given], Load]] = {
    "attraction": _attraction,
    "couple": _couple,
    "damper": _damper,
    "drag": _drag,
    "on": _on,
    "spring": _spring,
}


def _unit(vector: ca.SX) -> ca.SX:
    """The vector's direction; zero where it has none."""
    length = ca.sqrt(ca.sumsqr(vector))
    return ca.if_else(length > 0, vector / length, ca.SX.zeros(3))


def _value(argument: Argument) -> Expression:
    assert isinstance(argument, Expression)
    return argument


def _literal(argument: Argument) -> object:
    return argument.value if isinstance(argument, Literal) else None
