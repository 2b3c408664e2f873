"""A body given by its mass, its inertia about G and the place of G."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.shapes.shape import Shape
from frot.compiler.mechanics.spatial import nowhere, whole
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body


class Solid(Shape):
    """Its inertia is always given."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """Given: `given_inertia` stands in its place."""
        raise TypeError(f"'{body.name}' gives its inertia")

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """The `origin`, from which G is given."""
        return -whole(lower(body.arguments["com"])) if name == "origin" else nowhere()
