"""Locks between the directions of two bodies: no turn, or turns about one axis alone."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.liaisons.actions import Action, Between, twist
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.spatial import Z, cross
from frot.compiler.mechanics.values import Axis


class _Turning(Lock):
    """What keeps from turning."""

    __slots__ = ()

    turns = True


@dataclass(frozen=True, slots=True, eq=False)
class Parallel(_Turning):
    """An axis of b stays perpendicular to one of the two beside the same axis of a.

    Two of them keep the axes parallel.
    """

    axis: Axis
    side: int

    @property
    def turns_about(self) -> Axis:
        """The one of b, and of a."""
        return self.axis

    def between(self, at: Between) -> Action:
        """As of two axes."""
        return Alongside(self.axis, self.axis, self.side).between(at)


@dataclass(frozen=True, slots=True, eq=False)
class Alongside(_Turning):
    """An axis of b stays perpendicular to one of the two beside another one of a.

    Two of them keep the axes parallel, or against each other.
    """

    axis_a: Axis
    axis_b: Axis
    side: int

    def between(self, at: Between) -> Action:
        """e_b . s_a = 0: its rate is (omega_b - omega_a) . (e_b x s_a)."""
        own = at.b.direction(self.axis_b.unit(at.lower))
        other = at.a.direction(self.axis_a.beside(at.lower)[self.side])
        return twist(cross(own, other), ca.dot(own, other))


@dataclass(frozen=True, slots=True, eq=False)
class Aligned(_Turning):
    """An axis of a stays perpendicular to the next axis of b: three of them allow no turn."""

    axis: int

    def between(self, at: Between) -> Action:
        """i_a . j_b = 0: its rate is (omega_b - omega_a) . (j_b x i_a)."""
        first, second = at.a.axes[:, self.axis], at.b.axes[:, (self.axis + 1) % 3]
        return twist(cross(second, first), ca.dot(first, second))


@dataclass(frozen=True, slots=True, eq=False)
class SameAngle(_Turning):
    """No turn in the plane."""

    def between(self, at: Between) -> Action:
        """The difference of the angles."""
        return twist(Z, at.b.angle - at.a.angle)


@dataclass(frozen=True, slots=True, eq=False)
class Crossed(_Turning):
    """An axis of a and an axis of b keep their angle: those of a universal joint."""

    axis_a: Axis
    axis_b: Axis

    def between(self, at: Between) -> Action:
        """A couple about the normal of both axes, on which neither turn does work."""
        own, other = self.axis_a.unit(at.lower), self.axis_b.unit(at.lower)
        first, second = at.a.direction(own), at.b.direction(other)
        return twist(cross(second, first), ca.dot(first, second) - ca.dot(own, other))


@dataclass(frozen=True, slots=True, eq=False)
class LineParallelToPlane(_Turning):
    """A line at b stays parallel to a plane at a."""

    normal: Axis
    along: Axis

    def between(self, at: Between) -> Action:
        """n_a . d_b = 0."""
        normal, along = self.normal.unit(at.lower), self.along.unit(at.lower)
        normal, along = at.a.direction(normal), at.b.direction(along)
        return twist(cross(along, normal), ca.dot(normal, along))


@dataclass(frozen=True, slots=True, eq=False)
class NoSpin(_Turning):
    """No turn about the normal of a plane of a: of what rolls on a line."""

    axis: Axis
    kinematic = True

    def between(self, at: Between) -> Action:
        """A couple about the normal; no places are its integral."""
        return twist(at.a.direction(self.axis.unit(at.lower)), ca.SX(0))
