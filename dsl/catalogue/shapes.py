"""Shapes of bodies: mass distribution, named frames and named geometry."""

from __future__ import annotations

from frot.dsl.catalogue.kinds import Argument, Shape, table
from frot.dsl.catalogue.types import INERTIA, LENGTH, MASS

SEMI_AXES = Argument("semi_axes", LENGTH, "vector", sign="positive", doc="semi-axes along x, y, z")
_SIZE = Argument("size", LENGTH, "vector", sign="positive", doc="lengths of the edges")
_MASS = Argument("mass", MASS, sign="positive", doc="mass of the body")
_RADIUS = Argument("radius", LENGTH, sign="positive", doc="radius")
_LENGTH = Argument("length", LENGTH, sign="positive", doc="length")
_INERTIA = Argument(
    "inertia",
    INERTIA,
    "inertia",
    required=False,
    sign="positive",
    doc="moment of inertia about G, in place of that of the shape",
)


def _semi_axis(name: str, axis: str) -> Argument:
    return Argument(name, LENGTH, sign="positive", doc=f"semi-axis along {axis}")


_ROWS = (
    Shape(
        "particle",
        (_MASS,),
        freedoms_space=3,
        freedoms_planar=2,
        turns=False,
        aliases=("point_materiel",),
        doc="A point with a mass; it does not turn.",
    ),
    Shape(
        "rod",
        (_MASS, _LENGTH, _INERTIA),
        freedoms_space=5,
        frames=("start", "tip", "G"),
        geometry={"axis": "curve"},
        aliases=("tige_mince",),
        doc="A slender homogeneous rod along its x axis, G in the middle.",
    ),
    Shape(
        "disc",
        (_MASS, _RADIUS, _INERTIA),
        freedoms_space=6,
        geometry={"rim": "curve"},
        aliases=("disk", "disque"),
        doc="A homogeneous disc about its z axis.",
    ),
    Shape(
        "ring",
        (_MASS, _RADIUS, _INERTIA),
        freedoms_space=6,
        geometry={"rim": "curve"},
        aliases=("hoop", "cerceau", "anneau"),
        doc="A thin homogeneous ring about its z axis.",
    ),
    Shape(
        "ellipse",
        (_MASS, _semi_axis("a", "x"), _semi_axis("b", "y"), _INERTIA),
        freedoms_space=6,
        geometry={"rim": "curve"},
        doc="A homogeneous elliptic lamina with semi-axes along x and y.",
    ),
    Shape(
        "sphere",
        (_MASS, _RADIUS, _INERTIA),
        freedoms_space=6,
        planar=False,
        geometry={"surface": "surface"},
        doc="A homogeneous ball.",
    ),
    Shape(
        "shell",
        (_MASS, _RADIUS, _INERTIA),
        freedoms_space=6,
        planar=False,
        geometry={"surface": "surface"},
        aliases=("coque",),
        doc="A thin spherical shell.",
    ),
    Shape(
        "ellipsoid",
        (_MASS, SEMI_AXES, _INERTIA),
        freedoms_space=6,
        planar=False,
        geometry={"surface": "surface"},
        aliases=("ellipsoide",),
        doc="A homogeneous ellipsoid.",
    ),
    Shape(
        "cylinder",
        (_MASS, _RADIUS, _LENGTH, _INERTIA),
        freedoms_space=6,
        planar=False,
        frames=("G", "bottom", "top"),
        geometry={"rims": "curves", "side": "surface"},
        aliases=("cylindre",),
        doc="A homogeneous cylinder along z.",
    ),
    Shape(
        "box",
        (_MASS, _SIZE, _INERTIA),
        freedoms_space=6,
        frames=("G", "bottom", "top", "left", "right", "front", "back"),
        geometry={
            "corners": "points",
            "edges": "curves",
            "bottom": "surface",
            "top": "surface",
            "left": "surface",
            "right": "surface",
            "front": "surface",
            "back": "surface",
        },
        aliases=("block", "pave"),
        doc="A homogeneous box; two sizes in planar models. Its frames are the face centres.",
    ),
    Shape(
        "polygon",
        (
            _MASS,
            Argument("vertices", LENGTH, "vertices", doc="corners in order, no sides cross"),
            _INERTIA,
        ),
        freedoms_space=6,
        space=False,
        geometry={"corners": "points", "sides": "curves"},
        aliases=("polygone",),
        doc="A homogeneous planar lamina.",
    ),
    Shape(
        "solid",
        (
            _MASS,
            Argument(
                "inertia", INERTIA, "inertia", sign="positive", doc="moment of inertia about G"
            ),
            Argument("com", LENGTH, "vector", required=False, default=0.0, doc="G from origin"),
        ),
        freedoms_space=6,
        frames=("origin", "G"),
        home="origin",
        aliases=("solide",),
        doc="A body given by its mass and inertia.",
    ),
)

SHAPES = table(_ROWS)
