"""Smooth friction that only a slip calls up, for comparison: `regularized`."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.coulomb import Coulomb
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.dsl.checked import Law, Liaison

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.laws.given_motions import GivenMotion
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class Regularized(Coulomb):
    """-mu N s/sqrt(s^2 + v^2): nothing sticks by it, a body on a slope creeps.

    What can part has a normal reaction of one sign, in which the law is linear: there it is a given
    force. Elsewhere its bound is the length of a reaction, and it is an element that never holds.
    """

    __slots__ = ()

    coefficients = ("mu", "mu")

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """As of `coulomb`, with a coefficient that grows from zero; none of what can part."""
        if is_unilateral(link.liaison):
            return ()
        smooth = law.arguments["v"]
        return tuple(replace(one, smooth=smooth) for one in super().elements(link, law))

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load | None:
        """Along the slip of what can part."""
        if not is_unilateral(liaison):
            return None
        import casadi as ca
        from frot.compiler.mechanics.laws.given_motions import give

        mu, speed = motion.lower(law.arguments["mu"]), motion.lower(law.arguments["v"])
        normal = variables.of_liaison(liaison, "normal_force")

        def push(one: GivenMotion) -> ca.SX:
            return -mu * normal * one.rate / ca.sqrt(one.square + speed**2)

        return give(liaison, variables, frictions, push)
