"""A couple opposed to the spin about the normal, bounded by delta N: `pivoting_resistance`."""

from __future__ import annotations

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.law import DryLaw
from frot.dsl.checked import Law


class PivotingResistance(DryLaw):
    """The couple about the normal of a contact in space; delta is a length."""

    __slots__ = ()

    coefficients = ("delta", "delta")

    def element(self, link: Constraint, law: Law) -> FrictionBlock:
        """The same length at rest and in motion."""
        return FrictionBlock(*self.coefficients_of(law), pivoting=True)
