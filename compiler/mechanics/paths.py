"""Curves by their parameter: the point of each value, and the value of a point."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.figures import Ball, Figure, Oval, Path, Ring
from frot.compiler.mechanics.moves import Lower, unit_vector
from frot.compiler.mechanics.spatial import Pose, X, Y, beside, whole


def point_of(figure: Figure, u: ca.SX, lower: Lower) -> ca.SX:
    """The point of a curve in the axes of its centre."""
    if isinstance(figure, Path):
        value = whole(lower(figure.point))
        return value if figure.u is None else ca.substitute(value, lower(figure.u), u)
    (a, first), (b, second) = _semi_axes(figure, lower)
    return ca.sparsify(a * ca.cos(u) * first + b * ca.sin(u) * second)


def parameter_of(figure: Figure, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
    """The parameter, within half a turn, of the point of a round curve `apart` from its centre."""
    (a, first), (b, second) = _semi_axes(figure, lower)
    x, y = (ca.dot(pose.direction(e), apart) for e in (first, second))
    return ca.atan2(y / b, x / a)


def _semi_axes(figure: Figure, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
    if isinstance(figure, Ball):
        radius = lower(figure.radius)
        return (radius, X), (radius, Y)
    assert isinstance(figure, Ring | Oval)
    first, second = beside(unit_vector(figure.axis.given, lower))
    if isinstance(figure, Ring):
        radius = lower(figure.radius)
        return (radius, first), (radius, second)
    return (lower(figure.a), first), (lower(figure.b), second)
