"""Coordinates that are values of time: they go by themselves, and a lock keeps them there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import casadi as ca
from frot.compiler.mechanics.liaisons.actions import Action, Between
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion, Seen
from frot.compiler.mechanics.liaisons.moves import Moved
from frot.compiler.mechanics.spatial import Moving
from frot.compiler.mechanics.values import Lower, rate_by_time
from frot.dsl.checked import Expression


@dataclass(frozen=True, slots=True, eq=False)
class Driven(Motion):
    """A motion whose coordinate is a value of time: it has none of its own."""

    motion: Motion
    value: Expression
    keeps_axis = True

    @property
    def bare(self) -> Motion:
        """What is driven."""
        return self.motion

    def reversed(self) -> Self:
        """Driven by the same value."""
        return replace(self, motion=self.motion.reversed())

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """As its motion goes by itself, with the acceleration that its value has."""
        value = lower(self.value)
        speed = rate_by_time(value, lower)
        moved = self.motion.move(base, value, speed, lower)
        (column,), push = moved.columns, rate_by_time(speed, lower)
        there = moved.moving
        there = replace(
            there,
            angular_bias=there.angular_bias + column.angular * push,
            linear_bias=there.linear_bias + column.linear * push,
        )
        return Moved(there, (), moved.way, moved.along)

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """The value itself."""
        value = lower(self.value)
        return value, rate_by_time(value, lower)


@dataclass(frozen=True, slots=True, eq=False)
class Drive(Lock):
    """The coordinate of a motion is a value of time."""

    driven: Driven
    drives = True

    @property
    def turns(self) -> bool:  # type: ignore[override]
        """Whether it keeps from turning."""
        return self.driven.motion.turns

    def between(self, at: Between) -> Action:
        """A force or couple along the motion, which does no work on the others that are left."""
        return self.driven.motion.hold(at.lower(self.driven.value), at)
