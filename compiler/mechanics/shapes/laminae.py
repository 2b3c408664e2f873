"""Flat bodies in their x-y plane: disc, ring, ellipse, polygon.

For all of them the moment about z is the sum of those about x and y, for z is zero in the body.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry import quadrics as curves
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.planes import Segment
from frot.compiler.mechanics.shapes.shape import (
    Shape,
    at_centre,
    item_of,
    principal,
    round_corner,
    round_corners,
)
from frot.compiler.mechanics.spatial import nowhere
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Binary, Body, BodyGeometry, BodyPoint
from frot.dsl.checked.arrays import element


class _Round(Shape):
    """What has a circle about G."""

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `rim`."""
        if part.name != "rim":
            return None
        radius = part.body.arguments["radius"]
        rim = curves.SphereSurface(radius) if planar else curves.Ring(Axis("z"), radius)
        return at_centre(part, rim)

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """Corners about its rim."""
        return round_corner(name, lower(body.arguments["radius"]))

    def corners(self, face: BodyGeometry) -> tuple[BodyPoint, ...]:
        """Those about its rim."""
        return round_corners(face) if face.name == "rim" else ()


class Disc(_Round):
    """A homogeneous disc."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M r^2/2 about z: the integral of s^2 (m/pi r^2) 2 pi s ds."""
        about_z = 0.5 * lower(body.arguments["mass"]) * lower(body.arguments["radius"]) ** 2
        return principal(about_z / 2, about_z / 2, about_z)

    def outside(self, part: BodyGeometry, lower: Lower) -> ca.SX:
        """The left of a circle is its inside."""
        return ca.SX(-1)


class Ring(_Round):
    """A thin ring: all mass at the radius."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M r^2 about z."""
        about_z = lower(body.arguments["mass"]) * lower(body.arguments["radius"]) ** 2
        return principal(about_z / 2, about_z / 2, about_z)


class Ellipse(Shape):
    """A homogeneous elliptic lamina with semi-axes a along x and b along y."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M b^2/4 about x and m a^2/4 about y: those of a disc, stretched."""
        mass = lower(body.arguments["mass"])
        about_x = mass * lower(body.arguments["b"]) ** 2 / 4
        about_y = mass * lower(body.arguments["a"]) ** 2 / 4
        return principal(about_x, about_y, about_x + about_y)

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `rim`."""
        if part.name != "rim":
            return None
        given = part.body.arguments
        return at_centre(part, curves.EllipseCurve(Axis("z"), given["a"], given["b"]))

    def outside(self, part: BodyGeometry, lower: Lower) -> ca.SX:
        """The left of an ellipse is its inside."""
        return ca.SX(-1)


class Polygon(Shape):
    """A homogeneous lamina; its corners in order, G is its centroid."""

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """Its corners, from the centroid."""
        corner = item_of(name, "corners")
        if not corner:
            return nowhere()
        corners = lower(body.arguments["vertices"])
        area, first_x, first_y, _ = _areas(corners)
        x, y = corners[corner - 1, 0] - first_x / area, corners[corner - 1, 1] - first_y / area
        return ca.sparsify(ca.vertcat(x, y, 0))

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """About G: the second moments of the triangles between the origin and the sides, moved."""
        area, first_x, first_y, second = _areas(lower(body.arguments["vertices"]))
        mass = lower(body.arguments["mass"])
        away = (first_x**2 + first_y**2) / area**2
        return principal(ca.SX(0), ca.SX(0), mass * (second / area - away))

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """A side, from its first corner to its second."""
        corners = self.corners(part)
        if not corners:
            return None
        first, second = corners
        vertices, span = part.body.arguments["vertices"], part.span
        ends = [element(vertices, item_of(x.name, "corners") - 1, span) for x in (second, first)]
        along = Binary("-", ends[0], ends[1], ends[0].type, span)
        return Placed(first, Segment(Axis(along), True))

    def outside(self, part: BodyGeometry, lower: Lower) -> ca.SX:
        """The right of each side where the corners go round counter-clockwise, else the left."""
        area, *_ = _areas(lower(part.body.arguments["vertices"]))
        return -ca.sign(area)

    def corners(self, face: BodyGeometry) -> tuple[BodyPoint, ...]:
        """The two ends of `sides[k]`."""
        number, count = item_of(face.name, "sides"), face.body.arguments["vertices"].type.shape[0]
        ends = (number, number % count + 1) if number else ()
        return tuple(BodyPoint(face.body, f"corners[{k}]", face.span) for k in ends)


def _areas(corners: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Area of a polygon, its first moments by x and y, its polar second moment."""
    count = corners.size1()
    area, first_x, first_y, second = ca.SX(0), ca.SX(0), ca.SX(0), ca.SX(0)
    for k in range(count):
        p, q = corners[k, :], corners[(k + 1) % count, :]
        part = p[0] * q[1] - p[1] * q[0]
        area += part / 2
        first_x += part * (p[0] + q[0]) / 6
        first_y += part * (p[1] + q[1]) / 6
        second += part * (ca.sumsqr(p) + ca.dot(p, q) + ca.sumsqr(q)) / 12
    return area, first_x, first_y, second
