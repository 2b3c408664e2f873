"""Laws of liaisons: friction, resistance, restitution, stops."""

from __future__ import annotations

from dataclasses import replace

from frot.dsl.catalogue.kinds import Argument, LawKind, LiaisonKind, table
from frot.dsl.catalogue.types import (
    ANGULAR_VELOCITY,
    DAMPING,
    LENGTH,
    ROTATIONAL_DAMPING,
    VELOCITY,
)
from frot.dsl.quantities.dimensions import REAL

_MU = Argument("mu", REAL, sign="nonnegative", doc="coefficient of friction of motion")
_MU_S = Argument(
    "mu_s",
    REAL,
    required=False,
    default_of="mu",
    sign="nonnegative",
    not_below="mu",
    doc="coefficient of friction of rest",
)
_DELTA = Argument("delta", LENGTH, sign="nonnegative", doc="couple of motion over normal force")
_DELTA_S = Argument(
    "delta_s",
    LENGTH,
    required=False,
    default_of="delta",
    sign="nonnegative",
    not_below="delta",
    doc="couple of rest over normal force",
)
_RADIUS = Argument(
    "radius",
    LENGTH,
    required=False,
    sign="positive",
    doc="radius of the pin, or distance of a guide from its axis",
)
_HALF_LENGTH = Argument(
    "half_length", LENGTH, required=False, sign="positive", doc="of a guide, or of a line"
)
_E = Argument("e", REAL, sign="nonnegative", at_most=1.0, doc="coefficient of restitution")

# Coordinates that `stops` may name.
STOPPED = ("angle", "angle_a", "angle_b", "displacement", "x", "y", "z", "u", "length", "gap")

_ROWS = (
    LawKind(
        "coulomb",
        (
            _MU,
            _MU_S,
            _RADIUS,
            _HALF_LENGTH,
        ),
        doc="Set-valued dry friction: rest is exact.",
    ),
    LawKind(
        "rolling_resistance",
        (_DELTA, _DELTA_S),
        aliases=("resistance_au_roulement",),
        doc="A couple opposed to rolling, bounded by delta N.",
    ),
    LawKind(
        "pivoting_resistance",
        (_DELTA, _DELTA_S),
        aliases=("resistance_au_pivotement",),
        doc="A couple opposed to the spin about the normal, bounded by delta N.",
        space_only=True,
    ),
    LawKind(
        "viscous",
        (
            Argument(
                "c",
                DAMPING,
                sign="nonnegative",
                others=(ROTATIONAL_DAMPING,),
                doc="reaction over speed",
            ),
        ),
        aliases=("visqueux",),
        doc="Linear damping.",
        repeats=True,
    ),
    LawKind(
        "stribeck",
        (
            _MU,
            Argument("mu_s", REAL, sign="nonnegative", not_below="mu", doc="coefficient at rest"),
            Argument(
                "v_s", VELOCITY, sign="positive", others=(ANGULAR_VELOCITY,), doc="Stribeck speed"
            ),
            Argument(
                "c",
                DAMPING,
                required=False,
                default=0.0,
                sign="nonnegative",
                others=(ROTATIONAL_DAMPING,),
                doc="viscous part",
            ),
            _RADIUS,
            _HALF_LENGTH,
        ),
        doc="Friction that decreases with speed, then rises.",
    ),
    LawKind(
        "regularized",
        (
            _MU,
            Argument(
                "v", VELOCITY, sign="positive", others=(ANGULAR_VELOCITY,), doc="smoothing speed"
            ),
            _RADIUS,
            _HALF_LENGTH,
        ),
        aliases=("regularised", "regularise"),
        doc="Smooth friction, for comparison: it creeps.",
    ),
    LawKind(
        "restitution",
        (
            _E,
            Argument(
                "rule",
                kind="word",
                required=False,
                default="energetic",
                words=("energetic", "poisson", "newton"),
                doc="rule of impact",
            ),
        ),
        doc="Impact of a unilateral liaison.",
    ),
    LawKind(
        "stops",
        (
            Argument("min", LENGTH, others=(REAL,), doc="lower bound of the coordinate"),
            Argument(
                "max", LENGTH, others=(REAL,), not_below="min", doc="upper bound of the coordinate"
            ),
            Argument(
                "e",
                REAL,
                required=False,
                default=0.0,
                sign="nonnegative",
                at_most=1.0,
                doc="coefficient of restitution",
            ),
            Argument(
                "coordinate",
                kind="word",
                required=False,
                default="all",
                words=("all", *STOPPED),
                doc="which it bounds: by default all that have the unit of its bounds",
            ),
        ),
        aliases=("butees",),
        doc="Bounds on the coordinates of a liaison: it stops there, or bounces.",
        repeats=True,
    ),
)

LAWS = table(_ROWS)

# Coordinates of a liaison that are none of its motions.
_LENGTHS = ("gap", "length")
_PLACES = ("u", "abscissa", *_LENGTHS)
# Laws of the coordinate itself; the slip of a pin is a velocity at its surface.
_OF_COORDINATE = ("viscous", "stops")


def arguments_for(law: LawKind, liaison: LiaisonKind) -> tuple[Argument, ...]:
    """The arguments of a law in a liaison, each with the type that fits what the liaison leaves.

    Where it leaves a translation or slip alone, values of rotations are none of it; where it leaves
    rotations alone, nor are the others. A liaison of relations, or with both, takes either; so do
    stops on the parameter of a curve, which is a length on a line and an angle on a circle.
    """
    if not liaison.arguments or (law.name == "stops" and liaison.along_curve):
        return law.arguments
    if law.name == "stops" and set(liaison.coordinates) & set(_LENGTHS):
        moves = [liaison.coordinates[name] for name in STOPPED if name in liaison.coordinates]
    else:
        moves = [of for name, of in liaison.coordinates.items() if name not in _PLACES]
    turns = [of.dimension in (REAL.dimension, ANGULAR_VELOCITY.dimension) for of in moves]
    if not moves and liaison.pin:  # the ends of a rod turn
        turns = [True]
    if not any(turns):
        return tuple(replace(a, others=()) for a in law.arguments)
    if not all(turns):
        return law.arguments
    return tuple(
        replace(a, type=(*a.others, a.type)[0], others=())
        if law.name in _OF_COORDINATE or a.name == "c"
        else a
        for a in law.arguments
    )
