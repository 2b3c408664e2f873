"""What every law of a liaison has in common: what it takes, and what it adds to a constraint.

Free of CasADi, but for what a law is given to translate.
"""

from __future__ import annotations

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.unsupported import one_of, refuse
from frot.compiler.translate.walk import subexpressions
from frot.dsl import Log
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import Expression, Law, Liaison, Quantity

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.mechanics.constraint_geometry import GivenFriction
    from frot.compiler.mechanics.forces.force import Load
    from frot.compiler.mechanics.variables import Variables
    from frot.compiler.translate.expressions import Lowering

# What is solved for together with friction.
REACTION = ("force", "torque", "normal_force", "tangential_force", "power", "mode")
# Rates that no coefficient may depend on.
_RATES = (
    "velocity",
    "acceleration",
    "slip",
    "angular_velocity",
    "angular_acceleration",
    "speed",
)


class LawModel:
    """A law of liaisons: each has a file and a class of its own.

    `is_dry`: its friction is an element that the kernel solves for together with the reactions;
    any other acts as a given force.
    """

    __slots__ = ()

    is_dry = False

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """Report where the law is not supported; `known`: the kind of the liaison is."""
        raise NotImplementedError

    def fits(self, link: Constraint, law: Law, log: Log) -> bool:
        """Whether the law has a meaning between the places of a constraint; else reported."""
        return True

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """The elements of friction that the law adds to a constraint, if it is dry."""
        return ()

    def acts_while_closed(self, liaison: Liaison, law: Law) -> bool:
        """Whether the mode of what can part says if the law acts: not if `normal_force` does."""
        return False

    def action(
        self,
        liaison: Liaison,
        law: Law,
        variables: Variables,
        motion: Lowering,
        frictions: dict[Liaison, GivenFriction],
    ) -> Load | None:
        """What the law gives as a force with a value; `frictions` gains it."""
        return None


def is_taken(liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> bool:
    """Whether the kind of a liaison takes a law, as the catalogue says; else that is reported."""
    name, kind = law.kind.name, liaison.kind
    if not known and not liaison.relations:
        return True
    if planar and law.kind.space_only:
        refuse(log, f"the law '{name}' in the plane", law.span, "a model in space takes it")
        return False
    if name in (kind.laws if planar else kind.laws_in_space):
        return True
    takes = [x.name for x in LIAISONS.values() if name in (x.laws if planar else x.laws_in_space)]
    where = f"the law '{name}' of a {kind.title}" + ("" if planar else " in space")
    refuse(log, where, law.span, one_of("liaisons with this law", takes))
    return False


class DryLaw(LawModel):
    """A law of dry friction, bounded by a reaction times a coefficient."""

    __slots__ = ()

    is_dry = True
    # The arguments that are the coefficients of motion and of rest. The catalogue says that they
    # are not negative: of literals when they are read, of parameters when a run begins; in the
    # motion a negative one is no number (`friction_coefficients`).
    coefficients: tuple[str, str]

    def coefficients_of(self, law: Law) -> tuple[Expression, Expression]:
        """The coefficients of motion and of rest."""
        of_motion, of_rest = self.coefficients
        return law.arguments[of_motion], law.arguments[of_rest]

    def unsupported_arguments(self, liaison: Liaison) -> tuple[str, ...]:
        """Names of arguments that the law does not take in this liaison."""
        return ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """The catalogue says which kinds take the law; coefficients follow places."""
        name = law.kind.name
        if not is_taken(liaison, law, planar, known, log):
            return
        for argument in self.unsupported_arguments(liaison):
            if argument in law.arguments:
                refuse(log, f"'{argument}' of the law '{name}'", law.arguments[argument].span)
        self.check_arguments(liaison, law, log)
        for value in law.arguments.values():
            for node in subexpressions(value):
                if isinstance(node, Quantity) and node.name in (*_RATES, *REACTION):
                    refuse(
                        log,
                        f"a coefficient that depends on '{node.name}'",
                        node.span,
                        "coefficients may depend on positions and time",
                    )

    def check_arguments(self, liaison: Liaison, law: Law, log: Log) -> None:
        """Report what this law does not take of its own arguments; by default it takes all."""
