"""A force towards a centre, k times the distance: `attraction`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.forces.force import ForceModel, Given, Load, between


class Attraction(ForceModel):
    """The force -k (point - centre) on the point, and its opposite on the centre."""

    __slots__ = ()

    def load(self, given: Given) -> Load:
        """Its potential is k d^2/2, where k and the centre are constant."""
        start, end = given.end("centre"), given.end("point")
        apart, stiffness = end.place - start.place, given.value("k")
        energy = stiffness * ca.sumsqr(apart) / 2 if given.is_constant else None
        return Load(between(start, end, -stiffness * apart), energy)
