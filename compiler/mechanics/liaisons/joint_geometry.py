"""Joints as functions of coordinates and speeds: what they lock, their coordinates, variables."""

from __future__ import annotations

from functools import partial

import casadi as ca
from frot.compiler.lowering.symbols import Rows
from frot.compiler.mechanics.geometry.touches import Touch
from frot.compiler.mechanics.geometry.tracking import Track, along, tangency, track
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.locks import Across, Drive, Stated, Tangent, Thread, Touching
from frot.compiler.mechanics.liaisons.motions import Nearing, Slide, bare, name_of
from frot.compiler.mechanics.liaisons.moves import way_of
from frot.compiler.mechanics.liaisons.stated import state, value_of
from frot.compiler.mechanics.liaisons.wrenches import Action, act
from frot.compiler.mechanics.mechanism import Joint, Relation, point_body
from frot.compiler.mechanics.spatial import Moving, Pose, Z, conjugate, cross, nowhere, product
from frot.compiler.mechanics.values import Lower
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class JointGeometry:
    """A joint between its places.

    `actions` of its locks, `drives` tells those that drive coordinates; `turned` is -1 where its a
    is the liaison's second place; `touch` of figures that touch at one place, with the relative
    velocity `moves` there; `way` (3) along which a slide of the plane goes; `coordinates` and their
    rates by name; `relative` angular velocity (3) of b from a, its `attitude` a quaternion; `apart`
    the velocities along the locks where coordinates keep them, of auxiliary speeds alone (empty
    where no reaction is computed); `radius` of the pin or None.
    """

    actions: tuple[Action, ...]
    turned: int
    touch: Touch | None
    moves: ca.SX
    way: ca.SX | None
    drives: tuple[bool, ...]
    coordinates: dict[str, ca.SX]
    rates: dict[str, ca.SX]
    relative: ca.SX
    attitude: ca.SX
    apart: ca.SX
    radius: ca.SX | None
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX

    @property
    def speed(self) -> ca.SX:
        """The rate of its first coordinate."""
        return next(iter(self.rates.values()))


@dataclass(frozen=True, slots=True, eq=False)
class RelationGeometry:
    """One lock of a joint that closes a loop: its gap, the rate of that, and `reach`, see there."""

    gap: ca.SX
    rate: ca.SX
    witness: ca.SX
    reach: ca.SX


def joint_geometry(joint: Joint, kinematics: Kinematics, side: ca.SX) -> JointGeometry:
    """A joint, whether coordinates keep it or not."""
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    lower = kinematics.fixed.lower
    tangent, followed = kinematics.tangents.get(joint.liaison), track_of(joint, kinematics)
    coordinates: dict[str, ca.SX] = {}
    rates: dict[str, ca.SX] = {}
    touch: Touch | None = None
    for k, motion in enumerate(joint.motions):
        name = name_of(motion)
        if isinstance(motion, Nearing):
            seen = _near(motion, a.pose, b.pose, lower, followed)
            touch, coordinates[name], rates[name] = seen.touch, seen.gap, seen.rate(a, b)
        elif name:
            coordinates[name], rates[name] = kinematics.coordinate(joint, k)
    actions = tuple(
        state(lock, joint, kinematics)
        if isinstance(lock, Stated)
        else act(lock, a.pose, b.pose, lower, side, tangent, track=followed)
        for lock in joint.locks
    )
    measured = [x.measure for x in actions if x.measure is not None]
    if measured:
        coordinates["length"] = measured[0]
    touch = next((x.touch for x in actions if x.touch is not None), touch)
    if sum(isinstance(lock, Touching) for lock in joint.locks) > 1:
        touch = None  # a curve that is where two surfaces meet has no one normal
    place = b.pose.origin if touch is None else touch.place
    moves = b.velocity_of(place) - a.velocity_of(place)
    at = kinematics.readings.get(joint.liaison)
    sw = kinematics.symbols.sw
    return JointGeometry(
        actions=actions,
        turned=-1 if joint.swapped else 1,
        touch=touch,
        moves=moves,
        way=_way(joint, a.pose, kinematics),
        drives=tuple(isinstance(lock, Drive) for lock in joint.locks),
        coordinates=coordinates,
        rates=rates,
        relative=b.angular - a.angular,
        attitude=product(conjugate(a.pose.quaternion), b.pose.quaternion),
        apart=ca.SX.zeros(0) if at is None else sw[at : at + len(joint.held)],
        radius=None if joint.radius is None else lower(joint.radius),
        gap=ca.SX(0) if touch is None else touch.gap,
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
    )


def _way(joint: Joint, a: Pose, kinematics: Kinematics) -> ca.SX | None:
    ways = [own for m in joint.motions if isinstance(own := bare(m), Slide)]
    if not kinematics.planar or len(ways) != 1:
        return None
    return a.direction(way_of(ways[0], kinematics.fixed.lower))


def track_of(joint: Joint, kinematics: Kinematics) -> Track | None:
    """What is followed where the figures of a joint touch, or where a point is on its curve."""
    if joint.liaison in kinematics.tangents:
        return None
    let_go = [_nearing(m) for m in joint.motions if isinstance(m, Nearing)]
    for lock in (*joint.locks, *let_go):
        if isinstance(lock, Across | Tangent) or (isinstance(lock, Touching) and lock.followed):
            return kinematics.track(joint.liaison, partial(_make_track, lock, joint, kinematics))
    return None


def _near(motion: Nearing, a: Pose, b: Pose, lower: Lower, followed: Track | None) -> Action:
    """The gap on the side of a on which the figure b is; of a point it has the sign of the side."""
    found = act(_nearing(motion), a, b, lower, track=followed)
    if motion.b.is_point:
        return found
    assert found.touch is not None
    side = ca.if_else(found.touch.witness < 0, -1, 1)
    return act(_nearing(motion), a, b, lower, side, track=followed)


def _nearing(motion: Nearing) -> Touching:
    return Touching(motion.a, motion.b, motion.followed)


def _make_track(lock: Across | Tangent | Touching, joint: Joint, kinematics: Kinematics) -> Track:
    at, lower = (kinematics.pose(joint.a), kinematics.pose(joint.b)), kinematics.fixed.lower
    match lock:
        case Across(curve=curve):
            return along(curve, at, lower)
        case Tangent(a=a, b=b):
            return tangency(a, b, at, lower)
    return track(lock.a, lock.b, at, lower, kinematics.planar)


def relation_geometry(relation: Relation, kinematics: Kinematics, side: ca.SX) -> RelationGeometry:
    """A lock between bodies that coordinates do not keep together."""
    joint = relation.joint
    if isinstance(relation.lock, Stated):
        value, size = value_of(relation.lock, kinematics)
        if relation.lock.kinematic:
            return RelationGeometry(ca.SX(0), value, ca.SX.ones(3), ca.SX(0))
        return RelationGeometry(value, kinematics.rate(value), ca.SX.ones(3), size)
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    turn = None
    if isinstance(relation.lock, Thread):
        turn = kinematics.coordinate(joint, 0)[0]
    followed = track_of(joint, kinematics)
    lower = kinematics.fixed.lower
    action = act(relation.lock, a.pose, b.pose, lower, side, turn=turn, track=followed)
    sizes = kinematics.lengths_between(
        (point_body(joint.a), kinematics.local_point(joint.a)),
        (point_body(joint.b), kinematics.local_point(joint.b)),
    )
    if isinstance(relation.lock, Tangent) and relation.lock.part == 2:
        exact = _exact_rate(action, a, b, kinematics)
        return RelationGeometry(action.gap, exact, ca.SX.ones(3), ca.SX(1))
    reach = ca.SX(1) if relation.lock.turns else ca.dot(ca.fabs(action.force), sizes)
    witness = ca.SX.ones(3)
    if action.touch is not None:
        reach, witness[0] = reach + action.touch.size, action.touch.witness
    rate = action.rate(a, b)
    if isinstance(relation.lock, Touching) and relation.lock.a.is_steep:
        rate = _exact_rate(action, a, b, kinematics)
    return RelationGeometry(action.gap, rate, witness, reach)


def _exact_rate(action: Action, a: Moving, b: Moving, kinematics: Kinematics) -> ca.SX:
    """The rate of a gap that is a distance to first order only, beside its relation too.

    Auxiliary speeds, which displace nothing, move along the wrench.
    """
    rate, auxiliary = action.rate(a, b), kinematics.symbols.sw
    if not auxiliary.numel():
        return kinematics.rate(action.gap)
    still = ca.substitute(rate, auxiliary, ca.SX.zeros(auxiliary.shape))
    return kinematics.rate(action.gap) + rate - still


def _beside(geometry: JointGeometry, vector: ca.SX, planar: bool) -> ca.SX:
    """The part of a vector along a contact, or along the ways that a liaison leaves.

    In the plane it is a signed scalar: along a contact, or along the way of a slide.
    """
    found = geometry.touch
    if not planar:
        return ca.densify(vector - _part(vector, None if found is None else found.normal))
    if found is not None:
        return ca.dot(vector, cross(found.normal, Z))
    return ca.SX(0) if geometry.way is None else ca.dot(vector, geometry.way)


def _part(vector: ca.SX, normal: ca.SX | None) -> ca.SX:
    return nowhere() if normal is None else ca.dot(vector, normal) * normal


def joint_variable(
    geometry: JointGeometry,
    name: str,
    rows: Rows | None,
    lam: ca.SX,
    drive: tuple[ca.SX, ca.SX],
    planar: bool,
) -> ca.SX:
    """A variable of a joint; `rows` is None where its reaction is not computed.

    `drive`: force and couple of what keeps prescribed coordinates.

    The force, at the place b, and the couple are those of a on b, in ground axes. With the radius
    of a pin, `slip` and `tangential_force` are those at its surface; where nothing touches,
    `tangential_force` is what drives the liaison along its ways.
    """
    if name in geometry.coordinates:
        return geometry.coordinates[name]
    match name:
        case "speed":
            return geometry.rates.get("displacement", geometry.speed)
        case "speed_angle":
            return geometry.rates["angle"]
        case "angular_velocity":
            return ca.densify(geometry.relative)
        case "orientation":
            return ca.densify(geometry.attitude)
        case "gap":
            return geometry.gap
        case "slip" if geometry.radius is not None:
            return geometry.radius * geometry.speed
        case "slip":
            return _beside(geometry, geometry.moves * (1 if planar else geometry.turned), planar)
    if rows is None:
        if geometry.actions:
            raise KeyError(name)
        rows = Rows((), -1, -1)  # nothing is locked
    force, couple = (ca.densify(x) for x in drive)
    along = force
    for row, action, drives in zip(rows.reaction, geometry.actions, geometry.drives, strict=True):
        force += lam[row] * action.force
        couple += lam[row] * action.couple
        along += drives * lam[row] * action.force
    friction = lam[rows.tangent] if rows.tangent >= 0 else ca.SX(0)
    force, couple = geometry.turned * force, geometry.turned * couple
    match name:
        case "force":
            return force[:2] if planar else force
        case "torque":
            couple[2] += friction
            return couple[2] if planar else couple
        case "normal_force" if geometry.touch is not None:
            return geometry.turned * ca.dot(force, geometry.touch.normal)
        case "normal_force":
            return ca.sqrt(ca.sumsqr(force[:2] if planar else force))
        case "tangential_force" if geometry.radius is not None:
            return friction / geometry.radius
        case "tangential_force" if geometry.touch is not None:
            return _beside(geometry, geometry.turned * force if planar else force, planar)
        case "tangential_force":
            return _beside(geometry, geometry.turned * along, planar)
        case "power":
            return friction * geometry.speed if rows.tangent >= 0 else ca.SX(0)
    raise KeyError(name)
