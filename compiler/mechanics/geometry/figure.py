"""What a figure knows of itself: its points, the function that is zero on it, how far it reaches.

A figure is given in the axes of a point of its body, which is its centre, or a point of it where it
has none. How two figures touch stands in `closest_closed_form.py`, and where no formula says it in
`closest_solved.py`; both ask the figures.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.spatial import GROUND, Pose, cross, nowhere, whole
from frot.compiler.mechanics.values import Axis, Lower
from frot.compiler.translate.walk import is_fixed
from frot.dsl.checked import BodyPoint, Expression, Frame

Point = BodyPoint | Frame

# What a liaison loses at a figure: in words, the names of the numbers that tell where, the
# distance from there, these numbers.
Loss = tuple[str, tuple[str, ...], ca.SX, ca.SX]
NO_PLACE = "no single place of '{}' is the nearest"


class Figure:
    """A point, a curve or a surface; what one kind has not, it says no to."""

    __slots__ = ()

    @property
    def parameters(self) -> int:
        """The number of parameters of its points, -1 of a figure that is given otherwise."""
        return -1

    @property
    def rank(self) -> int:
        """Its place among those that are where a function is zero, -1 of another.

        Those come first whose function tells most: where it is the distance.
        """
        return -1

    @property
    def is_point(self) -> bool:
        """Whether it is one point."""
        return self.parameters == 0

    @property
    def is_surface(self) -> bool:
        """Whether points on it have two freedoms; in the plane those of a line or a circle one."""
        return self.rank >= 0 or self.parameters == 2

    @property
    def is_thin(self) -> bool:
        """A point or a line: two of them meet by more than one relation, or cross."""
        return False

    @property
    def is_round(self) -> bool:
        """Whether it looks the same however it turns, and is no point."""
        return False

    @property
    def is_hollow(self) -> bool:
        """Whether others may be inside of it, as in a bowl."""
        return False

    @property
    def is_steep(self) -> bool:
        """Whether its function is the distance to first order only."""
        return False

    @property
    def rolls(self) -> bool:
        """Whether it may roll on a plane, its angular velocity the only speed along that."""
        return False

    @property
    def bends(self) -> bool:
        """Whether the material elements of a curve move along it as time tells."""
        return False

    @property
    def line(self) -> Axis | None:
        """The direction of a straight line; None of what is none."""
        return None

    @property
    def plane(self) -> Axis | None:
        """The normal of a plane, in the plane the direction of a line whose left is the normal."""
        return None

    @property
    def tube(self) -> tuple[Axis, Expression] | None:
        """The axis and the radius of a round cylinder; None of what is none."""
        return None

    @property
    def straight(self) -> Axis | None:
        """The direction of a straight line, or of the axis of a round cylinder."""
        return self.line or (self.tube[0] if self.tube else None)

    @property
    def long(self) -> Expression | None:
        """How long a straight line or a cylinder is that ends."""
        return None

    @property
    def outwards(self) -> tuple[Axis, ...]:
        """The normals of the faces that meet in an edge."""
        return ()

    @property
    def oval(self) -> Axis | None:
        """The normal of the plane of a circle or an ellipse in space; None of what is none."""
        return None

    @property
    def walls(self) -> tuple[Figure, ...]:
        """The surfaces in which a curve is where they meet, none where it is not given so."""
        return ()

    def point(self, u: ca.SX, lower: Lower) -> ca.SX:
        """The point (3) with these parameters in the axes of its centre."""
        (a, first), (b, second) = self.semi_axes(lower)
        return ca.sparsify(a * ca.cos(u) * first + b * ca.sin(u) * second)

    def parameter(self, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
        """The parameter of the point `apart` from its centre; an angle within half a turn."""
        (a, first), (b, second) = self.semi_axes(lower)
        x, y = (ca.dot(pose.direction(e), apart) for e in (first, second))
        return ca.atan2(y / b, x / a)

    def semi_axes(self, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
        """Lengths and directions of those of a circle or an ellipse."""
        raise NotImplementedError

    @property
    def has_ends(self) -> bool:
        """Whether the parameter of a curve ends somewhere."""
        return False

    def ends(self, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """The least and the largest parameter of a curve that has ends."""
        raise NotImplementedError

    def limits(self, lower: Lower) -> Iterator[tuple[int, ca.SX, ca.SX]]:
        """The parameters of a surface that end: the place of each, its least and its largest."""
        yield from ()

    @property
    def borders(self) -> tuple[tuple[Axis, Expression], ...]:
        """Directions along which a surface ends at half of a length on either side of its place."""
        return ()

    @property
    def depth(self) -> Expression | None:
        """How far the body of a face reaches behind it."""
        return None

    def middle(self, lower: Lower) -> ca.SX:
        """A point (3) amid its points, in its axes: between its ends, or its centre."""
        if not self.has_ends:
            return nowhere()
        least, largest = self.ends(lower)
        return self.point((least + largest) / 2, lower)

    def beginnings(self, lower: Lower) -> list[ca.SX]:
        """Parameters from which a search begins; none where a formula gives the nearest."""
        return []

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """What is zero on it, at a place (3) in its axes, and grows outwards."""
        raise NotImplementedError

    def beyond(self, x: ca.SX, lower: Lower) -> ca.SX | None:
        """A length that has the sign of the side of a closed curve of the plane: outside +1.

        Of the place (3) in its axes; None of what is not known to be closed.
        """
        return None

    def radius_in(self, lower: Lower) -> ca.SX:
        """The radius of what is round about its place; zero of a point or a line."""
        raise NotImplementedError

    def spread(self, pose: Pose, lower: Lower) -> ca.SX:
        """The matrix S of an ellipsoid, flat or not: it reaches sqrt(n . S n) in a direction n."""
        raise NotImplementedError

    def below(self, pose: Pose, normal: ca.SX, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """How far it reaches along a normal, and the vector (3) to there from its centre.

        The point of x . S^-1 x = 1 whose normal is n: S n/sqrt(n . S n).
        """
        low = self.spread(pose, lower) @ normal
        reach = ca.sqrt(ca.dot(normal, low))
        return reach, low / reach

    def reach(self, lower: Lower) -> ca.SX:
        """How far it reaches from its centre, but for a root of three."""
        return ca.sqrt(ca.trace(self.spread(GROUND, lower)))

    def facing(self, slope: ca.SX, side: ca.SX, lower: Lower) -> ca.SX | None:
        """The point (3) whose normal is along a slope, in its axes; None where none is known.

        `side` is -1 for the one whose normal is against it.
        """
        return None

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """How far a `place` with the parameters `s` is from where a tangent or normal is lost."""
        yield from ()


def local_of(pose: Pose, place: ca.SX) -> ca.SX:
    """A place in ground axes, in those of a pose."""
    return ca.densify(pose.axes.T @ (place - pose.origin))


def lost_axis(axis: Axis, lower: Lower) -> Iterator[Loss]:
    """That an axis that changes may have no direction."""
    if isinstance(axis.given, Expression) and not is_fixed(axis.given):
        size = ca.norm_2(whole(lower(axis.given)))
        yield "'{}' has no direction", (), size, ca.SX.zeros(0)


def lost_on_axis(
    axis: Axis, size: Expression, pose: Pose, place: ca.SX, lower: Lower
) -> Iterator[Loss]:
    """That on its axis nothing round has a nearest place: the distance in radii."""
    across = cross(axis.unit(lower), local_of(pose, place) / lower(size))
    yield NO_PLACE, (), ca.norm_2(across), ca.SX.zeros(0)


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A figure at a point of a body."""

    point: Point
    figure: Figure
