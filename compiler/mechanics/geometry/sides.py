"""On which side of its curve a contact of the plane is.

The side s multiplies the left normal n of the curve; s n points to the body, which never gets
through. It is the sign of the first of three numbers that is not zero where the run begins:

* the height, to the left, of the point or of the middle of the figure that touches;
* for what is on the curve itself the side outside of a body with matter, else the one against
  gravity; of what rests with its curve on a point that is fixed, the one below;
* the height of the touching body's G; for a point that is fixed, that of the other body's G, which
  is on the other side.

Without any of these the side is the left one. The ground is below its own line, whatever the start
says, and a point that cannot leave its line has its normal to the left.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.contact_parts import ContactParts
from frot.compiler.mechanics.kinematics import Kinematics, Line
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.spatial import X, Y, Z
from frot.dsl.checked import BodyGeometry, World

STANDARD_GRAVITY = 9.81
DOWN = {"+x": X, "-x": -X, "+y": Y, "-y": -Y, "+z": Z, "-z": -Z}


def gravity(world: World, kinematics: Kinematics) -> ca.SX:
    """Acceleration of free fall (3)."""
    given = world.gravity
    size = ca.SX(STANDARD_GRAVITY) if given is None else kinematics.fixed.lower(given)
    if isinstance(world.down, str):
        return ca.sparsify(size * DOWN[world.down])
    way = ca.densify(kinematics.fixed.lower(world.down))
    way = ca.vertcat(way, ca.SX.zeros(3 - way.numel()))
    return ca.sparsify(size * way / ca.norm_2(way))


def sides_of(
    contact: ContactParts, line: Line, height: ca.SX, kinematics: Kinematics, world: World
) -> ca.SX:
    """The three numbers, of a line or of the tangent of a curve; `height` is the first."""
    if contact.floor or contact.keeps_left:
        return ca.SX.ones(3)
    outside = _outside(contact, kinematics)
    up = ca.dot(line.normal, _natural(contact, kinematics, world))
    return ca.vertcat(
        height, up if outside.is_zero() else outside, _of_centre(contact, line, kinematics)
    )


def _outside(contact: ContactParts, kinematics: Kinematics) -> ca.SX:
    """The side of the curve that is outside of its body: +1 the left one, 0 for a thin body."""
    liaison = contact.liaison
    place = liaison.a if contact.track_first else liaison.b
    if not isinstance(place, BodyGeometry):
        return ca.SX(0)
    return shape_of(place.body).outside(place, kinematics.fixed.lower)


def _natural(contact: ContactParts, kinematics: Kinematics, world: World) -> ca.SX:
    """The unit vector against gravity, zero without gravity; along it for a point that is fixed."""
    fall = gravity(world, kinematics)
    size = ca.sqrt(ca.sumsqr(fall))
    down = fall / ca.if_else(size > 0, size, 1)
    return down if point_body(contact.point) in kinematics.still else -down


def _of_centre(contact: ContactParts, line: Line, kinematics: Kinematics) -> ca.SX:
    """The height of a body's G over the curve: within or without a closed one, else its tangent."""
    own, other = point_body(contact.point), point_body(contact.track.point)
    fixed = own in kinematics.still
    if fixed and other in kinematics.still:
        return ca.SX(0)
    centre = kinematics.position(other if fixed else own)
    base, lower = kinematics.pose(contact.track.point), kinematics.fixed.lower
    beyond = contact.track.figure.beyond(base.axes.T @ (centre - base.origin), lower)
    height = ca.dot(line.normal, centre - line.through) if beyond is None else -beyond
    return -height if fixed else height
