"""Gap, slip and rolling rate of the contacts, and the rows of every joint."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.kinematics import Kinematics, Line
from frot.compiler.mechanism import Contact, Joint, Pin, is_unilateral, owner_body, point_body
from frot.compiler.pins import PinGeometry, pin_geometry
from frot.dsl.checked import World

DOWN = {"+x": (1, 0), "-x": (-1, 0), "+y": (0, 1), "-y": (0, -1)}


@dataclass(frozen=True, slots=True, eq=False)
class Geometry:
    """A contact as functions of the coordinates.

    `line.normal` points to the left of the line's direction for a bilateral point on a line;
    against gravity, where gravity tells, for a contact that can part. `side` multiplies it by the
    side the body starts on. `gap` >= 0 while apart. `distance` is the signed distance whose sign
    chooses the side. `slip` and `roll` are the velocity of the body's material point relative to
    the line's, along the line's direction, and the relative angular velocity.
    """

    line: Line
    side: ca.SX
    gap: ca.SX
    distance: ca.SX
    slip: ca.SX
    roll: ca.SX
    abscissa: ca.SX


def _side_distance(contact: Contact, height: ca.SX, middle: ca.SX) -> ca.SX:
    """What chooses the side: the ground is below its own line, whatever the start says."""
    if contact.line.span is None:
        return ca.SX(1)
    return height if contact.round is not None else middle


def down(world: World) -> ca.SX:
    """Unit vector of gravity."""
    return ca.SX(ca.DM(DOWN[world.down]))


def joint_geometry(
    joint: Joint, kinematics: Kinematics, side: ca.SX, world: World
) -> Geometry | PinGeometry:
    """Geometry and relative velocities of a contact or pin, be it ideal or with friction."""
    if isinstance(joint, Pin):
        return pin_geometry(joint, kinematics)
    return contact_geometry(joint, kinematics, side, world)


def row_rates(
    joint: Joint, geometry: Geometry | PinGeometry, kinematics: Kinematics
) -> list[ca.SX]:
    """Relative velocities of the joint's rows, in their order."""
    if isinstance(geometry, PinGeometry):
        return [geometry.apart, *([geometry.speed] if joint.mu is not None else [])]
    rates = [kinematics.velocity(geometry.gap)]
    if joint.mu is not None:
        rates.append(geometry.slip)
    if joint.delta is not None:
        rates.append(geometry.roll)
    return rates


def contact_geometry(
    contact: Contact, kinematics: Kinematics, side: ca.SX, world: World
) -> Geometry:
    """Geometry and relative velocities of a point or rim on a line."""
    body, base = point_body(contact.point), owner_body(contact.line.owner)
    line = kinematics.line(contact.line)
    bilateral = contact.liaison.kind.name == "point_courbe" and not is_unilateral(contact.liaison)
    if bilateral:
        side = ca.SX(1)
    else:
        upward = ca.if_else(ca.dot(line.normal, down(world)) > 1e-12, -1, 1)
        line = Line(line.through, line.direction, upward * line.normal)
    centre = kinematics.position(contact.point)
    radius = (
        kinematics.fixed.lower(contact.round.arguments["radius"])
        if contact.round is not None
        else ca.SX(0)
    )
    height = ca.dot(line.normal, centre - line.through)
    touching = centre - side * radius * line.normal
    slip = ca.dot(
        line.direction,
        kinematics.velocity_at(body, touching) - kinematics.velocity_at(base, touching),
    )
    roll = kinematics.velocity(kinematics.poses[body].angle - kinematics.poses[base].angle)
    middle = ca.dot(line.normal, kinematics.poses[body].origin - line.through)
    return Geometry(
        line=line,
        side=side,
        gap=side * height - radius,
        distance=_side_distance(contact, height, middle),
        slip=slip,
        roll=roll,
        abscissa=ca.dot(line.direction, centre - line.through),
    )
