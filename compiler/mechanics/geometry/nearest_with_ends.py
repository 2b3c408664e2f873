"""Which figures in space that end may part from each other, and how each pair stands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import casadi as ca
from frot.compiler.mechanics.geometry.bounded_figures import ends, has_nearest_ball, nearest_ball
from frot.compiler.mechanics.geometry.closest_closed_form import Touch, is_closed, touch
from frot.compiler.mechanics.geometry.closest_solved import Track, is_tracked, on_side, track
from frot.compiler.mechanics.geometry.crossing_edges import (
    are_curves,
    are_straight,
    beside_edge,
    cross_curves,
    cross_straight,
    pierce,
    pierces,
    while_inside,
)
from frot.compiler.mechanics.geometry.curves_with_ends import Ending, between, track_to_ends
from frot.compiler.mechanics.geometry.figure import Figure
from frot.compiler.mechanics.spatial import Pose
from frot.compiler.mechanics.values import Lower

_Follow = Callable[[Callable[[], Track]], Track]


def may_part(a: Figure, b: Figure) -> bool:
    """Whether figures that can touch may part: they have no ends, or it is known what is there."""
    without = not (ends(a) or ends(b))
    if pierces(b, a):
        return False  # the oval comes first
    known = has_nearest_ball(a, b) or are_straight(a, b) or are_curves(a, b)
    return without or known or _is_foot(a, b) or _follows_curve(a, b) or _is_followed(a, b)


def _is_foot(a: Figure, b: Figure) -> bool:
    """Whether b touches a face or a side with borders at one place known in closed form."""
    return bool(a.borders) and is_closed(a, b)


def _follows_curve(a: Figure, b: Figure) -> bool:
    """Whether b is a curve with ends on a surface without, which is given by a function."""
    return a.rank >= 0 and not ends(a) and b.parameters == 1 and b.has_ends


def _is_followed(a: Figure, b: Figure) -> bool:
    """Whether b touches a face or a cylinder with borders at one place that is solved for."""
    return bool(a.borders) and a.rank >= 0 and not b.borders and is_tracked(a, b, False)


def nearest_with_ends(
    a: Figure,
    b: Figure,
    at: tuple[Pose, Pose],
    lower: Lower,
    ending: Ending,
    follow: _Follow,
) -> Touch:
    """How b stands to a; `follow` keeps what is solved for, by what makes it."""
    if has_nearest_ball(a, b):
        return nearest_ball(a, b, at, lower, ending)
    if are_straight(a, b):
        return cross_straight(a, b, at, lower, ending)
    if pierces(a, b):
        return pierce(a, b, at, lower, ending)
    if are_curves(a, b):
        return follow(partial(cross_curves, a, b, at, lower, ending)).touch
    if _is_foot(a, b):
        return _over(a, b, at, touch(a, b, at, lower, ending.side), lower, ending)
    if b.has_ends:
        found = follow(partial(track_to_ends, a, b, at, lower, ending)).touch
    else:
        found = on_side(follow(partial(track, a, b, at, lower, False)).touch, ending.side)
    if a.borders:
        return _over(a, b, at, found, lower, ending)
    return beside_edge(a, b, at, found, lower, ending)


def _over(
    a: Figure, b: Figure, at: tuple[Pose, Pose], found: Touch, lower: Lower, ending: Ending
) -> Touch:
    """The touch while its place is between the borders of a: beyond are edges, or a rim.

    What begins beyond the ends of a cylinder is outside of it.
    """
    ended, size, beside = ca.SX(0), ca.SX(0), ca.SX(1)
    centre = at[1].point(b.middle(lower)) - at[0].origin
    for axis, long in a.borders:
        way, half = at[0].direction(axis.unit(lower)), lower(long) / 2
        along = ca.dot(way, found.place - at[0].origin)
        beside = ca.logic_and(beside, ca.fabs(ca.dot(way, centre)) < half)
        ended, size = ended + between(-half, half, along, ending).ended, size + 2 * half
    if a.tube is not None:
        found = replace(found, witness=ca.if_else(beside, found.witness, size))
    return while_inside(found, ended, size)
