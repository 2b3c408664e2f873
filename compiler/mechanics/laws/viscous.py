"""A force or couple in proportion to the speed: `viscous`."""

from __future__ import annotations

from frot.compiler.mechanics.laws.law import LawModel, is_taken
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.dsl import Label, Log
from frot.dsl.catalogue.types import ROTATIONAL_DAMPING
from frot.dsl.checked import Expression, Law, Liaison, Literal

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.laws.given_motions import GivenMotion
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class Viscous(LawModel):
    """-c times the slip, or each speed of a joint that c fits: N.s/m slides, N.m.s turns.

    What can part has this force while it is closed.
    """

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """The catalogue says which kinds take it: once for what slides, once for what turns."""
        if not is_taken(liaison, law, planar, known, log):
            return
        turns = is_rotational(law.arguments["c"])
        for other in liaison.laws[: liaison.laws.index(law)]:
            if other.kind is law.kind and is_rotational(other.arguments["c"]) == turns:
                log.report(
                    "E0502",
                    f"the law '{law.kind.name}' of '{liaison.name}' is given twice for what "
                    + ("turns" if turns else "slides"),
                    law.span,
                    labels=(Label(other.span, "first here"),),
                    help="give one with the sum, or one in N.s/m and one in N.m.s",
                )

    def acts_while_closed(self, liaison: Liaison, law: Law) -> bool:
        """Of what can part."""
        return is_damped(law) and is_unilateral(liaison)

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load | None:
        """Against every motion that the coefficient fits."""
        if not is_damped(law):
            return None
        return damp(liaison, law.arguments["c"], variables, motion, frictions)


def damp(
    liaison: Liaison,
    coefficient: Expression,
    variables: Variables,
    motion: Lowering,
    frictions: dict[Liaison, GivenFriction],
) -> Load:
    """The load -c v of the slides of a liaison, or of its turns, as the type of c says.

    The closed parts of a liaison share c equally.
    """
    from frot.compiler.mechanics.laws.given_motions import give

    c = motion.lower(coefficient) * variables.share(liaison)
    turns = is_rotational(coefficient)

    def push(one: GivenMotion) -> ca.SX | None:
        return -c * one.rate if one.turns == turns else None

    return give(liaison, variables, frictions, push)


def is_rotational(coefficient: Expression) -> bool:
    """Whether a damping coefficient is one of turning."""
    return coefficient.type.dimension == ROTATIONAL_DAMPING.dimension


def is_damped(law: Law) -> bool:
    """Whether the text gives a damping coefficient other than the number zero."""
    c = law.arguments.get("c")
    return c is not None and not (isinstance(c, Literal) and c.value == 0)
