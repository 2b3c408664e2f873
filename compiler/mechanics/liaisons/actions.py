"""What a liaison does between two places: its wrench, the motion that forbids, its gap.

A liaison without friction does no work on what it leaves (P. Painlevé 1895, p. 1-6): its reaction
is a sum lam_k W_k of wrenches that do none. One unit of W_k is a force at the place b and a couple,
of a on b. A lock k has a motion C_k that it forbids, and W_k . C_j is one where j is k, else zero:
an auxiliary speed along C_k has lam_k alone as its force, which is how reactions of what
coordinates keep are read (Kane, see reduce.py). As a row W_k . (V_b - V_a) is the rate of the gap
that the lock keeps at zero.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.spatial import Moving, Pose, nowhere
from frot.compiler.mechanics.values import Lower


@dataclass(frozen=True, slots=True, eq=False)
class Between:
    """The places a and b, and what a lock between them may want to know.

    `side` is that of figures which touch, see there, None for the outside; `tangent` that of a
    curve which carries b; `turn` the angle of a screw with its whole turns, else it is within half
    a turn; `track` what is followed where they touch, or where b is on a curve.
    """

    a: Pose
    b: Pose
    lower: Lower
    side: ca.SX | None = None
    tangent: ca.SX | None = None
    turn: ca.SX | None = None
    track: Track | None = None

    @property
    def way(self) -> ca.SX:
        """From a to b (3)."""
        return self.b.origin - self.a.origin


class Part:
    """A lock or a motion of a liaison, and what meets there if anything does.

    `touches`: the distance of two figures is what it keeps, or what it is.
    """

    __slots__ = ()

    touches = False

    @property
    def is_followed(self) -> bool:
        """Whether where the bodies are nearest is solved for."""
        return False

    @property
    def figures(self) -> tuple[Figure, Figure] | None:
        """What meets, by the first of the parts that say so."""
        return None

    def find(self, at: tuple[Pose, Pose], lower: Lower, planar: bool) -> Track:
        """What is followed."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True, eq=False)
class Effort:
    """What one unit along a coordinate is: the rate it drives, its force and couple on b.

    In a liaison of which a curve of the plane is one place, `force` is that on the point.
    `along`: the part of each speed in the rate, where that is not linear in speeds.
    """

    rate: ca.SX
    force: ca.SX
    couple: ca.SX
    along: ca.SX | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A lock between two poses: `force` and `couple` of its wrench, `column`, `gap`.

    `own` is the rate of the gap while neither moves. `at`: where the force acts, None for the place
    b. `touch`: how the figures stand that touch. `measure`: a distance that the lock keeps.
    `length`: what the gap is made of beside distances. `drift`: the velocity of the material
    element of b from that of a, where figures depend on time. `normal`: of two tangent curves the
    direction in which they bend apart.
    """

    force: ca.SX
    couple: ca.SX
    column: Column
    gap: ca.SX
    own: ca.SX = field(default_factory=lambda: ca.SX(0))
    at: ca.SX | None = None
    touch: Touch | None = None
    measure: ca.SX | None = None
    length: ca.SX = field(default_factory=lambda: ca.SX(0))
    drift: ca.SX = field(default_factory=nowhere)
    normal: ca.SX | None = None

    def moves(self, a: Moving, b: Moving) -> ca.SX:
        """Velocity (3) of b relative to a where the force acts."""
        place = b.pose.origin if self.at is None else self.at
        moves = b.linear if self.at is None else b.velocity_of(place)
        return moves - a.velocity_of(place)

    def rate(self, a: Moving, b: Moving) -> ca.SX:
        """Rate of the gap: f . (v_b - v_a where f acts) + c . (omega_b - omega_a) + its own."""
        apart = self.moves(a, b)
        return ca.dot(self.force, apart) + ca.dot(self.couple, b.angular - a.angular) + self.own


def push(way: ca.SX, gap: ca.SX) -> Action:
    """A force along a unit vector."""
    return Action(way, nowhere(), Column(nowhere(), way), gap)


def twist(about: ca.SX, gap: ca.SX) -> Action:
    """A couple; the motion is that about the same line with one unit of power."""
    square = ca.sumsqr(about)
    turn = about if square.is_one() else about / square
    return Action(nowhere(), about, Column(turn, nowhere()), gap)
