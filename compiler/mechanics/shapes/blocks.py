"""Cylinder and box, G in the middle."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.shapes.shape import item_of, principal
from frot.compiler.mechanics.spatial import X, Y, Z, nowhere
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body


class Cylinder:
    """A homogeneous cylinder along z."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M r^2/2 about z as a disc; across, half of that and m l^2/12 as a rod."""
        mass, radius = lower(body.arguments["mass"]), lower(body.arguments["radius"])
        across = mass * (radius**2 / 4 + lower(body.arguments["length"]) ** 2 / 12)
        return principal(across, across, mass * radius**2 / 2)

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """`bottom` and `top` at -l/2 and l/2 along z."""
        if name not in ("bottom", "top"):
            return nowhere()
        half = lower(body.arguments["length"]) / 2
        return ca.sparsify((half if name == "top" else -half) * Z)


class Box:
    """A homogeneous box; its points are the centres of its faces, and its corners.

    Corners go round counter-clockwise from the one where x and y are least, in space first those
    of the bottom.

    In space `bottom` and `top` are those along z, `front` and `back` those along y; in the plane
    `bottom` and `top` are those along y. `left` and `right` are those along x.
    """

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M (b^2 + c^2)/12 about x, and so on: two slender rods across."""
        size = lower(body.arguments["size"])
        mass = lower(body.arguments["mass"])
        squares = [size[k] ** 2 if k < size.numel() else ca.SX(0) for k in range(3)]
        a, b, c = squares
        return principal(*(mass * (p + q) / 12 for p, q in ((b, c), (c, a), (a, b))))

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """Half an edge from G, of corners along all edges."""
        size = lower(body.arguments["size"])
        corner = item_of(name, "corners")
        if corner:
            signs = corner_signs(corner)
            halves = [sign * size[k] / 2 for k, sign in enumerate(signs[: size.numel()])]
            return ca.sparsify(ca.vertcat(*halves, *(ca.SX(0) for _ in range(3 - len(halves)))))
        up = Z if size.numel() == 3 else Y
        ways = {
            "left": -X,
            "right": X,
            "bottom": -up,
            "top": up,
            "front": -Y,
            "back": Y,
        }
        if name not in ways:
            return nowhere()
        return ca.sparsify(ways[name] * ca.dot(ca.fabs(ways[name])[: size.numel()], size) / 2)


def corner_signs(corner: int) -> tuple[int, int, int]:
    """On which side of G a corner of a box is, along x, y and z."""
    x, y = ((-1, -1), (1, -1), (1, 1), (-1, 1))[(corner - 1) % 4]
    return x, y, -1 if corner <= 4 else 1
