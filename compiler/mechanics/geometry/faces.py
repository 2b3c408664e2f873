"""Faces on planes: each corner is a contact of its own, and what the liaison says is their sum.

In the plane a side on a side has the corners of both: one that reaches beyond the other rests on
the other's corner.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.unsupported import refuse_places
from frot.compiler.translate.walk import follows_time
from frot.dsl import Log
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import BodyGeometry, Liaison, Model, Place

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
        if not all(follows_time(x) for x in liaison.driven.values()):
            found = found[:_DETERMINE]
        corners[liaison] = tuple(_contacts(liaison, found))
        liaisons += corners[liaison]
    return Faced(replace(model, liaisons=tuple(liaisons)), corners) if corners else Faced(model, {})


def _corners(liaison: Liaison, planar: bool) -> tuple[tuple[Place, Place], ...] | None:
    """Each corner with what it rests on, in the order of the liaison."""
    found: list[tuple[Place, Place]] = []
    for first in (True, False):
        face, other = (liaison.a, liaison.b) if first else (liaison.b, liaison.a)
        ends = shape_of(face.body).corners(face) if isinstance(face, BodyGeometry) else ()
        plane = figure_of(other, planar)
        if not ends or plane is None or not _is_flat(plane.figure, planar):
            continue
        if not found or (plane.figure.has_ends and is_unilateral(liaison)):
            found += [(corner, other) if first else (other, corner) for corner in ends]
    return tuple(found) or None


def _is_flat(figure: Figure, planar: bool) -> bool:
    """Whether it is a plane, or in the plane a line, one that depends on time too."""
    return figure.plane is not None or (planar and figure.line is not None)


def _contacts(liaison: Liaison, pairs: tuple[tuple[Place, Place], ...]) -> Iterator[Liaison]:
    kind = LIAISONS["contact_ponctuel"]
    for k, (a, b) in enumerate(pairs):
        yield replace(liaison, name=f"{liaison.name}[{k + 1}]", kind=kind, a=a, b=b)
