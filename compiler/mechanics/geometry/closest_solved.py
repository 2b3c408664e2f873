"""Where two figures are nearest, where no formula says it: parameters that are solved for.

Of a figure with points p(s) and one where F = 0, the place is where F along p is extremal; of two
with points, where the way between these is along their common normal; of two functions, where their
slopes are parallel. The parameters belong to the postures, as the solution of a few equations, and
follow them without a jump: the search begins where it ended before. Curves are taken by their
parameter, and closed surfaces by their function: none of these has a place that is singular.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import permutations

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch, is_closed
from frot.compiler.mechanics.geometry.closest_guess import (
    beginning,
    extremal,
    nearest,
    nearest_pair,
)
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.geometry.implicit_figures import level
from frot.compiler.mechanics.geometry.parametric_figures import Trace, trace
from frot.compiler.mechanics.solve import solve_in_units
from frot.compiler.mechanics.spatial import Pose, Z, beside_moving, cross
from frot.compiler.mechanics.values import Lower


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Parameters `unknowns` that solve 0 = `residual`, whose terms have the `size`.

    `start` is where the search begins, `names` those of the parameters; `touch` is how the figures
    stand there, with the side +1. Of a curve that a point stays on there is `trace`, of tangent
    curves `meeting`, by the parts of the lock. `sided`: the touch is seen from its side already.
    `bends`: what each figure adds to the slopes of the residual; none where they do not cancel.
    `elsewhere`: where the search for another place begins; None where only `start` is known.
    """

    unknowns: ca.SX
    names: tuple[str, ...]
    residual: ca.SX
    size: ca.SX
    start: ca.SX
    touch: Touch
    trace: Trace | None = None
    meeting: tuple[Meeting, ...] = ()
    sided: bool = False
    bends: tuple[ca.SX, ...] = ()
    elsewhere: ca.SX | None = None

    @property
    def alone(self) -> ca.SX:
        """How well the place is separated from those beside it, 0 where it is not and 1 at most.

        det(K)/perm|K| of the slopes K of the residual, each entry of |K| by what its figures add
        to it: of two curves the difference of their curvatures over the sum.
        """
        bends = self.bends or (ca.jacobian(self.residual, self.unknowns),)
        size = sum((ca.fabs(x) for x in bends[1:]), ca.fabs(bends[0]))
        most = _permanent(ca.densify(size))
        found = ca.fabs(ca.det(ca.densify(sum(bends[1:], bends[0]))))
        return found / ca.if_else(most > 0, most, 1)


def _permanent(matrix: ca.SX) -> ca.SX:
    n = matrix.shape[0]
    terms = (
        math.prod((matrix[i, k] for i, k in enumerate(order)), start=ca.SX(1))
        for order in permutations(range(n))
    )
    return sum(terms, ca.SX(0))


@dataclass(frozen=True, slots=True, eq=False)
class Meeting:
    """One relation of two tangent curves: its value, the wrench of its slope at a place.

    `own` is its rate while neither body moves.
    """

    gap: ca.SX
    force: ca.SX
    couple: ca.SX
    place: ca.SX
    own: ca.SX


def on_side(found: Touch, side: ca.SX) -> Touch:
    """The touch seen from a side: outside +1, inside -1."""
    return Touch(
        side * found.gap,
        side * found.normal,
        found.place,
        found.witness,
        found.size,
        side * found.own,
        found.drift,
    )


def can_touch(a: Figure, b: Figure, planar: bool) -> bool:
    """Whether one relation says that they touch, in this order."""
    return is_closed(a, b) or is_tracked(a, b, planar)


def is_tracked(a: Figure, b: Figure, planar: bool) -> bool:
    """Whether the places where they are nearest are followed, in this order.

    Between functions the first is the one that tells most; lines of the plane come first. A point
    and a curve in space, and what touches along a line, meet by more than one relation.
    """
    if is_closed(b, a):
        return False
    first, second = a.parameters, b.parameters
    if planar and a.rank < 0 and (b.plane or b.line) is not None:
        return False
    if a.rank >= 0:
        if a.plane is not None and (b.plane or b.tube or b.line) is not None:
            return False
        return a.rank <= b.rank if b.rank >= 0 else second >= 0
    if first < 0 or second < 0 or second > first:
        return False
    return first == 2 or (first == 1 and (planar or second == 1))


def track(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
    """The nearest places of two figures, in the order of `is_tracked`."""
    if a.rank < 0:
        return _of_points(a, b, at, lower, planar)
    return _of_levels(a, b, at, lower) if b.rank >= 0 else _of_level(a, b, at, lower)


def parameter_names(figure: Figure, of_b: bool) -> tuple[str, ...]:
    """Those of a figure, of the first or the second one."""
    end = "_b" if of_b else ""
    return tuple(f"{name}{end}" for name in "uv"[: figure.parameters])


def symbols_of(names: tuple[str, ...]) -> ca.SX:
    """A symbol for each."""
    return ca.vertcat(*(ca.SX.sym(name) for name in names)) if names else ca.SX.zeros(0)


def far_of(*vectors: ca.SX) -> ca.SX:
    """The size of the lengths that a difference of places is made of."""
    return sum((ca.norm_1(ca.densify(v)) for v in vectors), ca.SX(0))


def long_of(vector: ca.SX) -> ca.SX:
    """Its length."""
    return ca.sqrt(ca.sumsqr(vector))


def _of_level(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Track:
    """Points p(s) of b, of which the one is wanted where F_a is extremal: grad F . p_s = 0."""
    (pa, pb), names = at, parameter_names(b, False)
    s = symbols_of(names)
    point = trace(b, s, pb, lower)
    found = level(a, point.point, pa, lower)
    steep, far = found.steep, far_of(pa.origin, pb.origin, point.point - pb.origin)
    own = (ca.dot(found.slope, point.drift) + found.rate) / steep
    normal = found.slope / steep
    witness = level(a, pb.point(b.middle(lower)), pa, lower).value
    touch = Touch(found.value / steep, normal, point.point, witness, far, own, point.drift)
    residual = [ca.dot(found.slope, x) for x in point.slopes]
    size = [steep * long_of(x) for x in point.slopes]

    def value(x: ca.SX) -> ca.SX:
        return level(a, trace(b, x, pb, lower).point, pa, lower).value

    start, other = (extremal(b, value, pa.origin, pb, lower, x) for x in (None, s))
    bends = bends_of(found.slope, point.slopes, s)
    return Track(
        s, names, _column(residual), _column(size), start, touch, bends=bends, elsewhere=other
    )


def bends_of(slope: ca.SX, slopes: tuple[ca.SX, ...], s: ca.SX) -> tuple[ca.SX, ca.SX]:
    """What the bend of a level F and that of a figure p(s) add to the slopes of grad F . p_s."""
    return (
        _column([x.T @ ca.jacobian(slope, s) for x in slopes]),
        _column([slope.T @ ca.jacobian(x, s) for x in slopes]),
    )


def _of_levels(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Track:
    """The place x with F_b = 0 where F_a is extremal: grad F_a + f grad F_b = 0."""
    pa, pb = at
    names = ("x", "y", "z", "factor")
    s = symbols_of(names)
    place = pb.point(s[:3])
    first, second = level(a, place, pa, lower), level(b, place, pb, lower)
    steep, far = first.steep, far_of(pa.origin, pb.origin, s[:3])
    drift = -second.rate / ca.sumsqr(second.slope) * second.slope
    own = (first.rate + ca.dot(first.slope, drift)) / steep
    touch = Touch(
        first.value / steep, first.slope / steep, place, level(a, pb.origin, pa, lower).value, far,
        own, drift,
    )  # fmt: skip
    residual = ca.vertcat(first.slope + s[3] * second.slope, second.value)
    size = ca.vertcat(*(steep for _ in range(3)), second.steep * far)
    start = beginning(a, b, at, lower)
    own = ca.jacobian(ca.vertcat(first.slope, 0), s)
    bends = own, ca.jacobian(residual, s) - own
    return Track(s, names, residual, size, start, touch, bends=bends)


def _of_points(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
    """The way from p_a to p_b is along the common normal of both figures."""
    (pa, pb), names = at, (*parameter_names(a, False), *parameter_names(b, True))
    s, n = symbols_of(names), a.parameters
    first, second = trace(a, s[:n], pa, lower), trace(b, s[n:], pb, lower)
    way = second.point - first.point
    far = far_of(pa.origin, pb.origin, first.point - pa.origin, second.point - pb.origin)
    residual = [ca.dot(way, x) for x in first.slopes]
    size = [far * long_of(x) for x in first.slopes]
    if n == 1 and not planar:
        normal = cross(first.slopes[0], second.slopes[0])
        residual += [ca.dot(way, x) for x in second.slopes]
        size += [far * long_of(x) for x in second.slopes]
    else:
        normal = cross(Z, first.slopes[0]) if n == 1 else cross(*first.slopes)
        residual += [ca.dot(normal, x) for x in second.slopes]
        size += [long_of(normal) * long_of(x) for x in second.slopes]
    normal = normal / long_of(normal)
    drift = second.drift - first.drift
    touch = Touch(
        ca.dot(normal, way), normal, second.point,
        ca.dot(normal, pb.point(b.middle(lower)) - first.point), far,
        ca.dot(normal, drift), drift,
    )  # fmt: skip
    start, other = (nearest_pair(a, b, at, lower, x) for x in (None, s[:n]))
    return Track(s, names, _column(residual), _column(size), start, touch, first, elsewhere=other)


def along(curve: Figure, at: tuple[Pose, Pose], lower: Lower) -> Track:
    """The point of a curve that is nearest to a place: the way there is beside the tangent."""
    pa, pb = at
    s = symbols_of(("u",))
    first = trace(curve, s, pa, lower)
    way = pb.origin - first.point
    far = far_of(pa.origin, pb.origin, first.point - pa.origin)
    (slope,) = first.slopes
    touch = Touch(ca.SX(0), way, pb.origin, ca.SX(1), far, ca.SX(0), -first.drift)
    start = nearest(curve, pb.origin, pa, lower)
    return Track(s, ("u",), ca.dot(way, slope), far * long_of(slope), start, touch, first)


def tangency(a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower) -> Track:
    """Where two curves in space are tangent: b is along a in the plane in which they bend apart.

    The wrench of the angle across that plane is its slope by small displacements of b, along with
    which the place moves: value_d - value_s R_s^-1 R_d.
    """
    pa, pb = at
    s, way, turn = symbols_of(("u", "u_b")), ca.SX.sym("way", 3), ca.SX.sym("turn", 3)
    axes = pb.axes + ca.skew(turn) @ pb.axes
    moved = Pose(pb.origin + way, axes, pb.quaternion, pb.angle)
    first, second = trace(a, s[0], pa, lower), trace(b, s[1], moved, lower)
    one, bent = _bend(first.slopes[0], s[0])
    other, bent_other = _bend(second.slopes[0], s[1])
    apart, between = bent - bent_other, second.point - first.point
    across = cross(one, apart) / long_of(apart)
    # The slope of the second is the square of `apart`, whichever of the curves is straight.
    turned = other - ca.if_else(ca.dot(one, other) < 0, -1, 1) * one
    residual = ca.vertcat(ca.dot(between, first.slopes[0]), ca.dot(apart, turned))
    angle = ca.dot(across, other)
    by_unknowns = ca.jacobian(residual, s)
    inside = solve_in_units(by_unknowns, ca.jacobian(residual, way))
    inside_turn = solve_in_units(by_unknowns, ca.jacobian(residual, turn))
    by_place = ca.jacobian(angle, s)
    force = (ca.jacobian(angle, way) - by_place @ inside).T
    couple = (ca.jacobian(angle, turn) - by_place @ inside_turn).T
    zero = ca.SX.zeros(3)
    values = [residual, angle, force, couple, between, second.point, one, apart]
    residual, angle, force, couple, between, place, one, apart = (
        ca.SX(x) for x in ca.substitute(values, [way, turn], [zero, zero])
    )
    couple = couple + cross(pb.origin - place, force)
    directions = beside_moving(one)
    drift = trace(b, s[1], pb, lower).drift - first.drift
    meeting = [
        Meeting(ca.dot(e, between), e, ca.SX.zeros(3), place, ca.dot(e, drift)) for e in directions
    ]
    meeting.append(Meeting(angle, force, couple, place, ca.SX(0)))
    far = far_of(pa.origin, pb.origin)
    size = ca.vertcat(far * long_of(first.slopes[0]), long_of(apart))
    normal = apart / long_of(apart)
    touch = Touch(ca.SX(0), normal, place, ca.SX(1), far, drift=drift)
    start = nearest_pair(a, b, at, lower)
    names = ("u", "u_b")
    return Track(s, names, residual, size, start, touch, meeting=tuple(meeting))


def _bend(slope: ca.SX, parameter: ca.SX) -> tuple[ca.SX, ca.SX]:
    """The unit tangent of a curve and its curvature, a vector beside it."""
    square = ca.sumsqr(slope)
    along, bend = slope / ca.sqrt(square), ca.jacobian(slope, parameter)
    return along, (bend - ca.dot(bend, along) * along) / square


def _column(values: list[ca.SX]) -> ca.SX:
    return ca.vertcat(*values) if values else ca.SX.zeros(0)
