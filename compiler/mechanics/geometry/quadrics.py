"""Spheres, circles, ellipses and ellipsoids."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.figure import (
    NO_PLACE,
    Figure,
    Loss,
    local_of,
    lost_axis,
    lost_on_axis,
)
from frot.compiler.mechanics.geometry.implicit_figures import lost_slope
from frot.compiler.mechanics.geometry.planes import LineOrCylinder, PlaneSurface
from frot.compiler.mechanics.spatial import Pose, X, Y
from frot.compiler.mechanics.values import Axis, Lower
from frot.compiler.translate.walk import has_time
from frot.dsl.checked import Expression

TURN = 16  # beginnings looked at along a round curve


@dataclass(frozen=True, slots=True, eq=False)
class SphereSurface(Figure):
    """A sphere, and everything round in the plane. `hollow`: others may be inside of it."""

    radius: Expression
    hollow: bool = False

    @property
    def rank(self) -> int:
        """Its function is the distance."""
        return 1

    @property
    def is_round(self) -> bool:
        """It is."""
        return True

    @property
    def is_hollow(self) -> bool:
        """As it is said."""
        return self.hollow

    @property
    def rolls(self) -> bool:
        """With a radius that stays."""
        return not has_time(self.radius)

    def semi_axes(self, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
        """Of a circle of the plane."""
        radius = lower(self.radius)
        return (radius, X), (radius, Y)

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """The distance from the centre, less the radius."""
        return ca.sqrt(ca.sumsqr(x)) - lower(self.radius)

    def beyond(self, x: ca.SX, lower: Lower) -> ca.SX:
        """The same."""
        return self.function(x, lower)

    def radius_in(self, lower: Lower) -> ca.SX:
        """About the centre."""
        return lower(self.radius)

    def below(self, pose: Pose, normal: ca.SX, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """As far in every direction."""
        radius = lower(self.radius)
        return radius, radius * normal

    def reach(self, lower: Lower) -> ca.SX:
        """The radius."""
        return lower(self.radius)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The nearest place, in the centre."""
        far = ca.norm_2(local_of(pose, place) / lower(self.radius))
        yield NO_PLACE, (), far, ca.SX.zeros(0)


@dataclass(frozen=True, slots=True, eq=False)
class Ring(Figure):
    """A circle in space about an axis."""

    axis: Axis
    radius: Expression

    @property
    def parameters(self) -> int:
        """The angle."""
        return 1

    @property
    def is_thin(self) -> bool:
        """It is a curve."""
        return True

    @property
    def rolls(self) -> bool:
        """On its rim."""
        return True

    @property
    def oval(self) -> Axis:
        """Its axis."""
        return self.axis

    @property
    def walls(self) -> tuple[Figure, ...]:
        """A plane meets a round cylinder."""
        return PlaneSurface(self.axis, False), LineOrCylinder(self.axis, self.radius)

    def semi_axes(self, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
        """Two radii."""
        first, second = self.axis.beside(lower)
        radius = lower(self.radius)
        return (radius, first), (radius, second)

    def beginnings(self, lower: Lower) -> list[ca.SX]:
        """All around."""
        return _all_around()

    def spread(self, pose: Pose, lower: Lower) -> ca.SX:
        """R^2 (1 - n n'): an ellipsoid without thickness."""
        axis = self.axis.unit(lower)
        local = lower(self.radius) ** 2 * (ca.SX.eye(3) - axis @ axis.T)
        return _turned(local, pose)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The nearest place, on the axis; the axis."""
        yield from lost_on_axis(self.axis, self.radius, pose, place, lower)
        yield from lost_axis(self.axis, lower)


@dataclass(frozen=True, slots=True, eq=False)
class EllipseCurve(Figure):
    """An ellipse with semi-axes along two of the axes of its point, or beside its normal."""

    axis: Axis
    a: Expression
    b: Expression

    @property
    def parameters(self) -> int:
        """The angle of the circle that it is stretched from."""
        return 1

    @property
    def is_thin(self) -> bool:
        """It is a curve."""
        return True

    @property
    def bends(self) -> bool:
        """Where it is stretched as time tells."""
        return has_time(self.a) or has_time(self.b)

    @property
    def rolls(self) -> bool:
        """On its rim."""
        return True

    @property
    def oval(self) -> Axis:
        """Its normal."""
        return self.axis

    @property
    def walls(self) -> tuple[Figure, ...]:
        """A plane meets the cylinder over it, which has its own function."""
        return PlaneSurface(self.axis, False), self

    def semi_axes(self, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
        """Its own."""
        first, second = self.axis.beside(lower)
        return (lower(self.a), first), (lower(self.b), second)

    def beginnings(self, lower: Lower) -> list[ca.SX]:
        """All around."""
        return _all_around()

    def beyond(self, x: ca.SX, lower: Lower) -> ca.SX:
        """How far a place is beyond the similar ellipse through it, measured along an axis."""
        (a, first), (b, second) = self.semi_axes(lower)
        part = ca.sqrt((ca.dot(first, x) / a) ** 2 + (ca.dot(second, x) / b) ** 2)
        return (part - 1) * ca.fmin(a, b)

    def spread(self, pose: Pose, lower: Lower) -> ca.SX:
        """A^2 e e' + b^2 f f': an ellipsoid without thickness."""
        first, second = self.axis.beside(lower)
        a, b = lower(self.a), lower(self.b)
        return _turned(a**2 * first @ first.T + b**2 * second @ second.T, pose)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The nearest place, on the axis; the axis."""
        yield from lost_on_axis(self.axis, self.a, pose, place, lower)
        yield from lost_axis(self.axis, lower)


@dataclass(frozen=True, slots=True, eq=False)
class EllipsoidSurface(Figure):
    """An ellipsoid with semi-axes along the axes of its point."""

    semi: Expression

    @property
    def rank(self) -> int:
        """Its function is a distance to first order."""
        return 3

    @property
    def is_steep(self) -> bool:
        """The distance is that over the slope."""
        return True

    @property
    def rolls(self) -> bool:
        """With semi-axes that stay."""
        return not has_time(self.semi)

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """Half of x . S^-1 x - 1."""
        semi = lower(self.semi)
        return (sum(((x[k] / semi[k]) ** 2 for k in range(3)), ca.SX(0)) - 1) / 2

    def spread(self, pose: Pose, lower: Lower) -> ca.SX:
        """The squares of the semi-axes."""
        semi = lower(self.semi)
        return _turned(ca.diag(ca.vertcat(*(semi[k] ** 2 for k in range(3)))), pose)

    def facing(self, slope: ca.SX, side: ca.SX, lower: Lower) -> ca.SX:
        """S n/sqrt(n . S n), the centre where the slope is zero."""
        low = lower(self.semi) ** 2 * ca.densify(slope)
        reach = ca.sqrt(ca.dot(low, slope))
        return side * low / ca.if_else(reach > 0, reach, 1)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The normal, where the slope is zero."""
        return lost_slope(self, pose, place, lower)


def _all_around() -> list[ca.SX]:
    return [ca.SX(2 * ca.pi * k / TURN - ca.pi) for k in range(TURN)]


def _turned(local: ca.SX, pose: Pose) -> ca.SX:
    return ca.sparsify(pose.axes @ ca.sparsify(local) @ pose.axes.T)
