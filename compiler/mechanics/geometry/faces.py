"""Faces on planes: each corner is a contact of its own, and what the liaison says is their sum."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from frot.compiler.lowering.walk import follows_time
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.refuse import refuse_places
from frot.compiler.mechanics.shapes import shape_of
from frot.dsl import Log
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import BodyGeometry, BodyPoint, Liaison, Model, Place
from frot.dsl.data.classes import dataclass, replace

# Corners that tell where a face is: an effort along each of more could not be told apart.
_DETERMINE = 3


@dataclass(frozen=True, slots=True, eq=False)
class Faced:
    """The model with a liaison for each corner, and those that each liaison of faces stands for."""

    model: Model
    corners: Mapping[Liaison, tuple[Liaison, ...]]


def part_faces(model: Model, log: Log) -> Faced:
    """Replace `appui_faces`; places that are no face on a plane are reported."""
    liaisons: list[Liaison] = []
    corners: dict[Liaison, tuple[Liaison, ...]] = {}
    for liaison in model.liaisons:
        if liaison.kind.name != "appui_faces":
            liaisons.append(liaison)
            continue
        found = _corners(liaison, model.planar)
        if found is None:
            refuse_places(liaison, log)
            continue
        first, ends = found
        if not all(follows_time(x) for x in liaison.driven.values()):
            ends = ends[:_DETERMINE]
        corners[liaison] = tuple(_contacts(liaison, first, ends))
        liaisons += corners[liaison]
    return Faced(replace(model, liaisons=tuple(liaisons)), corners) if corners else Faced(model, {})


def _corners(liaison: Liaison, planar: bool) -> tuple[bool, tuple[BodyPoint, ...]] | None:
    """Whether the face is the first place, and its corners."""
    for face, other in ((liaison.a, liaison.b), (liaison.b, liaison.a)):
        ends = shape_of(face.body).corners(face) if isinstance(face, BodyGeometry) else ()
        plane = figure_of(other, planar)
        if ends and plane is not None and plane.figure.plane is not None:
            return face is liaison.a, ends
    return None


def _contacts(liaison: Liaison, first: bool, ends: tuple[BodyPoint, ...]) -> Iterator[Liaison]:
    kind = LIAISONS["contact_ponctuel"]
    for k, corner in enumerate(ends):
        places: tuple[Place, Place] = (corner, liaison.b) if first else (liaison.a, corner)
        name = f"{liaison.name}[{k + 1}]"
        yield replace(liaison, name=name, kind=kind, a=places[0], b=places[1])
