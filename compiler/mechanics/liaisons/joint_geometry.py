"""Joints as functions of coordinates and speeds: what they lock, their coordinates, variables."""

from __future__ import annotations

import casadi as ca
from frot.compiler.lowering.symbols import Rows
from frot.compiler.mechanics.geometry.touches import Touch
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, RelationGeometry
from frot.compiler.mechanics.mechanism import Joint, Relation
from frot.compiler.mechanics.spatial import Pose, Z, conjugate, cross, nowhere, product
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


def joint_geometry(joint: Joint, kinematics: Kinematics, side: ca.SX) -> JointGeometry:
    """A joint, whether coordinates keep it or not."""
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    between = kinematics.between(joint, side)
    coordinates: dict[str, ca.SX] = {}
    rates: dict[str, ca.SX] = {}
    touch: Touch | None = None
    for k, motion in enumerate(joint.motions):
        near = motion.near(between)
        if near is not None:
            touch = near.touch
            coordinates[motion.name], rates[motion.name] = near.gap, near.rate(a, b)
        elif motion.name:
            coordinates[motion.name], rates[motion.name] = kinematics.coordinate(joint, k)
    actions = tuple(lock.of_joint(joint, kinematics, side) for lock in joint.locks)
    measured = [x.measure for x in actions if x.measure is not None]
    if measured:
        coordinates["length"] = measured[0]
    touch = next((x.touch for x in actions if x.touch is not None), touch)
    if sum(lock.touches for lock in joint.locks) > 1:
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
        drives=tuple(lock.drives for lock in joint.locks),
        coordinates=coordinates,
        rates=rates,
        relative=b.angular - a.angular,
        attitude=product(conjugate(a.pose.quaternion), b.pose.quaternion),
        apart=ca.SX.zeros(0) if at is None else sw[at : at + len(joint.held)],
        radius=None if joint.radius is None else kinematics.fixed.lower(joint.radius),
        gap=ca.SX(0) if touch is None else touch.gap,
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
    )


def _way(joint: Joint, a: Pose, kinematics: Kinematics) -> ca.SX | None:
    ways = (motion.bare.way(kinematics.fixed.lower) for motion in joint.motions)
    found = [way for way in ways if way is not None]
    return a.direction(found[0]) if kinematics.planar and len(found) == 1 else None


def relation_geometry(relation: Relation, kinematics: Kinematics, side: ca.SX) -> RelationGeometry:
    """A lock between bodies that coordinates do not keep together."""
    return relation.lock.of_relation(relation.joint, kinematics, side)


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
