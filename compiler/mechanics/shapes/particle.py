"""A particle: a mass at a point."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.shapes.shape import Shape
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body


class Particle(Shape):
    """It has no orientation, and so no inertia."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """None."""
        return ca.SX(3, 3)
