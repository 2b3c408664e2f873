"""One lock of a joint that closes a loop: a row of its own, kept by its reaction.

The kernel bounds friction by one reaction of a row, or by lengths of readings. Where several rows
bound it, their reactions are read: an auxiliary speed u moves the gap of each relation alone,
J v + u. It carries no mass, so that its equation is 0 = lam + R: the reading R is the opposite of
the reaction.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint, FrictionBlock, JointParts
from frot.compiler.mechanics.constraint_geometry import Geometry, RelationGeometry, Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.points import Point
from frot.dsl.checked import Liaison, World


@dataclass(frozen=True, slots=True, eq=False)
class OfJoint(Constraint):
    """What stands for a part of a joint."""

    joint: JointParts = field()

    @property
    def liaison(self) -> Liaison:
        """That of the joint."""
        return self.joint.liaison

    @property
    def whole(self) -> Constraint:
        """The joint."""
        return self.joint

    @property
    def ends(self) -> tuple[Point, Point]:
        """Those of the joint."""
        return self.joint.ends

    @property
    def relation_count(self) -> int:
        """That of the joint."""
        return self.joint.relation_count

    def law_labels(self) -> Iterator[str]:
        """Of the components of its laws of friction, by their numbers."""
        for law in self.frictions:
            for k in range(law.components):
                yield f"{self.liaison.name}.{law.name}[{k + 1}]"


@dataclass(frozen=True, slots=True, eq=False)
class Relation(OfJoint):
    """A lock of a joint; `first`: it stands for the joint.

    `read`: the number of the reading that its reaction is too (`Pressed`), None of no one.
    """

    lock: Lock
    first: bool = field()
    frictions: tuple[FrictionBlock, ...] = ()
    read: int | None = None
    ruled = False

    @property
    def held(self) -> tuple[Lock, ...]:
        """It."""
        return (self.lock,)

    @property
    def rolls(self) -> bool:  # type: ignore[override]
        """Whether its joint does."""
        return self.joint.rolls

    @property
    def kinematic(self) -> bool:  # type: ignore[override]
        """Whether its lock is."""
        return self.lock.kinematic

    @property
    def turns(self) -> bool:  # type: ignore[override]
        """Whether its lock keeps from turning."""
        return self.lock.turns

    @property
    def cancels(self) -> bool:  # type: ignore[override]
        """What the text says in its own words is its own affair."""
        return not self.lock.stated

    def counted(self, planar: bool) -> Iterator[tuple[Constraint, int]]:
        """In space; in the plane the angles of bodies count the turns."""
        if self.first and not planar:
            for k, motion in enumerate(self.joint.motions):
                if motion.comes_round:
                    yield self.joint, k

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> RelationGeometry:
        """The gap of the lock, and what friction opposes that its reaction bounds."""
        own = self.lock.of_relation(self.joint, kinematics, side)
        if self.read is not None:
            place = kinematics.readings[self.liaison] + self.read
            own = replace(own, rate=own.rate + kinematics.symbols.sw[place])
        if not self.frictions:
            return own
        whole = self.joint.geometry(kinematics, side, world)
        return replace(own, rubs=whole.rubbed_rates)

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """By the place among the joint's locks."""
        number = self.joint.locks.index(self.lock) + 1
        return (f"{self.liaison.name}.reaction[{number}]", *self.law_labels())


@dataclass(frozen=True, slots=True, eq=False)
class Pressed(OfJoint):
    """The laws of a joint that is kept relation by relation; `first`: it stands for the joint."""

    first: bool = field()
    frictions: tuple[FrictionBlock, ...] = ()
    has_normal = False
    repeats = True

    @property
    def reduced(self) -> bool:
        """It has readings, and no row of its own that keeps anything."""
        return True

    @property
    def readings(self) -> int:
        """One for each relation that presses."""
        return len(self.joint.pressing)

    @property
    def norms(self) -> tuple[int, ...]:
        """One length."""
        return (self.readings,)

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> PressedGeometry:
        """The velocities that friction opposes."""
        whole = self.joint.geometry(kinematics, side, world)
        first = kinematics.readings[self.liaison]
        return PressedGeometry(
            apart=kinematics.symbols.sw[first : first + self.readings],
            rubs=whole.rubbed_rates,
            gap=ca.SX(0),
            witness=ca.SX.ones(3),
            reach=ca.SX(0),
        )

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """The readings by their numbers, then the laws."""
        name = self.liaison.name
        readings = (f"{name}.pressing[{k + 1}]" for k in range(self.readings))
        return (*readings, *self.law_labels())


@dataclass(frozen=True, slots=True, eq=False)
class PressedGeometry(Geometry):
    """`apart`: the auxiliary speeds of the readings; `rubs`: what friction opposes."""

    apart: ca.SX
    rubs: tuple[ca.SX, ...]
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Of the readings, then those that friction opposes."""
        return [self.apart, *self.rubs]
