"""Bounds on the coordinates of a liaison: `stops`, each a contact that may part."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from frot.compiler.mechanics.laws.law import LawModel
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.unsupported import refuse
from frot.compiler.translate.walk import follows_time, is_fixed
from frot.dsl import Log
from frot.dsl.catalogue.laws import STOPPED
from frot.dsl.checked import Expression, Law, Liaison, Literal
from frot.dsl.checked.liaison_variables import liaison_variables
from frot.dsl.quantities.dimensions import Type


@dataclass(frozen=True, slots=True, eq=False)
class Bounds:
    """The lowest and highest value of a coordinate, and the coefficient of restitution there."""

    law: Law
    coordinate: str
    least: Expression
    largest: Expression
    restitution: Expression


class Stops(LawModel):
    """`min` <= coordinate <= `max`, with the coefficient of restitution `e` at both."""

    __slots__ = ()

    def check(self, liaison: Liaison, law: Law, planar: bool, known: bool, log: Log) -> None:
        """It bounds something; its bounds have one unit, and e is constant in a run."""
        low, high, given = law.arguments["min"], law.arguments["max"], law.arguments["e"]
        if low.type.dimension != high.type.dimension:
            log.report(
                "E0301",
                f"'min' and 'max' of the stops of '{liaison.name}' have different units",
                high.span,
                help="both are angles, or both are lengths",
            )
            return
        for name, value in (("min", low), ("max", high)):
            if not follows_time(value):
                refuse(
                    log,
                    f"'{name}' of stops that depends on the motion",
                    value.span,
                    "it may depend on parameters and time",
                )
        if not is_fixed(given):
            refuse(
                log,
                "a coefficient of restitution that depends on time or motion",
                given.span,
                "it may depend on parameters",
            )
        named = _named(law)
        found = _bounded(liaison, law, planar)
        if not found:
            has = ", ".join(_stopped(liaison, planar)) or "none"
            what = "coordinate of this unit" if named == "all" else f"coordinate '{named}'"
            log.report(
                "E0511",
                f"stops of '{liaison.name}', which has no {what}",
                law.span,
                help=f"its coordinates: {has}",
            )
        self._refuse_twice(liaison, law, found, planar, log)

    def _refuse_twice(
        self, liaison: Liaison, law: Law, found: tuple[str, ...], planar: bool, log: Log
    ) -> None:
        others = liaison.laws[: liaison.laws.index(law)]
        taken = {x for one in others if is_stop(one) for x in _bounded(liaison, one, planar)}
        for coordinate in found:
            kept = coordinate in _KEPT and not is_unilateral(liaison)
            if coordinate in taken or coordinate in liaison.driven or kept:
                why = "is kept by the liaison" if kept else "is driven"
                why = "is bounded twice" if coordinate in taken else why
                log.report(
                    "E0511",
                    f"stops of '{liaison.name}': its coordinate '{coordinate}' {why}",
                    law.span,
                    help="name another one, as in `coordinate = angle`, or leave out these stops",
                )


# Coordinates that move where a liaison can part alone.
_KEPT = ("gap", "length")


def is_stop(law: Law) -> bool:
    """Whether a law bounds a coordinate."""
    return law.kind.name == "stops"


def bounds_of(liaison: Liaison, planar: bool) -> tuple[Bounds, ...]:
    """The bounds that the laws of a liaison set, coordinate after coordinate."""
    return tuple(
        Bounds(law, coordinate, *(law.arguments[x] for x in ("min", "max", "e")))
        for law in liaison.laws
        if is_stop(law)
        for coordinate in _bounded(liaison, law, planar)
    )


def _bounded(liaison: Liaison, law: Law, planar: bool) -> tuple[str, ...]:
    """The coordinates that a law bounds: the one that it names, or all that have its unit."""
    named, dimension = _named(law), law.arguments["min"].type.dimension
    return tuple(
        name
        for name, kind in _stopped(liaison, planar).items()
        if kind.dimension == dimension and named in ("all", name)
    )


def _stopped(liaison: Liaison, planar: bool) -> Mapping[str, Type]:
    kinds = liaison_variables(liaison, planar)
    own = liaison.kind.coordinates
    return {name: kinds[name] for name in STOPPED if name in own and name in kinds}


def _named(law: Law) -> str:
    value = law.arguments.get("coordinate")
    return str(value.value) if isinstance(value, Literal) else "all"
