"""Drives that follow other than time alone, and relations of one's own, as equations of the text.

A coordinate that is a value of time is none (`motions.Driven`). One that follows an input, a
variable, a motion or a switch, and a prescribed speed, stay free: an effort along them, an unknown,
is what the equation `coordinate = value` needs. Index reduction finds it, as it does for a motor on
a flange.
"""

from __future__ import annotations

from dataclasses import replace

from frot.compiler.mechanics.liaisons.kinematic_relations import (
    TURNING,
    coordinate_of,
    drives_of,
    is_rate,
    is_row,
    reaction_of,
)
from frot.compiler.mechanics.liaisons.orientations import ANGULAR_VELOCITY
from frot.compiler.translate.walk import follows_time
from frot.dsl.catalogue import TYPES
from frot.dsl.checked import Equation, Expression, Flange, Liaison, Model, Quantity, Variable

# What drives a coordinate is a couple where this is an angle, else a force.
_ANGLES = ("angle", "angle_a", "angle_b")


def free_drives(model: Model) -> Model:
    """The model with each of them as an effort and an equation; itself where it has none."""
    drives = any(_goes_free(x, name, model.planar) for x in model.liaisons for name in drives_of(x))
    if not drives and all(is_row(r) for x in model.liaisons for r in x.relations):
        return model
    efforts: list[Flange] = []
    equations: list[Equation] = []
    for liaison in model.liaisons:
        for name, value in drives_of(liaison).items():
            if _goes_free(liaison, name, model.planar):
                efforts += _efforts(liaison, driven_coordinate(liaison, name))
                equations.append(_equation(liaison, name, value))
        for k, relation in enumerate(liaison.relations, 1):
            if not is_row(relation):
                effort = reaction_of(liaison, k)
                efforts.append(Flange(liaison, coordinate_of(k), effort, drives=True))
                sides = relation.left, relation.right
                equations.append(Equation(*sides, relation.left.span, drives=True))
    return replace(
        model,
        variables=(*model.variables, *(x.effort for x in efforts)),
        equations=(*model.equations, *equations),
        flanges=(*model.flanges, *efforts),
    )


def driven_coordinate(liaison: Liaison, name: str) -> str:
    """The coordinate that a drive moves: of a speed, that whose rate it is."""
    if not name.startswith("speed"):
        return name
    slides = name == "speed" and "displacement" in liaison.kind.coordinates
    return "displacement" if slides else "angle"


def told_by_time(liaison: Liaison, planar: bool) -> dict[str, Expression]:
    """The drives of a liaison that are values of time: their coordinates are none."""
    return {k: x for k, x in drives_of(liaison).items() if not _goes_free(liaison, k, planar)}


def _goes_free(liaison: Liaison, name: str, planar: bool) -> bool:
    along_a_line = planar and liaison.kind.along_curve
    return is_rate(name) or along_a_line or not follows_time(drives_of(liaison)[name])


def _efforts(liaison: Liaison, coordinate: str) -> list[Flange]:
    """What drives a coordinate; an angular velocity in space has three couples."""
    if coordinate == TURNING:
        return [_effort(liaison, name) for name in ANGULAR_VELOCITY]
    return [_effort(liaison, coordinate)]


def _effort(liaison: Liaison, coordinate: str) -> Flange:
    quantity = "Torque" if coordinate in (*_ANGLES, *ANGULAR_VELOCITY) else "Force"
    effort = Variable(
        f"{liaison.name}.drive.{coordinate}",
        TYPES[quantity],
        liaison.span,
        f"what drives '{coordinate}'",
        quantity=quantity,
    )
    return Flange(liaison, coordinate, effort, drives=True)


def _equation(liaison: Liaison, name: str, value: Expression) -> Equation:
    place = Quantity(liaison, name, value.type, value.span)
    return Equation(place, value, value.span, drives=True)
