"""Gap, slip and rolling rate of the contacts, and the rows of every joint."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.kinematics import Kinematics, Line, rotation
from frot.compiler.mechanics.mechanism import (
    Contact,
    Joint,
    Pin,
    is_unilateral,
    owner_body,
    point_body,
)
from frot.compiler.mechanics.pins import PinGeometry, pin_geometry
from frot.dsl.checked import World

STANDARD_GRAVITY = 9.81
DOWN = {"+x": (1, 0), "-x": (-1, 0), "+y": (0, 1), "-y": (0, -1)}


@dataclass(frozen=True, slots=True, eq=False)
class Geometry:
    """A contact as functions of the coordinates.

    `line.normal` points to the left of the line's direction; `side`, chosen once, multiplies it by
    the side of the body. `gap` >= 0 while apart. `witness` are the three numbers the first of which
    that is not zero has the sign of the side: height of the point or of the rim's centre over the
    line, part of the normal that is against gravity, height of the body's G. `reach` is the size of
    the lengths that the gap is made of beside the coordinates, even where they cancel out. `slip`
    and `roll` are the velocity of the body's material point relative to the line's, along the
    line's direction, and the relative angular velocity.
    """

    line: Line
    side: ca.SX
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    slip: ca.SX
    roll: ca.SX
    abscissa: ca.SX


def _witness(contact: Contact, line: Line, kinematics: Kinematics, world: World) -> ca.SX:
    """What chooses the side.

    The ground is below its own line, whatever the start says, and a point that cannot leave its
    line has its normal to the left.
    """
    if contact.line.span is None or _keeps_left(contact):
        return ca.SX.ones(3)
    centre = kinematics.position(contact.point)
    middle = kinematics.poses[point_body(contact.point)].origin
    vectors = (centre - line.through, _upward(world, kinematics), middle - line.through)
    return ca.vertcat(*(ca.dot(line.normal, vector) for vector in vectors))


def _keeps_left(contact: Contact) -> bool:
    return contact.liaison.kind.name == "point_courbe" and not is_unilateral(contact.liaison)


def _reach(contact: Contact, line: Line, kinematics: Kinematics) -> ca.SX:
    """Size of the vectors from the bodies' coordinates to the point and to the line.

    What both hang on is left out: it cancels out before any rounding.
    """
    body, base = point_body(contact.point), owner_body(contact.line.owner)
    own, other = kinematics.arms[body], kinematics.arms[base]
    while own and other and own[0][0] is other[0][0]:
        own, other = own[1:], other[1:]
    arm = kinematics.arm(body, kinematics.local_point(contact.point))
    arm = sum((size for _, size in (*own, *other)), arm)
    # along a line its given point counts for nothing, wherever its body turns
    turn = rotation(kinematics.poses[base].angle).T
    through = kinematics.local_through(contact.line)
    return ca.dot(ca.fabs(line.normal), arm) + ca.dot(ca.fabs(turn @ line.normal), ca.fabs(through))


def gravity(world: World, kinematics: Kinematics) -> ca.SX:
    """Acceleration of free fall (2)."""
    given = world.gravity
    size = ca.SX(STANDARD_GRAVITY) if given is None else kinematics.fixed.lower(given)
    return size * ca.DM(DOWN[world.down])


def _upward(world: World, kinematics: Kinematics) -> ca.SX:
    """Unit vector against gravity, zero without gravity."""
    fall = gravity(world, kinematics)
    size = ca.sqrt(ca.sumsqr(fall))
    return -fall / ca.if_else(size > 0, size, 1)


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
    at = kinematics.auxiliary.get(joint.liaison)
    # what coordinates keep moves along its normal by its auxiliary speed alone
    rates = [kinematics.velocity(geometry.gap) if at is None else kinematics.symbols.sw[at]]
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
    if _keeps_left(contact):
        side = ca.SX(1)
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
    return Geometry(
        line=line,
        side=side,
        gap=side * height - radius,
        witness=_witness(contact, line, kinematics, world),
        reach=radius + _reach(contact, line, kinematics),
        slip=slip,
        roll=roll,
        abscissa=ca.dot(line.direction, centre - line.through),
    )
