"""Which figures in space that end may part from each other, and how each pair stands."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import casadi as ca
from frot.compiler.mechanics.geometry.bounded_figures import ends, has_nearest_ball, nearest_ball
from frot.compiler.mechanics.geometry.closest_closed_form import Touch, is_closed, touch
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.mechanics.geometry.crossing_edges import (
    are_curves,
    are_straight,
    beside_edge,
    cross_curves,
    cross_straight,
    length_of,
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
    return without or known or _is_foot(a, b) or _follows_curve(a, b)


def _is_foot(a: Figure, b: Figure) -> bool:
    """Whether b touches a face with borders at one place known in closed form."""
    return a.plane is not None and bool(a.borders) and is_closed(a, b)


def _follows_curve(a: Figure, b: Figure) -> bool:
    """Whether b is a curve with ends on a surface without, which is given by a function."""
    return a.rank >= 0 and not ends(a) and b.parameters == 1 and b.has_ends


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
        return _foot_on_face(a, b, at, lower, ending)
    found = follow(partial(track_to_ends, a, b, at, lower, ending)).touch
    return beside_edge(a, b, at, found, lower, ending)


def _foot_on_face(
    a: Figure, b: Figure, at: tuple[Pose, Pose], lower: Lower, ending: Ending
) -> Touch:
    """Where b is lowest over a face, while that is over it: beyond are edges."""
    found = touch(a, b, at, lower, ending.side)
    ended, size = ca.SX(0), length_of(b, lower)
    for axis, long in a.borders:
        along = ca.dot(at[0].direction(axis.unit(lower)), found.place - at[0].origin)
        half = lower(long) / 2
        ended, size = ended + between(-half, half, along, ending).ended, size + 2 * half
    return while_inside(found, ended, size)
