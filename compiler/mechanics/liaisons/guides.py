"""The locks of a guide of finite length, which presses at both of its ends.

A sleeve on b, of half length L about the place b, carries a force across its axis and the couple
across it by two forces R1, R2 at its ends: R1 + R2 = F, L e x (R1 - R2) = C. Friction is bounded by
|R1| + |R2| (the locking of a drawer; P. Painlevé 1895, p. 93-97). What keeps from turning about the
axis presses at a distance from it, if the text gives one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.mechanics.liaisons.actions import Action, Between, twist
from frot.compiler.mechanics.liaisons.joints import Pairing
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.translations import LEFT
from frot.compiler.mechanics.points import Point, is_particle, point_body
from frot.compiler.mechanics.spatial import Z, cross
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Expression, Liaison


@dataclass(frozen=True, slots=True, eq=False)
class GuideEnd(Lock):
    """One end of a guide stays on the axis, in one direction beside it; `end` is +1 or -1."""

    axis: Axis
    side: int
    half_length: Expression
    end: int

    @property
    def presses(self) -> int:
        """As the force at this end."""
        return 0 if self.end > 0 else 1

    def between(self, at: Between) -> Action:
        """A force at the end; the motion is one about the other end."""
        local, length = self.axis.unit(at.lower), self.end * at.lower(self.half_length)
        beside = cross(Z, local) if self.side == LEFT else self.axis.beside(at.lower)[self.side]
        way, along = at.a.direction(beside), at.b.direction(local)
        couple = length * cross(along, way)
        column = Column(couple / (2 * length * length), way / 2)
        return Action(way, couple, column, ca.dot(way, at.way + length * along))


@dataclass(frozen=True, slots=True, eq=False)
class GuideTwist(Lock):
    """No turn about the axis of a guide; its unit is one of force at `radius` from the axis."""

    axis: Axis
    radius: Expression | None
    turns = True

    @property
    def presses(self) -> int | None:
        """At the radius, if there is one."""
        return None if self.radius is None else 2

    def between(self, at: Between) -> Action:
        """A direction beside the axis of a stays perpendicular to the next one of b."""
        one, other = self.axis.beside(at.lower)
        first, second = at.a.direction(one), at.b.direction(other)
        arm = ca.SX(1) if self.radius is None else at.lower(self.radius)
        return twist(arm * cross(second, first), arm * ca.dot(first, second))


def with_guide(pairing: Pairing, liaison: Liaison, planar: bool) -> Pairing:
    """A prismatic liaison whose locks are what its guide presses with, where a law says how long.

    A particle turns no guide.
    """
    law = next((law for law in liaison.laws if "half_length" in law.arguments), None)
    if law is None or liaison.kind.name != "prismatique" or _has_particle(liaison):
        return pairing
    axis = Axis(liaison.options.get("axis", "x"))
    length, radius = law.arguments["half_length"], law.arguments.get("radius")
    sides = (LEFT,) if planar else (0, 1)
    ends = tuple(GuideEnd(axis, side, length, end) for end in (1, -1) for side in sides)
    return replace(pairing, locks=ends if planar else (*ends, GuideTwist(axis, radius)))


def _has_particle(liaison: Liaison) -> bool:
    places = (x for x in (liaison.a, liaison.b) if isinstance(x, Point))
    return any(is_particle(point_body(x)) for x in places)
