"""A couple opposed to the spin about the normal, bounded by delta N: `pivoting_resistance`."""

from __future__ import annotations

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock, Way
from frot.compiler.mechanics.laws.law import DryLaw
from frot.dsl.checked import Law


class PivotingResistance(DryLaw):
    """The couple about the normal of a contact in space; delta is a length."""

    __slots__ = ()

    coefficients = ("delta", "delta_s")

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """About the normal, of a joint by its angle."""
        beside = link.has_normal or link.rolls or any(link.uncounted)
        ways = () if beside else (Way("angle"),)
        return (FrictionBlock(*self.coefficients_of(law), pivoting=True, ways=ways),)
