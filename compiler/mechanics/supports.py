"""Bodies whose places follow parameters, inputs or the text's equations at given states."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.mechanics.mechanism import (
    Coordinates,
    FreeCoordinates,
    LineCoordinates,
    owner_body,
    point_body,
)
from frot.dsl.checked import Liaison
from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """A body that a change from outside could move: by its liaison, or by the text's equations.

    `value`: x, y and angle of the body, velocity (2) of the place that carries it.
    """

    body: str
    by: str
    span: Span | None
    value: ca.SX


def carried_bodies(system: Assembled) -> tuple[Carried, ...]:
    """The bodies whose place or whose carrier's velocity is not given by the states alone."""
    reduced = system.reduced
    outside = ca.vertcat(reduced.symbols.u, reduced.symbols.p, system.y)
    found: list[Carried] = []
    for coordinates in reduced.mechanism.coordinates:
        pose = reduced.variables.kinematics.poses[coordinates.body]
        place = ca.vertcat(pose.origin, pose.angle, _carrier_velocity(coordinates, system))
        value = system.resolve(reduced.variables.settled(place))
        if outside.numel() and ca.depends_on(value, outside):
            liaison = _carrier(coordinates)
            span = coordinates.body.span if liaison is None else liaison.span
            name = "" if liaison is None else liaison.name
            found.append(Carried(coordinates.body.name, name, span, value))
    return tuple(found)


def _carrier(coordinates: Coordinates) -> Liaison | None:
    if isinstance(coordinates, FreeCoordinates):
        return None
    if isinstance(coordinates, LineCoordinates):
        return coordinates.liaison
    return coordinates.pin.liaison


def _carrier_velocity(coordinates: Coordinates, system: Assembled) -> ca.SX:
    """Velocity of the material point of the other body where the liaison is."""
    kinematics = system.reduced.variables.kinematics
    if isinstance(coordinates, FreeCoordinates):
        return ca.SX.zeros(2)
    if isinstance(coordinates, LineCoordinates):
        base, point = owner_body(coordinates.line.owner), coordinates.point
    else:
        pin = coordinates.pin
        point = pin.a if coordinates.carries_b else pin.b
        base = point_body(point)
    return kinematics.velocity_at(base, kinematics.position(point))
