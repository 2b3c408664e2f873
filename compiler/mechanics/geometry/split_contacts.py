"""Contacts in space that are several: what a figure with ends touches a plane or a face with.

A cylinder lies on its rims, a rod on its ends. On a face with borders they may touch its edges too,
the rims of a cylinder and its side, and so may any rim or ellipsoid: each pair is a contact of its
own.
"""

from __future__ import annotations

from frot.compiler.mechanics.geometry.bounded_figures import has_nearest_ball
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.shapes import shape_of
from frot.dsl.checked import BodyGeometry, Liaison, Place

Pairs = tuple[tuple[Place, Place], ...]


def split_contact(liaison: Liaison, planar: bool) -> Pairs:
    """The pairs of places, in the order of the liaison; none where it is one contact."""
    if planar or not (is_unilateral(liaison) or liaison.laws):
        return ()
    a, b = (figure_of(x, planar) for x in (liaison.a, liaison.b))
    if a is None or b is None:
        return ()
    if b.figure.plane is not None:
        return _on_plane(liaison, liaison.a, liaison.b, a, b)
    if a.figure.plane is not None:
        found = _on_plane(liaison, liaison.b, liaison.a, b, a)
        return tuple((face, own) for own, face in found)
    return ()


def _on_plane(liaison: Liaison, own: Place, face: Place, a: Placed, b: Placed) -> Pairs:
    """What a place touches a plane with, and the edges of that."""
    ends = shape_of(own.body).ends(own) if isinstance(own, BodyGeometry) else ()
    found: list[tuple[Place, Place]] = [(end, face) for end in ends]
    if not isinstance(face, BodyGeometry) or not is_unilateral(liaison):
        return tuple(found)
    edges = shape_of(face.body).edges(face)
    if not edges or has_nearest_ball(b.figure, a.figure):
        return tuple(found)
    touching = [x for x in ends if isinstance(x, BodyGeometry)]
    corners = shape_of(face.body).corners(face) if touching else ()
    found = found or [(own, face)]
    edged = ((x, edge) for x in (*touching, own) for edge in edges)
    return (*found, *edged, *((own, corner) for corner in corners))
