"""Curves and surfaces of the text, with the arguments that place them."""

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.catalogue.kinds import Argument, table
from frot.dsl.catalogue.shapes import SEMI_AXES
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.quantities.dimensions import REAL


@dataclass(frozen=True, slots=True)
class FigureKind:
    """A kind of curve or surface; `form` is how one is written that is given by a function."""

    name: str
    arguments: tuple[Argument, ...] = ()
    aliases: tuple[str, ...] = ()
    form: str = ""
    doc: str = ""


def _axis(name: str, doc: str, required: bool = False, space_only: bool = False) -> Argument:
    default = None if required else "z"
    return Argument(
        name, REAL, "axis", required=required, default=default, space_only=space_only, doc=doc
    )


_RADIUS = Argument("radius", LENGTH, sign="positive", doc="radius")
_THROUGH = Argument("through", LENGTH, "vector", doc="a point of it")
_CENTRE = Argument("centre", LENGTH, "vector", required=False, default=0.0, doc="its centre")
_NORMAL = _axis("normal", "normal of its plane", space_only=True)

CURVES = table(
    (
        FigureKind(
            "line",
            (_THROUGH, Argument("direction", REAL, "vector", doc="its direction")),
            ("droite",),
            doc="A straight line without ends.",
        ),
        FigureKind("circle", (_RADIUS, _NORMAL, _CENTRE), ("cercle",), doc="A circle."),
        FigureKind(
            "ellipse",
            (
                Argument("a", LENGTH, sign="positive", doc="semi-axis along x"),
                Argument("b", LENGTH, sign="positive", doc="semi-axis along y"),
                _NORMAL,
                _CENTRE,
            ),
            doc="An ellipse.",
        ),
        FigureKind(
            "parametric",
            form="parametric((x(u), y(u)), u = (from, to), periodic = false)",
            doc="The points of a parameter; three components in space.",
        ),
    )
)

SURFACES = table(
    (
        FigureKind(
            "plane",
            (_THROUGH, _axis("normal", "its normal", required=True)),
            ("plan",),
            doc="A plane without borders.",
        ),
        FigureKind("sphere", (_RADIUS, _CENTRE), doc="A sphere."),
        FigureKind("ellipsoid", (SEMI_AXES, _CENTRE), ("ellipsoide",), doc="An ellipsoid."),
        FigureKind(
            "cylinder",
            (_RADIUS, _axis("axis", "direction of its axis")),
            doc="A round cylinder without ends, about its owner's origin.",
        ),
        FigureKind(
            "implicit",
            form="implicit(F(x, y, z))",
            doc="The points where a function is zero.",
        ),
        FigureKind(
            "parametric",
            form="parametric((x(u, v), y(u, v), z(u, v)), u = (from, to), v = (from, to), "
            "periodic = false)",
            doc="The points of two parameters.",
        ),
    )
)
