"""How a figure that rolls on a plane at rest moves: where they touch, it has no velocity.

With r from there to the centre of the figure, n the normal and w the angular velocity, the centre
moves along the plane by w x r, and away from it by the rate of its height. So the two relations of
a motion without slip hold identically, whatever the speeds (P. Appell 1899; J. Kravtchenko 1946,
sect. 18). That they touch is a relation of the height and the orientation, which a row keeps: it is
found at the start, and kept, as any other.

What rolls so has its angular velocity and the rate of its height as its only speeds. Rows keep a
liaison without slip where other figures touch, on bodies that move, where the body is held by rows
that keep places, which would move what rolls without its turning, and where time moves anything.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.constraint import JointParts
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.kinematics import Kinematics, TakenAlong
from frot.compiler.mechanics.liaisons.motion import Carrier, Motion, Quaternion
from frot.compiler.mechanics.liaisons.moves import Column, Moved
from frot.compiler.mechanics.liaisons.orientations import ANGULAR_VELOCITY, ORIENTATION
from frot.compiler.mechanics.liaisons.translations import Slide
from frot.compiler.mechanics.points import frames_of, point_body, turns
from frot.compiler.mechanics.spatial import Moving, Pose, X, Y, Z, axes_of, cross, nowhere
from frot.compiler.mechanics.values import Axis, Lower


@dataclass(frozen=True, slots=True, eq=False)
class RollingContactPoint(Motion):
    """The place of what rolls along a plane of the base: it has no speeds of its own (`Roll`)."""

    axis: Axis
    coordinates = ("x", "y")
    is_taken = True

    def rates(self, q: ca.SX, v: ca.SX) -> ca.SX:
        """What takes it along knows better."""
        return ca.SX.zeros(len(self.coordinates))

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """Along two directions of the plane."""
        first, second = self.axis.beside(lower)
        way = base.pose.direction(first * q[0] + second * q[1])
        return Moved(base.shifted(way), (), way)


@dataclass(frozen=True, slots=True, eq=False)
class Roll(Motion):
    """Any orientation of a figure on a plane of the base, whose turning takes its place along.

    The angular velocity is all that moves it along the plane: independent speeds of a motion that
    is not holonomic (P. Appell 1899), which no orientation makes singular.
    """

    figure: Figure
    axis: Axis
    coordinates = ORIENTATION
    speeds = ANGULAR_VELOCITY
    quaternion = Quaternion(own_axes=False)
    faces_ground = True
    turns = True

    def carry(
        self, kinematics: Kinematics, carrier: Carrier, base: Moving, q: ca.SX, v: ca.SX
    ) -> Moved:
        """It takes the first of its coordinates along, and says where they and its height begin."""
        assert carrier.liaison is not None
        lower, side = kinematics.fixed.lower, kinematics.sides[carrier.liaison]
        moved, rates = self.roll(base, q, v, lower, side)
        first = carrier.first
        for k, rate in enumerate(ca.vertsplit(rates)):
            kinematics.spots[first + k] = TakenAlong(rate, self.figure.reach(lower))
        assert carrier.base is not None  # without a guess a body is at the origin of the ground
        plane = kinematics.pose(carrier.base)
        for k, way in enumerate((*self.axis.beside(lower), self.axis.unit(lower))):
            kinematics.starts[first + k] = -ca.dot(plane.direction(way), plane.origin)
        return moved

    def roll(
        self, plane: Moving, q: ca.SX, v: ca.SX, lower: Lower, side: ca.SX
    ) -> tuple[Moved, ca.SX]:
        """The axes of the figure, and the rates (2) of its spot on the plane.

        `plane`: its axes at the centre of the figure, which is on the `side` of it. Speeds are
        taken at the material point that touches: the figure turns about it. Where it is not round,
        its height has a speed of its own, and what turning alone would make of it is taken off.
        While no speed changes, w x r has the rate w x r' along the plane.
        """
        local = self.axis.unit(lower)
        normal = plane.pose.direction(local)
        pose = Pose(plane.pose.origin, axes_of(q), q, ca.SX(0))
        _, depth = self.figure.below(pose, side * normal, lower)
        takes, bends, lever = cross(v, depth), nowhere(), nowhere()
        if ca.depends_on(depth, q):  # what is round moves along the plane alone
            across = ca.SX.eye(3) - normal @ normal.T
            bends = across @ cross(v, ca.jtimes(depth, q, self.rates(q, v)))
            takes, lever = across @ takes, cross(depth, normal)
        takes, bends = ca.sparsify(takes), ca.sparsify(bends)
        moving = Moving(pose, v, plane.linear + takes, nowhere(), plane.linear_bias + bends)
        columns = tuple(Column(e, ca.sparsify(-ca.dot(e, lever) * normal)) for e in (X, Y, Z))
        ways = (plane.pose.direction(way) for way in self.axis.beside(lower))
        spot = ca.vertcat(*(ca.dot(way, takes) for way in ways))
        return Moved(moving, columns, depth, back=-depth), spot


def can_roll(joint: JointParts) -> bool:
    """Whether its figures can: what is round on a plane of the ground.

    On a body that moves, a start that states the place of what rolls would move that body too.
    """
    if not joint.locks or [x.rolls for x in joint.locks[1:]] != [True, True]:
        return False
    if point_body(joint.a).shape is not None or not turns(point_body(joint.b)):
        return False
    found = joint.locks[0].rolls_on
    if found is None:
        return False
    return found[1].is_round or all(frame.angle is None for frame in frames_of(joint.b))


def rolling_motions(joint: JointParts) -> tuple[Motion, ...]:
    """The motions along the plane, away from it, and about the centre of the figure."""
    found = joint.locks[0].rolls_on
    assert found is not None
    axis, figure = found
    return RollingContactPoint(axis), Slide(axis, coordinates=("height",)), Roll(figure, axis)
