"""Where what cannot part comes to the end of a curve or a face: a fault, reported by name.

What can part leaves it there, or stays on the end itself (`curves_with_ends.py`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.curves_with_ends import AT_END
from frot.compiler.mechanics.geometry.figure import Figure, local_of
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.geometry.vanishing import Figured, figures_in
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.values import Lower
from frot.compiler.mechanics.variables import Variables
from frot.dsl.checked import Expression, Liaison, Literal


@dataclass(frozen=True, slots=True, eq=False)
class Leaving:
    """That a liaison leaves a curve, in words: once `value` is positive, unless it may part."""

    liaison: Liaison
    text: str
    value: ca.SX
    parts: Expression | None


def find_leaving(variables: Variables) -> Iterator[Leaving]:
    """Both ends of each curve that has some, the borders of faces, the ends of parameters."""
    kinematics, lower = variables.kinematics, variables.kinematics.fixed.lower
    for liaison, link in variables.links.items():
        parts = liaison.options["unilateral"] if is_unilateral(liaison) else None
        if isinstance(parts, Literal) and parts.value is True:
            continue
        if liaison.kind.along_curve:
            placed = figure_of(liaison.b, kinematics.planar)
            assert placed is not None
            name = " ".join(liaison.b.span.text.split())
            found = [(name, placed.figure, variables.of_liaison(liaison, "u"))]
            own = []
        else:
            own = list(figures_in(link, variables.geometry[liaison], kinematics))
            found = [(x.name, x.figure, _parameter(x, lower)) for x in own]
        for name, figure, u in found:
            if figure.has_ends:
                straight = figure.line is not None or figure.plane is not None
                more = "" if straight else " (unless it says `periodic = true`)"
                yield Leaving(liaison, _text(liaison, name) + more, _past(u, figure, lower), parts)
        for one in own:
            for k, least, largest in one.figure.limits(lower) if one.parameters.numel() else ():
                text = f"{_text(liaison, one.name)} (unless it says `periodic = true`)"
                yield Leaving(liaison, text, _beyond(one.parameters[k], least, largest), parts)
            for axis, long in one.figure.borders:
                way = ca.dot(axis.unit(lower), local_of(one.pose, one.place))
                beyond = ca.fabs(way) - (0.5 + AT_END) * lower(long)
                yield Leaving(liaison, _text(liaison, one.name), beyond, parts)


def _text(liaison: Liaison, name: str) -> str:
    return f"liaison '{liaison.name}' leaves '{name}', which ends there"


def _past(u: ca.SX, figure: Figure, lower: Lower) -> ca.SX:
    """How far a parameter is beyond the ends of a curve."""
    return _beyond(u, *figure.ends(lower))


def _beyond(u: ca.SX, least: ca.SX, largest: ca.SX) -> ca.SX:
    return ca.fmax(u - largest, least - u) - AT_END * (largest - least)


def _parameter(one: Figured, lower: Lower) -> ca.SX:
    """That of the place where a figure touches."""
    if one.parameters.numel() or not one.figure.has_ends:
        return one.parameters
    return one.figure.parameter(one.place - one.pose.origin, one.pose, lower)
