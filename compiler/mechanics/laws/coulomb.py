"""Dry friction of a contact or of a joint, bounded by mu times its reaction: `coulomb`."""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock, Way
from frot.compiler.mechanics.laws.law import DryLaw
from frot.compiler.mechanics.points import turns
from frot.compiler.mechanics.unsupported import refuse
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
from frot.dsl.catalogue import LiaisonKind
from frot.dsl.checked import Law, Liaison

# Components of a slip that turns any way.
_ANY_TURN = 3


class Coulomb(DryLaw):
    """Sliding of a contact or along a guide, turning of a pin of the given radius."""

    __slots__ = ()

    coefficients = ("mu", "mu_s")

    def unsupported_arguments(self, liaison: Liaison) -> tuple[str, ...]:
        """A pin has a radius, a guide a half length, and with that a radius."""
        if liaison.relations:
            return ("half_length",)
        if liaison.kind.guide:
            return () if _guide(liaison) else ("radius",)
        return ("half_length",) if liaison.kind.pin else ("radius", "half_length")

    def check_arguments(self, liaison: Liaison, law: Law, log: Log) -> None:
        """The radius of a pin and the length of a guide are constant."""
        for name in ("radius", "half_length"):
            value = law.arguments.get(name)
            known = name not in self.unsupported_arguments(liaison)
            if known and value is not None and not is_fixed(value):
                refuse(log, f"a {name} that depends on time or motion", value.span)

    def fits(self, link: Constraint, law: Law, log: Log) -> bool:
        """A pin joins bodies that turn, and has a radius."""
        kind = link.liaison.kind
        if link.liaison.relations:
            return _fits_relations(link, law, log)
        if link.has_normal or not kind.pin:
            return True
        name, slides = link.liaison.name, _slides(kind)
        any_turns = bool(link.pinned) or any(turns(body) for body in link.bodies)
        if not any_turns and not slides:
            log.report(
                "E0511",
                f"'{law.kind.name}' of '{name}', a pin of two bodies that do not turn",
                law.span,
                help="a particle has no angle: use a rod, a disc or a ring",
            )
            return False
        if any_turns and "radius" not in law.arguments:
            bound = "friction makes a couple of radius times a force"
            if not slides:
                bound = "its friction couple is mu*radius*norm(R)"
            log.report(
                "E0204",
                f"'{law.kind.name}' of the {kind.title} '{name}' needs radius",
                law.span,
                notes=(f"radius: radius of the pin; {bound}",),
                help=f"write `{law.kind.name}(..., radius = 8 mm)`",
            )
            return False
        return True

    def elements(self, link: Constraint, law: Law) -> tuple[FrictionBlock, ...]:
        """By the normal reaction of a contact, by the size of the reaction of a joint."""
        mu, mu_s = self.coefficients_of(law)
        kind = link.liaison.kind
        if link.has_normal:
            return (FrictionBlock(mu, mu_s, components=link.slip_components),)
        radius = law.arguments.get("radius")
        slides, turns_left = link.uncounted
        if link.pinned:
            block = FrictionBlock(mu, mu_s, arm=radius, components=link.turnings)
            return tuple(replace(block, end=end) for end in link.pinned)
        if slides:
            return (FrictionBlock(mu, mu_s, components=slides),)
        if turns_left:
            return (FrictionBlock(mu, mu_s, arm=radius, components=turns_left),)
        if _slides(kind):
            whole = any(turns(body) for body in link.bodies)
            ways = (Way("displacement"), Way("angle", radius))[: 2 if whole else 1]
            return (FrictionBlock(mu, mu_s, components=len(ways), ways=ways),)
        arm = radius if kind.pin else None
        return tuple(
            FrictionBlock(
                mu,
                mu_s,
                arm=arm,
                components=len(names) or _ANY_TURN,
                ways=tuple(Way(name) for name in names),
            )
            for names in kind.slips
        )


def _guide(liaison: Liaison) -> bool:
    """Whether a law of the liaison says how long its guide is."""
    return any("half_length" in law.arguments for law in liaison.laws)


def _slides(kind: LiaisonKind) -> bool:
    """Whether a pin slides along its axis too."""
    return kind.pin and any("displacement" in names for names in kind.slips)


def _fits_relations(link: Constraint, law: Law, log: Log) -> bool:
    """A liaison of the user has a force that bounds friction, and leaves a slip or a turning."""
    name, (slides, turns_left) = link.liaison.name, link.uncounted
    joint = link.joint
    span = law.span
    if joint is None or not joint.pressing:
        log.report(
            "E0511",
            f"'{law.kind.name}' of '{name}', whose relations call up no force",
            span,
            help="its friction is bounded by a force: state a relation between places",
        )
        return False
    if not slides and not turns_left:
        log.report(
            "E0511",
            f"'{law.kind.name}' of '{name}', which leaves no motion",
            span,
            help="leave out the law",
        )
        return False
    if slides and "radius" in law.arguments:
        log.report(
            "E0204",
            f"'radius' of '{law.kind.name}' of '{name}', whose places slide",
            law.arguments["radius"].span,
            help="leave it out: friction is a force against the slip",
        )
        return False
    if not slides and "radius" not in law.arguments:
        log.report(
            "E0204",
            f"'{law.kind.name}' of '{name}', which only turns, needs radius",
            span,
            notes=("radius: its friction couple is mu*radius*norm(R)",),
            help=f"write `{law.kind.name}(..., radius = 8 mm)`",
        )
        return False
    return True
