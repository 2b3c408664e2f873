"""Where what cannot part comes to the end of a curve: a fault, told by name.

What can part leaves it there, or stays on the end itself (`ended.py`).
"""

from __future__ import annotations

from collections.abc import Iterator

import casadi as ca
from frot.compiler.mechanics.geometry.ended import AT_END
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.geometry.vanishing import Figured, figures_in
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.values import Lower
from frot.compiler.mechanics.variables import Variables
from frot.dsl.checked import Expression, Liaison, Literal
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Leaving:
    """That a liaison leaves a curve, in words: once `value` is positive, unless it may part."""

    liaison: Liaison
    text: str
    value: ca.SX
    parts: Expression | None


def find_leaving(variables: Variables) -> Iterator[Leaving]:
    """Both ends of each curve that has some."""
    kinematics = variables.kinematics
    for liaison, link in variables.links.items():
        parts = liaison.options["unilateral"] if is_unilateral(liaison) else None
        if isinstance(parts, Literal) and parts.value is True:
            continue
        if liaison.kind.along_curve:
            placed = figure_of(liaison.b, kinematics.planar)
            assert placed is not None
            name = " ".join(liaison.b.span.text.split())
            found = [(name, placed.figure, variables.of_liaison(liaison, "u"))]
        else:
            own = figures_in(link, variables.geometry[liaison], kinematics)
            found = [(x.name, x.figure, _parameter(x, kinematics.fixed.lower)) for x in own]
        for name, figure, u in found:
            if figure.has_ends:
                text = f"liaison '{liaison.name}' leaves '{name}', which ends there"
                straight = figure.line is not None or figure.plane is not None
                text += "" if straight else " (unless it says `periodic = true`)"
                least, largest = figure.ends(kinematics.fixed.lower)
                beyond = ca.fmax(u - largest, least - u) - AT_END * (largest - least)
                yield Leaving(liaison, text, beyond, parts)


def _parameter(one: Figured, lower: Lower) -> ca.SX:
    """That of the place where a figure touches."""
    if one.parameters.numel() or not one.figure.has_ends:
        return one.parameters
    return one.figure.parameter(one.place - one.pose.origin, one.pose, lower)
