"""Variables of bodies, of frames and named points, and of liaisons, with their types."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.catalogue.kinds import LiaisonKind
from frot.dsl.catalogue.types import (
    ACCELERATION,
    ANGULAR_ACCELERATION,
    ANGULAR_MOMENTUM,
    ANGULAR_VELOCITY,
    ENERGY,
    FORCE,
    LENGTH,
    MODE,
    MOMENTUM,
    POWER,
    TORQUE,
    VELOCITY,
)
from frot.dsl.quantities.dimensions import REAL, Type


def vector(of: Type, planar: bool) -> Type:
    """The type of a vector with items of this type in a planar or a space model."""
    return Type(of.base, of.dimension, (2,) if planar else (3,))


def _turning(of: Type, planar: bool) -> Type:
    return of if planar else vector(of, planar)


def point_members(planar: bool, turns: bool = True) -> Mapping[str, Type]:
    """Variables of a frame or of a named point of a body."""
    members = {
        "position": vector(LENGTH, planar),
        "velocity": vector(VELOCITY, planar),
        "acceleration": vector(ACCELERATION, planar),
    }
    if turns:
        members["angle" if planar else "orientation"] = REAL if planar else Type(shape=(4,))
        members["angular_velocity"] = _turning(ANGULAR_VELOCITY, planar)
        members["angular_acceleration"] = _turning(ANGULAR_ACCELERATION, planar)
        members["ex"] = members["ey"] = vector(REAL, planar)
        if not planar:
            members["ez"] = vector(REAL, planar)
    return members


def body_members(planar: bool, turns: bool = True) -> Mapping[str, Type]:
    """Variables of a body; those of rotation are left out where `turns` is False."""
    return {
        **point_members(planar, turns),
        "kinetic_energy": ENERGY,
        "momentum": vector(MOMENTUM, planar),
        "angular_momentum": _turning(ANGULAR_MOMENTUM, planar),
    }


def liaison_members(kind: LiaisonKind, planar: bool) -> Mapping[str, Type]:
    """Variables of a liaison: its own coordinates and those common to all.

    In the plane the tangent has one direction: `slip` and `tangential_force` are signed scalars.
    """
    return {
        "force": vector(FORCE, planar),
        "torque": _turning(TORQUE, planar),
        "normal_force": FORCE,
        "tangential_force": _turning(FORCE, planar),
        "slip": _turning(VELOCITY, planar),
        "gap": LENGTH,
        "mode": MODE,
        "power": POWER,
        **coordinates_of(kind, planar),
    }


def coordinates_of(kind: LiaisonKind, planar: bool) -> Mapping[str, Type]:
    """The coordinates of a liaison: what turns any way has an angle in the plane alone."""
    any_way = "angular_velocity" in kind.coordinates
    other = ("z", "orientation", "angular_velocity") if planar else ("angle",) * any_way
    return {name: of for name, of in kind.coordinates.items() if name not in other}
