"""Where the search for the place at which two figures are nearest begins."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.implicit_figures import level
from frot.compiler.mechanics.geometry.parametric_figures import trace
from frot.compiler.mechanics.spatial import Pose
from frot.compiler.mechanics.values import Lower

ROUNDS = 2  # of the nearest point on one figure to that on the other


def _least(places: list[ca.SX], values: list[ca.SX]) -> tuple[ca.SX, ca.SX]:
    """The place of the least value, and that."""
    best, least = places[0], values[0]
    for place, value in zip(places[1:], values[1:], strict=True):
        lower_one = value < least
        best, least = ca.if_else(lower_one, place, best), ca.if_else(lower_one, value, least)
    return best, least


def _least_beside(
    curve: Figure, places: list[ca.SX], values: list[ca.SX], s: ca.SX, lower: Lower
) -> ca.SX:
    """The place of the least value that is one among its neighbours, and not about that of `s`.

    Of two places that are nearest the other one is wanted; where there is none, the least of all.
    """
    points = [curve.point(place, lower) for place in places]
    here, last = curve.point(s, lower), len(places) - 1
    apart = []
    for k, (value, point) in enumerate(zip(values, points, strict=True)):
        beside = [x for x in (k - 1, k + 1) if not curve.has_ends or 0 <= x <= last]
        least, about = ca.SX(1), ca.SX(0)
        for x in (x % (last + 1) for x in beside):
            least = ca.logic_and(least, value <= values[x])
            about = ca.fmax(about, ca.sumsqr(points[x] - point))
        least = ca.logic_and(least, ca.sumsqr(here - point) > about)
        apart.append(ca.if_else(least, value, ca.inf))
    best, value = _least(places, apart)
    return ca.if_else(value < ca.inf, best, _least(places, values)[0])


def _all_values(places: list[ca.SX], value: Callable[[ca.SX], ca.SX]) -> list[ca.SX]:
    s = ca.SX.sym("s", places[0].numel())
    own = value(s)
    return [ca.substitute(own, s, place) for place in places]


def extremal(
    b: Figure,
    value: Callable[[ca.SX], ca.SX],
    towards: ca.SX,
    pb: Pose,
    lower: Lower,
    beside: ca.SX | None = None,
) -> ca.SX:
    """Where a function is least on b, or largest where it is negative on most of it.

    On a curve another such place than `beside`, if there is one.
    """
    if b.is_point:
        return ca.SX.zeros(0)
    places = b.beginnings(lower)
    if not places:
        return b.parameter(towards - pb.origin, pb, lower)
    values = _all_values(places, value)
    sign = ca.if_else(sum(values, ca.SX(0)) < 0, -1, 1)
    values = [sign * x for x in values]
    if beside is not None and b.parameters == 1:
        return _least_beside(b, places, values, beside, lower)
    return _least(places, values)[0]


def nearest(
    figure: Figure, place: ca.SX, pose: Pose, lower: Lower, beside: ca.SX | None = None
) -> ca.SX:
    """The parameters of the point nearest to a place; on a curve of another one than `beside`."""
    if figure.is_point:
        return ca.SX.zeros(0)
    places, local = figure.beginnings(lower), ca.SX.sym("local", 3)
    if not places:
        return figure.parameter(place - pose.origin, pose, lower)
    far = _all_values(places, lambda s: ca.sumsqr(figure.point(s, lower) - local))
    there = ca.densify(pose.axes.T @ (place - pose.origin))
    if beside is not None and figure.parameters == 1:
        best = _least_beside(figure, places, far, beside, lower)
    else:
        best, _ = _least(places, far)
    return ca.substitute(best, local, there)


def nearest_pair(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, beside: ca.SX | None = None
) -> ca.SX:
    """The parameters of the nearest points of two figures, of some all along them.

    On a curve a another one than `beside`, if there is one.
    """
    pa, pb = at
    place = pb.origin
    first = second = ca.SX.zeros(0)
    for _ in range(ROUNDS):
        first = nearest(a, place, pa, lower, beside)
        place = trace(a, first, pa, lower).point
        if b.is_point:
            break
        second = nearest(b, place, pb, lower)
        place = trace(b, second, pb, lower).point
    return ca.vertcat(first, second)


def beginning(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> ca.SX:
    """Of an ellipsoid where its normal is along the slope of F_a, else down the slope of F_b."""
    pa, pb = at
    x = _where_it_faces(a, b, at, lower)
    if x is None:
        flat = a.plane is not None
        place = pb.origin if flat else pa.origin
        if flat:
            found = level(a, place, pa, lower)
            place = place - found.value * found.slope
        for _ in range(2 * ROUNDS):
            own = level(b, place, pb, lower)
            square = ca.sumsqr(own.slope)
            place = place - own.value * own.slope / ca.if_else(square > 0, square, 1)
        x = ca.densify(pb.axes.T @ (place - pb.origin))
    place = pb.point(x)
    first, second = level(a, place, pa, lower).slope, level(b, place, pb, lower).slope
    square = ca.sumsqr(second)
    return ca.vertcat(x, -ca.dot(first, second) / ca.if_else(square > 0, square, 1))


def _where_it_faces(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> ca.SX | None:
    """The point of b, in its axes, whose normal is along the slope of F_a there."""
    pa, pb = at
    x = ca.SX.zeros(3)
    side = ca.if_else(level(a, pb.origin, pa, lower).value < 0, 1, -1)
    for _ in range(ROUNDS):
        slope = pb.axes.T @ level(a, pb.point(x), pa, lower).slope
        found = b.facing(slope, side, lower)
        if found is None:
            return None
        x = found
    return x
