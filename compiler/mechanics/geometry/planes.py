"""Points, planes, lines and round cylinders."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure, Loss, lost_axis, lost_on_axis
from frot.compiler.mechanics.spatial import Pose, Z, cross, nowhere, whole
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Expression


@dataclass(frozen=True, slots=True, eq=False)
class PointFigure(Figure):
    """A point."""

    @property
    def parameters(self) -> int:
        """It has no other points."""
        return 0

    @property
    def is_thin(self) -> bool:
        """A point is."""
        return True

    def radius_in(self, lower: Lower) -> ca.SX:
        """None."""
        return ca.SX(0)

    def below(self, pose: Pose, normal: ca.SX, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """It reaches nowhere."""
        return ca.SX(0), nowhere()


@dataclass(frozen=True, slots=True, eq=False)
class CordCircle(Figure):
    """How far a thread lets a point go from its other end."""

    length: Expression

    def parameter(self, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
        """None: it turns with nobody."""
        return ca.SX(0)


@dataclass(frozen=True, slots=True, eq=False)
class PlaneSurface(Figure):
    """A plane with its normal; in the plane a line with its direction, whose left is the normal.

    `depth`: how far the body of a face reaches behind it.
    """

    axis: Axis
    in_plane: bool
    borders: tuple[tuple[Axis, Expression], ...] = ()
    depth: Expression | None = None

    @property
    def rank(self) -> int:
        """The distance from a plane is linear."""
        return 0

    @property
    def plane(self) -> Axis:
        """The normal, or the direction of the line."""
        return self.axis

    def normal(self, lower: Lower) -> ca.SX:
        """The normal (3) in its axes."""
        axis = self.axis.unit(lower)
        return cross(Z, axis) if self.in_plane else axis

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """The height."""
        return ca.dot(self.normal(lower), x)

    def point(self, u: ca.SX, lower: Lower) -> ca.SX:
        """Of a line of the plane, by the length along it."""
        return ca.sparsify(u * self.axis.unit(lower))

    def parameter(self, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
        """The length along the line."""
        return ca.dot(pose.direction(self.axis.unit(lower)), apart)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """Its direction."""
        return lost_axis(self.axis, lower)


@dataclass(frozen=True, slots=True, eq=False)
class Segment(PlaneSurface):
    """A line of the plane with ends: the side of a polygon or a box, a rod.

    As long as `long` on both sides of its point or, without it, as its direction from there on.
    """

    long: Expression | None = None

    @property
    def parameters(self) -> int:
        """The length along it."""
        return 1

    @property
    def rank(self) -> int:
        """Beside it its height is not the distance."""
        return -1

    @property
    def has_ends(self) -> bool:
        """It does."""
        return True

    def ends(self, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """Half of its length on either side, or from zero on."""
        if self.long is not None:
            return _halves(self.long, lower)
        assert isinstance(self.axis.given, Expression)
        return ca.SX(0), ca.norm_2(whole(lower(self.axis.given)))


def _halves(long: Expression, lower: Lower) -> tuple[ca.SX, ca.SX]:
    half = lower(long) / 2
    return -half, half


@dataclass(frozen=True, slots=True, eq=False)
class LineOrCylinder(Figure):
    """A line in space, or with a radius a round cylinder about it.

    What is `long` ends at half of that on both sides of its point. `outwards`: the normals of the
    faces of which a line is the edge.
    """

    axis: Axis
    radius: Expression | None
    long: Expression | None = None
    outwards: tuple[Axis, ...] = ()

    @property
    def parameters(self) -> int:
        """The length along a line."""
        return 1 if self.radius is None else -1

    @property
    def rank(self) -> int:
        """The function of a cylinder is the distance."""
        return -1 if self.radius is None else 2

    @property
    def is_thin(self) -> bool:
        """A line is."""
        return self.radius is None

    @property
    def has_ends(self) -> bool:
        """A line, where a length is given."""
        return self.radius is None and self.long is not None

    def ends(self, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """Half of its length on either side."""
        assert self.long is not None
        return _halves(self.long, lower)

    @property
    def borders(self) -> tuple[tuple[Axis, Expression], ...]:
        """A cylinder's, where a length is given."""
        return () if self.radius is None or self.long is None else ((self.axis, self.long),)

    @property
    def bends(self) -> bool:
        """What turns about moves its elements."""
        return self.radius is None and self.axis.turns

    @property
    def line(self) -> Axis | None:
        """Along the line."""
        return self.axis if self.radius is None else None

    @property
    def tube(self) -> tuple[Axis, Expression] | None:
        """With a radius."""
        return None if self.radius is None else (self.axis, self.radius)

    def point(self, u: ca.SX, lower: Lower) -> ca.SX:
        """By the length along it."""
        return ca.sparsify(u * self.axis.unit(lower))

    def parameter(self, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
        """The length along it."""
        return ca.dot(pose.direction(self.axis.unit(lower)), apart)

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """The distance from the axis, less the radius."""
        axis = self.axis.unit(lower)
        return ca.sqrt(ca.sumsqr(x - ca.dot(axis, x) * axis)) - self.radius_in(lower)

    def radius_in(self, lower: Lower) -> ca.SX:
        """About the axis."""
        return ca.SX(0) if self.radius is None else lower(self.radius)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The nearest place on the axis of a cylinder; the direction."""
        if self.radius is not None:
            yield from lost_on_axis(self.axis, self.radius, pose, place, lower)
        yield from lost_axis(self.axis, lower)
