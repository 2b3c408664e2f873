"""How a figure that rolls on a plane moves: where they touch, both have the same velocity.

With r from there to the centre of the figure, n the normal, w and W the angular velocities of the
figure and of the plane, the centre moves along the plane by (w - W) x r, and away from it by the
rate of its height. So the two relations of a motion without slip hold identically, whatever the
speeds (P. Appell 1899; J. Kravtchenko 1946, sect. 18). That they touch is a relation of the height
and the orientation, which a row keeps: it is found at the start, and kept, as any other.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.touches import depth_of
from frot.compiler.mechanics.liaisons.motions import Roll
from frot.compiler.mechanics.liaisons.moves import Column, Moved, rates
from frot.compiler.mechanics.spatial import Moving, Pose, X, Y, Z, axes_of, beside, cross, nowhere
from frot.compiler.mechanics.values import Lower, unit_vector


def roll(
    motion: Roll, plane: Moving, q: ca.SX, v: ca.SX, lower: Lower, side: ca.SX
) -> tuple[Moved, ca.SX]:
    """The axes of the figure, and the rates (2) of its spot on the plane.

    `plane`: its axes at the centre of the figure, which is on the `side` of it. Speeds are taken at
    the material point that touches: there the plane carries it, and it turns about it. Where the
    figure is not round, its height has a speed of its own, and what turning alone would make of it
    is taken off.

    The acceleration without rates of speeds: t = (w - W) x r along the plane has in its axes the
    rate (w - W)' x r + (w - W) x r', with w' - W' = -W_bias - W x w there, and what moves along a
    turning plane has twice W x t.
    """
    local = unit_vector(motion.axis.given, lower)
    normal = plane.pose.direction(local)
    pose = Pose(plane.pose.origin, axes_of(q), q, ca.SX(0))
    depth = depth_of(motion.figure, pose, side * normal, lower)
    is_round = not ca.depends_on(depth, q)

    def along(vector: ca.SX) -> ca.SX:
        """What is round moves along the plane alone."""
        return vector if is_round else vector - ca.dot(normal, vector) * normal

    turning = v - plane.angular
    takes = ca.sparsify(along(cross(turning, depth)))
    turns_on = -plane.angular_bias - cross(plane.angular, v)
    bends = cross(turns_on, depth)
    if not is_round:
        bends += cross(turning, ca.jtimes(depth, q, rates(motion, q, v)))
    moving = Moving(
        pose,
        v,
        plane.linear + takes,
        nowhere(),
        plane.linear_bias + 2 * cross(plane.angular, takes) + along(bends),
    )
    lever = nowhere() if is_round else cross(depth, normal)
    columns = tuple(Column(e, ca.sparsify(-ca.dot(e, lever) * normal)) for e in (X, Y, Z))
    ways = (plane.pose.direction(way) for way in beside(local))
    spot = ca.vertcat(*(ca.dot(way, takes) for way in ways))
    return Moved(moving, columns, depth, back=-depth), spot
