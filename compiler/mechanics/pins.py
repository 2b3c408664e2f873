"""Rotoïdes: their angle, the rows of their reaction, and their variables."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.symbols import Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.mechanism import Pin


@dataclass(frozen=True, slots=True, eq=False)
class PinGeometry:
    """A pin as functions of the coordinates.

    `angle` of b's axes less that of a's, `speed` its rate; `apart` (2, or empty where no reaction
    is computed) the velocity of b's point relative to a's, of auxiliary speeds alone, in ground
    axes; `radius` of the pin or None where nobody gave it.
    """

    angle: ca.SX
    speed: ca.SX
    apart: ca.SX
    radius: ca.SX | None

    @property
    def gap(self) -> ca.SX:
        """The points coincide."""
        return ca.SX(0)

    @property
    def witness(self) -> ca.SX:
        """A pin has no sides to choose from."""
        return ca.SX.ones(3)

    @property
    def reach(self) -> ca.SX:
        """Nor a gap made of lengths."""
        return ca.SX(0)


def pin_geometry(pin: Pin, kinematics: Kinematics) -> PinGeometry:
    """Angle and relative velocities of a pin, be it ideal or with friction."""
    symbols = kinematics.symbols
    index = kinematics.pin_angles.get(pin.liaison)
    if index is not None:
        angle, speed = symbols.q[index], symbols.v[index]
    else:
        angle = kinematics.angle(pin.b) - kinematics.angle(pin.a)
        speed = kinematics.velocity(angle)
    at = kinematics.auxiliary.get(pin.liaison)
    apart = ca.SX.zeros(0) if at is None else symbols.sw[at : at + 2]
    radius = None if pin.radius is None else kinematics.fixed.lower(pin.radius)
    return PinGeometry(angle, speed, apart, radius)


def pin_variable(geometry: PinGeometry, name: str, rows: Rows | None, lam: ca.SX) -> ca.SX:
    """A variable of a pin; `rows` is None where its reaction is not computed.

    The force and the couple are those of a on b. With the radius of the pin, `slip` and
    `tangential_force` are those at its surface.
    """
    match name:
        case "angle":
            return geometry.angle
        case "speed":
            return geometry.speed
        case "gap":
            return geometry.gap
        case "slip" if geometry.radius is not None:
            return geometry.radius * geometry.speed
    if rows is None:
        raise KeyError(name)
    force = ca.vertcat(lam[rows.normal], lam[rows.second])
    couple = lam[rows.tangent] if rows.tangent >= 0 else ca.SX(0)
    match name:
        case "force":
            return force
        case "torque":
            return couple
        case "normal_force":
            return ca.sqrt(ca.sumsqr(force))
        case "tangential_force" if geometry.radius is not None:
            return couple / geometry.radius
        case "power":
            return couple * geometry.speed
    raise KeyError(name)
