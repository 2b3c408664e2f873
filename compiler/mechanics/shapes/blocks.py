"""Cylinder and box, G in the middle."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.planes import LineOrCylinder, PlaneSurface, Segment
from frot.compiler.mechanics.geometry.quadrics import Ring
from frot.compiler.mechanics.shapes.shape import (
    Shape,
    at_centre,
    item_of,
    principal,
    round_corner,
    round_corners,
)
from frot.compiler.mechanics.spatial import X, Y, Z, nowhere
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Body, BodyGeometry, BodyPoint
from frot.dsl.checked.arrays import element


class Cylinder(Shape):
    """A homogeneous cylinder along z."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M r^2/2 about z as a disc; across, half of that and m l^2/12 as a rod."""
        mass, radius = lower(body.arguments["mass"]), lower(body.arguments["radius"])
        across = mass * (radius**2 / 4 + lower(body.arguments["length"]) ** 2 / 12)
        return principal(across, across, mass * radius**2 / 2)

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """`bottom` and `top` at -l/2 and l/2 along z, corners about the rims there."""
        half, (rim, _, corner) = lower(body.arguments["length"]) / 2, name.partition(".")
        height = {"bottom": -half, "rims[1]": -half, "top": half, "rims[2]": half}.get(rim)
        if height is None:
            return nowhere()
        return ca.sparsify(height * Z + round_corner(corner, lower(body.arguments["radius"])))

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `side`, and the `rims` of its two ends."""
        radius = part.body.arguments["radius"]
        if part.name == "side":
            return at_centre(part, LineOrCylinder(Axis("z"), radius, part.body.arguments["length"]))
        rim = item_of(part.name, "rims")
        if not rim:
            return None
        end = BodyPoint(part.body, ("bottom", "top")[rim - 1], part.span)
        return Placed(end, Ring(Axis("z"), radius))

    def corners(self, face: BodyGeometry) -> tuple[BodyPoint, ...]:
        """Those about a rim."""
        return round_corners(face) if item_of(face.name, "rims") else ()

    def ends(self, part: BodyGeometry) -> tuple[BodyGeometry, ...]:
        """The rims of its side."""
        names = ("rims[1]", "rims[2]") if part.name == "side" else ()
        return tuple(BodyGeometry(part.body, name, part.span) for name in names)


class Box(Shape):
    """A homogeneous box; its points are the centres of its faces, and its corners.

    Corners go round counter-clockwise from the one where x and y are least, in space first those
    of the bottom. Edges go round likewise, each from the corner of its number: those of the bottom,
    those of the top, then those along z.

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
        """Half an edge from G, of corners along all edges; of edges their middles."""
        size = lower(body.arguments["size"])
        corner, edge = item_of(name, "corners"), item_of(name, "edges")
        if corner or edge:
            signs = corner_signs(corner) if corner else edge_signs(edge)
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

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """A face, with its normal; in the plane an edge, with the direction whose left that is."""
        edge = item_of(part.name, "edges")
        if edge and not planar:
            return _edge(part, edge)
        if part.name not in _FACES:
            return None
        centre = BodyPoint(part.body, part.name, part.span)
        size = part.body.arguments["size"]
        if planar:
            axis = _SIDES[part.name]
            long = element(size, "xy".index(axis[-1]), part.span)
            return Placed(centre, Segment(Axis(axis), True, long=long))
        normal = _FACES[part.name]
        borders = tuple(
            (Axis(axis), element(size, k, part.span))
            for k, axis in enumerate("xyz")
            if axis != normal[-1]
        )
        depth = element(size, "xyz".index(normal[-1]), part.span)
        return Placed(centre, PlaneSurface(Axis(normal), False, borders, depth))

    def outside(self, part: BodyGeometry, lower: Lower) -> ca.SX:
        """The left of each edge."""
        return ca.SX(1)

    def corners(self, face: BodyGeometry) -> tuple[BodyPoint, ...]:
        """Four of a face, two of an edge."""
        planar = face.body.arguments["size"].type.shape[0] == 2
        numbers = (_ENDS if planar else _CORNERS).get(face.name, ())
        return tuple(BodyPoint(face.body, f"corners[{k}]", face.span) for k in numbers)

    def ends(self, part: BodyGeometry) -> tuple[BodyPoint, ...]:
        """Two of an edge in space."""
        edge = item_of(part.name, "edges")
        numbers = EDGES[edge - 1] if edge else ()
        return tuple(BodyPoint(part.body, f"corners[{k}]", part.span) for k in numbers)

    def edges(self, face: BodyGeometry) -> tuple[BodyGeometry, ...]:
        """Four of a face in space."""
        corners = _CORNERS.get(face.name, ())
        numbers = [k for k, ends in enumerate(EDGES, 1) if set(ends) <= set(corners)]
        return tuple(BodyGeometry(face.body, f"edges[{k}]", face.span) for k in numbers)


def _edge(part: BodyGeometry, edge: int) -> Placed:
    """An edge in space with the normals of its two faces."""
    size, signs = part.body.arguments["size"], edge_signs(edge)
    (k,) = (k for k in range(3) if signs[k] == 0)
    normals = ({1: name, -1: f"-{name}"}.get(sign) for name, sign in zip("xyz", signs, strict=True))
    outwards = tuple(Axis(normal) for normal in normals if normal)
    line = LineOrCylinder(Axis("xyz"[k]), None, element(size, k, part.span), outwards)
    return Placed(BodyPoint(part.body, part.name, part.span), line)


# Normals of the faces; in the plane the directions whose left they are.
_FACES = {"left": "-x", "right": "x", "bottom": "-z", "top": "z", "front": "-y", "back": "y"}
_SIDES = {"left": "y", "right": "-y", "bottom": "-x", "top": "x", "front": "-x", "back": "x"}
# The corners of each.
_ENDS = {
    "bottom": (1, 2),
    "right": (2, 3),
    "top": (3, 4),
    "left": (4, 1),
    "front": (1, 2),
    "back": (3, 4),
}
_CORNERS = {
    "bottom": (1, 2, 3, 4),
    "top": (5, 6, 7, 8),
    "left": (1, 4, 5, 8),
    "right": (2, 3, 6, 7),
    "front": (1, 2, 5, 6),
    "back": (3, 4, 7, 8),
}


def corner_signs(corner: int) -> tuple[int, int, int]:
    """On which side of G a corner of a box is, along x, y and z."""
    x, y = ((-1, -1), (1, -1), (1, 1), (-1, 1))[(corner - 1) % 4]
    return x, y, -1 if corner <= 4 else 1


# The corners that each edge joins, in space.
EDGES = (
    *((k, k % 4 + 1) for k in range(1, 5)),
    *((k + 4, k % 4 + 5) for k in range(1, 5)),
    *((k, k + 4) for k in range(1, 5)),
)


def edge_signs(edge: int) -> tuple[int, ...]:
    """On which side of G the middle of an edge is, along x, y and z; 0 along the edge."""
    ends = (corner_signs(corner) for corner in EDGES[edge - 1])
    return tuple((a + b) // 2 for a, b in zip(*ends, strict=True))
