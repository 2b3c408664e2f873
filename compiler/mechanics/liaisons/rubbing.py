"""What dry friction opposes in a joint: along which coordinates, by which forces and couples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.constraint import FrictionBlock, JointParts, Way
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.joint_places import between_places
from frot.compiler.mechanics.spatial import X, Y, Z, beside_moving, nowhere


@dataclass(frozen=True, slots=True, eq=False)
class Rubbing:
    """One row of a law: the velocity that it opposes, force and couple on b of one unit.

    Their power is one unit for each unit of the velocity.
    """

    rate: ca.SX
    force: ca.SX
    couple: ca.SX


def rubbings(
    joint: JointParts,
    rates: Mapping[str, ca.SX],
    relative: ca.SX,
    touch: Touch | None,
    kinematics: Kinematics,
) -> tuple[tuple[Rubbing, ...], ...]:
    """The rows of each law of a joint.

    `rates` of its coordinates, `relative` its angular velocity, `touch` how its figures stand.
    """
    found = []
    for law in joint.frictions:
        if law.ways:
            found.append(tuple(_along(joint, way, rates, kinematics) for way in law.ways))
            continue
        axes = (X, Y, Z) if touch is None else _turns(law, touch.normal, kinematics.planar)
        found.append(tuple(Rubbing(ca.dot(axis, relative), nowhere(), axis) for axis in axes))
    return tuple(found)


def _turns(law: FrictionBlock, normal: ca.SX, planar: bool) -> tuple[ca.SX, ...]:
    """The axes of what rolls, or pivots about the normal."""
    if planar:
        return (Z,)
    return (normal,) if law.pivoting else beside_moving(normal)


def _along(
    joint: JointParts, way: Way, rates: Mapping[str, ca.SX], kinematics: Kinematics
) -> Rubbing:
    """Along a coordinate: on a curve by its length, of a turn beside a slide at the radius."""
    names = [motion.name for motion in joint.motions]
    motion = joint.motions[names.index(way.name)].bare
    between = between_places(joint, kinematics, ca.SX(1))
    force, couple = motion.wrench(between)
    scale = ca.SX(1) if way.arm is None else kinematics.fixed.lower(way.arm)
    if motion.curve is not None:
        scale = 1 / ca.norm_2(force)
    return Rubbing(scale * rates[way.name], force * scale, couple * scale)
