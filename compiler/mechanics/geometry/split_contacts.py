"""Contacts in space that are several: what figures with ends touch a plane, a face or a side with.

A cylinder lies on its rims, a rod on its ends. On a face with borders they may touch its edges too,
the rims of a cylinder and its side, and so may any rim or ellipsoid: each pair is a contact of its
own. Sides that cross touch at one place, those that are parallel by their rims. So is each end of a
line on a plane a contact, which presses as a guide does: of half length L it carries the force N
along the normal and the couple C across by N1 + N2 = N, L (N1 - N2) = C.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from frot.compiler.mechanics.geometry.bounded_figures import has_nearest_ball
from frot.compiler.mechanics.geometry.figure import Figure, Placed
from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.shapes import shape_of
from frot.dsl.catalogue import TYPES
from frot.dsl.checked import (
    Binary,
    BodyGeometry,
    BodyPoint,
    Call,
    CurvePlace,
    Expression,
    Frame,
    Law,
    Liaison,
    Literal,
    Place,
)
from frot.dsl.quantities.dimensions import REAL

Pairs = tuple[tuple[Place, Place], ...]
_SPACE = (3,)


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
    return _on_side(liaison, a, b) if is_unilateral(liaison) else ()


def _on_side(liaison: Liaison, a: Placed, b: Placed) -> Pairs:
    """The side of a cylinder with what has an extent, then the ends of each with the other.

    A rim touches surfaces and lines, no other curve.
    """
    one, other = a.figure, b.figure
    ball = has_nearest_ball(one, other) or has_nearest_ball(other, one)
    if one.tube is other.tube is None or ball:
        return ()
    found = [
        *((end, liaison.b) for end in _own_ends(liaison.a, other)),
        *((liaison.a, end) for end in _own_ends(liaison.b, one)),
    ]
    return ((liaison.a, liaison.b), *found) if found else ()


def _own_ends(place: Place, other: Figure) -> tuple[BodyPoint | BodyGeometry, ...]:
    """The ends of a side, an axis or an edge that may touch another figure."""
    if not isinstance(place, BodyGeometry) or not (other.is_surface or other.straight):
        return ()
    return shape_of(place.body).ends(place)


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


def split_line(liaison: Liaison, planar: bool) -> tuple[Liaison, ...]:
    """The liaison with its plane for each end of its line; none where it is one liaison.

    The ends are those of a rod or an edge, or lie at the `half_length` of a law beside the point of
    a line of the text.
    """
    rubs = any(law.kind.name in liaison.kind.laws_in_space for law in liaison.laws)
    if planar or not (rubs or is_unilateral(liaison)):
        return ()
    for line, plane in ((liaison.a, liaison.b), (liaison.b, liaison.a)):
        surface = figure_of(plane, planar)
        ends = tuple(_ends(line, liaison))
        if surface is None or surface.figure.plane is None or not ends:
            continue
        laws = tuple(_of_end(law) for law in liaison.laws)
        pairs = ((end, plane) if line is liaison.a else (plane, end) for end in ends)
        return tuple(replace(liaison, a=a, b=b, laws=laws) for a, b in pairs)
    return ()


def _ends(line: Place, liaison: Liaison) -> Iterator[Place]:
    """The two places where a line presses; none of what is no line, or has no length."""
    if isinstance(line, BodyGeometry):
        own = figure_of(line, False)
        if own is not None and own.figure.line is not None:
            yield from shape_of(line.body).ends(line)
        return
    half = next((x for law in liaison.laws if (x := law.arguments.get("half_length"))), None)
    if not isinstance(line, CurvePlace) or line.curve.kind != "line" or half is None:
        return
    curve, length = line.curve, TYPES["Length"].of_shape(_SPACE)
    through, direction, span = curve.arguments["through"], curve.arguments["direction"], line.span
    size = Call("norm", (direction,), direction.type.item, span)
    unit = Binary("/", direction, size, REAL.of_shape(_SPACE), span)
    for sign in (-1.0, 1.0):
        signed: Expression = Binary("*", Literal(sign, REAL, span), half, half.type, span)
        way = Binary("*", signed, unit, length, span)
        place = Binary("+", through, way, length, span)
        yield Frame(curve.name, curve.owner, place, None, "z", span)


def _of_end(law: Law) -> Law:
    """The law of one end: it needs no length."""
    own = {name: value for name, value in law.arguments.items() if name != "half_length"}
    return replace(law, arguments=own)
