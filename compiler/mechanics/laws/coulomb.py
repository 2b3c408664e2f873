"""Dry friction of a contact or of a pin, bounded by mu times the reaction: `coulomb`."""

from __future__ import annotations

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.law import DryLaw
from frot.compiler.mechanics.points import turns
from frot.compiler.mechanics.unsupported import refuse
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
from frot.dsl.checked import Law, Liaison


class Coulomb(DryLaw):
    """Sliding along a curve, or turning of a pin of the given radius."""

    __slots__ = ()

    coefficients = ("mu", "mu_s")

    def unsupported_arguments(self, liaison: Liaison) -> tuple[str, ...]:
        """A contact has no radius, and nothing in the plane has a guide with a length."""
        return ("half_length",) if _is_pin(liaison) else ("radius", "half_length")

    def check_arguments(self, liaison: Liaison, law: Law, log: Log) -> None:
        """The radius of a pin is constant."""
        radius = law.arguments.get("radius")
        if _is_pin(liaison) and radius is not None and not is_fixed(radius):
            refuse(log, "a radius that depends on time or motion", radius.span)

    def fits(self, link: Constraint, law: Law, log: Log) -> bool:
        """A pin joins bodies that turn, and has a radius."""
        if link.has_normal:
            return True
        name = link.liaison.name
        if not any(turns(body) for body in link.bodies):
            log.report(
                "E0511",
                f"'coulomb' of '{name}', a pin of two bodies that do not turn",
                law.span,
                help="a particle has no angle: use a rod, a disc or a ring",
            )
            return False
        if "radius" not in law.arguments:
            log.report(
                "E0204",
                f"'coulomb' of the {link.liaison.kind.title} '{name}' needs radius",
                law.span,
                notes=("radius: radius of the pin; its friction couple is mu*radius*norm(R)",),
                help="write `coulomb(..., radius = 8 mm)`",
            )
            return False
        return True

    def element(self, link: Constraint, law: Law) -> FrictionBlock:
        """By the normal reaction of a contact, by the size of the reaction of a pin."""
        arm = None if link.has_normal else law.arguments["radius"]
        return FrictionBlock(*self.coefficients_of(law), arm=arm, components=link.slip_components)


def _is_pin(liaison: Liaison) -> bool:
    """Whether the liaison turns in a bearing, on a pin or on a ball."""
    return "angle" in liaison.kind.coordinates or liaison.kind.name == "spherique"
