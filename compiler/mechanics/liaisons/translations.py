"""Ways between the places of two bodies: along them, none along them, and their distance."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Self

import casadi as ca
from frot.compiler.mechanics.liaisons.actions import Action, Between, push
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion, Seen
from frot.compiler.mechanics.liaisons.moves import Column, Moved, along_way
from frot.compiler.mechanics.spatial import Moving, Pose, X, Y, Z, cross, nowhere
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Expression

LEFT = 2


@dataclass(frozen=True, slots=True, eq=False)
class Slide(Motion):
    """By a length along an axis fixed to the base, or along one of the two beside it (`side`)."""

    axis: Axis
    side: int | None = None
    sign: int = 1
    coordinates: tuple[str, ...] = ("displacement",)
    slides = True

    def way(self, lower: Lower) -> ca.SX:
        """Where it goes."""
        return self.axis.unit(lower) if self.side is None else self.axis.beside(lower)[self.side]

    def reversed(self) -> Self:
        """By the opposite length."""
        return replace(self, sign=-self.sign)

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The column is the way."""
        along, slid, way = along_way(self.sign * self.way(lower), base, q, v, lower)
        return Moved(slid, (Column(nowhere(), along),), way)

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """By the place of b in the axes of a."""
        along, there = a.pose.direction(self.way(lower)), b.pose.origin
        rate = ca.dot(along, b.linear - a.velocity_of(there))
        return ca.dot(along, there - a.pose.origin), rate

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """A force."""
        return at.a.direction(self.way(at.lower)), nowhere()

    def hold(self, value: ca.SX, at: Between) -> Action:
        """A force."""
        way = at.a.direction(self.way(at.lower))
        return push(way, ca.dot(way, at.way) - value)


@dataclass(frozen=True, slots=True, eq=False)
class Reach(Motion):
    """The distance of two places, of a rod that is drawn out: it is seen, and carries nothing."""

    coordinates = ("length",)

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """The length of the way."""
        way = b.pose.origin - a.pose.origin
        long = ca.sqrt(ca.sumsqr(way))
        return long, ca.dot(way / long, b.linear - a.linear)

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """A force along the way."""
        way = at.way
        return way / ca.sqrt(ca.sumsqr(way)), nowhere()


@dataclass(frozen=True, slots=True, eq=False)
class FixedPoint(Lock):
    """No way along an axis of the ground (0, 1, 2): of a liaison that leaves no way at all."""

    axis: int
    presses = 0

    @property
    def ground_axis(self) -> int:
        """It."""
        return self.axis

    def turning_with_a(self, axis: Axis) -> Lock:
        """The axis itself is the last."""
        return FixedAlong(axis, (0, 1, None)[self.axis])

    def between(self, at: Between) -> Action:
        """A force along the axis."""
        return push((X, Y, Z)[self.axis], at.b.origin[self.axis] - at.a.origin[self.axis])


@dataclass(frozen=True, slots=True, eq=False)
class FixedAlong(Lock):
    """No way along an axis of a, along one of the two beside it, or to its left (`side`)."""

    axis: Axis
    side: int | None = None
    presses = 0

    def between(self, at: Between) -> Action:
        """E . (b - a) with e fixed to a, which sweeps the place b along."""
        way = _along(at.a, self.axis, at.lower, self.side)
        return push(way, ca.dot(way, at.way))


@dataclass(frozen=True, slots=True, eq=False)
class FixedDistance(Lock):
    """The places keep a distance, which time may change."""

    length: Expression
    presses = 0

    def told(self, values: Mapping[str, Expression]) -> Lock:
        """The length that is reported."""
        return FixedDistance(values["length"]) if "length" in values else self

    def let_go(self, prescribed: Collection[str]) -> Motion | None:
        """The distance is seen."""
        return Reach() if "length" in prescribed else None

    def between(self, at: Between) -> Action:
        """Places that coincide have no direction: a search that ends there is reported."""
        way, size = at.way, at.lower(self.length)
        long = ca.sqrt(ca.sumsqr(way))
        way = way / ca.if_else(long > 0, long, 1)
        return replace(push(way, long - size), measure=long, length=size)


def _along(pose: Pose, axis: Axis, lower: Lower, side: int | None) -> ca.SX:
    """Ground components of an axis, of one of the two beside it, or of its left in the plane."""
    if side is not None and side != LEFT:
        return pose.direction(axis.beside(lower)[side])
    local = axis.unit(lower)
    return pose.direction(local if side is None else cross(Z, local))
