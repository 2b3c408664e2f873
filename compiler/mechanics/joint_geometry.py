"""Joints as functions of coordinates and speeds: what they lock, their coordinates, variables."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.symbols import Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.mechanism import Joint, Relation, point_body
from frot.compiler.mechanics.motions import name_of
from frot.compiler.mechanics.wrenches import Action, act


@dataclass(frozen=True, slots=True, eq=False)
class JointGeometry:
    """A joint between its places.

    `actions` of its locks; `coordinates` and their rates by name; `relative` angular velocity (3)
    of b from a; `apart` the velocities along the locks where coordinates keep them, of auxiliary
    speeds alone (empty where no reaction is computed); `radius` of the pin or None.
    """

    actions: tuple[Action, ...]
    coordinates: dict[str, ca.SX]
    rates: dict[str, ca.SX]
    relative: ca.SX
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


def joint_geometry(joint: Joint, kinematics: Kinematics) -> JointGeometry:
    """A joint, whether coordinates keep it or not."""
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    lower = kinematics.fixed.lower
    coordinates: dict[str, ca.SX] = {}
    rates: dict[str, ca.SX] = {}
    for k, motion in enumerate(joint.motions):
        name = name_of(motion)
        if name:
            coordinates[name], rates[name] = kinematics.coordinate(joint, k)
    at = kinematics.readings.get(joint.liaison)
    sw = kinematics.symbols.sw
    return JointGeometry(
        actions=tuple(act(lock, a.pose, b.pose, lower) for lock in joint.locks),
        coordinates=coordinates,
        rates=rates,
        relative=b.angular - a.angular,
        apart=ca.SX.zeros(0) if at is None else sw[at : at + len(joint.locks)],
        radius=None if joint.radius is None else lower(joint.radius),
        gap=ca.SX(0),
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
    )


def relation_geometry(relation: Relation, kinematics: Kinematics) -> RelationGeometry:
    """A lock between bodies that coordinates do not keep together."""
    joint = relation.joint
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    action = act(relation.lock, a.pose, b.pose, kinematics.fixed.lower)
    sizes = kinematics.lengths_between(
        (point_body(joint.a), kinematics.local_point(joint.a)),
        (point_body(joint.b), kinematics.local_point(joint.b)),
    )
    reach = ca.SX(1) if relation.lock.turns else ca.dot(ca.fabs(action.force), sizes)
    return RelationGeometry(action.gap, action.rate(a, b), ca.SX.ones(3), reach)


def joint_variable(
    geometry: JointGeometry, name: str, rows: Rows | None, lam: ca.SX, planar: bool
) -> ca.SX:
    """A variable of a joint; `rows` is None where its reaction is not computed.

    The force, at the place b, and the couple are those of a on b, in ground axes. With the radius
    of a pin, `slip` and `tangential_force` are those at its surface.
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
        case "gap":
            return geometry.gap
        case "slip" if geometry.radius is not None:
            return geometry.radius * geometry.speed
    if rows is None:
        raise KeyError(name)
    force, couple = ca.SX.zeros(3), ca.SX.zeros(3)
    for row, action in zip(rows.reaction, geometry.actions, strict=True):
        force += lam[row] * action.force
        couple += lam[row] * action.couple
    friction = lam[rows.tangent] if rows.tangent >= 0 else ca.SX(0)
    match name:
        case "force":
            return force[:2] if planar else force
        case "torque":
            couple[2] += friction
            return couple[2] if planar else couple
        case "normal_force":
            return ca.sqrt(ca.sumsqr(force[:2] if planar else force))
        case "tangential_force" if geometry.radius is not None:
            return friction / geometry.radius
        case "power":
            return friction * geometry.speed if rows.tangent >= 0 else ca.SX(0)
    raise KeyError(name)
