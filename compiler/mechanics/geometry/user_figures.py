"""Curves and surfaces that the text gives by a function or by their points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure, Loss
from frot.compiler.mechanics.geometry.implicit_figures import lost_slope
from frot.compiler.mechanics.spatial import Pose, cross, whole
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Expression

LONG = 32  # beginnings looked at along a curve
ACROSS = 8  # along each parameter of a surface


@dataclass(frozen=True, slots=True, eq=False)
class Implicit(Figure):
    """A surface F(x, y, z) = 0; `unknowns` are x, y, z in it, None where one does not occur."""

    value: Expression
    unknowns: tuple[Expression | None, ...]

    @property
    def rank(self) -> int:
        """Nothing is known of its function."""
        return 4

    @property
    def is_steep(self) -> bool:
        """The distance is that over the slope."""
        return True

    def function(self, x: ca.SX, lower: Lower) -> ca.SX:
        """F."""
        value = lower(self.value)
        for k, unknown in enumerate(self.unknowns):
            if unknown is not None:
                value = ca.substitute(value, lower(unknown), x[k])
        return value

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The normal, where the slope is zero."""
        return lost_slope(self, pose, place, lower)


@dataclass(frozen=True, slots=True, eq=False)
class Path(Figure):
    """A curve of points that depend on the parameter `u`, None where it does not occur.

    `bounds` are the two ends of the parameter, of one that is `periodic` of a period.
    """

    points: Expression
    u: Expression | None
    bounds: Expression
    periodic: bool

    @property
    def parameters(self) -> int:
        """The one of the text."""
        return 1

    def point(self, u: ca.SX, lower: Lower) -> ca.SX:
        """As the text says."""
        return _put(self.points, (self.u,), u, lower)

    @property
    def has_ends(self) -> bool:
        """Where its function is not periodic."""
        return not self.periodic

    def ends(self, lower: Lower) -> tuple[ca.SX, ca.SX]:
        """As the text says, in either order."""
        bounds = lower(self.bounds)
        return ca.mmin(bounds), ca.mmax(bounds)

    def beginnings(self, lower: Lower) -> list[ca.SX]:
        """From end to end."""
        return _between(lower(self.bounds), LONG)

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The tangent, in a cusp: |c'|^2/|c''| from there, no number where both are zero."""
        if not s.numel():
            return
        u = ca.SX.sym("u")
        slope = ca.jacobian(self.point(u, lower), u)
        bend = ca.sqrt(ca.sumsqr(ca.jacobian(slope, u)))
        size = ca.sumsqr(slope)
        distance = ca.if_else(bend > 0, size / bend, ca.sqrt(size))
        yield "the tangent of '{}' vanishes", ("u",), ca.substitute(distance, u, s), s


@dataclass(frozen=True, slots=True, eq=False)
class Sheet(Figure):
    """A surface of points that depend on `u` and `v`, None for one that does not occur.

    `bounds` are as those of a curve, for each, and so is `periodic`.
    """

    points: Expression
    unknowns: tuple[Expression | None, ...]
    bounds: tuple[Expression, Expression]
    periodic: tuple[bool, bool]

    @property
    def parameters(self) -> int:
        """The two of the text."""
        return 2

    def point(self, u: ca.SX, lower: Lower) -> ca.SX:
        """As the text says; `u` has two items."""
        return _put(self.points, self.unknowns, u, lower)

    def limits(self, lower: Lower) -> Iterator[tuple[int, ca.SX, ca.SX]]:
        """As the text says."""
        for k, (bounds, periodic) in enumerate(zip(self.bounds, self.periodic, strict=True)):
            if not periodic:
                ends = lower(bounds)
                yield k, ca.mmin(ends), ca.mmax(ends)

    def beginnings(self, lower: Lower) -> list[ca.SX]:
        """Over the whole of it."""
        first, second = (_between(lower(x), ACROSS) for x in self.bounds)
        return [ca.vertcat(u, v) for u in first for v in second]

    def losses(self, pose: Pose, place: ca.SX, s: ca.SX, lower: Lower) -> Iterator[Loss]:
        """The normal: |p_u x p_v| over the greater of the slopes."""
        if not s.numel():
            return
        u = ca.SX.sym("u", 2)
        slope = ca.densify(ca.jacobian(self.point(u, lower), u))
        normal = cross(slope[:, 0], slope[:, 1])
        size = ca.sqrt(ca.sumsqr(normal) / ca.fmax(ca.sumsqr(slope[:, 0]), ca.sumsqr(slope[:, 1])))
        yield "the normal of '{}' vanishes", ("u", "v"), ca.substitute(size, u, s), s


def _put(
    points: Expression, unknowns: tuple[Expression | None, ...], u: ca.SX, lower: Lower
) -> ca.SX:
    value = whole(lower(points))
    for k, unknown in enumerate(unknowns):
        if unknown is not None:
            value = ca.substitute(value, lower(unknown), u[k])
    return ca.sparsify(value)


def _between(bounds: ca.SX, count: int) -> list[ca.SX]:
    first, last = ca.vertsplit(ca.vec(bounds))
    return [first + (last - first) * (k / count) for k in range(count + 1)]
