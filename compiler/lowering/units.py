"""Units of the values a program takes and gives: SI, with the author's unit for display."""

from __future__ import annotations

from functools import cache

from frot.dsl.quantities.dimensions import Dimension, dimension
from frot.dsl.quantities.turns import factor_between, rate_of_kind, rate_of_unit
from frot.dsl.quantities.units import parse_unit
from frot.runtime.program import Unit

_BY_QUANTITY = {
    "Angle": "rad",
    "AngularVelocity": "rad/s",
    "AngularAcceleration": "rad/s^2",
    "Torque": "N.m",
    "RotationalStiffness": "N.m/rad",
    "RotationalDamping": "N.m.s/rad",
    "Frequency": "Hz",
}
_TURNING = {"Angle": 1, "AngularVelocity": 1, "AngularAcceleration": 1}
_TURNING |= {"RotationalStiffness": -1, "RotationalDamping": -1}

_ENERGY = dimension(m=2, kg=1, s=-2)


@cache
def unit_of(of: Dimension, quantity: str = "", written: str = "") -> Unit:
    """The SI unit of a dimension; `written`, the author's unit, is kept for display if it differs.

    A half exponent (a square root of a unit) has no place in an FMU: such a unit is left out.
    """
    if any(e.denominator != 1 for e in of.exponents):
        return Unit("1")
    name = _BY_QUANTITY.get(quantity) or ("J" if of == _ENERGY else of.unit)
    exponents = (*(int(e) for e in of.exponents), _TURNING.get(quantity, 0))
    if not written or written == name:
        return Unit(name, exponents, quantity=quantity)
    parsed = parse_unit(written)
    if parsed is None or parsed.dimension != of:
        return Unit(name, exponents, quantity=quantity)
    turn = factor_between(rate_of_unit(written, of), rate_of_kind(quantity, "", of))
    factor, offset = float(parsed.factor * turn), float(parsed.offset)
    return Unit(name, exponents, written, factor, offset, quantity)
