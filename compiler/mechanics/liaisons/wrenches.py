"""What a lock does: the reaction it makes, the motion it forbids, the gap it keeps at zero.

One unit of the wrench is a force at the place b and a couple, of a on b. On the forbidden motion,
at the place b, it does one unit of power, and the wrenches of the other locks of the liaison none.
The rate of the gap is the power of the wrench on the motion of b relative to a.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.mechanics.geometry.paths import slope_at
from frot.compiler.mechanics.geometry.touches import Touch, touch
from frot.compiler.mechanics.geometry.tracking import Meeting, Track, on_side
from frot.compiler.mechanics.liaisons.locks import (
    LEFT,
    Across,
    Aligned,
    Apart,
    Crossed,
    Drive,
    Level,
    Lock,
    NoSlip,
    NoSpin,
    Parallel,
    SameAngle,
    Tangent,
    Thread,
    Touching,
    Way,
    WayAlong,
)
from frot.compiler.mechanics.liaisons.motions import Follow, Motion, Reach, Screw, Slide, Turn
from frot.compiler.mechanics.liaisons.moves import Column, way_of
from frot.compiler.mechanics.liaisons.seen import angle_about, arc
from frot.compiler.mechanics.spatial import Moving, Pose, X, Y, Z, beside, cross, nowhere
from frot.compiler.mechanics.values import Axis, Lower, Moments, rate_by_time
from frot.dsl.data.classes import dataclass, field, replace


@dataclass(frozen=True, slots=True, eq=False)
class Effort:
    """What one unit along a coordinate is: the rate it drives, its force and couple on b.

    In a liaison of which a curve of the plane is one place, `force` is that on the point.
    `along`: the part of each speed in the rate, where that is not linear in speeds.
    """

    rate: ca.SX
    force: ca.SX
    couple: ca.SX
    along: ca.SX | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A lock between two poses: `force` and `couple` of its wrench, `column`, `gap`.

    `own` is the rate of the gap while neither moves. `at`: where the force acts, None for the place
    b. `touch`: how the figures stand that touch. `measure`: a distance that the lock keeps.
    """

    force: ca.SX
    couple: ca.SX
    column: Column
    gap: ca.SX
    own: ca.SX = field(default_factory=lambda: ca.SX(0))
    at: ca.SX | None = None
    touch: Touch | None = None
    measure: ca.SX | None = None

    def rate(self, a: Moving, b: Moving) -> ca.SX:
        """Rate of the gap: f . (v_b - v_a where f acts) + c . (omega_b - omega_a) + its own."""
        place = b.pose.origin if self.at is None else self.at
        moves = b.linear if self.at is None else b.velocity_of(place)
        apart = moves - a.velocity_of(place)
        return ca.dot(self.force, apart) + ca.dot(self.couple, b.angular - a.angular) + self.own


def act(
    lock: Lock,
    a: Pose,
    b: Pose,
    lower: Lower,
    side: ca.SX | None = None,
    tangent: ca.SX | None = None,
    turn: ca.SX | None = None,
    track: Track | None = None,
) -> Action:
    """The lock between the places a and b.

    `side` is that of figures which touch, see there; `tangent` that of a curve which carries b;
    `turn` the angle of a screw with its whole turns, else it is within half a turn;
    `track` what is followed where they touch, or where b is on a curve.
    """
    if isinstance(lock, Across):
        return _across(lock, tangent, track)
    if isinstance(lock, Tangent):
        assert track is not None
        return _tangent(track.meeting[lock.part])
    if isinstance(lock, Touching | NoSlip):
        outside = ca.SX(1) if side is None else side
        if lock.followed:
            assert track is not None
            found = on_side(track.touch, outside)
        else:
            found = touch(lock.a, lock.b, (a, b), lower, outside)
        if isinstance(lock, NoSlip):
            return _no_slip(lock, found, a, lower)
        return _touching(found, ca.SX(0) if lock.apart is None else lower(lock.apart), lower)
    moments = Moments(lower)
    if isinstance(lock, Thread):
        seen = angle_about(lock.axis, a, b, moments) if turn is None else turn
        action = _thread(lock, seen, a, b, moments)
    else:
        action = _ACTS[type(lock)](lock, a, b, moments)
    if not moments.met:
        return action
    own = ca.jacobian(action.gap, moments.symbol)
    force, couple, angular, linear, gap, own, measure = moments.back(
        *(action.force, action.couple, action.column.angular, action.column.linear),
        *(action.gap, own, ca.SX(0) if action.measure is None else action.measure),
    )
    measured = None if action.measure is None else measure
    return Action(force, couple, Column(angular, linear), gap, own, measure=measured)


def _tangent(found: Meeting) -> Action:
    nothing = Column(nowhere(), nowhere())
    return Action(found.force, found.couple, nothing, found.gap, found.own, found.place)


def _across(lock: Across, tangent: ca.SX | None, track: Track | None) -> Action:
    """Beside a tangent; what coordinates do not keep on its curve has a way to it."""
    if tangent is not None:
        return _push(_beside_curve(tangent, lock.side), ca.SX(0))
    assert track is not None and track.trace is not None
    force = _beside_curve(track.trace.slopes[0], lock.side)
    own = ca.dot(force, track.touch.drift)
    return replace(_push(force, ca.dot(force, track.touch.normal)), own=own)


def _beside_curve(slope: ca.SX, side: int) -> ca.SX:
    return beside(slope / ca.norm_2(slope))[side]


def _push(way: ca.SX, gap: ca.SX) -> Action:
    return Action(way, nowhere(), Column(nowhere(), way), gap)


def _twist(about: ca.SX, gap: ca.SX) -> Action:
    """A couple; the motion is that about the same line with one unit of power."""
    square = ca.sumsqr(about)
    turn = about if square.is_one() else about / square
    return Action(nowhere(), about, Column(turn, nowhere()), gap)


def _along(pose: Pose, axis: Axis, lower: Lower, side: int | None = None) -> ca.SX:
    """Ground components of an axis, of one of the two beside it, or of its left in the plane."""
    if side is not None and side != LEFT:
        return pose.direction(axis.beside(lower)[side])
    local = axis.unit(lower)
    return pose.direction(local if side is None else cross(Z, local))


def _way(lock: Way, a: Pose, b: Pose, lower: Lower) -> Action:
    return _push((X, Y, Z)[lock.axis], b.origin[lock.axis] - a.origin[lock.axis])


def _way_along(lock: WayAlong, a: Pose, b: Pose, lower: Lower) -> Action:
    """E . (b - a) with e fixed to a, which sweeps the place b along."""
    way = _along(a, lock.axis, lower, lock.side)
    return _push(way, ca.dot(way, b.origin - a.origin))


def _parallel(lock: Parallel, a: Pose, b: Pose, lower: Lower) -> Action:
    """e_b . s_a = 0: its rate is (omega_b - omega_a) . (e_b x s_a)."""
    own, other = _along(b, lock.axis, lower), _along(a, lock.axis, lower, lock.side)
    return _twist(cross(own, other), ca.dot(own, other))


def _aligned(lock: Aligned, a: Pose, b: Pose, lower: Lower) -> Action:
    """i_a . j_b = 0: its rate is (omega_b - omega_a) . (j_b x i_a)."""
    first, second = a.axes[:, lock.axis], b.axes[:, (lock.axis + 1) % 3]
    return _twist(cross(second, first), ca.dot(first, second))


def _same_angle(lock: SameAngle, a: Pose, b: Pose, lower: Lower) -> Action:
    return _twist(Z, b.angle - a.angle)


def _thread(lock: Thread, turn: ca.SX, a: Pose, b: Pose, lower: Lower) -> Action:
    """A force F along e comes with the couple -F pitch/2 pi: no work on the screw's own motion."""
    along, advance = _along(a, lock.axis, lower), lower(lock.pitch) / (2 * ca.pi)
    gap = ca.dot(along, b.origin - a.origin) - advance * turn
    return Action(along, -advance * along, Column(nowhere(), along), gap)


def _crossed(lock: Crossed, a: Pose, b: Pose, lower: Lower) -> Action:
    """A couple about the normal of both axes, on which neither turn does work."""
    first, second = _along(a, lock.axis_a, lower), _along(b, lock.axis_b, lower)
    natural = (axis.unit(lower) for axis in (lock.axis_a, lock.axis_b))
    return _twist(cross(second, first), ca.dot(first, second) - ca.dot(*natural))


def _touching(found: Touch, apart: ca.SX, lower: Lower) -> Action:
    push, own = Column(nowhere(), found.normal), found.own - rate_by_time(apart, lower)
    return Action(found.normal, nowhere(), push, found.gap - apart, own, found.place, found)


def _no_slip(lock: NoSlip, found: Touch, a: Pose, lower: Lower) -> Action:
    """Along directions fixed to a plane; beside another normal, any two."""
    if lock.planar:
        way = cross(found.normal, Z)
    elif lock.a.plane is not None:
        way = a.direction(lock.a.plane.beside(lower)[lock.side])
    else:
        way = beside(found.normal)[lock.side]
    column, own = Column(nowhere(), way), ca.dot(way, found.drift)
    return Action(way, nowhere(), column, ca.SX(0), own, found.place, found)


def _no_spin(lock: NoSpin, a: Pose, b: Pose, lower: Lower) -> Action:
    return _twist(_along(a, lock.axis, lower), ca.SX(0))


def _apart(lock: Apart, a: Pose, b: Pose, lower: Lower) -> Action:
    """Places that coincide have no direction: no way is found out of there, which is told."""
    way, size = b.origin - a.origin, lower(lock.length)
    long = ca.sqrt(ca.sumsqr(way))
    way = way / ca.if_else(long > 0, long, 1)
    return replace(_push(way, long - size), measure=long)


def _level(lock: Level, a: Pose, b: Pose, lower: Lower) -> Action:
    """n_a . d_b = 0."""
    normal, along = _along(a, lock.normal, lower), _along(b, lock.along, lower)
    return _twist(cross(along, normal), ca.dot(normal, along))


def wrench_along(
    motion: Motion, a: Pose, b: Pose, lower: Lower, tangent: ca.SX | None = None
) -> tuple[ca.SX, ca.SX]:
    """Force and couple on b whose power is one unit for each unit of the coordinate's rate.

    On the other motions that are left it does no work. `tangent` is that of a curve that carries b.
    """
    if isinstance(motion, Slide):
        return a.direction(way_of(motion, lower)), nowhere()
    if isinstance(motion, Follow):
        if tangent is None:
            here = motion.curve.parameter(b.origin - a.origin, a, lower)
            tangent = a.direction(slope_at(motion.curve, here, lower))
        return tangent / ca.sumsqr(tangent), nowhere()
    if isinstance(motion, Reach):
        way = b.origin - a.origin
        return way / ca.sqrt(ca.sumsqr(way)), nowhere()
    assert isinstance(motion, Turn | Screw)
    return nowhere(), arc(motion, a, b, lower).about


def _drive(lock: Drive, a: Pose, b: Pose, lower: Lower) -> Action:
    """A force or couple along the motion, which does no work on the others that are left.

    The gap of an angle is within half a revolution.
    """
    motion, value = lock.driven.motion, lower(lock.driven.value)
    if isinstance(motion, Slide):
        way = a.direction(way_of(motion, lower))
        return _push(way, ca.dot(way, b.origin - a.origin) - value)
    if isinstance(motion, Follow):
        return _led(motion, value, a, b, lower)
    found = arc(motion, a, b, lower)
    c, s = ca.cos(value), ca.sin(value)
    apart = ca.atan2(found.sine * c - found.cosine * s, found.cosine * c + found.sine * s)
    axis = motion.axis.unit(lower)
    turn = b.direction(axis) if isinstance(motion, Turn) and motion.on_b else a.direction(axis)
    linear = nowhere()
    if isinstance(motion, Screw):
        linear = lower(motion.pitch) / (2 * ca.pi) * turn
    return Action(nowhere(), found.about, Column(turn, linear), apart)


def _led(motion: Follow, value: ca.SX, a: Pose, b: Pose, lower: Lower) -> Action:
    """Along a curve: to first order, and exact where the place is the one of the value."""
    u = ca.SX.sym("u")
    point = motion.curve.point(u, lower)
    here, slope = ca.substitute([point, ca.jacobian(point, u)], [u], [value])
    along, there = a.direction(slope), a.point(here)
    force = along / ca.sumsqr(along)
    gap = ca.dot(force, b.origin - there)
    return Action(force, nowhere(), Column(nowhere(), along), gap)


_ACTS: dict[type, Callable[..., Action]] = {
    Way: _way,
    WayAlong: _way_along,
    Parallel: _parallel,
    Aligned: _aligned,
    SameAngle: _same_angle,
    Crossed: _crossed,
    Drive: _drive,
    Apart: _apart,
    Level: _level,
    NoSpin: _no_spin,
}
