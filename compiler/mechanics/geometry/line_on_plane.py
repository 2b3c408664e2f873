"""A line on a plane that rubs or may part: it presses with its two ends, as a guide does.

A line of half length L carries the force N along the normal and the couple C across by N1 + N2 = N,
L (N1 - N2) = C. Each end is a contact of a point. The ends are those of a rod or an edge, or lie at
the `half_length` of a law beside the point of a line of the text.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from frot.compiler.mechanics.geometry.figures import figure_of
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.shapes import shape_of
from frot.dsl.catalogue import TYPES
from frot.dsl.checked import (
    Binary,
    BodyGeometry,
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

_SPACE = (3,)


def split_line(liaison: Liaison, planar: bool) -> tuple[Liaison, ...]:
    """The liaison with its plane for each end of its line; none where it is one liaison."""
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
    """The law of one end: it needs no length, and half of what damps the whole."""
    own = {name: value for name, value in law.arguments.items() if name != "half_length"}
    damping = own.get("c")
    if damping is not None:
        half = Literal(0.5, REAL, law.span)
        own["c"] = Binary("*", half, damping, damping.type, law.span)
    return replace(law, arguments=own)
