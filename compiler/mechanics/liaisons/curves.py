"""A point on a curve, and curves that are tangent."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

import casadi as ca
from frot.compiler.mechanics.geometry.closest_solved import Track, along, tangency
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.parametric_figures import slope_at
from frot.compiler.mechanics.geometry.planes import PointFigure
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Between, push
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Carrier, Motion, Seen
from frot.compiler.mechanics.liaisons.moves import AlongCurve, Column, Moved, slid
from frot.compiler.mechanics.spatial import Moving, Pose, beside_moving, nowhere
from frot.compiler.mechanics.values import Lower, rate_by_time

# A tangent vanishes that is less than this part of the one beside it, by this part of the curve.
CUSP = 1e-9
BESIDE = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class PointOnCurve(Motion):
    """Along a curve fixed to the base, by its parameter."""

    curve: Figure = field()
    sign: int = 1
    coordinates = ("u",)
    comes_round = True

    def reversed(self) -> Self:
        """Of the base along the curve."""
        return replace(self, sign=-self.sign)

    def carry(
        self, kinematics: Kinematics, carrier: Carrier, base: Moving, q: ca.SX, v: ca.SX
    ) -> Moved:
        """Without a guess it begins at 0, or at the end of the curve that is nearest to that.

        Where the curve has a cusp there, a part of the way to its farther end beside it.
        """
        lower = kinematics.fixed.lower
        if self.curve.has_ends:
            least, largest = self.curve.ends(lower)
            start = ca.fmin(ca.fmax(0, least), largest)
            farther = ca.if_else(largest - start > start - least, largest, least)
            beside = start + BESIDE * (farther - start)
            here, there = (ca.sumsqr(slope_at(self.curve, u, lower)) for u in (start, beside))
            kinematics.starts[carrier.own] = ca.if_else(here <= CUSP**2 * there, beside, start)
        return self.move(base, q, v, lower)

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The material element of the curve may move too: its parameter stays with it."""
        u = ca.SX.sym("u")
        point = self.sign * self.curve.point(u, lower)
        along, drift = ca.jacobian(point, u), rate_by_time(point, lower)
        bends = ca.jacobian(along, u) * v**2 + 2 * rate_by_time(along, lower) * v
        bends += rate_by_time(drift, lower)
        local = [ca.SX(x) for x in ca.substitute([point, along, drift, bends], [u], [q])]
        way, along, drift, bends = (base.pose.direction(ca.sparsify(x)) for x in local)
        moving = slid(base, way, along * v + drift, bends)
        return Moved(moving, (Column(nowhere(), along),), way, AlongCurve(q, v, along))

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """By the place of b, whose way along the curve has the rate v . c_u/|c_u|^2."""
        there = b.pose.origin
        at = self.curve.parameter(there - a.pose.origin, a.pose, lower)
        along = a.pose.direction(slope_at(self.curve, at, lower))
        moves = b.linear - a.velocity_of(there)
        return at, ca.dot(moves, along) / ca.sumsqr(along)

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """A force along the tangent."""
        tangent = at.tangent
        if at.track is not None and at.track.trace is not None:
            tangent = at.track.trace.slopes[0]
        elif tangent is None:
            here = self.curve.parameter(at.way, at.a, at.lower)
            tangent = at.a.direction(slope_at(self.curve, here, at.lower))
        return tangent / ca.sumsqr(tangent), nowhere()

    def hold(self, value: ca.SX, at: Between) -> Action:
        """To first order, and exact where the place is the one of the value."""
        u = ca.SX.sym("u")
        point = self.curve.point(u, at.lower)
        here, slope = ca.substitute([point, ca.jacobian(point, u)], [u], [value])
        along, there = at.a.direction(slope), at.a.point(here)
        force = along / ca.sumsqr(along)
        gap = ca.dot(force, at.b.origin - there)
        return Action(force, nowhere(), Column(nowhere(), along), gap)


@dataclass(frozen=True, slots=True, eq=False)
class Across(Lock):
    """No way beside a curve on which b is, in one of two directions."""

    curve: Figure
    side: int
    by_coordinates = True
    presses = 0

    @property
    def is_followed(self) -> bool:
        """Where coordinates do not keep b on the curve."""
        return True

    @property
    def figures(self) -> tuple[Figure, Figure] | None:
        """The curve and a point."""
        return (self.curve, PointFigure()) if self.side == 0 else None

    def find(self, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
        """The nearest point of the curve."""
        return along(self.curve, at, lower)

    def act(self, at: Between) -> Action:
        """Beside a tangent; what coordinates do not keep on its curve has a way to it."""
        if at.tangent is not None:
            return push(self._beside(at.tangent), ca.SX(0))
        assert at.track is not None and at.track.trace is not None
        force, found = self._beside(at.track.trace.slopes[0]), at.track.touch
        own = ca.dot(force, found.drift)
        return replace(push(force, ca.dot(force, found.normal)), own=own)

    def _beside(self, slope: ca.SX) -> ca.SX:
        return beside_moving(slope / ca.norm_2(slope))[self.side]


@dataclass(frozen=True, slots=True, eq=False)
class Tangent(Lock):
    """Two curves in space are tangent: no way in two directions beside them (0, 1), or no angle.

    Curves that meet have one relation (they cross), tangent ones two more. One of these two says
    how the place moves along the curves, the other, across the plane in which they bend apart,
    is the third relation (2).
    """

    a: Figure
    b: Figure
    part: int

    @property
    def turns(self) -> bool:  # type: ignore[override]
        """The angle does."""
        return self.part == 2

    @property
    def presses(self) -> int | None:
        """Across the tangent; the force of the angle's wrench is along it."""
        return None if self.turns else 0

    @property
    def to_first_order(self) -> bool:
        """The place moves along with the angle."""
        return self.part == 2

    @property
    def is_followed(self) -> bool:
        """Always."""
        return True

    @property
    def figures(self) -> tuple[Figure, Figure] | None:
        """The two."""
        return (self.a, self.b) if self.part == 0 else None

    def find(self, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
        """Where they are tangent."""
        return tangency(self.a, self.b, at, lower)

    def act(self, at: Between) -> Action:
        """As the place was found."""
        assert at.track is not None
        found, touch = at.track.meeting[self.part], at.track.touch
        still = Column(nowhere(), nowhere())
        action = Action(found.force, found.couple, still, found.gap, found.own, found.place)
        return replace(action, drift=touch.drift, normal=touch.normal)
