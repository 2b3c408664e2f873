"""What mechanics asks of a shape."""

from __future__ import annotations

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
