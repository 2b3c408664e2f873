"""A slender rod along its x axis, G in the middle."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.planes import LineOrCylinder, Segment
from frot.compiler.mechanics.shapes.shape import Shape, at_centre, principal
from frot.compiler.mechanics.spatial import X, nowhere
from frot.compiler.mechanics.values import Axis, Lower
from frot.dsl.checked import Body, BodyGeometry, BodyPoint


class Rod(Shape):
    """Without thickness: no inertia about its own axis."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """M l^2/12 across: the integral of x^2 m/l dx from -l/2 to l/2."""
        across = lower(body.arguments["mass"]) * lower(body.arguments["length"]) ** 2 / 12
        return principal(ca.SX(0), across, across)

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """`start` and `tip` at -l/2 and l/2."""
        if name not in ("start", "tip"):
            return nowhere()
        half = lower(body.arguments["length"]) / 2
        return ca.sparsify((-half if name == "start" else half) * X)

    def part(self, part: BodyGeometry, planar: bool) -> Placed | None:
        """Its `axis`."""
        if part.name != "axis":
            return None
        long = part.body.arguments["length"]
        axis = (
            Segment(Axis("x"), True, long=long) if planar else LineOrCylinder(Axis("x"), None, long)
        )
        return at_centre(part, axis)

    def ends(self, part: BodyGeometry) -> tuple[BodyPoint, ...]:
        """Those of its axis."""
        names = ("start", "tip") if part.name == "axis" else ()
        return tuple(BodyPoint(part.body, name, part.span) for name in names)
