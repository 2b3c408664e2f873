"""Ways in which a liaison keeps two bodies from moving relative to each other, as plain data.

A lock is one scalar relation between the places a and b. What it means for forces and velocities
stands in `wrenches.py`. `turns`: it keeps from turning, which a particle cannot feel. `kinematic`:
it is a relation between velocities, of which no places are the integral.
"""

from __future__ import annotations

from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.liaisons.motions import Driven
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Expression
from frot.dsl.data.classes import dataclass

LEFT = 2


class Lock:
    """One scalar relation between the places a and b."""

    __slots__ = ()

    turns: bool
    kinematic: bool

    @property
    def rolls(self) -> bool:
        """Whether it keeps from slipping what touches."""
        return False


@dataclass(frozen=True, slots=True, eq=False)
class Way(Lock):
    """No way along an axis of the ground (0, 1, 2): of a liaison that leaves no way at all."""

    axis: int
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class WayAlong(Lock):
    """No way along an axis of a, along one of the two beside it, or to its left (`side`)."""

    axis: Axis
    side: int | None = None
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Parallel(Lock):
    """An axis of b stays perpendicular to one of the two beside the same axis of a.

    Two of them keep the axes parallel.
    """

    axis: Axis
    side: int
    turns: bool = True
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Aligned(Lock):
    """An axis of a stays perpendicular to the next axis of b: three of them allow no turn."""

    axis: int
    turns: bool = True
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class SameAngle(Lock):
    """No turn in the plane."""

    turns: bool = True
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Thread(Lock):
    """Advance along an axis only with a turn."""

    axis: Axis
    pitch: Expression
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Crossed(Lock):
    """An axis of a and an axis of b keep their angle: those of a universal joint."""

    axis_a: Axis
    axis_b: Axis
    turns: bool = True
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Drive(Lock):
    """The coordinate of a motion is a value of time."""

    driven: Driven
    kinematic: bool = False

    @property
    def turns(self) -> bool:  # type: ignore[override]
        """Whether it keeps from turning."""
        return self.driven.motion.turns


@dataclass(frozen=True, slots=True, eq=False)
class Apart(Lock):
    """The places keep a distance, which time may change."""

    length: Expression
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Touching(Lock):
    """A figure at a and one at b touch, or stay `apart`, which time may change.

    `followed`: where they do is solved for (tracking.py).
    """

    a: Figure
    b: Figure
    followed: bool = False
    apart: Expression | None = None
    turns: bool = False
    kinematic: bool = False


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
    turns: bool = False
    kinematic: bool = True

    @property
    def rolls(self) -> bool:
        """It does."""
        return True


@dataclass(frozen=True, slots=True, eq=False)
class NoSpin(Lock):
    """No turn about the normal of a plane of a: of what rolls on a line."""

    axis: Axis
    turns: bool = True
    kinematic: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Tangent(Lock):
    """Two curves in space are tangent: no way in two directions beside them (0, 1), or no angle.

    Curves that meet have one relation (they cross), tangent ones two more. One of these two says
    how the place moves along the curves, the other, across the plane in which they bend apart,
    is the third relation (2).
    """

    a: Figure
    b: Figure
    part: int
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Across(Lock):
    """No way beside a curve on which b is, in one of two directions."""

    curve: Figure
    side: int
    turns: bool = False
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Level(Lock):
    """A line at b stays parallel to a plane at a."""

    normal: Axis
    along: Axis
    turns: bool = True
    kinematic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Stated(Lock):
    """A relation of the user: left = right."""

    left: Expression
    right: Expression
    kinematic: bool
    turns: bool = False
