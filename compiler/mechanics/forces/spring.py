"""A linear spring between two points: `spring`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.forces.force import ForceModel, Given, Load, between, literal


class Spring(ForceModel):
    """The force -k (d - length) along the line of the two points."""

    __slots__ = ()

    def load(self, given: Given) -> Load:
        """Where the ends meet it has no direction: the limit of the part without one is taken."""
        start, end = given.end("a"), given.end("b")
        apart, stiffness = end.place - start.place, given.value("k")
        rest = given.value("length")
        length = ca.sqrt(ca.sumsqr(apart))
        slack = ca.SX(0)
        if literal(given.arguments["length"]) != 0:
            slack = ca.if_else(length > 0, rest / length, ca.SX(0))
        energy = stiffness * (length - rest) ** 2 / 2 if given.is_constant else None
        return Load(between(start, end, -stiffness * (1 - slack) * apart), energy)
