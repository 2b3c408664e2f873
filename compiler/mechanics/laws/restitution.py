"""How a liaison that can part gives back the speed of an impact: `restitution`."""

from __future__ import annotations

from frot.compiler.mechanics.laws.law import LawModel
from frot.compiler.mechanics.mechanism import is_unilateral, may_part
from frot.compiler.mechanics.unsupported import refuse
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
from frot.dsl.checked import Expression, Law, Liaison, Literal

# The rules by their numbers in the kernel's `frot_impact_rule`.
RULES = ("energetic", "poisson", "newton")


class Restitution(LawModel):
    """The coefficient e of a unilateral liaison, between 0 and 1, and its rule."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """The liaison can part, and e is constant in a run."""
        if not is_unilateral(liaison):
            log.report(
                "E0511",
                f"restitution of '{liaison.name}', which cannot part",
                law.span,
                help="write `unilateral = true`, or leave out the law"
                if may_part(liaison, planar)
                else "leave it out; a bound of a coordinate is `stops(min, max, e)`, and what can "
                "part is a `contact_ponctuel`, an `appui_faces` or a `fil`",
            )
        if not is_fixed(law.arguments["e"]):
            refuse(
                log,
                "a coefficient of restitution that depends on time or motion",
                law.arguments["e"].span,
                "it may depend on parameters",
            )


def restitution_of(liaison: Liaison) -> tuple[Expression | None, int]:
    """The coefficient of a liaison, None where the text gives none, and the number of its rule."""
    for law in liaison.laws:
        if law.kind.name != "restitution":
            continue
        rule = law.arguments["rule"]
        return law.arguments["e"], RULES.index(str(rule.value)) if isinstance(rule, Literal) else 0
    return None, 0
