"""Applied forces."""

from __future__ import annotations

from frot.dsl.catalogue.kinds import Argument, ForceKind, table
from frot.dsl.catalogue.types import (
    DAMPING,
    FORCE,
    LENGTH,
    MOMENTUM,
    STIFFNESS,
    TIME,
    TORQUE,
)
from frot.dsl.quantities.dimensions import REAL


def _place(name: str, doc: str) -> Argument:
    return Argument(name, kind="place", places=("point",), doc=doc)


def _point(name: str, doc: str) -> Argument:
    return Argument(name, LENGTH, "point", places=("point",), doc=doc)


# Coordinates that a couple may drive.
ANGLES = ("angle", "angle_a", "angle_b")

_ROWS = (
    ForceKind(
        "on",
        (
            _place("frame", "where it is applied"),
            Argument("value", FORCE, "vector", doc="force, ground axes"),
        ),
        aliases=("sur",),
        doc="A force applied at a point.",
    ),
    ForceKind(
        "couple",
        (
            Argument("holder", kind="holder", doc="a body, or a liaison with an angle"),
            Argument("value", TORQUE, "couple", doc="about z, the liaison's axis, or ground axes"),
            Argument(
                "coordinate",
                kind="word",
                required=False,
                default="all",
                words=("all", *ANGLES),
                doc="which angle of a liaison that has several",
            ),
        ),
        aliases=("torque",),
        doc="A couple on a body, or in a liaison between its two bodies.",
    ),
    ForceKind(
        "spring",
        (
            _point("a", "first end"),
            _point("b", "second end"),
            Argument("k", STIFFNESS, sign="nonnegative", doc="stiffness"),
            Argument("length", LENGTH, sign="nonnegative", doc="length at rest"),
        ),
        aliases=("ressort",),
        doc="A linear spring between two points.",
    ),
    ForceKind(
        "damper",
        (
            _point("a", "first end"),
            _point("b", "second end"),
            Argument("c", DAMPING, sign="nonnegative", doc="damping"),
        ),
        aliases=("amortisseur",),
        doc="A linear damper between two points.",
    ),
    ForceKind(
        "attraction",
        (
            _place("point", "the point that is drawn"),
            _point("centre", "where to"),
            Argument("k", STIFFNESS, sign="nonnegative", doc="force over distance"),
        ),
        doc="A force towards a centre, k times the distance.",
    ),
    ForceKind(
        "drag",
        (
            _place("body", "the body that is slowed"),
            Argument("c", DAMPING, kind="number", sign="nonnegative", doc="coefficient"),
            Argument(
                "exponent", REAL, required=False, default=1.0, sign="positive", doc="of the speed"
            ),
        ),
        aliases=("trainee",),
        doc="A force against the velocity, c times a power of the speed.",
    ),
    ForceKind(
        "impulse",
        (
            _place("frame", "where it is applied"),
            Argument("value", MOMENTUM, "vector", doc="impulse, ground axes"),
            Argument("at", TIME, required=False, default=0.0, doc="when"),
        ),
        aliases=("percussion",),
        doc="A percussion: speeds jump by it and by the reactions that it calls up.",
    ),
)

FORCES = table(_ROWS)
