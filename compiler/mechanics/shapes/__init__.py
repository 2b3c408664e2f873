"""What each shape of body is to mechanics: its points and its inertia, one file a family."""

from __future__ import annotations

from collections.abc import Mapping

import casadi as ca
from frot.compiler.mechanics.shapes.blocks import Box, Cylinder
from frot.compiler.mechanics.shapes.laminae import Disc, Ellipse, Polygon, Ring
from frot.compiler.mechanics.shapes.particle import Particle
from frot.compiler.mechanics.shapes.rod import Rod
from frot.compiler.mechanics.shapes.round import Ellipsoid, Shell, Sphere
from frot.compiler.mechanics.shapes.shape import Shape, given_inertia
from frot.compiler.mechanics.shapes.solid import Solid
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import Body

SHAPES: Mapping[str, Shape] = {
    "box": Box(),
    "cylinder": Cylinder(),
    "disc": Disc(),
    "ellipse": Ellipse(),
    "ellipsoid": Ellipsoid(),
    "particle": Particle(),
    "polygon": Polygon(),
    "ring": Ring(),
    "rod": Rod(),
    "shell": Shell(),
    "solid": Solid(),
    "sphere": Sphere(),
}


def shape_of(body: Body) -> Shape:
    """The mechanics of a body's shape; not of the ground."""
    assert body.shape is not None
    return SHAPES[body.shape.name]


def inertia_of(body: Body, planar: bool, lower: Lower) -> ca.SX:
    """Inertia (3 x 3) about G in the body's axes; in a planar model only that about z.

    A given `inertia` stands in place of that of the shape.
    """
    if body.shape is None or not body.shape.turns:
        return ca.SX(3, 3)
    if "inertia" in body.arguments:
        return given_inertia(lower(body.arguments["inertia"]), planar)
    matrix = shape_of(body).inertia(body, lower)
    if not planar:
        return ca.sparsify(matrix)
    about_z = ca.SX(3, 3)
    about_z[2, 2] = matrix[2, 2]
    return about_z
