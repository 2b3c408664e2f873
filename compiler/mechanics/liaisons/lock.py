"""What a lock knows of itself: one way in which a liaison keeps two bodies from moving.

A lock is one scalar relation between the places a and b.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import casadi as ca
from frot.compiler.mechanics.constraint_geometry import RelationGeometry
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Between, Part
from frot.compiler.mechanics.liaisons.joint_places import JointPlaces, between_places
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.spatial import Moving
from frot.compiler.mechanics.values import Axis, Moments
from frot.dsl.checked import Expression


class Lock(Part):
    """A relation between two places; what one kind has not, it says no to.

    `turns`: it keeps from turning, which a particle cannot feel. `kinematic`: it is a relation
    between velocities, of which no places are the integral. `rolls`: it keeps what touches from
    slipping. `drives`: it moves what it keeps. `stated`: the text says it in its own words.
    `by_coordinates`: rows alone cannot tell where on a curve b is.
    """

    __slots__ = ()

    turns: bool = False
    kinematic: bool = False
    rolls = False
    drives = False
    stated = False
    by_coordinates = False

    @property
    def to_first_order(self) -> bool:
        """Whether the rate of its gap is no power of its wrench beside the relation."""
        return False

    @property
    def ground_axis(self) -> int | None:
        """The axis of the ground along which it pushes, if that is all it does."""
        return None

    @property
    def presses(self) -> int | None:
        """Of which of the reactions that bound friction it is a component, None of none."""
        return None

    @property
    def rolls_on(self) -> tuple[Axis, Figure] | None:
        """The normal of a plane and a figure that touches it and may roll there."""
        return None

    def told(self, values: Mapping[str, Expression]) -> Lock:
        """The lock with the lengths that are values of time."""
        return self

    def let_go(self, prescribed: Collection[str]) -> Motion | None:
        """What is seen where an equation of the text prescribes the length that it would keep."""
        return None

    def between(self, at: Between) -> Action:
        """What it does between two places."""
        raise NotImplementedError

    def act(self, at: Between) -> Action:
        """What it does between two places, with the rate that time alone gives its gap."""
        moments = Moments(at.lower)
        action = self.between(replace(at, lower=moments))
        if not moments.met:
            return action
        own = ca.jacobian(action.gap, moments.symbol)
        force, couple, angular, linear, gap, own, measure = moments.back(
            *(action.force, action.couple, action.column.angular, action.column.linear),
            *(action.gap, own, ca.SX(0) if action.measure is None else action.measure),
        )
        measured = None if action.measure is None else measure
        return Action(force, couple, Column(angular, linear), gap, own, measure=measured)

    def turn(self, joint: JointPlaces, kinematics: Kinematics) -> ca.SX | None:
        """The angle that its gap counts."""
        return None

    def still(self, action: Action, a: Moving, b: Moving) -> tuple[ca.SX, ca.SX] | None:
        """The velocity and the direction that `Geometry` tells of."""
        return None

    def turning_with_a(self, axis: Axis) -> Lock:
        """The same beside or along an axis of a, where it pushes along one of the ground."""
        return self

    @property
    def turns_about(self) -> Axis | None:
        """The axis that it keeps parallel."""
        return None

    def of_joint(self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX) -> Action:
        """What it does in a joint."""
        return self.act(between_places(joint, kinematics, side))

    def of_relation(
        self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX
    ) -> RelationGeometry:
        """The row of a joint that coordinates do not keep."""
        a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
        turn = self.turn(joint, kinematics)
        action = self.act(replace(between_places(joint, kinematics, side), turn=turn))
        sizes = kinematics.lengths_between(
            (point_body(joint.a), kinematics.local_point(joint.a)),
            (point_body(joint.b), kinematics.local_point(joint.b)),
        )
        lengths = ca.dot(ca.fabs(action.force), sizes) + ca.fabs(action.length)
        reach = ca.SX(1) if self.turns else lengths
        witness = ca.SX.ones(3)
        if action.touch is not None:
            reach, witness[0] = reach + action.touch.size, action.touch.witness
        rate = action.rate(a, b)
        if self.to_first_order:
            rate = _exact_rate(action.gap, rate, kinematics)
        return RelationGeometry(action.gap, rate, witness, reach, self.still(action, a, b))


def _exact_rate(gap: ca.SX, rate: ca.SX, kinematics: Kinematics) -> ca.SX:
    """The rate of a gap that is a distance to first order only, beside its relation too.

    Auxiliary speeds, which displace nothing, move along the wrench.
    """
    auxiliary = kinematics.symbols.sw
    if not auxiliary.numel():
        return kinematics.rate(gap)
    still = ca.substitute(rate, auxiliary, ca.SX.zeros(auxiliary.shape))
    return kinematics.rate(gap) + rate - still
