"""Balls: sphere, shell, ellipsoid."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.quadrics import EllipsoidSurface, SphereSurface
from frot.compiler.mechanics.shapes.shape import Shape, at_centre, principal
from frot.compiler.mechanics.spatial import whole
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body, BodyGeometry


def _of_ball(body: Body, lower: Lower, factor: float) -> ca.SX:
    moment = factor * lower(body.arguments["mass"]) * lower(body.arguments["radius"]) ** 2
    return principal(moment, moment, moment)


class _Round(Shape):
    """What has a sphere about G; `hollow`: others may be inside of it."""

    hollow = False

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `surface`."""
        if part.name != "surface":
            return None
        return at_centre(part, SphereSurface(part.body.arguments["radius"], self.hollow))


class Sphere(_Round):
    """A homogeneous ball."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """2 m r^2/5: two thirds of the integral of s^2 (3 m/r^3) s^2 ds."""
        return _of_ball(body, lower, 2 / 5)


class Shell(_Round):
    """A thin spherical shell."""

    hollow = True

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """2 m r^2/3: x^2 + y^2 is two thirds of r^2 on average."""
        return _of_ball(body, lower, 2 / 3)


class Ellipsoid(Shape):
    """A homogeneous ellipsoid with semi-axes along x, y, z."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M (b^2 + c^2)/5 about x, and so on: those of a ball, stretched."""
        a, b, c = (x**2 for x in ca.vertsplit(whole(lower(body.arguments["semi_axes"]))))
        mass = lower(body.arguments["mass"])
        return principal(*(mass * (p + q) / 5 for p, q in ((b, c), (c, a), (a, b))))

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `surface`."""
        if part.name != "surface":
            return None
        return at_centre(part, EllipsoidSurface(part.body.arguments["semi_axes"]))
