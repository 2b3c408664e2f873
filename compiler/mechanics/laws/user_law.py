"""A law of the user: the tangential reaction as an expression of slip and normal reaction."""

from __future__ import annotations

from frot.compiler.mechanics.laws.law import LawModel
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.unsupported import refuse
from frot.dsl import Log
from frot.dsl.checked import Law, Liaison

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering

_ONE_CONTACT = "a law of one's own acts in a `contact_ponctuel` or a `point_courbe` of the plane"


class UserLaw(LawModel):
    """A given force along the slip of a contact of the plane."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """It acts in contacts of the plane."""
        if not planar or liaison.kind.in_plane != "contact":
            where = f"of a {liaison.kind.title}" + ("" if planar else " in space")
            refuse(log, f"the law '{law.kind.name}' {where}", law.span, _ONE_CONTACT)

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, ca.SX],
    ) -> Load:
        """The force along the slip; what can part has none while it is apart."""
        import casadi as ca
        from frot.compiler.mechanics.forces.force import Action, Load

        force = motion.lower(law.arguments["tangential"])
        _refuse_left_over(liaison, law, force, variables, motion.log)
        frictions[liaison] = frictions.get(liaison, ca.SX(0)) + force
        return Load((Action(variables.of_liaison(liaison, "slip"), force),), None)


def _refuse_left_over(
    liaison: Liaison, law: Law, force: ca.SX, variables: Variables, log: Log
) -> None:
    """Report a law that does not vanish with the normal reaction of what can part."""
    import casadi as ca

    if not is_unilateral(liaison):
        return
    normal = variables.of_liaison(liaison, "normal_force")
    apart = ca.simplify(ca.substitute(force, normal, ca.SX(0)))
    if not apart.is_zero():
        log.report(
            "E0511",
            f"the law '{law.kind.name}' of liaison '{liaison.name}' does not vanish with `normal`",
            law.span,
            help="multiply it by `normal`, or write `unilateral = false`",
        )
