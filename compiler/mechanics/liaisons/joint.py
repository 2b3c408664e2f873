"""A liaison of two places that leaves motions and locks the rest."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint, JointParts
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Between
from frot.compiler.mechanics.liaisons.joint_geometry import JointGeometry, joint_geometry
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.relation import Pressed, Relation
from frot.compiler.mechanics.liaisons.rolling_on_planes import rolling_motions
from frot.compiler.mechanics.spatial import Pose
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import World


@dataclass(frozen=True, slots=True, eq=False)
class Joint(JointParts):
    """A joint with its rows, the motions by which it carries a body, and its geometry."""

    def rows(self, stated: bool) -> tuple[Constraint, ...]:
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
        own = self.frictions if self.rolls or not self.carries else ()
        pressing = joint.pressing
        if own and not self.rolls and len(pressing) > 1:
            places = {lock: k for k, lock in enumerate(pressing)}
            relations = (Relation(joint, x, False, read=places.get(x)) for x in joint.locks)
            return (*relations, Pressed(joint, stated, own))
        # by one reaction: of what rolls the normal one, which is the first
        ordered = pressing if own and not self.rolls else joint.locks
        main = next(iter(ordered), None)
        return tuple(
            Relation(joint, lock, stated and lock is main, own if lock is main else ())
            for lock in joint.locks
        )

    def carrying(self) -> tuple[Motion, ...]:
        """By rolling."""
        return rolling_motions(self)

    def columns(self, kinematics: Kinematics, a: Pose, b: Pose) -> list[Column]:
        """Along what it locks."""
        tangent = kinematics.tangent(self.liaison)
        between = Between(a, b, kinematics.fixed.lower, tangent=tangent)
        return [lock.act(between).column for lock in self.held]

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> JointGeometry:
        """Whether coordinates keep it or not."""
        return joint_geometry(self, kinematics, side)

    def bounding(self, rows: Rows) -> tuple[int, ...]:
        """The components of its force, of a guide those at one end, then those at the other."""
        held = zip(rows.reaction, self.held, strict=True)
        found = [(lock.presses, row) for row, lock in held if lock.presses is not None]
        return tuple(row for _, row in sorted(found))

    @property
    def norms(self) -> tuple[int, ...]:
        """One of a pin, one at each end of a guide, and one about its axis."""
        places = [lock.presses for lock in self.held]
        return tuple(n for k in range(3) if (n := places.count(k)))

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """By the axes of the ground, where all locks push along these; then those of each law."""
        name, count = self.liaison.name, len(rows.reaction)
        couple = tuple(
            f"{name}.torque" if law.components == 1 and law.arm else f"{name}.{law.name}[{k + 1}]"
            for law in self.frictions
            for k in range(law.components)
        )
        axes = [lock.ground_axis for lock in self.locks if lock.ground_axis is not None]
        if len(axes) == count:
            return (*(f"{name}.force.{'xyz'[k]}" for k in axes), *couple)
        first = len(self.locks) - count + 1
        return (*(f"{name}.reaction[{first + k}]" for k in range(count)), *couple)
