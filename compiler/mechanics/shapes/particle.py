"""A particle: a mass at a point."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.spatial import nowhere
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body


class Particle:
    """It has no orientation, and so no inertia."""

    def inertia(self, body: Body, lower: Lower) -> ca.SX:
        """None."""
        return ca.SX(3, 3)

    def point(self, body: Body, name: str, lower: Lower) -> ca.SX:
        """G is all there is."""
        return nowhere()
