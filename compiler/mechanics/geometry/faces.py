"""Faces on planes: each corner is a contact of its own, and what the liaison says is their sum.

A side on a side, or a face on a face, has the corners of both: one that reaches beyond the other
rests on the other's corner. A round face has those of a polygon about its rim (`shape.py`). Edges
of faces in space may cross, each pair of them a contact.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from frot.compiler.mechanics.geometry.bounded_figures import ends
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.geometry.split_contacts import Pairs, split_contact, split_line
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
        if liaison.kind.name == _LINE and (lines := split_line(liaison, model.planar)):
            pairs = tuple((x.a, x.b) for x in lines)
            corners[liaison] = tuple(_contacts(lines[0], pairs))
            liaisons += corners[liaison]
            continue
        split = _SPLITS.get(liaison.kind.name)
        found = () if split is None else split(liaison, model.planar)
        if not found and split is _corners:
            refuse_places(liaison, log)
            continue
        if not found:
            liaisons.append(liaison)
            continue
        if not all(follows_time(x) for x in liaison.driven.values()):
            found = found[:_DETERMINE]
        corners[liaison] = tuple(_contacts(liaison, found))
        liaisons += corners[liaison]
    return Faced(replace(model, liaisons=tuple(liaisons)), corners) if corners else Faced(model, {})


def _corners(liaison: Liaison, planar: bool) -> Pairs:
    """Each corner with what it rests on, in the order of the liaison; none without a face."""
    found: list[tuple[Place, Place]] = []
    for first in (True, False):
        face, other = (liaison.a, liaison.b) if first else (liaison.b, liaison.a)
        own = figure_of(face, planar)
        if not isinstance(face, BodyGeometry) or own is None or own.figure.is_round:
            continue  # a rim of the plane is no face
        corners, plane = shape_of(face.body).corners(face), figure_of(other, planar)
        if not corners or plane is None or not _is_flat(plane.figure, planar):
            continue
        if own.figure.oval is not None and ends(plane.figure):
            continue  # its rim would have to touch the edges too
        if not found or (ends(plane.figure) and is_unilateral(liaison)):
            found += [(corner, other) if first else (other, corner) for corner in corners]
    if not found:
        return ()
    return (*found, *(() if planar else _crossings(liaison)))


def _crossings(liaison: Liaison) -> Iterator[tuple[Place, Place]]:
    """The edges of two faces in space, which may cross."""
    a, b = liaison.a, liaison.b
    if isinstance(a, BodyGeometry) and isinstance(b, BodyGeometry) and is_unilateral(liaison):
        own, other = (shape_of(face.body).edges(face) for face in (a, b))
        yield from itertools.product(own, other)


# What presses with the ends of a line.
_LINE = "lineaire_rectiligne"
# What makes several contacts of one liaison, by its kind.
_SPLITS = {"appui_faces": _corners, "contact_ponctuel": split_contact}


def _is_flat(figure: Figure, planar: bool) -> bool:
    """Whether it is a plane, or in the plane a line, one that depends on time too."""
    return figure.plane is not None or (planar and figure.line is not None)


def _contacts(liaison: Liaison, pairs: Pairs) -> Iterator[Liaison]:
    kind = LIAISONS["contact_ponctuel"]
    for k, (a, b) in enumerate(pairs):
        yield replace(liaison, name=f"{liaison.name}[{k + 1}]", kind=kind, a=a, b=b)
