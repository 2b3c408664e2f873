"""Rates of turning and frequencies: both are in 1/s, but 1 Hz is one turn a second, 2 pi rad/s."""

from __future__ import annotations

import math
import re

from frot.dsl.quantities.dimensions import Dimension, dimension

CYCLES, TURNING = "a frequency (Hz)", "an angular velocity (rad/s)"
TURN = 2 * math.pi
RATE = dimension(s=-1)
_KINDS = {"Frequency": CYCLES, "AngularVelocity": TURNING}
_HERTZ = re.compile(r"(?:T|G|M|k|h|da|d|c|m|u|µ|μ|n|p)?Hz")
_ANGLES = re.compile(r"\b(?:rpm|m?rad|deg|tour|tr|rev)\b|°")


def rate_of_unit(unit: str, of: Dimension) -> str:
    """The kind of a unit of the dimension 1/s: CYCLES, TURNING, or an empty text for `1/s`."""
    if of != RATE:
        return ""
    if _HERTZ.fullmatch(unit):
        return CYCLES
    return TURNING if _ANGLES.search(unit) else ""


def rate_of_kind(name: str, unit: str, of: Dimension) -> str:
    """The kind of rate that a type, and perhaps its unit, declares."""
    return _KINDS.get(name, "") or rate_of_unit(unit, of)


def factor_between(found: str, wanted: str) -> float:
    """The factor from one kind of rate in SI to the other."""
    if not (found and wanted) or found == wanted:
        return 1.0
    return TURN if wanted == TURNING else 1 / TURN
