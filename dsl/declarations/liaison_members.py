"""The variables of a liaison in its model."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl import checked
from frot.dsl.catalogue import liaison_members
from frot.dsl.quantities.dimensions import REAL, Type


def coordinates(liaison: checked.Liaison, planar: bool) -> Mapping[str, Type]:
    """The variables by name; `u` on a curve with a parameter is that parameter."""
    members = dict(liaison_members(liaison.kind, planar))
    place = liaison.b
    if "u" in liaison.kind.coordinates and isinstance(place, checked.CurvePlace):
        members["u"] = parameter_type(place.curve)
    return members


def parameter_type(curve: checked.Curve) -> Type:
    """The type of the parameter of a curve: an abscissa on a line, an angle on a circle."""
    if curve.kind == "line":
        return liaison_length()
    start = curve.arguments.get("from")
    return REAL if start is None else start.type


def liaison_length() -> Type:
    """The type of an abscissa."""
    from frot.dsl.catalogue.types import LENGTH

    return LENGTH
