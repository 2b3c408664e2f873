"""Units as other notations write them, and how the language does."""

from __future__ import annotations

import re
import unicodedata

from frot.dsl.quantities.units import is_unit

_POINTS = "·⋅∙×*"
_DASHES = "\u2212\u2010\u2011\u2012\u2013"
_POWER = re.compile(r"\^\(?\+?(-?\d+)\)?")
_GLUED_POWER = re.compile(r"(?<=[^\W\d])(?=-?\d)")
_FACTOR = re.compile(r"([./]?)([^./()]+)")
_DIVIDED = re.compile(r"([^()]+)/\(([^()]+)\)")


def corrected(text: str) -> str:
    """A unit written `m.s-1`, `kg·m²` or `N.m/(rad/s)` as this language writes it.

    An empty text for what is no unit, and for what is one as it stands.
    """
    plain = "".join(_plain(c) for c in unicodedata.normalize("NFC", text).replace("**", "^"))
    plain = _GLUED_POWER.sub("^", _POWER.sub(r"^\1", plain))
    divided = _DIVIDED.fullmatch(plain)
    if divided is not None:
        plain = _divided(divided[1], divided[2])
    return plain if plain != text and is_unit(plain) else ""


def _plain(character: str) -> str:
    if character in _POINTS or character in _DASHES:
        return "." if character in _POINTS else "-"
    raised = character in "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺"
    return unicodedata.normalize("NFKC", character).replace("\u2212", "-") if raised else character


def _divided(above: str, below: str) -> str:
    """`above/(below)` without parentheses: `N.m/(rad/s)` is `N.m.s/rad`."""
    factors = _FACTOR.findall(below)
    up = "".join(f".{name}" for sign, name in factors if sign == "/")
    down = "".join(f"/{name}" for sign, name in factors if sign != "/")
    return above + up + down
