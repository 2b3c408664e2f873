"""Orientations placed relative to the ground, whatever carries them."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.liaisons.motion import Motion, Quaternion
from frot.compiler.mechanics.liaisons.moves import Column, Moved
from frot.compiler.mechanics.spatial import (
    GROUND,
    Moving,
    Pose,
    X,
    Y,
    Z,
    about_z,
    axes_of,
    nowhere,
    turn_in_plane,
    turning,
)
from frot.compiler.mechanics.values import Lower

ORIENTATION = tuple(f"orientation[{k + 1}]" for k in range(4))
ANGULAR_VELOCITY = tuple(f"angular_velocity.{k}" for k in "xyz")


@dataclass(frozen=True, slots=True, eq=False)
class Heading(Motion):
    """Any orientation in the plane: the angle of the axes from those of the ground."""

    coordinates = ("angle",)
    faces_ground = True
    turns = True

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The column is z."""
        pose = Pose(base.pose.origin, turn_in_plane(q), turning(Z, q), q)
        return Moved(placed(base, pose, about_z(v)), (Column(Z, nowhere()),), nowhere())


@dataclass(frozen=True, slots=True, eq=False)
class Attitude(Motion):
    """Any orientation in space: a unit quaternion, turned by the angular velocity in ground axes.

    What carries the body does not enter, and no orientation is singular.
    """

    coordinates = ORIENTATION
    speeds = ANGULAR_VELOCITY
    quaternion = Quaternion(own_axes=False)
    faces_ground = True
    turns = True

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """The columns are the axes of the ground."""
        pose = Pose(base.pose.origin, axes_of(q), q, ca.SX(0))
        columns = tuple(Column(e, nowhere()) for e in (X, Y, Z))
        return Moved(placed(base, pose, v), columns, nowhere())


@dataclass(frozen=True, slots=True, eq=False)
class Pointing(Motion):
    """Any direction of the own x axis: a turn about it alone has no inertia and does not happen.

    P. Painlevé (1895, p. 32) counts five freedoms for a slender rod.
    """

    coordinates = ORIENTATION
    speeds = ("turning.y", "turning.z")
    quaternion = Quaternion(own_axes=True)
    faces_ground = True
    turns = True

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """(R u)' = R u' + omega x (R u), and omega is R u: no bias."""
        axes = axes_of(q)
        pose = Pose(base.pose.origin, axes, q, ca.SX(0))
        columns = tuple(Column(axes[:, k], nowhere()) for k in (1, 2))
        return Moved(placed(base, pose, axes[:, 1:] @ v), columns, nowhere())


@dataclass(frozen=True, slots=True, eq=False)
class Steady(Motion):
    """No turning: the axes of a particle are those of the ground."""

    faces_ground = True

    def move(self, base: Moving, q: ca.SX, v: ca.SX, lower: Lower) -> Moved:
        """No columns."""
        pose = Pose(base.pose.origin, GROUND.axes, GROUND.quaternion, GROUND.angle)
        return Moved(placed(base, pose, nowhere()), (), nowhere())


def placed(base: Moving, pose: Pose, angular: ca.SX) -> Moving:
    """Axes placed relative to the ground: nothing of the base's turning is left, nor any bias."""
    return Moving(pose, angular, base.linear, nowhere(), base.linear_bias)
