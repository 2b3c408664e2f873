"""A force against the velocity, c times a power of the speed: `drag`."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
from frot.compiler.mechanics.forces.force import ForceModel, Given, Load, literal
from frot.dsl import Log
from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked import Force, Liaison, Literal, Place
from frot.dsl.quantities.dimensions import dimension


class Drag(ForceModel):
    """The force -c |v|^(exponent - 1) v at a point; the exponent is a number from 1 on."""

    __slots__ = ()

    def check(self, force: Force, log: Log) -> None:
        """The exponent is a number, for the unit of the coefficient follows from it."""
        exponent, c = force.arguments["exponent"], force.arguments["c"]
        assert not isinstance(exponent, Place | Liaison) and not isinstance(c, Place | Liaison)
        if not (isinstance(exponent, Literal) and float(exponent.value) >= 1):
            log.report(
                "E0305",
                "the exponent of a drag is a number, 1 or more: the unit of c follows from it",
                exponent.span,
                help="write `exponent = 2`; for another law write a force `on` the body",
            )
            return
        power = Fraction(float(exponent.value)).limit_denominator(1000)
        unit = dimension(m=1, kg=1, s=-2) / dimension(m=1, s=-1) ** power
        if c.type.dimension != unit:
            log.report(
                "E0301",
                f"c of a drag with exponent {exponent.value:g} is in {unit.unit}",
                c.span,
                help="give the other exponent, or c in that unit",
            )

    def load(self, given: Given) -> Load:
        """One force; it has no potential. At rest a root of the speed has no slope."""
        end = given.end("body")
        velocity = end.velocity
        factor = given.value("c")
        exponent = literal(given.arguments["exponent"])
        assert isinstance(exponent, int | float)
        size = FUNCTIONS["norm"].form
        assert size is not None
        if exponent == 2:
            factor *= size(ca, velocity)
        elif exponent != 1:
            speed = size(ca, velocity)
            moving = speed > 0
            factor *= ca.if_else(moving, ca.if_else(moving, speed, 1) ** (exponent - 1), 0)
        return Load((end.under(-factor * velocity),), None)
