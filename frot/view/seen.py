"""Values that a picture needs beside the variables of a run: poses, and places of contact.

Each becomes variables of a second program, whose names begin with `PREFIX`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import casadi as ca

from frot.compiler.lowering.result_variables import Listed
from frot.compiler.mechanics.points import point_body
from frot.dsl.checked import (
    Body,
    BodyGeometry,
    BodyPoint,
    Curve,
    CurvePlace,
    Frame,
    Liaison,
    Model,
    Surface,
    SurfacePlace,
)
from frot.dsl.quantities.dimensions import dimension

if TYPE_CHECKING:
    from frot.compiler.equations.assembled import Assembled

PREFIX = "picture:"
PARTS = 7  # of a pose: x, y, z, and the quaternion w, x, y, z
Owner = Body | Frame | BodyPoint


def key_of(owner: Owner) -> str:
    """The name of a body, a frame or a point of a body."""
    if isinstance(owner, BodyPoint):
        return f"{owner.body.name}.{owner.name}"
    return owner.name


def owners_of(model: Model) -> dict[str, Owner]:
    """All whose pose a picture reads, by name."""
    found: dict[str, Owner] = {body.name: body for body in model.bodies}
    found |= {frame.name: frame for frame in model.frames}
    shapes: tuple[Curve | Surface, ...] = (*model.curves, *model.surfaces)
    for shape in shapes:
        found.setdefault(key_of(shape.owner), shape.owner)
    places: list[Any] = [place for x in model.liaisons for place in (x.a, x.b)]
    places += [value for force in model.forces for value in force.arguments.values()]
    for place in places:
        if isinstance(place, (BodyPoint, Frame)):
            found.setdefault(key_of(place), place)
    found.pop("ground", None)
    return {name: owner for name, owner in found.items() if not _is_ground(owner)}


def _is_ground(owner: Owner) -> bool:
    return isinstance(owner, Body) and owner.shape is None


def body_of(place: Any) -> Body:
    """The body that a place of a liaison is fixed to."""
    match place:
        case CurvePlace(curve=Curve(owner=owner)) | SurfacePlace(surface=Surface(owner=owner)):
            return owner if isinstance(owner, Body) else point_body(owner)
        case BodyGeometry(body=body):
            return body
    return place if isinstance(place, Body) else point_body(place)


def list_seen(system: Assembled) -> tuple[Listed, ...]:
    """The variables of the second program."""
    return tuple(_all(system))


def _all(system: Assembled) -> Iterator[Listed]:
    variables = system.reduced.variables
    for name, owner in owners_of(system.reduced.mechanism.model).items():
        pose = variables.kinematics.pose(owner)
        quaternion = pose.quaternion
        if variables.kinematics.planar:
            half = pose.angle / 2
            quaternion = ca.vertcat(ca.cos(half), 0, 0, ca.sin(half))
        yield from _vector(f"pose:{name}", ca.vertcat(pose.origin, quaternion))
    for liaison, geometry in variables.geometry.items():
        yield from _vector(f"place:{liaison.name}", geometry.place(variables.kinematics))
        normal = normal_of(system, liaison)
        if normal is not None:
            yield from _vector(f"normal:{liaison.name}", normal)


def normal_of(system: Assembled, liaison: Liaison) -> ca.SX | None:
    """The direction (3) of the normal reaction where figures touch; None of what is jointed."""
    geometry: Any = system.reduced.variables.geometry[liaison]
    touch = getattr(geometry, "touch", None)
    if touch is not None:
        found: ca.SX = touch.normal
        return found
    line = getattr(geometry, "line", None)
    return None if line is None else geometry.side * line.normal


def _vector(name: str, value: ca.SX) -> Iterator[Listed]:
    for k, part in enumerate(ca.vertsplit(ca.densify(value))):
        yield Listed(f"{PREFIX}{name}[{k}]", part, dimension(), "")
