"""Types of liaisons (Painlevé 1895; ISO 3952) with their relations and coordinates."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.catalogue.kinds import Argument, LiaisonKind, table
from frot.dsl.catalogue.types import ANGULAR_VELOCITY, LENGTH, VELOCITY
from frot.dsl.quantities.dimensions import BOOLEAN, REAL, Type

POINT = ("point",)
CURVE = ("curve",)
SURFACE = ("surface",)
ANY_TURN = {"orientation": REAL.of_shape((4,)), "angular_velocity": ANGULAR_VELOCITY.of_shape((3,))}
ANY = ("point", "curve", "surface")


def _axis(name: str, default: str = "z", of: str = "a") -> Argument:
    doc = f"direction, axes of {of}"
    return Argument(name, REAL, "axis", required=False, default=default, space_only=True, doc=doc)


def _liaison(
    name: str,
    aliases: tuple[str, ...],
    a: tuple[str, ...],
    b: tuple[str, ...],
    relations: tuple[int, int | None],
    coordinates: Mapping[str, Type] | None = None,
    options: tuple[Argument, ...] = (),
    *,
    unilateral: bool = False,
    of_points: bool = False,
    doc: str,
) -> LiaisonKind:
    arguments = (
        Argument("a", kind="place", places=a, doc="the place that acts"),
        Argument("b", kind="place", places=b, doc="the place acted upon"),
        *options,
        Argument(
            "unilateral",
            BOOLEAN,
            "boolean",
            required=False,
            default=unilateral,
            doc="whether the places can part",
        ),
    )
    return LiaisonKind(
        name,
        arguments,
        *relations,
        coordinates=coordinates or {},
        unilateral=unilateral,
        aliases=aliases,
        doc=doc,
        of_points=of_points,
    )


_ROWS = (
    _liaison("encastrement", ("weld",), POINT, POINT, (6, 3), doc="No relative motion."),
    _liaison(
        "rotoide",
        ("pivot", "revolute"),
        POINT,
        POINT,
        (5, 2),
        {"angle": REAL, "speed": ANGULAR_VELOCITY},
        (_axis("axis"),),
        doc="Rotation about a common axis.",
    ),
    _liaison(
        "prismatique",
        ("glissiere", "prismatic"),
        POINT,
        POINT,
        (5, 2),
        {"displacement": LENGTH, "speed": VELOCITY},
        (Argument("axis", REAL, "axis", required=False, default="x", doc="direction, axes of a"),),
        doc="Translation along a common axis.",
    ),
    _liaison(
        "verrou",
        ("pivot_glissant", "cylindrical"),
        POINT,
        POINT,
        (4, None),
        {
            "angle": REAL,
            "displacement": LENGTH,
            "speed_angle": ANGULAR_VELOCITY,
            "speed": VELOCITY,
        },
        (_axis("axis"),),
        doc="Rotation about and translation along a common axis.",
    ),
    _liaison(
        "helicoidale",
        ("screw",),
        POINT,
        POINT,
        (5, None),
        {"angle": REAL, "speed": ANGULAR_VELOCITY},
        (
            Argument("pitch", LENGTH, doc="advance per turn"),
            _axis("axis"),
        ),
        doc="A screw.",
    ),
    _liaison(
        "cardan",
        ("universal",),
        POINT,
        POINT,
        (4, None),
        {"angle_a": REAL, "angle_b": REAL},
        (_axis("axis_a"), _axis("axis_b", "y", "b")),
        doc="Two crossed axes.",
    ),
    _liaison(
        "spherique",
        ("rotule", "spherical"),
        POINT,
        POINT,
        (3, None),
        ANY_TURN,
        of_points=True,
        doc="A common point.",
    ),
    _liaison(
        "appui_plan",
        ("planar",),
        POINT,
        POINT,
        (3, None),
        {"x": LENGTH, "y": LENGTH, "angle": REAL},
        (_axis("normal"),),
        doc="Two planes that stay on one another.",
    ),
    _liaison(
        "lineaire_annulaire",
        ("point_on_line",),
        ("point", "curve"),
        ("point", "curve"),
        (2, None),
        options=(_axis("axis"),),
        of_points=True,
        doc="A point stays on a straight line.",
    ),
    _liaison(
        "lineaire_rectiligne",
        ("line_on_plane",),
        ("curve", "surface"),
        ("curve", "surface"),
        (2, None),
        doc="A line stays on a plane.",
    ),
    _liaison(
        "tige",
        ("link",),
        POINT,
        POINT,
        (1, 1),
        {"length": LENGTH},
        (Argument("length", LENGTH, sign="positive", doc="distance of the points"),),
        of_points=True,
        doc="A massless rigid rod between two points.",
    ),
    _liaison(
        "fil",
        ("thread",),
        POINT,
        POINT,
        (1, 1),
        {"length": LENGTH},
        (Argument("length", LENGTH, sign="positive", doc="largest distance of the points"),),
        unilateral=True,
        of_points=True,
        doc="A massless inextensible thread between two points.",
    ),
    _liaison(
        "point_courbe",
        ("point_on_curve",),
        POINT,
        CURVE,
        (2, 1),
        {"u": LENGTH, "abscissa": LENGTH},
        of_points=True,
        doc="A point of a body stays on a curve.",
    ),
    _liaison(
        "point_surface",
        ("point_on_surface",),
        POINT,
        SURFACE,
        (1, None),
        of_points=True,
        doc="A point of a body stays on a surface.",
    ),
    _liaison(
        "contact_ponctuel",
        ("point_contact",),
        ANY,
        ANY,
        (1, 1),
        {"gap": LENGTH},
        unilateral=True,
        of_points=True,
        doc="Two of point, curve, surface touch at a point.",
    ),
    _liaison(
        "courbe_courbe",
        ("curves_tangent",),
        CURVE,
        CURVE,
        (3, 1),
        doc="Two curves stay tangent.",
    ),
    _liaison(
        "roulement",
        ("rolling",),
        ("curve", "surface"),
        ("curve", "surface"),
        (3, 2),
        doc="Contact is kept and does not slip: kinematic, non-holonomic in space.",
    ),
    _liaison(
        "appui_faces",
        ("face_contact",),
        ("surface", "curve"),
        ("surface", "curve"),
        (0, 0),
        {"gap": LENGTH},
        unilateral=True,
        doc="The corners of a face rest on a plane.",
    ),
    _liaison(
        "libre",
        ("free",),
        POINT,
        POINT,
        (0, 0),
        {"x": LENGTH, "y": LENGTH, "z": LENGTH, "angle": REAL, **ANY_TURN},
        of_points=True,
        doc="No relation.",
    ),
)

LIAISONS = table(_ROWS)
