"""Figures by parameters: a point with its slopes, and how the material there moves."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.spatial import Pose, nowhere
from frot.compiler.mechanics.values import Lower, rate_by_time


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
    if figure.is_point:
        return Trace(pose.origin, (), nowhere())
    own = [ca.SX.sym("s") for _ in range(s.numel())]
    point = figure.point(ca.vertcat(*own), lower)
    local = [point, *(ca.jacobian(point, x) for x in own), rate_by_time(point, lower)]
    here = [ca.sparsify(ca.SX(x)) for x in ca.substitute(local, own, list(ca.vertsplit(s)))]
    first, *slopes, drift = (pose.direction(x) for x in here)
    return Trace(pose.origin + first, tuple(slopes), drift)


def slope_at(figure: Figure, at: ca.SX, lower: Lower) -> ca.SX:
    """The derivative (3) of a curve's point by its parameter, in the axes of its centre."""
    u = ca.SX.sym("u")
    return ca.substitute(ca.jacobian(figure.point(u, lower), u), u, at)
