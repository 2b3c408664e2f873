"""The variables of a liaison: those of its kind, with the parameter of the curve that it has."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.catalogue import liaison_members
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.checked.expressions import Expression, Literal
from frot.dsl.checked.mechanics import BodyGeometry, Curve, CurvePlace, Liaison, Place
from frot.dsl.quantities.dimensions import REAL, Type

# Curves of shapes that are straight, and those that are circles.
_STRAIGHT = ("axis", "edges", "sides")
_CIRCLES = (("disc", "rim"), ("ring", "rim"), ("cylinder", "rims"))


def liaison_variables(liaison: Liaison, planar: bool) -> Mapping[str, Type]:
    """The variables by name. On a curve `u` is its parameter, and `abscissa` its arc length.

    An arc length that no closed form tells is no variable.
    """
    members = dict(liaison_members(liaison.kind, planar))
    if liaison.kind.along_curve:
        members["u"] = parameter_type(liaison.b)
        if arc_of_unit(liaison.b) is None:
            members.pop("abscissa", None)
    return members


def parameter_type(place: Place | Curve) -> Type:
    """The type of the parameter of a curve: a length on a line, an angle on a circle."""
    if isinstance(place, BodyGeometry):
        return LENGTH if _name(place) in _STRAIGHT else REAL
    curve = place.curve if isinstance(place, CurvePlace) else place
    if not isinstance(curve, Curve) or curve.kind == "line":
        return LENGTH
    start = curve.arguments.get("from")
    return REAL if start is None else start.type


def arc_of_unit(place: Place) -> Expression | None:
    """The arc length (m) from u = 0 to a parameter, over that parameter; None where it varies."""
    if isinstance(place, BodyGeometry):
        shape = place.body.shape
        if shape is not None and (shape.name, _name(place)) in _CIRCLES:
            return place.body.arguments["radius"]
        return _one(place) if _name(place) in _STRAIGHT else None
    if not isinstance(place, CurvePlace):
        return None
    if place.curve.kind == "circle":
        return place.curve.arguments["radius"]
    return _one(place) if place.curve.kind == "line" else None


def _one(place: BodyGeometry | CurvePlace) -> Expression:
    return Literal(1.0, REAL, place.span)


def _name(place: BodyGeometry) -> str:
    """Its name without the number of an item."""
    return place.name.partition("[")[0]
