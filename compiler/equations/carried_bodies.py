"""Bodies whose places follow parameters, inputs or the text's equations at given states."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.mechanics.mechanism import Hanging
from frot.compiler.mechanics.spatial import Pose, nowhere
from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """A body that a change from outside could move: by its liaison, or by the text's equations.

    `value`: place (3) and turn (3) of the body, velocity (3) of the place that carries it.
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
        pose = reduced.variables.kinematics.pose(coordinates.body)
        carried = _carrier_velocity(coordinates, system)
        place = ca.densify(ca.vertcat(pose.origin, _turn(pose), carried))
        value = system.resolve(reduced.variables.without_auxiliary(place))
        if outside.numel() and ca.depends_on(value, outside):
            liaison = None if coordinates.link is None else coordinates.link.liaison
            span = coordinates.body.span if liaison is None else liaison.span
            name = "" if liaison is None else liaison.name
            found.append(Carried(coordinates.body.name, name, span, value))
    return tuple(found)


def _turn(pose: Pose) -> ca.SX:
    """What changes by how far axes turn, to first order: the angle in the plane, else 2 r."""
    if pose.axes[2, 2].is_one():
        return ca.vertcat(0, 0, pose.angle)
    return 2 * pose.quaternion[1:]


def _carrier_velocity(hanging: Hanging, system: Assembled) -> ca.SX:
    """Velocity of the material point of the other body where the liaison is."""
    kinematics = system.reduced.variables.kinematics
    if hanging.base is None or hanging.own is None:
        return nowhere()
    return kinematics.moving(hanging.base).velocity_of(kinematics.position(hanging.own))
