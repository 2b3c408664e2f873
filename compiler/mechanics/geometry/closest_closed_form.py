"""Where two figures are nearest to each other, in closed form.

The normal points from a to b. For what a figure bends, the side of it on which b is counts: +1
outside, -1 inside; the gap grows away from it on that side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.planes import (
    CordCircle,
    LineOrCylinder,
    PlaneSurface,
    PointFigure,
    Segment,
)
from frot.compiler.mechanics.geometry.quadrics import (
    EllipseCurve,
    EllipsoidSurface,
    Ring,
    SphereSurface,
)
from frot.compiler.mechanics.geometry.user_figures import Implicit
from frot.compiler.mechanics.spatial import Pose, cross, nowhere
from frot.compiler.mechanics.values import Lower, Moments


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """A gap, its unit normal, and the place on b that is nearest to a.

    `witness` has the sign of the side, `size` that of the lengths beside the way between the
    figures' points. While neither body moves `own` is the rate of the gap, and `drift` (3) the
    velocity of the material element of b from that of a, where curves and surfaces depend on time.
    """

    gap: ca.SX
    normal: ca.SX
    place: ca.SX
    witness: ca.SX
    size: ca.SX
    own: ca.SX = field(default_factory=lambda: ca.SX(0))
    drift: ca.SX = field(default_factory=nowhere)


_Rule = Callable[..., Touch]
# Of two unit vectors: what rounding leaves of their product.
_PARALLEL = 1e-12


def touch(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, side: ca.SX) -> Touch:
    """How the figure b stands to the figure a, at the poses of their points."""
    moments = Moments(lower)
    found = _TOUCHES[type(a), type(b)](a, b, *at, moments, side)
    if not moments.met:
        return found
    own = ca.jacobian(found.gap, moments.symbol)
    gap, normal, place, witness, size, own = moments.back(
        found.gap, found.normal, found.place, found.witness, found.size, own
    )
    return Touch(gap, normal, place, witness, size, own, own * normal)


def is_closed(a: Figure, b: Figure) -> bool:
    """Whether there is a closed form, in this order; curves that time bends have none."""
    if a.bends or b.bends:
        return False
    return (type(a), type(b)) in _TOUCHES and not (a.is_thin and b.is_thin)


def _flat_ball(
    a: PlaneSurface, b: SphereSurface | PointFigure, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    normal = side * pa.direction(a.normal(lower))
    radius = b.radius_in(lower)
    height = ca.dot(normal, pb.origin - pa.origin)
    place = pb.origin - radius * normal
    return Touch(height - radius, normal, place, side * height, radius)


def _flat_egg(
    a: PlaneSurface,
    b: Ring | EllipseCurve | EllipsoidSurface,
    pa: Pose,
    pb: Pose,
    lower: Lower,
    side: ca.SX,
) -> Touch:
    """The lowest point is S n/sqrt(n . S n) below the centre."""
    normal = side * pa.direction(a.normal(lower))
    reach, below = b.below(pb, normal, lower)
    height = ca.dot(normal, pb.origin - pa.origin)
    return Touch(height - reach, normal, pb.origin - below, side * height, reach)


def _ball_ball(
    a: SphereSurface | PointFigure,
    b: SphereSurface | PointFigure,
    pa: Pose,
    pb: Pose,
    lower: Lower,
    side: ca.SX,
) -> Touch:
    """As round things do."""
    apart = pb.origin - pa.origin
    return _round(apart, pb, a.radius_in(lower), b.radius_in(lower), side)


def direction_of(apart: ca.SX, far: ca.SX) -> ca.SX:
    """The direction of a vector of length `far`; at the common centre there is none, and no row."""
    return apart / ca.if_else(far > 0, far, 1)


def _round(apart: ca.SX, pb: Pose, first: ca.SX, second: ca.SX, side: ca.SX) -> Touch:
    """Round things whose centres, or the nearest points of whose axes, are `apart`.

    Outside of each other, or the smaller inside of the larger one, whichever is the first.
    """
    far = ca.sqrt(ca.sumsqr(apart))
    normal = side * direction_of(apart, far)
    if first.is_zero() or second.is_zero():
        gap = side * (far - first) - second
        return Touch(gap, normal, pb.origin - second * normal, far - first, first + second)
    wide = ca.fmax(first, second)
    inside = ca.if_else(ca.logic_and(side < 0, first < second), 1, -1)
    outside = ca.if_else(ca.eq(first, second), wide, far - wide)  # of its size nothing is inside
    gap = side * (far - wide) - (first + second - wide)
    return Touch(gap, normal, pb.origin + inside * second * normal, outside, first + second)


def _tether_dot(
    a: CordCircle, b: PointFigure, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """(l^2 - d^2)/2 l is the rest of the length where that is small, smooth also at d = 0."""
    way, long = pb.origin - pa.origin, lower(a.length)
    gap = (long - ca.sumsqr(way) / long) / 2
    return Touch(gap, -way / long, pb.origin, ca.SX(1), long)


def _straight_ball(
    a: LineOrCylinder, b: SphereSurface | PointFigure, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    along = pa.direction(a.axis.unit(lower))
    apart = pb.origin - pa.origin
    radius = b.radius_in(lower)
    across = apart - ca.dot(along, apart) * along
    return _round(across, pb, a.radius_in(lower), radius, side)


def _straight_straight(
    a: LineOrCylinder, b: LineOrCylinder, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """Along the common normal of two axes that cross; of parallel ones there is none."""
    first = pa.direction(a.axis.unit(lower))
    second = pb.direction(b.axis.unit(lower))
    apart, both = pb.origin - pa.origin, cross(first, second)
    crossing = ca.sqrt(ca.sumsqr(both))
    across = both / ca.if_else(crossing > _PARALLEL, crossing, ca.SX.nan())
    # where the axes become parallel, and go on, their product turns about
    normal = ca.sign(ca.dot(across, apart)) * across
    height = ca.dot(normal, apart)
    along = ca.dot(cross(first, both), apart) / ca.sumsqr(both)
    ra, rb = a.radius_in(lower), b.radius_in(lower)
    place = pb.origin + along * second - rb * normal
    return Touch(height - ra - rb, normal, place, ca.SX(1), ra + rb)


def _ring_ball(a: Ring, b: SphereSurface, pa: Pose, pb: Pose, lower: Lower, side: ca.SX) -> Touch:
    """The nearest point of the circle lies in the plane of its axis and the centre.

    So does the one farthest off, with which it touches the sphere from inside.
    """
    axis, radius = pa.direction(a.axis.unit(lower)), lower(b.radius)
    apart = pb.origin - pa.origin
    across = apart - ca.dot(axis, apart) * axis
    wide = ca.sqrt(ca.sumsqr(across))
    touching = apart - side * lower(a.radius) * across / wide
    far = ca.sqrt(ca.sumsqr(touching))
    normal = side * touching / far
    beyond = ca.sqrt(ca.sumsqr(apart) + lower(a.radius) ** 2) - radius
    place, size = pb.origin - side * radius * normal, radius + lower(a.radius)
    return Touch(side * (far - radius), normal, place, beyond, size)


def _implicit_dot(
    a: Implicit, b: PointFigure, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """F/|grad F| is the distance to first order, and exact where it is zero."""
    local = ca.densify(pa.axes.T @ (pb.origin - pa.origin))
    x = ca.vertcat(*(ca.SX.sym("x") if u is None else lower(u) for u in a.unknowns))
    value = lower(a.value)
    value, slope = ca.substitute([value, ca.gradient(value, x)], [x], [local])
    steep = ca.sqrt(ca.sumsqr(slope))
    normal = side * pa.direction(slope / steep)
    size = ca.dot(ca.fabs(slope), ca.fabs(local)) / steep
    return Touch(side * value / steep, normal, pb.origin, value, size)


def _oval_dot(
    a: EllipseCurve, b: PointFigure, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """In the plane of the ellipse, or on the cylinder over it: x^2/a^2 + y^2/b^2 = 1."""
    first, second = (pa.direction(e) for e in a.axis.beside(lower))
    apart = pb.origin - pa.origin
    x, y = ca.dot(first, apart), ca.dot(second, apart)
    p, q = lower(a.a), lower(a.b)
    slope = x / p**2 * first + y / q**2 * second
    steep = ca.sqrt(ca.sumsqr(slope))
    value = (x**2 / p**2 + y**2 / q**2 - 1) / 2
    normal = side * slope / steep
    return Touch(side * value / steep, normal, pb.origin, value, p + q)


# The pairs that touch in closed form, in this order.
_TOUCHES: Mapping[tuple[type, type], _Rule] = {
    (PlaneSurface, PointFigure): _flat_ball,
    (PlaneSurface, SphereSurface): _flat_ball,
    (PlaneSurface, Ring): _flat_egg,
    (PlaneSurface, EllipseCurve): _flat_egg,
    (PlaneSurface, EllipsoidSurface): _flat_egg,
    (Segment, PointFigure): _flat_ball,
    (Segment, SphereSurface): _flat_ball,
    (SphereSurface, PointFigure): _ball_ball,
    (SphereSurface, SphereSurface): _ball_ball,
    (CordCircle, PointFigure): _tether_dot,
    (LineOrCylinder, PointFigure): _straight_ball,
    (LineOrCylinder, SphereSurface): _straight_ball,
    (LineOrCylinder, LineOrCylinder): _straight_straight,
    (Ring, SphereSurface): _ring_ball,
    (Implicit, PointFigure): _implicit_dot,
    (EllipseCurve, PointFigure): _oval_dot,
}
