"""Where a figure loses its tangent or its normal, measured by how far its liaison is from there.

A curve has no tangent where its slope c' is zero, and is |c'|^2/|c''| from there to first order; a
surface of points likewise by the product of its slopes, and one F = 0 by its slope. On its axis, or
in its centre, nothing round has a nearest place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.planes import PointFigure
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.points import frames_of
from frot.compiler.mechanics.spatial import Pose, whole
from frot.compiler.translate.walk import follows_time, is_fixed
from frot.dsl.checked import Curve, CurvePlace, Expression, Liaison, Surface, SurfacePlace

COUNT = 3  # numbers that tell where (FROT_WHERE)
ALIKE = "where its figures are nearest they bend alike, so that no place of them is the nearest"


@dataclass(frozen=True, slots=True, eq=False)
class Vanishing:
    """What a liaison may lose, in words; `names` of the numbers `where` (3) that tell the place.

    `distance` from there, to first order: in m, or in radii; what is no number is none.
    """

    liaison: Liaison
    text: str
    names: tuple[str, ...]
    distance: ca.SX
    where: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Figured:
    """A figure of a liaison, at a pose, where it touches: at a place and by parameters."""

    name: str
    figure: Figure
    pose: Pose
    parameters: ca.SX
    place: ca.SX


def find_vanishing(
    links: Mapping[Liaison, Constraint],
    geometry: Mapping[Liaison, Geometry],
    kinematics: Kinematics,
) -> Iterator[Vanishing]:
    """What the figures of the liaisons may lose, and the directions that change."""
    lower = kinematics.fixed.lower
    for liaison, link in links.items():
        for what, value in _changing(liaison, link):
            size = lower(value)
            size = ca.norm_2(whole(size)) if value.type.shape else ca.fabs(size)
            yield Vanishing(
                liaison, f"liaison '{liaison.name}': {what}", (), size, ca.SX.zeros(COUNT)
            )
        for one in figures_in(link, geometry[liaison], kinematics):
            losses = one.figure.losses(one.pose, one.place, one.parameters, lower)
            for what, names, distance, where in losses:
                text = f"liaison '{liaison.name}': {what.format(one.name)}"
                padded = ca.vertcat(where, ca.SX.zeros(COUNT - where.numel()))
                yield Vanishing(liaison, text, names, distance, padded)
        track = kinematics.tracks.get(liaison)
        if track is not None:
            text = f"liaison '{liaison.name}': {ALIKE}"
            yield Vanishing(liaison, text, (), track.alone, ca.SX.zeros(COUNT))


def _changing(liaison: Liaison, link: Constraint) -> Iterator[tuple[str, Expression]]:
    """Axes and sizes of a liaison, and of what it joins, which are not given by parameters."""
    for argument in liaison.kind.arguments:
        value = liaison.options.get(argument.name)
        if value is None or is_fixed(value) or not follows_time(value):
            continue  # a length by the text or by motions is kept positive by an assertion
        if argument.kind == "axis":
            yield f"its {argument.name} has no direction", value
        elif argument.sign == "positive":
            yield f"its {argument.name} vanishes", value
    for frame in (frame for end in link.ends for frame in frames_of(end)):
        if isinstance(frame.axis, Expression) and not is_fixed(frame.axis):
            yield f"the axis of frame '{frame.name}' has no direction", frame.axis
    for place in (liaison.a, liaison.b):
        shaped: Curve | Surface
        match place:
            case CurvePlace():
                shaped = place.curve
            case SurfacePlace():
                shaped = place.surface
            case _:
                continue
        for name in ("radius", "a", "b"):
            value = shaped.arguments.get(name)
            if value is not None and not is_fixed(value):
                yield f"the {name} of '{shaped.name}' vanishes", value


def figures_in(link: Constraint, geometry: Geometry, kinematics: Kinematics) -> Iterator[Figured]:
    """The figures of a liaison, each where it touches, that which coordinates follow alone."""
    track, liaison = kinematics.tracks.get(link.liaison), link.liaison
    unknowns = ca.SX.zeros(0) if track is None else track.unknowns
    place, pairs = geometry.place(kinematics), link.pairs
    if liaison not in kinematics.along and not pairs:
        return
    first, second = (kinematics.pose(point) for point in link.ends)
    texts = [" ".join(x.span.text.split()) for x in (liaison.a, liaison.b)]
    name, other = reversed(texts) if link.swapped else texts
    if liaison in kinematics.along:
        unknowns = kinematics.along[liaison].parameter
        pairs = tuple((curve, PointFigure()) for curve in link.curves) or pairs
    for a, b in pairs:
        own = ca.SX.zeros(0) if a.rank >= 0 and b.rank >= 0 else unknowns
        count = 0 if a.rank >= 0 or not own.numel() else a.parameters
        yield _figured(name, a, first, own[:count], place, kinematics)
        yield _figured(other, b, second, own[count:], place, kinematics)


def _figured(
    name: str, figure: Figure, pose: Pose, own: ca.SX, place: ca.SX, kinematics: Kinematics
) -> Figured:
    """Where its parameters tell the place of its own, it is that."""
    if own.numel() and own.numel() == figure.parameters:
        place = pose.point(figure.point(own, kinematics.fixed.lower))
    return Figured(name, figure, pose, own, place)
