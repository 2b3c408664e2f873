"""Types and values in the words of messages."""

from __future__ import annotations

from frot.dsl.catalogue import WORDS
from frot.dsl.dimensions import Type


def describe(kind: Type) -> str:
    """`a length (m)`, `a vector of 2 velocities (m/s)`, `a condition`, `a number`."""
    if kind.base == "boolean":
        return "a condition"
    if kind.base == "string":
        return "a text"
    unit = kind.dimension.unit
    word = WORDS.get(Type(dimension=kind.dimension), "")
    tail = "" if kind.dimension.is_one else f" ({unit})"
    if kind.is_scalar:
        if not word:
            return f"a quantity in {unit}"
        return f"{'an' if word[0] in 'aeiou' else 'a'} {word}{tail}"
    size = "x".join(str(n) for n in kind.shape)
    return f"a vector of {size} {word + ' items' if word else 'items'}{tail}"


def quantity(value: float, kind: Type) -> str:
    """A value in SI with its unit: `-1 kg`."""
    return f"{value:g}" if kind.dimension.is_one else f"{value:g} {kind.dimension.unit}"


def listed(names: tuple[str, ...] | list[str], last: str = "or") -> str:
    """`'a', 'b' or 'c'`."""
    shown = [repr(n) for n in names]
    if len(shown) < 2:
        return "".join(shown)
    return f"{', '.join(shown[:-1])} {last} {shown[-1]}"
