"""Turning about an axis, alone or with an advance along it: pin, universal joint, screw."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import casadi as ca
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Between
from frot.compiler.mechanics.liaisons.joint_places import JointPlaces, joint_coordinate
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion, Seen
from frot.compiler.mechanics.liaisons.moves import Column, Moved, along_way, turned
from frot.compiler.mechanics.spatial import Moving, Pose, Z, beside, counted, cross, nowhere
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Expression


@dataclass(frozen=True, slots=True, eq=False)
class Arc:
    """The angle of a turn: its sine and cosine, and the vector whose part of omega is its rate."""

    about: ca.SX
    sine: ca.SX
    cosine: ca.SX

    @property
    def angle(self) -> ca.SX:
        """Within half a turn."""
        return ca.atan2(self.sine, self.cosine)

    def beyond(self, value: ca.SX) -> ca.SX:
        """What the angle has more than a value, within half a turn."""
        c, s = ca.cos(value), ca.sin(value)
        return ca.atan2(self.sine * c - self.cosine * s, self.cosine * c + self.sine * s)


@dataclass(frozen=True, slots=True, eq=False)
class Turn(Motion):
    """By an angle about an axis that both bodies keep.

    `mark`: the other axis of a universal joint, which shows the angle; None where any direction
    beside the axis does. `on_b`: then the axis is fixed to b, else to a.
    """

    axis: Axis
    sign: int = 1
    coordinates: tuple[str, ...] = ("angle",)
    mark: Axis | None = None
    on_b: bool = False
    turns = True
    hinges = True
    comes_round = True

    @property
    def keeps_axis(self) -> bool:  # type: ignore[override]
        """About an axis n(time) of both bodies: what n' adds to omega is across n."""
        return self.mark is None

    def reversed(self) -> Self:
        """By the opposite angle."""
        return replace(self, sign=-self.sign)

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The column is the axis."""
        local = self.axis.unit(lower)
        along = self.sign * base.pose.direction(local)
        angle, rate = self.sign * q, self.sign * v
        moving = turned(base, local, angle, rate, base.pose.direction(local), lower)
        return Moved(moving, (Column(along, nowhere()),), nowhere())

    def arc(self, a: Pose, b: Pose, lower: Lower) -> Arc:
        """The angle by which b is turned from a.

        Of a universal joint with the axes e and f, the part of omega along e beside f is wanted: it
        is omega . (x x f)/|x|^2 with x = f x e.
        """
        if self.mark is None:
            return arc_about(self.axis, a, b, lower)
        local = self.axis.unit(lower)
        mark = self.mark.unit(lower)
        own = (b if self.on_b else a).direction(local)
        other = (a if self.on_b else b).direction(mark)
        start, end, normal = a.direction(mark), b.direction(mark), cross(other, own)
        return Arc(
            cross(normal, other) / ca.sumsqr(normal),
            ca.dot(own, cross(start, end)),
            ca.dot(start, end) - ca.dot(own, start) * ca.dot(own, end),
        )

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """By the axes of both."""
        if self.mark is None:
            return _seen_about(self.axis, a, b, lower)
        found = self.arc(a.pose, b.pose, lower)
        return found.angle, ca.dot(found.about, b.angular - a.angular)

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """A couple."""
        return nowhere(), self.arc(at.a, at.b, at.lower).about

    def hold(self, value: ca.SX, at: Between) -> Action:
        """A couple; the gap is within half a revolution."""
        found = self.arc(at.a, at.b, at.lower)
        apart = found.beyond(value)
        turn = (at.b if self.on_b else at.a).direction(self.axis.unit(at.lower))
        return Action(nowhere(), found.about, Column(turn, nowhere()), apart)


@dataclass(frozen=True, slots=True, eq=False)
class Screw(Motion):
    """By an angle about an axis and a length along it, `pitch` for each turn.

    Where it closes a loop its way tells which turn it is in.
    """

    axis: Axis
    pitch: Expression
    sign: int = 1
    coordinates = ("angle",)
    turns = True
    keeps_axis = True

    def reversed(self) -> Self:
        """By the opposite angle."""
        return replace(self, sign=-self.sign)

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """First along, then about the axis: they commute."""
        local = self.axis.unit(lower)
        advance = lower(self.pitch) / (2 * ca.pi) * self.sign * local
        way, slid, far = along_way(advance, base, q, v, lower)
        angle, rate = self.sign * q, self.sign * v
        moving = turned(slid, local, angle, rate, base.pose.direction(local), lower)
        return Moved(moving, (Column(self.sign * base.pose.direction(local), way),), far)

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """By its angle, and its way."""
        _, rate = _seen_about(self.axis, a, b, lower)
        return self._angle(a.pose, b.pose, lower), rate

    def _angle(self, a: Pose, b: Pose, lower: Lower) -> ca.SX:
        """With whole turns; within half a turn without pitch."""
        along, pitch = a.direction(self.axis.unit(lower)), lower(self.pitch)
        angle = angle_about(self.axis, a, b, lower)
        by_way = 2 * ca.pi * ca.dot(along, b.origin - a.origin) / ca.if_else(pitch, pitch, 1)
        return counted(angle, ca.if_else(pitch, by_way, angle))

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """A couple."""
        return nowhere(), arc_about(self.axis, at.a, at.b, at.lower).about

    def hold(self, value: ca.SX, at: Between) -> Action:
        """A couple; the motion is that of the screw."""
        found = arc_about(self.axis, at.a, at.b, at.lower)
        apart = self._angle(at.a, at.b, at.lower) - value
        turn = at.a.direction(self.axis.unit(at.lower))
        linear = at.lower(self.pitch) / (2 * ca.pi) * turn
        return Action(nowhere(), found.about, Column(turn, linear), apart)


@dataclass(frozen=True, slots=True, eq=False)
class ScrewCoupling(Lock):
    """Advance along an axis only with a turn."""

    axis: Axis
    pitch: Expression
    presses = 0

    def turn(self, joint: JointPlaces, kinematics: Kinematics) -> ca.SX:
        """That of the screw, with its whole turns."""
        return joint_coordinate(joint, 0, kinematics)[0]

    def between(self, at: Between) -> Action:
        """A force F along e comes with the couple -F pitch/2 pi: no work on the screw's motion."""
        turn = angle_about(self.axis, at.a, at.b, at.lower) if at.turn is None else at.turn
        along = at.a.direction(self.axis.unit(at.lower))
        advance = at.lower(self.pitch) / (2 * ca.pi)
        gap = ca.dot(along, at.way) - advance * turn
        return Action(along, -advance * along, Column(nowhere(), along), gap)


def arc_about(axis: Axis, a: Pose, b: Pose, lower: Lower) -> Arc:
    """The angle by which b is turned from a about an axis of both, by a direction beside it."""
    local = axis.unit(lower)
    first, second = (a.direction(e) for e in beside(local))
    mark = b.direction(beside(local)[0])
    return Arc(a.direction(local), ca.dot(mark, second), ca.dot(mark, first))


def angle_about(axis: Axis, a: Pose, b: Pose, lower: Lower) -> ca.SX:
    """The angle of that; in the plane with its turns."""
    if axis.unit(lower) is Z and a.axes[2, 2].is_one() and b.axes[2, 2].is_one():
        return b.angle - a.angle
    return arc_about(axis, a, b, lower).angle


def _seen_about(axis: Axis, a: Moving, b: Moving, lower: Lower) -> Seen:
    along = a.pose.direction(axis.unit(lower))
    return angle_about(axis, a.pose, b.pose, lower), ca.dot(along, b.angular - a.angular)
