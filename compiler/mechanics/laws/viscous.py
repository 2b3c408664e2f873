"""A force or couple in proportion to the speed: `viscous`."""

from __future__ import annotations

from frot.compiler.mechanics.laws.law import LawModel, is_taken
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.dsl import Log
from frot.dsl.catalogue.types import ROTATIONAL_DAMPING
from frot.dsl.checked import Expression, Law, Liaison

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.laws.given_motions import GivenMotion
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class Viscous(LawModel):
    """-c times the slip, or each speed of a joint that c fits: N.s/m slides, N.m.s turns."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """What can part has no friction while it is apart."""
        if is_taken(liaison, law, planar, known, log):
            refuse_parting(liaison, law, log)

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load:
        """Against every motion that the coefficient fits."""
        return damp(liaison, law.arguments["c"], variables, motion, frictions)


def damp(
    liaison: Liaison,
    coefficient: Expression,
    variables: Variables,
    motion: Lowering,
    frictions: dict[Liaison, GivenFriction],
) -> Load:
    """The load -c v of the slides of a liaison, or of its turns, as the type of c says."""
    from frot.compiler.mechanics.laws.given_motions import give

    c, turns = motion.lower(coefficient), is_rotational(coefficient)

    def push(one: GivenMotion) -> ca.SX | None:
        return -c * one.rate if one.turns == turns else None

    return give(liaison, variables, frictions, push)


def is_rotational(coefficient: Expression) -> bool:
    """Whether a damping coefficient is one of turning."""
    return coefficient.type.dimension == ROTATIONAL_DAMPING.dimension


def refuse_parting(liaison: Liaison, law: Law, log: Log) -> None:
    """Report a force that does not vanish with the normal reaction of what can part."""
    if is_unilateral(liaison):
        log.report(
            "E0511",
            f"the law '{law.kind.name}' of liaison '{liaison.name}' does not vanish with the "
            "normal reaction, and the liaison can part",
            law.span,
            help="write `unilateral = false`, or a law of one's own with the factor `normal`",
        )
