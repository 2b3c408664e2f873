"""How long a thread is drawn out: its length d between its ends, and the rest of what it has.

The gap of its contact, (l^2 - d^2)/2 l, is smooth where the ends meet, but only a first
approximation of the rest elsewhere. Its normal has the size d/l. What is read, driven or bounded is
the length itself: d' = (v_b - v_a) . e, by the unit vector e from one end to the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.closest_closed_form import direction_of
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.mechanism import is_thread
from frot.compiler.mechanics.points import Point
from frot.compiler.mechanics.spatial import nowhere
from frot.compiler.mechanics.values import rate_by_time
from frot.dsl.checked import Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Thread:
    """The length (m) of a thread and its `rest`, with their rates; `way` (3) is e, of b from a."""

    length: ca.SX
    rest: ca.SX
    way: ca.SX
    rate: ca.SX
    rest_rate: ca.SX

    def effort(self, coordinate: str) -> Effort:
        """A force on b along the thread, by `length` outwards, by `gap` inwards."""
        if coordinate == "length":
            return Effort(self.rate, self.way, nowhere())
        return Effort(self.rest_rate, -self.way, nowhere())


def thread_of(liaison: Liaison, kinematics: Kinematics, a: Point, b: Point) -> Thread | None:
    """What a thread between two points is; None of another liaison."""
    if not is_thread(liaison):
        return None
    lower = kinematics.fixed.lower
    first, second = kinematics.moving(a), kinematics.moving(b)
    apart, longest = second.pose.origin - first.pose.origin, lower(liaison.options["length"])
    length = ca.norm_2(apart)
    way = direction_of(apart, length)
    rate = ca.dot(way, second.linear - first.linear)
    rest_rate = rate_by_time(longest, lower) - rate
    return Thread(length, longest - length, way, rate, rest_rate)
