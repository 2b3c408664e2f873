"""Figures as places where a function is zero: plane, sphere, cylinder, ellipsoid, implicit surface.

The function grows outwards. No surface needs charts so, and none of its points is singular.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure, Loss, local_of
from frot.compiler.mechanics.spatial import Pose
from frot.compiler.mechanics.values import Lower, rate_by_time


@dataclass(frozen=True, slots=True, eq=False)
class LevelValue:
    """The function at a place, its slope (3, ground axes), its rate at a place of the body."""

    value: ca.SX
    slope: ca.SX
    rate: ca.SX

    @property
    def steep(self) -> ca.SX:
        """Length of the slope; value/steep is the distance to first order."""
        return ca.sqrt(ca.sumsqr(self.slope))


def level(figure: Figure, place: ca.SX, pose: Pose, lower: Lower) -> LevelValue:
    """The function of a figure at a place in ground axes."""
    local = ca.sparsify(pose.axes.T @ (place - pose.origin))
    x = ca.SX.sym("x", 3)
    value = figure.function(x, lower)
    found = [value, ca.gradient(value, x), rate_by_time(value, lower)]
    here = [ca.sparsify(ca.SX(f)) for f in ca.substitute(found, [x], [ca.densify(local)])]
    return LevelValue(here[0], pose.direction(here[1]), here[2])


def lost_slope(figure: Figure, pose: Pose, place: ca.SX, lower: Lower) -> Iterator[Loss]:
    """That a figure has no normal at a place, where the slope of its function is zero."""
    steep = level(figure, place, pose, lower).steep
    yield "the normal of '{}' vanishes", ("x", "y", "z"), steep, local_of(pose, place)
