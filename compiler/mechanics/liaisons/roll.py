"""How a figure that rolls on a plane at rest moves: where they touch, it has no velocity.

With r from there to the centre of the figure, n the normal and w the angular velocity, the centre
moves along the plane by w x r, and away from it by the rate of its height. So the two relations of
a motion without slip hold identically, whatever the speeds (P. Appell 1899; J. Kravtchenko 1946,
sect. 18). That they touch is a relation of the height and the orientation, which a row keeps: it is
found at the start, and kept, as any other.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.liaisons.motions import Roll
from frot.compiler.mechanics.liaisons.moves import Column, Moved, rates
from frot.compiler.mechanics.spatial import Moving, Pose, X, Y, Z, axes_of, cross, nowhere
from frot.compiler.mechanics.values import Lower


def roll(
    motion: Roll, plane: Moving, q: ca.SX, v: ca.SX, lower: Lower, side: ca.SX
) -> tuple[Moved, ca.SX]:
    """The axes of the figure, and the rates (2) of its spot on the plane.

    `plane`: its axes at the centre of the figure, which is on the `side` of it. Speeds are taken at
    the material point that touches: the figure turns about it. Where it is not round, its height
    has a speed of its own, and what turning alone would make of it is taken off. While no speed
    changes, w x r has the rate w x r' along the plane.
    """
    local = motion.axis.unit(lower)
    normal = plane.pose.direction(local)
    pose = Pose(plane.pose.origin, axes_of(q), q, ca.SX(0))
    _, depth = motion.figure.below(pose, side * normal, lower)
    takes, bends, lever = cross(v, depth), nowhere(), nowhere()
    if ca.depends_on(depth, q):  # what is round moves along the plane alone
        across = ca.SX.eye(3) - normal @ normal.T
        bends = across @ cross(v, ca.jtimes(depth, q, rates(motion, q, v)))
        takes, lever = across @ takes, cross(depth, normal)
    takes, bends = ca.sparsify(takes), ca.sparsify(bends)
    moving = Moving(pose, v, plane.linear + takes, nowhere(), plane.linear_bias + bends)
    columns = tuple(Column(e, ca.sparsify(-ca.dot(e, lever) * normal)) for e in (X, Y, Z))
    ways = (plane.pose.direction(way) for way in motion.axis.beside(lower))
    spot = ca.vertcat(*(ca.dot(way, takes) for way in ways))
    return Moved(moving, columns, depth, back=-depth), spot
