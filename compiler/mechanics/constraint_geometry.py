"""Constraints as functions of the coordinates: gaps, rates of their rows, variables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows of a constraint in the order of the kernel's arrays.

    `reaction` are the components of what it locks, of a contact the normal one; `tangent` and
    `rolling` those along which dry friction acts by forces and by couples, `of_laws` the same law
    after law.
    """

    reaction: tuple[int, ...]
    tangent: tuple[int, ...] = ()
    rolling: tuple[int, ...] = ()
    of_laws: tuple[tuple[int, ...], ...] = ()

    @property
    def all(self) -> tuple[int, ...]:
        """Every row."""
        return (*self.reaction, *self.tangent, *self.rolling)


@dataclass(frozen=True, slots=True, eq=False)
class Rubbing:
    """One row of a law: the velocity that it opposes, force and couple on b of one unit.

    Their power is one unit for each unit of the velocity.
    """

    rate: ca.SX
    force: ca.SX
    couple: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Uncounted:
    """What a joint leaves and no coordinate counts: slips beside its reaction, and turnings.

    `ends`: those of a rod without mass from the bodies at its two ends. `normal`: about which
    tangent curves pivot.
    """

    slides: tuple[Rubbing, ...] = ()
    turns: tuple[Rubbing, ...] = ()
    ends: tuple[tuple[Rubbing, ...], ...] = ()
    normal: ca.SX | None = None


class Geometry:
    """A constraint as functions of the coordinates: CasADi expressions.

    `gap` >= 0 while apart; `witness` (3), the first of which that is not zero has the sign of the
    side; `reach`, the size of the lengths that the gap is made of beside the coordinates.

    Of what does not slip `still` is the velocity (3) that is zero beside the normal, with the
    direction (3) in which the row says so. Which direction that is means nothing: how it turns
    adds nothing to the row's acceleration in the motion, and beside it, where the stages of a step
    lie, it must add nothing. `left`: the motions that no coordinate counts.
    """

    __slots__ = ()

    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    still: tuple[ca.SX, ca.SX] | None = None
    left: Uncounted = Uncounted()

    @property
    def rubbed_rates(self) -> tuple[ca.SX, ...]:
        """The velocities that its friction opposes, row after row."""
        return ()

    def ways_of_law(self, law: int) -> tuple[ca.SX, ...]:
        """Unit vectors (3), in ground axes, along which the rows of a law act on the second place.

        None in the plane, and of rows that have none, as of a slip along an axis and around it.
        """
        return ()

    @property
    def is_free(self) -> bool:
        """Whether it locks nothing, so that what drives it is all that acts."""
        return False

    @property
    def words(self) -> Mapping[str, str]:
        """Those of `slip`, `normal_force` and `tangential_force` that it has, described."""
        raise NotImplementedError

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Relative velocities of the link's rows, in their order."""
        raise NotImplementedError

    def coordinate(self, index: int, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
        """A coordinate by the place of its motion, and its rate."""
        raise NotImplementedError

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """The rate of a coordinate, with what auxiliary speeds add to it."""
        raise NotImplementedError

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """One unit along a coordinate, whether coordinates keep the liaison or not."""
        raise NotImplementedError

    def place(self, kinematics: Kinematics) -> ca.SX:
        """Where it touches, or its place b (3)."""
        raise NotImplementedError

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """A variable of the liaison; KeyError if it has none of this name."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True, eq=False)
class GivenFriction:
    """What laws of a liaison give as forces with a value: viscous ones, smooth ones, the user's.

    `along` the slip of a contact of the plane; else a `force` and a `couple` (3 each) on the second
    place, and their `power`.
    """

    along: ca.SX = field(default_factory=lambda: ca.SX(0))
    force: ca.SX = field(default_factory=lambda: ca.SX.zeros(3))
    couple: ca.SX = field(default_factory=lambda: ca.SX.zeros(3))
    power: ca.SX = field(default_factory=lambda: ca.SX(0))

    def __add__(self, other: GivenFriction) -> GivenFriction:
        """Both."""
        return GivenFriction(
            self.along + other.along,
            self.force + other.force,
            self.couple + other.couple,
            self.power + other.power,
        )


@dataclass(frozen=True, slots=True, eq=False)
class Reaction:
    """What acts in a liaison.

    `rows` of the reactions `lam`, None where they are not computed; force and couple of what keeps
    prescribed coordinates (`drive`), what laws give that are no dry friction (`friction`).
    """

    rows: Rows | None
    lam: ca.SX
    drive: tuple[ca.SX, ca.SX]
    friction: GivenFriction
    planar: bool


@dataclass(frozen=True, slots=True, eq=False)
class RelationGeometry(Geometry):
    """One lock of a joint that closes a loop: its gap, the rate of that, and `reach`, see there.

    `rubs`: the velocities that friction opposes which its reaction bounds.
    """

    gap: ca.SX
    rate: ca.SX
    witness: ca.SX
    reach: ca.SX
    still: tuple[ca.SX, ca.SX] | None = None
    rubs: tuple[ca.SX, ...] = ()

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """That of the gap, then those that friction opposes."""
        return [self.rate, *self.rubs]
