"""What every kind of force has in common: its arguments, what it does, where it acts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.dynamics import Push
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.spatial import nowhere, whole
from frot.compiler.mechanics.values import rate_by_time
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
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
class End:
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


@dataclass(frozen=True, slots=True, eq=False)
class Given:
    """The arguments of a force, and what lowers them; `strike` of a percussion."""

    arguments: Mapping[str, Argument]
    kinematics: Kinematics
    lowering: Lowering
    effort: Callable[[Liaison, str], Effort]
    strike: ca.SX | None = None

    def value(self, name: str) -> ca.SX:
        """A number or a vector."""
        return self.lowering.lower(value_of(self.arguments[name]))

    def end(self, name: str, rated: bool = False) -> End:
        """A point of a body, or a place given by its coordinates: `rated` with its velocity."""
        argument = self.arguments[name]
        if not isinstance(argument, (BodyPoint, Frame)):
            place, rest = whole(self.value(name)), nowhere()
            velocity = self.rate(argument) if rated else rest
            return End(place, velocity, None, rest, rest, rest)
        moving, body = self.kinematics.moving(argument), point_body(argument)
        local, own = self.kinematics.local_point(argument), self.kinematics.bodies[body]
        arm = own.pose.direction(local)
        walks = own.pose.direction(rate_by_time(local, self.kinematics.fixed.lower))
        material = own.shifted(arm).linear
        return End(moving.pose.origin, moving.linear, body, arm, material, walks)

    def rate(self, argument: Argument) -> ca.SX:
        """The velocity (3) of a place given by its coordinates."""
        if is_fixed(place := value_of(argument)):
            return nowhere()
        return whole(self.lowering.lower(Derivative(place, place.type, place.span)))

    @property
    def is_constant(self) -> bool:
        """Whether parameters alone give it."""
        return all(is_fixed(a) for a in self.arguments.values() if isinstance(a, Expression))


class ForceModel:
    """A kind of force: each has a file and a class of its own."""

    __slots__ = ()

    def check(self, force: Force, log: Log) -> None:
        """Report arguments that have no meaning together; by default there are none."""

    def load(self, given: Given) -> Load:
        """The actions of a force with these arguments, and its potential."""
        raise NotImplementedError


def between(start: End, end: End, pull: ca.SX) -> tuple[Action, Action]:
    """A force on the end, and its opposite on the start."""
    return end.under(pull), start.under(-pull)


def value_of(argument: Argument) -> Expression:
    """The argument, which is an expression."""
    assert isinstance(argument, Expression)
    return argument


def literal(argument: Argument) -> object:
    """The number that is written, None where there is none."""
    return argument.value if isinstance(argument, Literal) else None
