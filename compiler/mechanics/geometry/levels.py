"""Figures as places where a function is zero: plane, sphere, cylinder, ellipsoid, implicit surface.

The function grows outwards. No surface needs charts so, and none of its points is singular.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import casadi as ca
from frot.compiler.mechanics.geometry.figures import Ball, Egg, Figure, Flat, Implicit, Straight
from frot.compiler.mechanics.spatial import Pose, Z, cross
from frot.compiler.mechanics.values import Lower, rate_by_time, unit_vector
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """The function at a place, its slope (3, ground axes), its rate at a place of the body."""

    value: ca.SX
    slope: ca.SX
    rate: ca.SX

    @property
    def steep(self) -> ca.SX:
        """Length of the slope; value/steep is the distance to first order."""
        return ca.sqrt(ca.sumsqr(self.slope))


def level(figure: Figure, place: ca.SX, pose: Pose, lower: Lower) -> Level:
    """The function of a figure at a place in ground axes."""
    local = ca.sparsify(pose.axes.T @ (place - pose.origin))
    x = ca.SX.sym("x", 3)
    value = _FUNCTIONS[type(figure)](figure, x, lower)
    found = [value, ca.gradient(value, x), rate_by_time(value, lower)]
    here = [ca.sparsify(ca.SX(f)) for f in ca.substitute(found, [x], [ca.densify(local)])]
    return Level(here[0], pose.direction(here[1]), here[2])


def _flat(figure: Flat, x: ca.SX, lower: Lower) -> ca.SX:
    axis = unit_vector(figure.axis.given, lower)
    return ca.dot(cross(Z, axis) if figure.in_plane else axis, x)


def _ball(figure: Ball, x: ca.SX, lower: Lower) -> ca.SX:
    return ca.sqrt(ca.sumsqr(x)) - lower(figure.radius)


def _straight(figure: Straight, x: ca.SX, lower: Lower) -> ca.SX:
    assert figure.radius is not None
    axis = unit_vector(figure.axis.given, lower)
    return ca.sqrt(ca.sumsqr(x - ca.dot(axis, x) * axis)) - lower(figure.radius)


def _egg(figure: Egg, x: ca.SX, lower: Lower) -> ca.SX:
    semi = lower(figure.semi_axes)
    return (sum(((x[k] / semi[k]) ** 2 for k in range(3)), ca.SX(0)) - 1) / 2


def _implicit(figure: Implicit, x: ca.SX, lower: Lower) -> ca.SX:
    value = lower(figure.value)
    for k, unknown in enumerate(figure.unknowns):
        if unknown is not None:
            value = ca.substitute(value, lower(unknown), x[k])
    return value


_FUNCTIONS: Mapping[type, Callable[..., ca.SX]] = {
    Flat: _flat,
    Ball: _ball,
    Straight: _straight,
    Egg: _egg,
    Implicit: _implicit,
}
