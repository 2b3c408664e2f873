"""Where two figures are nearest to each other, in closed form.

The normal points from a to b. For what a figure bends, the side of it on which b is counts: +1
outside, -1 inside; the gap grows away from it on that side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import casadi as ca
from frot.compiler.mechanics.geometry.figures import (
    Ball,
    Dot,
    Egg,
    Figure,
    Flat,
    Implicit,
    Oval,
    Ring,
    Straight,
)
from frot.compiler.mechanics.liaisons.moves import Moments
from frot.compiler.mechanics.spatial import GROUND, Pose, Z, cross, nowhere
from frot.compiler.mechanics.values import Lower, beside_given, unit_vector
from frot.dsl.checked import Expression
from frot.dsl.data.classes import dataclass, field


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


def length(value: Expression | None, lower: Lower) -> ca.SX:
    """A radius, zero where there is none."""
    return ca.SX(0) if value is None else lower(value)


def normal_of(figure: Flat, pose: Pose, lower: Lower) -> ca.SX:
    """The normal of a plane, or the left of a line of the plane."""
    local = unit_vector(figure.axis.given, lower)
    return pose.direction(cross(Z, local) if figure.in_plane else local)


def spread_of(figure: Ring | Oval | Egg, pose: Pose, lower: Lower) -> ca.SX:
    """The matrix S of an ellipsoid, flat or not: it reaches sqrt(n . S n) in the direction n."""
    if isinstance(figure, Egg):
        semi = lower(figure.semi_axes)
        local = ca.diag(ca.vertcat(*(semi[k] ** 2 for k in range(3))))
    elif isinstance(figure, Ring):
        axis = unit_vector(figure.axis.given, lower)
        local = lower(figure.radius) ** 2 * (ca.SX.eye(3) - axis @ axis.T)
    else:
        first, second = oval_axes(figure, lower)
        a, b = lower(figure.a), lower(figure.b)
        local = a**2 * first @ first.T + b**2 * second @ second.T
    return ca.sparsify(pose.axes @ ca.sparsify(local) @ pose.axes.T)


def oval_axes(figure: Oval, lower: Lower) -> tuple[ca.SX, ca.SX]:
    """The directions of the semi-axes in the axes of the figure's point."""
    return beside_given(figure.axis.given, lower)


def depth_of(figure: Figure, pose: Pose, normal: ca.SX, lower: Lower) -> ca.SX:
    """The vector (3) to the centre from where a plane with this normal touches what rolls on it."""
    if isinstance(figure, Ball):
        return length(figure.radius, lower) * normal
    assert isinstance(figure, Ring | Oval | Egg)
    below = spread_of(figure, pose, lower) @ normal
    return below / ca.sqrt(ca.dot(normal, below))


def reach_of(figure: Figure, lower: Lower) -> ca.SX:
    """How far a round figure, or an ellipsoid, reaches from its centre, but for a root of three."""
    if isinstance(figure, Ball):
        return length(figure.radius, lower)
    assert isinstance(figure, Ring | Oval | Egg)
    return ca.sqrt(ca.trace(spread_of(figure, GROUND, lower)))


def _flat_ball(a: Flat, b: Ball | Dot, pa: Pose, pb: Pose, lower: Lower, side: ca.SX) -> Touch:
    normal = side * normal_of(a, pa, lower)
    radius = length(b.radius, lower) if isinstance(b, Ball) else ca.SX(0)
    height = ca.dot(normal, pb.origin - pa.origin)
    place = pb.origin - radius * normal
    return Touch(height - radius, normal, place, side * height, radius)


def _flat_egg(
    a: Flat, b: Ring | Oval | Egg, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """The lowest point is S n/sqrt(n . S n) below the centre."""
    normal = side * normal_of(a, pa, lower)
    below = spread_of(b, pb, lower) @ normal
    reach = ca.sqrt(ca.dot(normal, below))
    height = ca.dot(normal, pb.origin - pa.origin)
    return Touch(height - reach, normal, pb.origin - below / reach, side * height, reach)


def _ball_ball(
    a: Ball | Dot, b: Ball | Dot, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """Outside of each other, or the smaller inside of the larger one, whichever is the first."""
    first, second = (length(x.radius, lower) if isinstance(x, Ball) else ca.SX(0) for x in (a, b))
    apart = pb.origin - pa.origin
    if second.is_zero():
        return _round(apart, pb, first, second, side)
    far, wide = ca.sqrt(ca.sumsqr(apart)), ca.fmax(first, second)
    normal, beyond = side * apart / far, far - wide
    inside = ca.if_else(ca.logic_and(side < 0, first < second), 1, -1)
    gap = side * beyond - (first + second - wide)
    return Touch(gap, normal, pb.origin + inside * second * normal, beyond, first + second)


def _round(apart: ca.SX, pb: Pose, first: ca.SX, second: ca.SX, side: ca.SX) -> Touch:
    """Round things whose centres, or the nearest points of whose axes, are `apart`."""
    far = ca.sqrt(ca.sumsqr(apart))
    normal = side * apart / far
    gap = side * (far - first) - second
    return Touch(gap, normal, pb.origin - second * normal, far - first, first + second)


def _straight_ball(
    a: Straight, b: Ball | Dot, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    along = pa.direction(unit_vector(a.axis.given, lower))
    apart = pb.origin - pa.origin
    radius = length(b.radius, lower) if isinstance(b, Ball) else ca.SX(0)
    across = apart - ca.dot(along, apart) * along
    return _round(across, pb, length(a.radius, lower), radius, side)


def _straight_straight(
    a: Straight, b: Straight, pa: Pose, pb: Pose, lower: Lower, side: ca.SX
) -> Touch:
    """Along the common normal of two axes that cross."""
    first = pa.direction(unit_vector(a.axis.given, lower))
    second = pb.direction(unit_vector(b.axis.given, lower))
    apart, both = pb.origin - pa.origin, cross(first, second)
    across = both / ca.sqrt(ca.sumsqr(both))
    # where the axes become parallel, and go on, their product turns about
    normal = ca.sign(ca.dot(across, apart)) * across
    height = ca.dot(normal, apart)
    along = ca.dot(cross(first, both), apart) / ca.sumsqr(both)
    ra, rb = length(a.radius, lower), length(b.radius, lower)
    place = pb.origin + along * second - rb * normal
    return Touch(height - ra - rb, normal, place, ca.SX(1), ra + rb)


def _ring_ball(a: Ring, b: Ball, pa: Pose, pb: Pose, lower: Lower, side: ca.SX) -> Touch:
    """The nearest point of the circle lies in the plane of its axis and the centre.

    So does the one farthest off, with which it touches the sphere from inside.
    """
    axis, radius = pa.direction(unit_vector(a.axis.given, lower)), lower(b.radius)
    apart = pb.origin - pa.origin
    across = apart - ca.dot(axis, apart) * axis
    wide = ca.sqrt(ca.sumsqr(across))
    touching = apart - side * lower(a.radius) * across / wide
    far = ca.sqrt(ca.sumsqr(touching))
    normal = side * touching / far
    beyond = ca.sqrt(ca.sumsqr(apart) + lower(a.radius) ** 2) - radius
    place, size = pb.origin - side * radius * normal, radius + lower(a.radius)
    return Touch(side * (far - radius), normal, place, beyond, size)


def _implicit_dot(a: Implicit, b: Dot, pa: Pose, pb: Pose, lower: Lower, side: ca.SX) -> Touch:
    """F/|grad F| is the distance to first order, and exact where it is zero."""
    local = ca.densify(pa.axes.T @ (pb.origin - pa.origin))
    x = ca.vertcat(*(ca.SX.sym("x") if u is None else lower(u) for u in a.unknowns))
    value = lower(a.value)
    value, slope = ca.substitute([value, ca.gradient(value, x)], [x], [local])
    steep = ca.sqrt(ca.sumsqr(slope))
    normal = side * pa.direction(slope / steep)
    size = ca.dot(ca.fabs(slope), ca.fabs(local)) / steep
    return Touch(side * value / steep, normal, pb.origin, value, size)


def _oval_dot(a: Oval, b: Dot, pa: Pose, pb: Pose, lower: Lower, side: ca.SX) -> Touch:
    """In the plane of the ellipse, or on the cylinder over it: x^2/a^2 + y^2/b^2 = 1."""
    first, second = (pa.direction(e) for e in oval_axes(a, lower))
    apart = pb.origin - pa.origin
    x, y = ca.dot(first, apart), ca.dot(second, apart)
    p, q = lower(a.a), lower(a.b)
    slope = x / p**2 * first + y / q**2 * second
    steep = ca.sqrt(ca.sumsqr(slope))
    value = (x**2 / p**2 + y**2 / q**2 - 1) / 2
    normal = side * slope / steep
    return Touch(side * value / steep, normal, pb.origin, value, p + q)


# Their pairs are those of `figures.CLOSED_FORMS`, which can be asked without CasADi.
_TOUCHES: Mapping[tuple[type, type], _Rule] = {
    (Flat, Dot): _flat_ball,
    (Flat, Ball): _flat_ball,
    (Flat, Ring): _flat_egg,
    (Flat, Oval): _flat_egg,
    (Flat, Egg): _flat_egg,
    (Ball, Dot): _ball_ball,
    (Ball, Ball): _ball_ball,
    (Straight, Dot): _straight_ball,
    (Straight, Ball): _straight_ball,
    (Straight, Straight): _straight_straight,
    (Ring, Ball): _ring_ball,
    (Implicit, Dot): _implicit_dot,
    (Oval, Dot): _oval_dot,
}
