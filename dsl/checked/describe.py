"""Types and values in the words of messages."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.catalogue import WORDS
from frot.dsl.quantities.dimensions import Type

_SAID = {"boolean": ("a condition", "conditions"), "string": ("a text", "texts")}


def describe(kind: Type, unit: str = "") -> str:
    """`a length (m)`, `a vector of 2 velocities (m/s)`, `a condition`, `a number`.

    `unit` is shown in place of the SI unit: as the author wrote it.
    """
    if kind.base in _SAID:
        one, several = _SAID[kind.base]
        return one if kind.is_scalar else f"an array of {_size(kind)} {several}"
    if kind.enumeration is not None:
        one = f"of the enumeration {kind.enumeration.name!r}"
        return f"a value {one}" if kind.is_scalar else f"an array of {_size(kind)} values {one}"
    shown = unit or kind.dimension.unit
    word = WORDS.get(Type(dimension=kind.dimension), "")
    tail = "" if kind.dimension.is_one and not unit else f" ({shown})"
    if kind.is_scalar:
        if not word:
            return f"a quantity in {shown}"
        return f"{'an' if word[0] in 'aeiou' else 'a'} {word}{tail}"
    return f"a vector of {_size(kind)} {_several(word) if word else 'items'}{tail}"


def _several(word: str) -> str:
    """The plural of a word for a quantity: `forces`, `masses`, `moments of inertia`."""
    if " or " in word:
        return " or ".join(_several(one) for one in word.split(" or "))
    head, of, rest = word.partition(" of ")
    ending = "ies" if head.endswith("y") else "es" if head.endswith(("s", "x")) else "s"
    return (head.removesuffix("y") if ending == "ies" else head) + ending + of + rest


def _size(kind: Type) -> str:
    return "x".join(str(n) for n in kind.shape)


def quantity(value: float, kind: Type) -> str:
    """A value in SI with its unit: `-1 kg`."""
    return f"{value:g}" if kind.dimension.is_one else f"{value:g} {kind.dimension.unit}"


def listed(names: tuple[str, ...] | list[str], last: str = "or") -> str:
    """`'a', 'b' or 'c'`."""
    shown = [repr(n) for n in names]
    if len(shown) < 2:
        return "".join(shown)
    return f"{', '.join(shown[:-1])} {last} {shown[-1]}"


def written_unit(node: checked.Expression) -> str:
    """The unit an author wrote in an expression or for what it names, or an empty text."""
    for _ in range(20):
        match node:
            case checked.Literal(unit=unit):
                return unit
            case checked.Reference(target=target):
                return target.unit
            case checked.Unary(operand=inner) | checked.Element(operand=inner):
                node = inner
            case checked.Vector(items=items) if items:
                node = items[0]
            case checked.Binary(op="+" | "-", left=left):
                node = left
            case _:
                return ""
    return ""


def pair(wanted: Type, found: Type, wanted_unit: str, found_unit: str) -> tuple[str, str]:
    """Two types that differ, in the author's units where both sides have one."""
    both = wanted_unit and found_unit
    return describe(wanted, wanted_unit if both else ""), describe(
        found, found_unit if both else ""
    )
