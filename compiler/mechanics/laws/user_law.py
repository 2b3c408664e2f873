"""A law of the user: the tangential reaction as an expression of slip and normal reaction."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanics.laws.law import LawModel
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.unsupported import one_of, refuse
from frot.compiler.translate.walk import quantities_in
from frot.dsl import Log
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import Law, Liaison, Quantity

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.laws.given_motions import GivenMotion
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering


class UserLaw(LawModel):
    """A given force along the slip; in the tangent plane of a contact in space along its vector."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """It acts where there is one slip."""
        model = "plane" if planar else "space"
        if model not in liaison.kind.own_laws:
            takes = [kind.name for kind in LIAISONS.values() if model in kind.own_laws]
            where = f"of a {liaison.kind.title}" + ("" if planar else " in space")
            takes_it = one_of("liaisons with laws of one's own", takes)
            refuse(log, f"the law '{law.kind.name}' {where}", law.span, takes_it)

    def acts_while_closed(self, liaison: Liaison, law: Law) -> bool:
        """Of what can part, where the law does not read the normal reaction."""
        read = quantities_in(law.arguments["tangential"])
        return is_unilateral(liaison) and not any(x.name == "normal_force" for x in read)

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load:
        """The force along the slip; what can part has none while it is apart."""
        import casadi as ca
        from frot.compiler.mechanics.laws.given_motions import give

        def push(one: GivenMotion) -> ca.SX | None:
            if one.turns:
                return None

            def quantity(node: Quantity) -> ca.SX:
                if node.owner is liaison and node.name == "slip":
                    return one.size
                return variables.quantity(node)

            own = replace(motion, quantity=quantity, done={})
            force = own.lower(law.arguments["tangential"])
            if self.acts_while_closed(liaison, law):
                force *= variables.share(liaison)
            else:
                _refuse_left_over(liaison, law, force, variables, motion.log)
            if one.rate.numel() == 1:
                return force
            moves = one.size > 0
            return ca.if_else(moves, force / ca.if_else(moves, one.size, 1), 0) * one.rate

        return give(liaison, variables, frictions, push)


def _refuse_left_over(
    liaison: Liaison, law: Law, force: ca.SX, variables: Variables, log: Log
) -> None:
    """Report a law that reads the normal reaction of what can part, and does not vanish with it."""
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
