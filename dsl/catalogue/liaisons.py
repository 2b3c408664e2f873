"""Types of liaisons (Painlevé 1895; ISO 3952) with their relations and coordinates."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.catalogue.kinds import Argument, LiaisonKind, Softer, table
from frot.dsl.catalogue.types import ANGULAR_VELOCITY, LENGTH, VELOCITY
from frot.dsl.quantities.dimensions import BOOLEAN, REAL, Type

POINT = ("point",)
CURVE = ("curve",)
SURFACE = ("surface",)
ANY_TURN = {"orientation": REAL.of_shape((4,)), "angular_velocity": ANGULAR_VELOCITY.of_shape((3,))}
ANY = ("point", "curve", "surface")
# Laws of a contact of the plane, of one in space, of what slides or turns alone; axes that a kind
# that locks less keeps.
SLIDING = ("coulomb", "stribeck", "viscous")
CONTACT_LAWS = (*SLIDING, "regularized", "rolling_resistance")
DRY_LAWS = (*CONTACT_LAWS, "pivoting_resistance")
KEEPS_AXIS = (("axis", "axis", "z"),)
KEEPS_SLIDE = (("axis", "axis", "x"),)


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
    title: str = "",
    joins: str = "",
    in_plane: str = "",
    laws: tuple[str, ...] = (),
    laws_in_space: tuple[str, ...] = (),
    softer: tuple[Softer, ...] = (),
    softer_in_plane: tuple[Softer, ...] = (),
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
        title=title or name,
        joins=joins,
        in_plane=in_plane,
        laws=laws,
        laws_in_space=laws_in_space,
        softer=softer,
        softer_in_plane=softer_in_plane,
    )


_ROWS = (
    _liaison(
        "encastrement",
        ("weld",),
        POINT,
        POINT,
        (6, 3),
        doc="No relative motion.",
        softer=(Softer("spherique"),),
        softer_in_plane=(Softer("rotoide"),),
    ),
    _liaison(
        "rotoide",
        ("pivot", "revolute"),
        POINT,
        POINT,
        (5, 2),
        {"angle": REAL, "speed": ANGULAR_VELOCITY},
        (_axis("axis"),),
        doc="Rotation about a common axis.",
        title="rotoïde",
        laws=SLIDING,
        laws_in_space=SLIDING,
        softer=(
            Softer("spherique"),
            Softer("verrou", KEEPS_AXIS),
            Softer("lineaire_annulaire", KEEPS_AXIS),
        ),
        softer_in_plane=(Softer("point_courbe along x"), Softer("point_courbe along y")),
    ),
    _liaison(
        "prismatique",
        ("glissiere", "prismatic"),
        POINT,
        POINT,
        (5, 2),
        {"displacement": LENGTH, "speed": VELOCITY},
        (Argument("axis", REAL, "axis", required=False, default="x", doc="direction, axes of a"),),
        laws=SLIDING,
        laws_in_space=SLIDING,
        doc="Translation along a common axis.",
        softer=(Softer("verrou", KEEPS_SLIDE), Softer("lineaire_annulaire", KEEPS_SLIDE)),
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
        laws_in_space=SLIDING,
        doc="Rotation about and translation along a common axis.",
        softer=(Softer("lineaire_annulaire", KEEPS_AXIS),),
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
        laws_in_space=SLIDING,
        doc="A screw.",
        title="hélicoïdale",
    ),
    _liaison(
        "cardan",
        ("universal",),
        POINT,
        POINT,
        (4, None),
        {"angle_a": REAL, "angle_b": REAL},
        (_axis("axis_a"), _axis("axis_b", "y", "b")),
        laws_in_space=SLIDING,
        doc="Two crossed axes.",
        softer=(Softer("spherique"),),
    ),
    _liaison(
        "spherique",
        ("rotule", "spherical"),
        POINT,
        POINT,
        (3, None),
        ANY_TURN,
        of_points=True,
        laws_in_space=SLIDING,
        doc="A common point.",
        title="sphérique",
    ),
    _liaison(
        "appui_plan",
        ("planar",),
        POINT,
        POINT,
        (3, None),
        {"x": LENGTH, "y": LENGTH, "angle": REAL},
        (_axis("normal"),),
        laws_in_space=(*SLIDING, "pivoting_resistance"),
        doc="Two planes that stay on one another.",
        softer=(Softer("point_surface", (("axis", "normal", "z"),)),),
    ),
    _liaison(
        "lineaire_annulaire",
        ("point_on_line",),
        ("point", "curve"),
        ("point", "curve"),
        (2, None),
        options=(_axis("axis"),),
        of_points=True,
        laws_in_space=SLIDING,
        doc="A point stays on a straight line.",
        joins="it takes a point and a straight line, or two points with `axis`",
    ),
    _liaison(
        "lineaire_rectiligne",
        ("line_on_plane",),
        ("curve", "surface"),
        ("curve", "surface"),
        (2, None),
        doc="A line stays on a plane.",
        joins="it takes a straight line and a plane",
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
        in_plane="figures",
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
        in_plane="figures",
    ),
    _liaison(
        "point_courbe",
        ("point_on_curve",),
        POINT,
        CURVE,
        (2, 1),
        {"u": LENGTH, "abscissa": LENGTH},
        of_points=True,
        laws_in_space=SLIDING,
        doc="A point of a body stays on a curve.",
        joins="it takes a point, then a curve",
        in_plane="contact",
        laws=CONTACT_LAWS,
    ),
    _liaison(
        "point_surface",
        ("point_on_surface",),
        POINT,
        SURFACE,
        (1, None),
        of_points=True,
        laws_in_space=DRY_LAWS,
        doc="A point of a body stays on a surface.",
        joins="it takes a point, then a surface",
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
        laws_in_space=DRY_LAWS,
        doc="Two of point, curve, surface touch at a point.",
        joins="by one relation touch a point and a surface, and any two of curve, rim and "
        "surface; two points are a `spherique`, a point and a curve in space a `point_courbe`, a "
        "line on a plane a `lineaire_rectiligne`, two planes an `appui_plan`",
        in_plane="contact",
        laws=CONTACT_LAWS,
    ),
    _liaison(
        "courbe_courbe",
        ("curves_tangent",),
        CURVE,
        CURVE,
        (3, 1),
        doc="Two curves stay tangent.",
        joins="it takes two curves or rims, not both straight",
        in_plane="contact",
        laws=CONTACT_LAWS,
    ),
    _liaison(
        "roulement",
        ("rolling",),
        ("curve", "surface"),
        ("curve", "surface"),
        (3, 2),
        doc="Contact is kept and does not slip: kinematic, non-holonomic in space.",
        laws=("rolling_resistance",),
        laws_in_space=("rolling_resistance", "pivoting_resistance"),
        joins="it takes two of curve, rim and surface",
        in_plane="figures",
    ),
    _liaison(
        "appui_faces",
        ("face_contact",),
        ("surface", "curve"),
        ("surface", "curve"),
        (0, 0),
        {"gap": LENGTH},
        unilateral=True,
        laws_in_space=DRY_LAWS,
        doc="The corners of a face rest on a plane.",
        joins="it takes a face of a box, or a side of a polygon, and a plane or line",
        laws=CONTACT_LAWS,
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
