"""Liaisons of the user: relations between places and velocities as the text states them.

What a relation does to b is found by moving b alone: its wrench is the slope of the relation's rate
by the velocity of the place b and by the angular velocity of its body.
"""

from __future__ import annotations

import copy
import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import casadi as ca
from frot.compiler.mechanics.constraint_geometry import RelationGeometry
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Effort
from frot.compiler.mechanics.liaisons.joint_places import JointPlaces
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.spatial import (
    Moving,
    Pose,
    combinations,
    combined,
    cross,
    nowhere,
    product,
)
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.walk import subexpressions
from frot.dsl import Log
from frot.dsl.checked import (
    Body,
    BodyPoint,
    Expression,
    Frame,
    Liaison,
    Quantity,
    StatedRelation,
    Variable,
)

_SPACE = 3


@dataclass(frozen=True, slots=True, eq=False)
class Stated(Lock):
    """A relation of the user: left = right."""

    left: Expression
    right: Expression
    kinematic: bool = field()
    stated = True

    @property
    def pushes(self) -> bool:
        """Whether it keeps places, or their velocities: by a force."""
        sides = itertools.chain(*map(subexpressions, (self.left, self.right)))
        names = (node.name for node in sides if isinstance(node, Quantity))
        return any(name in ("position", "velocity") for name in names)

    def of_joint(self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX) -> Action:
        """The wrench and the gap; of a relation between velocities there is no gap."""
        reader = Reader(kinematics)
        gap = ca.SX(0) if self.kinematic else reader.value(self)[0]
        force, couple = _wrench(self, joint, reader)
        return Action(force, couple, Column(nowhere(), nowhere()), gap)

    def of_relation(
        self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX
    ) -> RelationGeometry:
        """Left side less right side, and the size of both."""
        reader = Reader(kinematics)
        value, size = reader.value(self)
        if self.kinematic:
            return RelationGeometry(ca.SX(0), value, ca.SX.ones(3), ca.SX(0))
        return RelationGeometry(value, _rate(self, reader), ca.SX.ones(3), size)


@dataclass(frozen=True, slots=True, eq=False)
class UnitStated(Lock):
    """A relation that pushes, combined with those before it so that its force is a unit vector.

    The forces of all of them are orthonormal, and their reactions are components of one force. A
    combination with a relation between velocities is one too.
    """

    relations: tuple[Stated, ...]
    stated = True
    presses = 0

    @property
    def kinematic(self) -> bool:  # type: ignore[override]
        """Whether one of them is."""
        return any(x.kinematic for x in self.relations)

    def of_joint(self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX) -> Action:
        """The combined wrench and gap."""
        parts = [x.of_joint(joint, kinematics, side) for x in self.relations]
        factors = combinations([x.force for x in parts])[-1]
        return Action(
            combined(factors, [x.force for x in parts]),
            combined(factors, [x.couple for x in parts]),
            Column(nowhere(), nowhere()),
            combined(factors, [x.gap for x in parts]),
        )

    def of_relation(
        self, joint: JointPlaces, kinematics: Kinematics, side: ca.SX
    ) -> RelationGeometry:
        """The combined gap and rate; while the gaps are zero, factors that move add nothing."""
        forces = [x.of_joint(joint, kinematics, side).force for x in self.relations]
        factors = combinations(forces)[-1]
        parts = [x.of_relation(joint, kinematics, side) for x in self.relations]
        return RelationGeometry(
            combined(factors, [x.gap for x in parts]),
            combined(factors, [x.rate for x in parts]),
            ca.SX.ones(3),
            combined([ca.fabs(x) for x in factors], [x.reach for x in parts]),
        )


def with_unit_forces(relations: Sequence[Stated]) -> tuple[Lock, ...]:
    """Relations with those that push as units: first those between places, then the others."""
    pushing = [x for x in relations if x.pushes]
    pushing.sort(key=lambda x: x.kinematic)
    units = (UnitStated(tuple(pushing[: k + 1])) for k in range(len(pushing)))
    return (*units, *(x for x in relations if not x.pushes))


@dataclass(frozen=True, slots=True)
class Reader:
    """What the names in a relation stand for; without a text only places and their velocities."""

    kinematics: Kinematics
    variable: Callable[[Variable], ca.SX] | None = None
    of_liaison: Callable[[Liaison, str], ca.SX] | None = None
    rate_of: Callable[[Liaison, str], ca.SX] | None = None

    def value(self, relation: Stated | StatedRelation) -> tuple[ca.SX, ca.SX]:
        """Left side less right side of a relation, and the size of both."""
        lowering = Lowering(
            self.kinematics.symbols, self._quantity, _unrated, Log(), variable=self.variable
        )
        left, right = lowering.lower(relation.left), lowering.lower(relation.right)
        return left - right, ca.fabs(left) + ca.fabs(right)

    def _quantity(self, node: Quantity) -> ca.SX:
        if isinstance(node.owner, Liaison):
            assert self.of_liaison is not None
            return self.of_liaison(node.owner, node.name)
        value = _read(node, self.kinematics)
        planar = self.kinematics.planar and value.numel() == _SPACE
        return ca.densify(value[:2]) if planar else value


def bodies_of(relation: Stated | StatedRelation) -> set[Body]:
    """The bodies whose places or velocities a relation reads."""
    sides = itertools.chain(*map(subexpressions, (relation.left, relation.right)))
    owners = (node.owner for node in sides if isinstance(node, Quantity))
    return {
        owner if isinstance(owner, Body) else point_body(owner)
        for owner in owners
        if isinstance(owner, Body | BodyPoint | Frame)
    }


def unit_of(relation: StatedRelation, joint: JointPlaces, reader: Reader) -> Effort:
    """What one unit of what keeps a relation does."""
    kinematics = reader.kinematics
    speeds = ca.vertcat(kinematics.symbols.v, kinematics.symbols.sw)
    along = ca.jacobian(_rate(relation, reader), speeds).T
    force, couple = _wrench(relation, joint, reader)
    return Effort(ca.dot(along, speeds), force, couple, along)


def _rate(relation: Stated | StatedRelation, reader: Reader) -> ca.SX:
    """Rate of left side less right side, to which auxiliary speeds add as they move its bodies."""
    value, _ = reader.value(relation)
    if relation.kinematic:
        return value
    kinematics, step = reader.kinematics, ca.SX.sym("step")
    auxiliary, rate = kinematics.symbols.sw, kinematics.rate(value)
    if not auxiliary.numel():
        return rate
    moved = {}
    for body in bodies_of(relation):
        own = kinematics.bodies[body]
        linear, turn = (ca.jtimes(x, auxiliary, auxiliary) for x in (own.linear, own.angular))
        moved[body] = _displaced(own, step * linear, step * turn)

    def coordinate(liaison: Liaison, name: str) -> ca.SX:
        assert reader.of_liaison is not None and reader.rate_of is not None
        apart = ca.jtimes(reader.rate_of(liaison, name), auxiliary, auxiliary)
        return reader.of_liaison(liaison, name) + step * apart

    gone = replace(_with_bodies(reader, moved), of_liaison=coordinate)
    slope = ca.jacobian(gone.value(relation)[0], step)
    return rate + ca.substitute(slope, step, 0)


def _unrated(value: ca.SX) -> ca.SX:
    raise TypeError("a derivative in a relation")


def _read(node: Quantity, kinematics: Kinematics) -> ca.SX:
    assert isinstance(node.owner, Body | BodyPoint | Frame)
    moving = kinematics.moving(node.owner)
    match node.name:
        case "position":
            return ca.densify(moving.pose.origin)
        case "velocity":
            return ca.densify(moving.linear)
        case "angular_velocity":
            return ca.densify(moving.angular[2] if kinematics.planar else moving.angular)
        case "angle":
            return moving.pose.angle
        case "orientation":
            return moving.pose.quaternion
    return ca.densify(moving.pose.axes[:, "xyz".index(node.name[1])])


def _wrench(
    relation: Stated | StatedRelation, joint: JointPlaces, reader: Reader
) -> tuple[ca.SX, ca.SX]:
    """Force and couple on b for one unit of what keeps a relation."""
    kinematics = reader.kinematics
    body, there = point_body(joint.b), kinematics.position(joint.b)
    way, turn = ca.SX.sym("way", 3), ca.SX.sym("turn", 3)
    own = kinematics.bodies[body]
    linear = way + cross(turn, own.pose.origin - there)
    other = _faster(own, linear, turn) if relation.kinematic else _displaced(own, linear, turn)
    value, _ = _with_bodies(reader, {body: other}).value(relation)
    slopes = [ca.jacobian(value, x).T for x in (way, turn)]
    zero = ca.SX.zeros(3)
    force, couple = ca.substitute(slopes, [way, turn], [zero, zero])
    return force, couple


def _with_bodies(reader: Reader, moved: dict[Body, Moving]) -> Reader:
    """The reader of the same relation with some bodies elsewhere, or faster."""
    kinematics = copy.copy(reader.kinematics)
    kinematics.bodies = {**kinematics.bodies, **moved}
    return replace(reader, kinematics=kinematics)


def _faster(own: Moving, linear: ca.SX, turn: ca.SX) -> Moving:
    return replace(own, linear=own.linear + linear, angular=own.angular + turn)


def _displaced(own: Moving, linear: ca.SX, turn: ca.SX) -> Moving:
    """By a little, so that slopes at zero are right."""
    pose = own.pose
    half = ca.vertcat(0, turn / 2)
    turned = Pose(
        pose.origin + linear,
        pose.axes + ca.skew(turn) @ pose.axes,
        pose.quaternion + product(half, ca.densify(pose.quaternion)),
        pose.angle + turn[2],
    )
    return replace(own, pose=turned)
