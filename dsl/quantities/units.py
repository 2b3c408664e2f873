"""Units: the table, the prefixes, and the reading of `kg.m/s^2`."""

from __future__ import annotations

import difflib
import math
import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from frot.dsl.quantities.dimensions import ONE, Dimension, dimension


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: its dimension, and the SI value `factor * number + offset` of a number of it.

    `offset` is not zero for degrees Celsius only, an absolute temperature.
    """

    dimension: Dimension
    factor: float
    offset: float = 0.0


class UnknownUnit(ValueError):
    """A text that is no unit; `word` is the part not known, `near` a likely one or empty."""

    def __init__(self, word: str, sentence: str, near: str = "") -> None:
        super().__init__(sentence)
        self.word = word
        self.near = near


PREFIXES: Mapping[str, float] = {
    "T": 1e12,
    "G": 1e9,
    "M": 1e6,
    "k": 1e3,
    "h": 1e2,
    "da": 1e1,
    "d": 1e-1,
    "c": 1e-2,
    "m": 1e-3,
    "u": 1e-6,
    "µ": 1e-6,
    "n": 1e-9,
    "p": 1e-12,
}

_NEWTON = dimension(m=1, kg=1, s=-2)
_JOULE = dimension(m=2, kg=1, s=-2)
_WATT = dimension(m=2, kg=1, s=-3)
_PASCAL = dimension(m=-1, kg=1, s=-2)
_RATE = dimension(s=-1)
_VOLT = dimension(m=2, kg=1, s=-3, A=-1)
_OHM = dimension(m=2, kg=1, s=-3, A=-2)

# Units that take prefixes.
PREFIXED: Mapping[str, Unit] = {
    "m": Unit(dimension(m=1), 1.0),
    "g": Unit(dimension(kg=1), 1e-3),
    "s": Unit(dimension(s=1), 1.0),
    "A": Unit(dimension(A=1), 1.0),
    "K": Unit(dimension(K=1), 1.0),
    "mol": Unit(Dimension((*ONE.exponents[:5], dimension(m=1).exponents[0], ONE.exponents[6])), 1),
    "cd": Unit(Dimension((*ONE.exponents[:6], dimension(m=1).exponents[0])), 1.0),
    "rad": Unit(ONE, 1.0),
    "N": Unit(_NEWTON, 1.0),
    "J": Unit(_JOULE, 1.0),
    "W": Unit(_WATT, 1.0),
    "Pa": Unit(_PASCAL, 1.0),
    "bar": Unit(_PASCAL, 1e5),
    "Hz": Unit(_RATE, 1.0),
    "C": Unit(dimension(A=1, s=1), 1.0),
    "V": Unit(_VOLT, 1.0),
    "Ohm": Unit(_OHM, 1.0),
    "Ω": Unit(_OHM, 1.0),
    "S": Unit(ONE / _OHM, 1.0),
    "H": Unit(dimension(m=2, kg=1, s=-2, A=-2), 1.0),
    "F": Unit(dimension(m=-2, kg=-1, s=4, A=2), 1.0),
    "Wb": Unit(_VOLT * dimension(s=1), 1.0),
    "T": Unit(dimension(kg=1, s=-2, A=-1), 1.0),
    "L": Unit(dimension(m=3), 1e-3),
    "l": Unit(dimension(m=3), 1e-3),
    "t": Unit(dimension(kg=1), 1e3),
    "Wh": Unit(_JOULE, 3600.0),
    "eV": Unit(_JOULE, 1.602176634e-19),
}

# Units that take none.
PLAIN: Mapping[str, Unit] = {
    "1": Unit(ONE, 1.0),
    "%": Unit(ONE, 0.01),
    "deg": Unit(ONE, math.pi / 180),
    "°": Unit(ONE, math.pi / 180),
    "tour": Unit(ONE, 2 * math.pi),
    "tr": Unit(ONE, 2 * math.pi),
    "rev": Unit(ONE, 2 * math.pi),
    "rpm": Unit(_RATE, 2 * math.pi / 60),
    "min": Unit(dimension(s=1), 60.0),
    "h": Unit(dimension(s=1), 3600.0),
    "d": Unit(dimension(s=1), 86400.0),
    "degC": Unit(dimension(K=1), 1.0, 273.15),
    "°C": Unit(dimension(K=1), 1.0, 273.15),
    "atm": Unit(_PASCAL, 101325.0),
    "kgf": Unit(_NEWTON, 9.80665),
    "daN": Unit(_NEWTON, 10.0),
    "inch": Unit(dimension(m=1), 0.0254),
    "ft": Unit(dimension(m=1), 0.3048),
    "lb": Unit(dimension(kg=1), 0.45359237),
    "lbf": Unit(_NEWTON, 4.4482216152605),
}

_MISNAMED: Mapping[str, str] = {
    "sec": "s",
    "secs": "s",
    "second": "s",
    "seconds": "s",
    "meter": "m",
    "meters": "m",
    "metre": "m",
    "metres": "m",
    "mètre": "m",
    "mètres": "m",
    "gram": "g",
    "kilo": "kg",
    "kgs": "kg",
    "kilogram": "kg",
    "newton": "N",
    "Newton": "N",
    "Nm": "N.m",
    "joule": "J",
    "watt": "W",
    "degree": "deg",
    "degrees": "deg",
    "degré": "deg",
    "degrés": "deg",
    "º": "°",
    "radian": "rad",
    "radians": "rad",
    "rads": "rad",
    "hz": "Hz",
    "ohm": "Ohm",
    "ohms": "Ohm",
    "volt": "V",
    "volts": "V",
    "amp": "A",
    "mn": "min",
    "hr": "h",
    "KG": "kg",
    "Kg": "kg",
    "mps": "m/s",
    "kph": "km/h",
    "in": "inch",
}

_FACTOR = re.compile(r"([./])?([^./^]+|)(?:\^([^./^]*))?")
_RAISED = re.compile("[⁻²³¹⁰⁴⁵⁶⁷⁸⁹]+")
_LARGEST_POWER = 20


@cache
def parse_unit(text: str) -> Unit:
    """The unit written `kg.m/s^2`: factors by `.` and `/` from left to right, powers by `^`.

    Raises UnknownUnit with a full sentence.
    """
    text = unicodedata.normalize("NFC", text).replace("μ", "µ").replace("Ω", "Ω")
    text = _RAISED.sub(_lowered, text)
    if text in PLAIN:
        return PLAIN[text]
    if not text:
        raise UnknownUnit("", "a unit has no text")
    dim, factor = ONE, 1.0
    position = 0
    while position < len(text):
        found = _FACTOR.match(text, position)
        if found is None or found.end() == position or (position > 0) != (found[1] is not None):
            raise UnknownUnit(text, f"{text!r} is not a unit: factors are joined by '.' or '/'")
        name, power_text = found[2], found[3]
        one = _simple(name)
        if one.offset:
            raise UnknownUnit(name, f"{name} is an absolute temperature; in a product write K")
        power = _power(text, power_text)
        if found[1] == "/":
            power = -power
        dim = dim * one.dimension**power
        factor = factor * one.factor**power
        position = found.end()
    if not (0 < factor < math.inf):
        raise UnknownUnit(text, f"the unit {text!r} is out of the range of numbers")
    return Unit(dim, factor)


def _lowered(raised: re.Match[str]) -> str:
    """`⁻²` as `^-2`."""
    return "^" + unicodedata.normalize("NFKC", raised[0]).replace("\u2212", "-")


def _power(text: str, digits: str | None) -> int:
    if digits is None:
        return 1
    if not re.fullmatch(r"-?[0-9]{1,3}", digits) or abs(int(digits)) > _LARGEST_POWER:
        raise UnknownUnit(text, f"in the unit {text!r} the power must be a small whole number")
    return int(digits)


def _simple(name: str) -> Unit:
    unit = PLAIN.get(name) or PREFIXED.get(name)
    if unit is not None:
        return unit
    for length in (1, 2):
        prefix, rest = name[:length], name[length:]
        if prefix in PREFIXES and rest in PREFIXED:
            base = PREFIXED[rest]
            return Unit(base.dimension, PREFIXES[prefix] * base.factor)
    raised = re.fullmatch(r"(\D+)([1-4])", name)
    if raised is not None and is_unit(raised[1]):
        raise UnknownUnit(name, f"unknown unit {name!r}", f"{raised[1]}^{raised[2]}")
    raise UnknownUnit(name, f"unknown unit {name!r}", nearest_unit(name))


def is_unit(name: str) -> bool:
    """Whether a word is a unit."""
    try:
        parse_unit(name)
    except UnknownUnit:
        return False
    return True


def nearest_unit(name: str) -> str:
    """A unit the author may have meant, or an empty text."""
    if name in _MISNAMED:
        return _MISNAMED[name]
    names = unit_names()
    folded = {n.lower(): n for n in reversed(names)}
    if name.lower() in folded:
        return folded[name.lower()]
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.6)
    return close[0] if close else ""


@cache
def unit_names() -> list[str]:
    """Every name without prefix, and the prefixed ones in common use."""
    common = "mm cm km um ms us kg mg kN mN MN kJ MJ mJ kW MW mW kPa MPa GPa kHz MHz mA mV kV"
    more = "kOhm MOhm mH uH uF nF pF mrad dm mL"
    return [n for n in (*PREFIXED, *PLAIN, *common.split(), *more.split()) if n != "1"]
