"""Figures by parameters: the point of each value, and the value of a point."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.figures import (
    Ball,
    Dot,
    Figure,
    Flat,
    Oval,
    Path,
    Ring,
    Sheet,
    Straight,
)
from frot.compiler.mechanics.spatial import Pose, X, Y, nowhere, whole
from frot.compiler.mechanics.values import Lower, beside_given, rate_by_time, unit_vector
from frot.dsl.checked import Expression
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """A point of a figure in ground axes, its slopes by the parameters, and its own velocity.

    `drift` is the velocity of the material element, which keeps its parameters, in the body's axes.
    """

    point: ca.SX
    slopes: tuple[ca.SX, ...]
    drift: ca.SX


def trace(figure: Figure, s: ca.SX, pose: Pose, lower: Lower) -> Trace:
    """The point of a figure that has the parameters `s`."""
    if isinstance(figure, Dot):
        return Trace(pose.origin, (), nowhere())
    own = [ca.SX.sym("s") for _ in range(s.numel())]
    point = point_of(figure, ca.vertcat(*own), lower)
    local = [point, *(ca.jacobian(point, x) for x in own), rate_by_time(point, lower)]
    here = [ca.sparsify(ca.SX(x)) for x in ca.substitute(local, own, list(ca.vertsplit(s)))]
    first, *slopes, drift = (pose.direction(x) for x in here)
    return Trace(pose.origin + first, tuple(slopes), drift)


def point_of(figure: Figure, u: ca.SX, lower: Lower) -> ca.SX:
    """The point of a curve or surface in the axes of its centre; of a surface u has two items."""
    if isinstance(figure, Path):
        return _put(figure.point, (figure.u,), u, lower)
    if isinstance(figure, Sheet):
        return _put(figure.point, figure.unknowns, u, lower)
    if isinstance(figure, Straight | Flat):
        return ca.sparsify(u * unit_vector(figure.axis.given, lower))
    (a, first), (b, second) = _semi_axes(figure, lower)
    return ca.sparsify(a * ca.cos(u) * first + b * ca.sin(u) * second)


def _put(
    point: Expression, unknowns: tuple[Expression | None, ...], u: ca.SX, lower: Lower
) -> ca.SX:
    value = whole(lower(point))
    for k, unknown in enumerate(unknowns):
        if unknown is not None:
            value = ca.substitute(value, lower(unknown), u[k])
    return ca.sparsify(value)


def parameter_of(figure: Figure, apart: ca.SX, pose: Pose, lower: Lower) -> ca.SX:
    """The parameter of the point `apart` from a curve's centre; an angle within half a turn."""
    if isinstance(figure, Straight | Flat):
        return ca.dot(pose.direction(unit_vector(figure.axis.given, lower)), apart)
    (a, first), (b, second) = _semi_axes(figure, lower)
    x, y = (ca.dot(pose.direction(e), apart) for e in (first, second))
    return ca.atan2(y / b, x / a)


def _semi_axes(figure: Figure, lower: Lower) -> tuple[tuple[ca.SX, ca.SX], tuple[ca.SX, ca.SX]]:
    if isinstance(figure, Ball):
        radius = lower(figure.radius)
        return (radius, X), (radius, Y)
    assert isinstance(figure, Ring | Oval)
    first, second = beside_given(figure.axis.given, lower)
    if isinstance(figure, Ring):
        radius = lower(figure.radius)
        return (radius, first), (radius, second)
    return (lower(figure.a), first), (lower(figure.b), second)
