"""The places of a joint and what coordinates and figures tell of them."""

from __future__ import annotations

from functools import partial
from typing import Protocol

import casadi as ca
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Between, Part
from frot.compiler.mechanics.liaisons.motion import Motion, seen
from frot.compiler.mechanics.points import Point
from frot.dsl.checked import Liaison


class JointPlaces(Protocol):
    """The places a and b of a liaison, the motions that it leaves, and the rest, which it locks."""

    @property
    def liaison(self) -> Liaison:
        """The liaison of the text."""
        ...

    @property
    def a(self) -> Point:
        """The place that its locks see at rest."""
        ...

    @property
    def b(self) -> Point:
        """The place on which they act."""
        ...

    @property
    def motions(self) -> tuple[Motion, ...]:
        """The motions of b relative to a."""
        ...

    @property
    def locks(self) -> tuple[Part, ...]:
        """The relations between a and b."""
        ...


def between_places(joint: JointPlaces, kinematics: Kinematics, side: ca.SX) -> Between:
    """The places of a joint, with what is known there; `side` as of figures that touch."""
    return Between(
        kinematics.pose(joint.a),
        kinematics.pose(joint.b),
        kinematics.fixed.lower,
        side=side,
        tangent=kinematics.tangent(joint.liaison),
        track=_track_of(joint, kinematics),
    )


def _track_of(joint: JointPlaces, kinematics: Kinematics) -> Track | None:
    """What is followed where the figures of a joint touch, or where a point is on its curve."""
    if joint.liaison in kinematics.along:
        return None
    parts: tuple[Part, ...] = (*joint.locks, *joint.motions)
    for part in parts:
        if part.is_followed:
            at, lower = (kinematics.pose(joint.a), kinematics.pose(joint.b)), kinematics.fixed.lower
            return kinematics.track(joint.liaison, partial(part.find, at, lower, kinematics.planar))
    return None


def joint_coordinate(joint: JointPlaces, index: int, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
    """A coordinate of a joint that can be counted, of b relative to a, and its rate."""
    motion, symbols = joint.motions[index], kinematics.symbols
    carried = kinematics.carried_by(joint, (joint.a, joint.b))
    if carried is not None and len(carried.motions) == len(joint.motions):
        k = index if carried.carries_b else len(joint.motions) - 1 - index
        nq, nv, names = carried.motions[k]
        if motion.coordinates and names == motion.coordinates:
            return symbols.q[nq], symbols.v[nv]
    if motion.curve is not None and joint.liaison in kinematics.tracks:
        return (
            kinematics.tracks[joint.liaison].unknowns[0],
            kinematics.track_rates[joint.liaison][0],
        )
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    value, rate = seen(motion, a, b, kinematics.fixed.lower)
    return kinematics.counted(joint.liaison, index, value), rate
