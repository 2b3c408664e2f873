"""A liaison of two places that leaves motions and locks the rest."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Self

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint, Friction, Point, Rows
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.liaisons.actions import Between, Part
from frot.compiler.mechanics.liaisons.joint_geometry import JointGeometry, joint_geometry
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.relation import Relation
from frot.compiler.mechanics.rolling_by_coordinates import rolling_motions
from frot.compiler.mechanics.spatial import Pose
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Liaison, World

if TYPE_CHECKING:
    from frot.compiler.mechanics.kinematics import Kinematics


@dataclass(frozen=True, slots=True, eq=False)
class Joint(Constraint):
    """A liaison of the points `a` and `b` that leaves `motions` and locks the rest.

    `carries`: coordinates can keep it, else only rows. `swapped`: `a` is the second place of the
    liaison. `reduced`: it is built into the coordinates. `frictions`: of a pin.
    """

    liaison: Liaison = field()
    a: Point
    b: Point
    motions: tuple[Motion, ...]
    locks: tuple[Lock, ...]
    reduced: bool = False
    frictions: tuple[Friction, ...] = ()
    carries: bool = True
    swapped: bool = False
    has_normal = False

    @property
    def joint(self) -> Joint:
        """It."""
        return self

    @property
    def is_rigid(self) -> bool:
        """Whether it joins two bodies to one."""
        return self.carries and not self.motions

    @property
    def ends(self) -> tuple[Point, Point]:
        """Its places."""
        return self.a, self.b

    @property
    def rolls(self) -> bool:  # type: ignore[override]
        """Where a lock keeps from slipping."""
        return any(lock.rolls for lock in self.locks)

    @property
    def ruled(self) -> bool:  # type: ignore[override]
        """What rolls does so in every mode."""
        return not self.rolls

    @property
    def first(self) -> bool:  # type: ignore[override]
        """What rolls has its mode with its first relation."""
        return not self.rolls

    @property
    def held(self) -> tuple[Lock, ...]:
        """The locks that coordinates keep, where they keep the joint: of what rolls, no slip."""
        return tuple(x for x in self.locks if x.kinematic) if self.rolls else self.locks

    @property
    def relation_count(self) -> int:
        """That of its locks."""
        return len(self.locks)

    @property
    def readings(self) -> int:
        """Those of all that coordinates keep."""
        return len(self.held) if self.reduced else 0

    @property
    def has_gap(self) -> bool:
        """As a whole it has none."""
        return False

    @property
    def keeps_places(self) -> bool:
        """By locks that are more than relations between velocities."""
        return not all(lock.kinematic for lock in self.locks)

    @property
    def slips(self) -> bool:
        """At the surface of a pin, where figures touch, or along a slide."""
        ways = sum(motion.bare.slides for motion in self.motions)
        return bool(self.frictions) or any(x.touches for x in self._parts) or ways == 1

    @property
    def by_coordinates(self) -> bool:
        """Where a lock is."""
        return any(lock.by_coordinates for lock in self.locks)

    @property
    def pairs(self) -> tuple[tuple[Figure, Figure], ...]:
        """Those of its parts."""
        return tuple(x.figures for x in self._parts if x.figures is not None)

    @property
    def curves(self) -> tuple[Figure, ...]:
        """Those of its motions."""
        return tuple(x.curve for x in self.motions if x.curve is not None)

    @property
    def _parts(self) -> tuple[Part, ...]:
        return (*self.motions, *self.locks)

    def kept(self, reduced: bool) -> Self:
        """By coordinates, or by rows."""
        return replace(self, reduced=reduced)

    def without_friction(self) -> Self:
        """A pin that is smooth."""
        return replace(self, frictions=())

    def rows(self, told: bool) -> tuple[Constraint, ...]:
        """Relation by relation.

        In space ways are along axes of a, last the one about which a pin turns: rows of a loop that
        depend on each other, as those of a flat one, then do so in the same way wherever the loop
        turns. Those along axes of the ground would take turns.
        """
        joint = self
        if any(lock.ground_axis == 2 for lock in self.locks):
            axes = (lock.turns_about for lock in self.locks)
            axis = next((x for x in axes if x is not None), Axis("z"))
            joint = replace(self, locks=tuple(x.turning_with_a(axis) for x in self.locks))
        return tuple(Relation(joint, lock, told and k == 0) for k, lock in enumerate(joint.locks))

    def carrying(self) -> tuple[Motion, ...]:
        """By rolling."""
        return rolling_motions(self)

    def columns(self, kinematics: Kinematics, a: Pose, b: Pose) -> list[Column]:
        """Along what it locks."""
        tangent = kinematics.tangents.get(self.liaison)
        between = Between(a, b, kinematics.fixed.lower, tangent=tangent)
        return [lock.act(between).column for lock in self.held]

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> JointGeometry:
        """Whether coordinates keep it or not."""
        return joint_geometry(self, kinematics, side)

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """By the axes of the ground, where all locks push along these; then the couple of a pin."""
        name, count = self.liaison.name, len(rows.reaction)
        couple = (f"{name}.torque",) if rows.tangent >= 0 else ()
        axes = [lock.ground_axis for lock in self.locks if lock.ground_axis is not None]
        if len(axes) == count:
            return (*(f"{name}.force.{'xyz'[k]}" for k in axes), *couple)
        first = len(self.locks) - count + 1
        return (*(f"{name}.reaction[{first + k}]" for k in range(count)), *couple)
