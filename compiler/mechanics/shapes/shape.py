"""What mechanics asks of a shape."""

from __future__ import annotations

import math

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure, Placed
from frot.compiler.mechanics.spatial import nowhere
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body, BodyGeometry, BodyPoint


class Shape:
    """A shape of body; `lower` makes expressions of its arguments."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """Inertia (3 x 3, kg.m^2) about G in the body's axes."""
        raise NotImplementedError

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """A named point (3, m) in the body's axes at G, which many have alone."""
        return nowhere()

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """The figure of a rim, a surface, a face, ...; None of one that has no figure yet."""
        return None

    def outside(self, part: BodyGeometry, lower: Lower) -> ca.SX:
        """In the plane the side of a curve that its matter leaves free: +1 left, 0 both."""
        return ca.SX(0)

    def corners(self, face: BodyGeometry) -> tuple[BodyPoint, ...]:
        """The corners of a face, or of a side; none of what is neither."""
        return ()

    def ends(self, part: BodyGeometry) -> tuple[BodyPoint | BodyGeometry, ...]:
        """The rims or points in which a side or an axis ends; none of what is neither."""
        return ()

    def edges(self, face: BodyGeometry) -> tuple[BodyGeometry, ...]:
        """The edges of a face in space; none of what is none."""
        return ()


def at_centre(part: BodyGeometry, figure: Figure) -> Placed:
    """A figure about G."""
    return Placed(BodyPoint(part.body, "G", part.span), figure)


# Corners of the polygon that stands for a round face in space: its sides are tangent to the rim, of
# which one faces each axis of the body.
ROUND_CORNERS = 8


def round_corners(rim: BodyGeometry) -> tuple[BodyPoint, ...]:
    """The corners of the regular polygon about a rim."""
    names = (f"{rim.name}.corners[{k}]" for k in range(1, ROUND_CORNERS + 1))
    return tuple(BodyPoint(rim.body, name, rim.span) for name in names)


def round_corner(name: str, radius: ca.SX) -> ca.SX:
    """The place (3, m) of the corner of a rim, as `rim.corners[3]`, from the centre of that."""
    corner = item_of(name.rpartition(".")[2], "corners")
    if not corner:
        return nowhere()
    angle = (2 * corner - 1) * math.pi / ROUND_CORNERS
    far = radius / math.cos(math.pi / ROUND_CORNERS)
    return ca.sparsify(ca.vertcat(far * math.cos(angle), far * math.sin(angle), 0))


def principal(first: ca.SX, second: ca.SX, third: ca.SX) -> ca.SX:
    """The inertia with these moments about the body's axes; what is zero has no entry."""
    matrix = ca.SX(3, 3)
    for k, moment in enumerate((first, second, third)):
        matrix[k, k] = moment
    return ca.sparsify(matrix)


def given_inertia(value: ca.SX, planar: bool) -> ca.SX:
    """Inertia (3 x 3) from what the text gives: one moment about z, three, or the matrix."""
    if planar:
        return principal(ca.SX(0), ca.SX(0), value)
    return principal(*ca.vertsplit(value)) if value.numel() == 3 else value


def item_of(name: str, what: str) -> int:
    """The number k of the point `what[k]`, 0 for another."""
    return int(name[len(what) + 1 : -1]) if name.startswith(f"{what}[") else 0
