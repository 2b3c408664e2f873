"""A linear damper between two points: `damper`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.forces.force import ForceModel, Given, Load, between


class Damper(ForceModel):
    """The force -c d' along the line of the two points."""

    __slots__ = ()

    def load(self, given: Given) -> Load:
        """It has no potential; where the points meet it has no direction and is zero."""
        start, end = given.end("a", rated=True), given.end("b", rated=True)
        damping = given.value("c")
        along = _unit(end.place - start.place)
        rate = ca.dot(end.velocity - start.velocity, along)
        return Load(between(start, end, -damping * rate * along), None)


def _unit(vector: ca.SX) -> ca.SX:
    """The vector's direction; zero where it has none."""
    length = ca.sqrt(ca.sumsqr(vector))
    return ca.if_else(length > 0, vector / length, ca.SX.zeros(3))
