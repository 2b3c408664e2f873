"""Two figures that touch: they stay so, at a distance, or without slip."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch, touch
from frot.compiler.mechanics.geometry.closest_solved import Track, on_side, track
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.liaisons.actions import Action, Between
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.spatial import Moving, Pose, Z, beside_moving, cross, nowhere
from frot.compiler.mechanics.values import Axis, Lower, rate_by_time
from frot.dsl.checked import Expression


@dataclass(frozen=True, slots=True, eq=False)
class Touching(Lock):
    """A figure at a and one at b touch, or stay `apart`, which time may change.

    `followed`: where they do is solved for (closest_solved.py).
    """

    a: Figure
    b: Figure
    followed: bool = False
    apart: Expression | None = None
    touches = True
    presses = 0

    @property
    def to_first_order(self) -> bool:
        """Where the function of a is the distance to first order."""
        return self.a.is_steep

    @property
    def is_followed(self) -> bool:
        """It may be."""
        return self.followed

    @property
    def figures(self) -> tuple[Figure, Figure]:
        """The two."""
        return self.a, self.b

    @property
    def rolls_on(self) -> tuple[Axis, Figure] | None:
        """What touches a plane in closed form."""
        if self.followed or self.apart is not None or self.a.plane is None or not self.b.rolls:
            return None
        return self.a.plane, self.b

    def told(self, values: Mapping[str, Expression]) -> Lock:
        """The gap that is reported."""
        return replace(self, apart=values["gap"]) if "gap" in values else self

    def let_go(self, prescribed: Collection[str]) -> Motion | None:
        """The gap is seen."""
        return Nearing(self.a, self.b, self.followed) if "gap" in prescribed else None

    def find(self, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
        """The nearest places."""
        return track(self.a, self.b, at, lower, planar)

    def act(self, at: Between) -> Action:
        """A force along the normal."""
        found = _touch_of(self, at)
        apart = ca.SX(0) if self.apart is None else at.lower(self.apart)
        column, own = Column(nowhere(), found.normal), found.own - rate_by_time(apart, at.lower)
        gap, drift = found.gap - apart, found.drift
        return Action(found.normal, nowhere(), column, gap, own, found.place, found, drift=drift)


@dataclass(frozen=True, slots=True, eq=False)
class NoSlip(Lock):
    """Where two figures touch they do not slip along one of the two directions beside the normal.

    In the plane there is one direction.
    """

    a: Figure
    b: Figure
    side: int
    planar: bool
    followed: bool = False
    kinematic = True
    rolls = True

    def act(self, at: Between) -> Action:
        """Along directions fixed to a plane; beside another normal, any two."""
        found = _touch_of(self, at)
        if self.planar:
            way = cross(found.normal, Z)
        elif self.a.plane is not None:
            way = at.a.direction(self.a.plane.beside(at.lower)[self.side])
        else:
            way = beside_moving(found.normal)[self.side]
        column, own = Column(nowhere(), way), ca.dot(way, found.drift)
        return Action(way, nowhere(), column, ca.SX(0), own, found.place, found)

    def still(self, action: Action, a: Moving, b: Moving) -> tuple[ca.SX, ca.SX] | None:
        """Of the material points."""
        assert action.touch is not None
        return action.moves(a, b) + action.touch.drift, action.force


@dataclass(frozen=True, slots=True, eq=False)
class Nearing(Motion):
    """The gap of two figures that an equation of the text keeps: it is seen, and carries nothing.

    `followed`: where they are nearest is solved for.
    """

    a: Figure
    b: Figure
    followed: bool
    coordinates = ("gap",)
    touches = True

    @property
    def is_followed(self) -> bool:
        """It may be."""
        return self.followed

    @property
    def figures(self) -> tuple[Figure, Figure]:
        """The two."""
        return self.a, self.b

    def find(self, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
        """The nearest places."""
        return track(self.a, self.b, at, lower, planar)

    def near(self, at: Between) -> Action:
        """The gap on the side of a on which the figure b is; of a point it has the side's sign."""
        lock = Touching(self.a, self.b, self.followed)
        found = lock.act(replace(at, side=None))
        if self.b.is_point:
            return found
        assert found.touch is not None
        return lock.act(replace(at, side=ca.if_else(found.touch.witness < 0, -1, 1)))


def _touch_of(lock: Touching | NoSlip, at: Between) -> Touch:
    """How the figures of a lock stand."""
    outside = ca.SX(1) if at.side is None else at.side
    if not lock.followed:
        return touch(lock.a, lock.b, (at.a, at.b), at.lower, outside)
    assert at.track is not None
    return on_side(at.track.touch, outside)
