"""Where two figures of the plane are nearest that may part, and of which one is a curve with ends.

The nearest place of a bounded curve is one where the connection is along the normal, or an end.
Its parameter s continues beyond the end then, while the curve stays there: what is missing to the
connection's being along the normal is the parameter's excess, so that s goes through the end
without a jump and turns back as soon as a place inside is nearer. Distance and normal are
continuous there, but for a point that slides over the end: it leaves. That s passes an end is an
event, at which contacts are evaluated anew; until then the curve continues as it bends at its end.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.geometry.closest_guess import extremal, nearest_pair
from frot.compiler.mechanics.geometry.closest_solved import (
    Track,
    bends_of,
    far_of,
    long_of,
    on_side,
    parameter_names,
    symbols_of,
)
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.implicit_figures import level
from frot.compiler.mechanics.geometry.parametric_figures import Trace, trace
from frot.compiler.mechanics.spatial import Pose, Z, cross
from frot.compiler.mechanics.values import Lower

# Part of a curve's length within which what is at its end is still on it, but for rounding.
AT_END = 1e-13
# Angle by which what goes round an end is turned beyond it where only rounding tells.
TILT = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Ending:
    """The side of a contact, and what makes a flag that is 1 while a value is positive.

    Values are ways beyond the end of a curve, in parts of its length.
    """

    side: ca.SX
    beyond: Callable[[ca.SX], ca.SX]


@dataclass(frozen=True, slots=True, eq=False)
class Bounded:
    """A parameter and how it stands to the ends of its curve.

    `inside` is the one between these; `ended`: it is beyond since the last event, `out` -1, 0 or 1,
    on which side. `excess` is how far it is then, in parts of the way between the ends, `over` how
    far it is where it only goes to be.
    """

    inside: ca.SX
    excess: ca.SX
    over: ca.SX
    ended: ca.SX
    out: ca.SX


def bounded(figure: Figure, s: ca.SX, lower: Lower, ending: Ending) -> Bounded:
    """A parameter of a figure, which may have ends."""
    if not figure.has_ends:
        return Bounded(s, *(ca.SX(0) for _ in range(4)))
    return between(*figure.ends(lower), s, ending)


def between(least: ca.SX, largest: ca.SX, s: ca.SX, ending: Ending) -> Bounded:
    """A parameter between two values of it."""
    long = largest - least
    above, below = (ending.beyond(x / long - AT_END) for x in (s - largest, least - s))
    within, ended = ca.fmin(ca.fmax(s, least), largest), above + below
    inside = ca.if_else(above, largest, ca.if_else(below, least, within))
    away = s - inside
    excess, over = ca.if_else(ended, away / long, 0), ca.if_else(ended, 0, away)
    return Bounded(inside, excess, over, ended, above - below)


def trace_on(figure: Figure, one: Bounded, pose: Pose, lower: Lower) -> Trace:
    """The point with a parameter; where it only goes to be beyond an end, as the curve bends there.

    The stages of a step that ends where it passes an end lie on both sides of it.
    """
    found = trace(figure, one.inside, pose, lower)
    if not figure.has_ends:
        return found
    u = ca.SX.sym("u")
    bend = ca.jacobian(ca.jacobian(figure.point(u, lower), u), u)
    bend = pose.direction(ca.sparsify(ca.substitute(bend, u, one.inside)))
    (slope,) = found.slopes
    point = found.point + one.over * (slope + one.over / 2 * bend)
    return Trace(point, (slope + one.over * bend,), found.drift)


def away(way: ca.SX, least: ca.SX, instead: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Length and direction of a vector; where it is no longer than `least` another direction."""
    square = ca.sumsqr(way)
    is_long = square > least**2
    far = ca.sqrt(ca.if_else(is_long, square, 1))
    return ca.if_else(is_long, far, 0), ca.if_else(is_long, way / far, instead)


def track_to_ends(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending
) -> Track:
    """The nearest places of two figures, in the order of `is_tracked`."""
    if a.rank >= 0:
        return _of_level(a, b, at, lower, ending)
    return _of_point(a, b, at, lower, ending) if b.is_point else _of_curves(a, b, at, lower, ending)


def _of_level(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending) -> Track:
    """Of a curve b with ends the point where F_a is extremal, or the end that is nearest.

    Outside of a that is where F_a is least, inside where it is largest.
    """
    (pa, pb), names = at, parameter_names(b, False)
    s = symbols_of(names)
    one = bounded(b, s, lower, ending)
    point = trace_on(b, one, pb, lower)
    found = level(a, point.point, pa, lower)
    middle = level(a, pb.point(b.middle(lower)), pa, lower).value
    far, (slope,) = far_of(pa.origin, pb.origin, point.point - pb.origin), point.slopes
    own = (ca.dot(found.slope, point.drift) + found.rate) / found.steep
    normal = found.slope / found.steep
    touch = Touch(found.value / found.steep, normal, point.point, middle, far, own, point.drift)
    size = found.steep * long_of(slope)
    residual = ca.dot(found.slope, slope) + ca.if_else(middle < 0, -1, 1) * size * one.excess

    def value(x: ca.SX) -> ca.SX:
        return level(a, trace(b, x, pb, lower).point, pa, lower).value

    start, other = (extremal(b, value, pa.origin, pb, lower, x) for x in (None, one.inside))
    seen, bends = on_side(touch, ending.side), bends_of(found.slope, point.slopes, s)
    size, beyond = size * (1 + ca.fabs(one.excess)), ca.jacobian(residual, s) - sum(bends)
    return Track(
        s, names, residual, size, start, seen, sided=True, bends=(*bends, beyond), elsewhere=other
    )


def _of_point(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending) -> Track:
    """The way to a point b is beside the tangent of a, or beyond the end of it."""
    (pa, pb), names = at, parameter_names(a, False)
    s, side = symbols_of(names), ending.side
    one = bounded(a, s, lower, ending)
    first = trace_on(a, one, pa, lower)
    (slope,), way = first.slopes, pb.origin - first.point
    steep = long_of(slope)
    far = far_of(pa.origin, pb.origin, first.point - pa.origin)
    least, largest = a.ends(lower)
    residual = ca.dot(way, slope) - steep**2 * (largest - least) * one.excess
    left = cross(Z, slope) / steep
    beyond, outwards = away(way, AT_END * steep * (largest - least), one.out * slope / steep)
    normal = ca.if_else(one.ended, outwards, side * left)
    touch = Touch(
        ca.if_else(one.ended, beyond, side * ca.dot(left, way)), normal, pb.origin,
        ca.dot(left, way), far, -ca.dot(normal, first.drift), -first.drift,
    )  # fmt: skip
    size = steep * (far + steep * (largest - least) * ca.fabs(one.excess))
    start, other = (nearest_pair(a, b, at, lower, x) for x in (None, one.inside))
    return Track(s, names, residual, size, start, touch, first, sided=True, elsewhere=other)


def _of_curves(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending) -> Track:
    """Two curves: along the normal of both, of an end and the other, or from end to end.

    An end has the normal of the other curve there: that of a points away from a, at first to where
    b is, an end of b is met from where the middle of b is.
    """
    (pa, pb), names = at, (*parameter_names(a, False), *parameter_names(b, True))
    s = symbols_of(names)
    one, other = (bounded(x, s[k], lower, ending) for k, x in enumerate((a, b)))
    first, second = trace_on(a, one, pa, lower), trace_on(b, other, pb, lower)
    way = second.point - first.point
    left, right = (cross(Z, x.slopes[0]) / long_of(x.slopes[0]) for x in (first, second))
    amid_b = pb.point(b.middle(lower))
    witness = ca.dot(left, amid_b - first.point)
    to_b = ca.if_else(witness < 0, -1, 1) * left
    beyond_a = one.out * first.slopes[0] / long_of(first.slopes[0]) + TILT * to_b
    from_a = ca.if_else(ca.dot(right, beyond_a) < 0, -1, 1) * right
    far = far_of(pa.origin, pb.origin, first.point - pa.origin, second.point - pb.origin)
    (along,), (across,) = first.slopes, second.slopes
    long, wide = far * long_of(along), far * long_of(across)
    alone = one.ended * (1 - other.ended)
    residual = ca.vertcat(
        ca.if_else(alone, -far * ca.dot(from_a, along), -ca.dot(way, along)) + long * one.excess,
        ca.if_else(one.ended, ca.dot(way, across), far * ca.dot(to_b, across))
        + wide * other.excess,
    )
    size = ca.vertcat(long * (1 + ca.fabs(one.excess)), wide * (1 + ca.fabs(other.excess)))
    beyond, outwards = away(way, AT_END * far, from_a)
    of_end = ca.if_else(other.ended, outwards, from_a)
    normal = ca.if_else(one.ended, of_end, ending.side * left)
    gap = ca.if_else(one.ended * other.ended, beyond, ca.dot(normal, way))
    drift = second.drift - first.drift
    touch = Touch(gap, normal, second.point, witness, far, ca.dot(normal, drift), drift)
    start, found = (nearest_pair(a, b, at, lower, x) for x in (None, one.inside))
    return Track(s, names, residual, size, start, touch, first, sided=True, elsewhere=found)
