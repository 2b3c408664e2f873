"""Friction of a joint that several relations keep, bounded by the length of their reactions.

The kernel bounds friction by one reaction of a row, or by lengths of readings. So the reactions of
the rows are read: an auxiliary speed u moves the gap of each relation alone, J v + u. It carries no
mass, so that its equation is 0 = lam + R: the reading R is the opposite of the reaction.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint, FrictionBlock, JointParts
from frot.compiler.mechanics.constraint_geometry import Geometry, Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.points import Point
from frot.dsl.checked import Liaison, World


@dataclass(frozen=True, slots=True, eq=False)
class Pressed(Constraint):
    """The laws of a joint that is kept relation by relation; `first`: it stands for the joint."""

    joint: JointParts = field()
    first: bool = field()
    frictions: tuple[FrictionBlock, ...] = ()
    has_normal = False
    repeats = True

    @property
    def liaison(self) -> Liaison:
        """That of the joint."""
        return self.joint.liaison

    @property
    def whole(self) -> Constraint:
        """The joint."""
        return self.joint

    @property
    def reduced(self) -> bool:
        """It has readings, and no row of its own that keeps anything."""
        return True

    @property
    def ends(self) -> tuple[Point, Point]:
        """Those of the joint."""
        return self.joint.ends

    @property
    def relation_count(self) -> int:
        """That of the joint."""
        return self.joint.relation_count

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
        laws = ((law, k) for law in self.frictions for k in range(law.components))
        return (
            *(f"{name}.pressing[{k + 1}]" for k in range(self.readings)),
            *(f"{name}.{law.name}[{k + 1}]" for law, k in laws),
        )


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
