"""The motions that laws with a value act on: slips of contacts, coordinates of joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.constraint_geometry import GivenFriction, Uncounted
from frot.compiler.mechanics.forces.force import Action, Load
from frot.compiler.mechanics.spatial import nowhere
from frot.compiler.mechanics.variables import Variables
from frot.dsl.checked import Liaison


@dataclass(frozen=True, slots=True, eq=False)
class GivenMotion:
    """A motion that a law sees: `rate` is a number, or a vector (3) of a slip or a turning.

    Of a number `force` and `couple` (3 each) are those on the second place of one unit along it.
    `turns`: it is an angular velocity.
    """

    rate: ca.SX
    turns: bool = False
    force: ca.SX | None = None
    couple: ca.SX | None = None

    @property
    def size(self) -> ca.SX:
        """Its length; of a number the number with its sign."""
        return self.rate if self.rate.numel() == 1 else ca.norm_2(self.rate)

    @property
    def square(self) -> ca.SX:
        """That of its length."""
        return ca.sumsqr(self.rate)

    def friction(self, push: ca.SX, planar: bool) -> GivenFriction:
        """A force or couple `push` along it, as the liaison shows it."""
        power = ca.dot(push, self.rate)
        if self.force is not None and self.couple is not None:
            return GivenFriction(force=push * self.force, couple=push * self.couple, power=power)
        if planar:
            return GivenFriction(along=push, power=power)
        if self.turns:
            return GivenFriction(couple=push, power=power)
        return GivenFriction(force=push, power=power)


def given_motions(liaison: Liaison, variables: Variables) -> Iterator[GivenMotion]:
    """The slip of a contact; of a joint each of its motions."""
    joint = variables.links[liaison].joint
    if joint is None:
        yield GivenMotion(ca.densify(variables.of_liaison(liaison, "slip")))
        return
    if any(joint.uncounted) or joint.pinned:
        yield from _uncounted(variables.geometry[liaison].left, joint.pinned)
        return
    for motion in joint.motions:
        if motion.bare.turns and not motion.bare.hinges and not motion.name:
            yield GivenMotion(ca.densify(variables.of_liaison(liaison, "angular_velocity")), True)
        elif motion.name:
            unit = variables.effort(liaison, motion.name)
            scale = 1 / ca.norm_2(unit.force) if motion.curve is not None else ca.SX(1)
            turns = motion.bare.turns
            yield GivenMotion(scale * unit.rate, turns, scale * unit.force, scale * unit.couple)


def _uncounted(left: Uncounted, pinned: tuple[int, ...]) -> Iterator[GivenMotion]:
    """One slip or turning of several components is a vector; at ends of a rod they stand alone."""
    for end in pinned:
        yield from (GivenMotion(x.rate, True, x.force, x.couple) for x in left.ends[end])
    for turns, own in ((False, left.slides), (True, left.turns)):
        if len(own) == 1:
            yield GivenMotion(own[0].rate, turns, own[0].force, own[0].couple)
        elif own:
            ways = [x.couple if turns else x.force for x in own]
            parts = (x.rate * way for x, way in zip(own, ways, strict=True))
            yield GivenMotion(ca.densify(sum(parts, ca.SX.zeros(3))), turns)


def give(
    liaison: Liaison,
    variables: Variables,
    frictions: dict[Liaison, GivenFriction],
    push: Callable[[GivenMotion], ca.SX | None],
) -> Load:
    """The load of a law that pushes along each motion, or not (None); `frictions` gains it."""
    actions = []
    planar = variables.kinematics.planar
    for motion in given_motions(liaison, variables):
        value = push(motion)
        if value is None:
            continue
        friction = motion.friction(value, planar)
        frictions[liaison] = frictions.get(liaison, GivenFriction()) + friction
        actions.append(Action(motion.rate, value, place=nowhere()))
    return Load(tuple(actions), None)
