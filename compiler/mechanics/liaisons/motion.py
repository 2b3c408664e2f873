"""What an elementary motion knows of itself: how it moves axes, how it is seen, what drives it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import casadi as ca
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Between, Part
from frot.compiler.mechanics.liaisons.moves import Moved
from frot.compiler.mechanics.points import Point
from frot.compiler.mechanics.spatial import Moving, product
from frot.compiler.mechanics.values import Lower, Moments
from frot.dsl.checked import Liaison

Seen = tuple[ca.SX, ca.SX]


@dataclass(frozen=True, slots=True)
class Quaternion:
    """Four coordinates that turn by an angular velocity.

    `own_axes`: the speeds are its components along the own y and z axes, else along the ground's.
    """

    own_axes: bool


@dataclass(frozen=True, slots=True)
class Carrier:
    """The liaison by which a motion carries a body, and the place that carries.

    `first` is the index of the body's first coordinate, `own` that of the motion's.
    """

    liaison: Liaison | None
    base: Point | None
    first: int
    own: int


class Motion(Part):
    """Of b relative to a, by coordinates; what one kind has not, it says no to.

    `coordinates` and `speeds` are the ends of the names of q and v (`speeds` empty where v is q').
    `faces_ground`: q places the axes relative to the ground, whatever carries them. `turns`: the
    speeds are angular velocities. `hinges`, `slides`: it does nothing but turn about one axis, or
    go along one.
    """

    __slots__ = ()

    coordinates: tuple[str, ...] = ()
    speeds: tuple[str, ...] = ()
    quaternion: Quaternion | None = None
    faces_ground = False
    turns = False
    hinges = False
    slides = False
    comes_round = False  # a turn of the bodies brings back the posture at which q began
    keeps_axis = False  # its rate is that by the velocities, though time may change the axis
    is_taken = False  # what another motion does takes its coordinates along

    @property
    def bare(self) -> Motion:
        """The motion itself, whether it is driven or not."""
        return self

    @property
    def name(self) -> str:
        """The name of its coordinate where that can be counted, else ""."""
        own = self.bare
        return "" if own.faces_ground or not own.coordinates else own.coordinates[0]

    @property
    def speed_count(self) -> int:
        """The number of its speeds."""
        return 0 if self.is_taken else len(self.speeds or self.coordinates)

    @property
    def curve(self) -> Figure | None:
        """The curve that it goes along by its parameter."""
        return None

    def way(self, lower: Lower) -> ca.SX | None:
        """The unit vector (3) of a slide in the axes of its base, None of another."""
        return None

    def reversed(self) -> Self:
        """The motion of a relative to b; what faces the ground does not know of a."""
        return self

    def rates(self, q: ca.SX, v: ca.SX) -> ca.SX:
        """The rates q'.

        2 r' = (0, omega) r of quaternions, or r (0, 0, v) where the speeds are along own axes.
        """
        if self.quaternion is None:
            return v
        if self.quaternion.own_axes:
            return product(q, ca.vertcat(0, 0, v)) / 2
        return product(ca.vertcat(0, v), q) / 2

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The axes after the motion, the columns of its speeds, the way of their origin."""
        raise NotImplementedError

    def carry(
        self, kinematics: Kinematics, carrier: Carrier, base: Moving, q: ca.SX, v: ca.SX
    ) -> Moved:
        """The same where it carries a body."""
        return self.move(base, q, v, kinematics.fixed.lower)

    def see(self, a: Moving, b: Moving, lower: Lower) -> Seen:
        """The coordinate and its rate from the postures of a and b alone.

        Angles count the turns in the plane; in space they are within half a revolution (`counted`).
        """
        raise NotImplementedError

    def wrench(self, at: Between) -> tuple[ca.SX, ca.SX]:
        """Force and couple on b whose power is one unit for each unit of the coordinate's rate.

        On the other motions that are left it does no work.
        """
        raise NotImplementedError

    def hold(self, value: ca.SX, at: Between) -> Action:
        """What keeps the coordinate at a value: its wrench does no work on the other motions."""
        raise NotImplementedError

    def near(self, at: Between) -> Action | None:
        """The gap of two figures, where that is the coordinate."""
        return None


def seen(motion: Motion, a: Moving, b: Moving, lower: Lower) -> Seen:
    """The coordinate of a motion that time may change, and its rate."""
    moments = Moments(lower)
    value, rate = motion.see(a, b, moments)
    if not moments.met:
        return value, rate
    if not motion.keeps_axis:
        rate = rate + ca.jacobian(value, moments.symbol)
    value, rate = moments.back(value, rate)
    return value, rate
