"""Dry friction whose coefficient decreases with the slip, with a viscous part: `stribeck`."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.coulomb import Coulomb
from frot.compiler.mechanics.laws.viscous import damp, is_damped
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.dsl.checked import Law, Liaison

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class Stribeck(Coulomb):
    """The coefficient mu + (mu_s - mu) exp(-(s/v_s)^2) of a slip s, mu_s at rest; and -c s."""

    __slots__ = ()

    def acts_while_closed(self, liaison: Liaison, law: Law) -> bool:
        """The viscous part of what can part."""
        return is_damped(law) and is_unilateral(liaison)

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """As of `coulomb`, with the speed over which the coefficient decreases."""
        fades = law.arguments["v_s"]
        return tuple(replace(one, fades=fades) for one in super().elements(link, law))

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load | None:
        """The viscous part."""
        if not is_damped(law):
            return None
        return damp(liaison, law.arguments["c"], variables, motion, frictions)
