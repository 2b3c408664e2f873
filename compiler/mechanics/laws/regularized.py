"""Smooth friction that only a slip calls up, for comparison: `regularized`."""

from __future__ import annotations

from frot.compiler.mechanics.laws.law import LawModel, is_taken
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.unsupported import refuse
from frot.dsl import Log
from frot.dsl.checked import Law, Liaison

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.laws.given_motions import GivenMotion
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class Regularized(LawModel):
    """-mu N s/sqrt(s^2 + v^2): nothing sticks by it, a body on a slope creeps."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """Of a reaction of either sign its size would count, which is not linear."""
        if is_taken(liaison, law, planar, known, log) and not is_unilateral(liaison):
            refuse(
                log,
                f"the law '{law.kind.name}' of the {liaison.kind.title} '{liaison.name}', which "
                "presses both ways,",
                law.span,
                "use `coulomb`, or a liaison with `unilateral = true`",
            )

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load:
        """Along the slip."""
        import casadi as ca
        from frot.compiler.mechanics.laws.given_motions import give

        mu, speed = motion.lower(law.arguments["mu"]), motion.lower(law.arguments["v"])
        normal = variables.of_liaison(liaison, "normal_force")

        def push(one: GivenMotion) -> ca.SX:
            return -mu * normal * one.rate / ca.sqrt(one.square + speed**2)

        return give(liaison, variables, frictions, push)
