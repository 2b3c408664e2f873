"""Values of parameters and inputs as a user gives them: numbers, texts, whole arrays."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping

from frot.dsl.messages.errors import fail
from frot.runtime.program import ParameterInfo, Program, Unit

_ITEM = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")


def read_settings(
    given: Mapping[str, object] | None,
    known: tuple[ParameterInfo, ...],
    what: str,
    program: Program,
) -> list[tuple[int, float]]:
    """Index and SI value of each scalar that is set; FrotError for unknown names, bad values.

    An array is set as a whole, by one value for all items, or item by item as `mu[2]`; an item goes
    before the whole, whatever their order.
    """
    if given is not None and not isinstance(given, Mapping):
        raise fail(
            "E0806",
            f"the {what}s are given as {type(given).__name__}, not by their names",
            help=f"write {what}s={{'name': value}}",
        )
    index = {p.name: k for k, p in enumerate(known)}
    arrays = _arrays(known)
    values: dict[int, float] = {}
    for name, raw in sorted((given or {}).items(), key=lambda pair: str(pair[0]) not in arrays):
        value = _plain(raw)
        plain = str(name).replace(" ", "")
        if plain in arrays:
            items = arrays[plain]
            values.update(zip(items, _whole(plain, [known[k] for k in items], value), strict=True))
        elif plain in index:
            values[index[plain]] = parameter_value(known[index[plain]], value)
        else:
            raise _unknown(plain, [*arrays, *index], what, program)
    return list(values.items())


def read_each(
    name: str,
    values: Iterable[object],
    known: tuple[ParameterInfo, ...],
    what: str,
    program: Program,
) -> list[list[tuple[int, float]]]:
    """What `read_settings` gives for a name with each of several values."""
    plain = str(name).replace(" ", "")
    place = next((k for k, one in enumerate(known) if one.name == plain), -1)
    if place < 0:
        return [read_settings({name: value}, known, what, program) for value in values]
    return [[(place, parameter_value(known[place], _plain(value)))] for value in values]


def read_option(name: str, value: object, unit: str) -> float | None:
    """An option of a run, in SI: a number or a text with its unit; FrotError if it is neither."""
    if value is None:
        return None
    exponents = (0, 0, 1, 0, 0, 0, 0, 0) if unit == "s" else (0,) * 8
    info = ParameterInfo(name, "real", Unit(unit, exponents), 0.0, "")
    return parameter_value(info, _plain(value))


def _plain(value: object) -> object:
    """Numbers and arrays of numpy as numbers and lists of Python."""
    make = getattr(value, "tolist", None)
    return value if make is None else make()


def _arrays(known: tuple[ParameterInfo, ...]) -> dict[str, list[int]]:
    """The indices of the items of each array, by rows."""
    found: dict[str, list[int]] = {}
    for k, one in enumerate(known):
        item = _ITEM.fullmatch(one.name)
        if item is not None:
            found.setdefault(item[1], []).append(k)
    return found


def _unknown(name: str, names: list[str], what: str, program: Program) -> Exception:
    from difflib import get_close_matches

    why = dict(program.fixed).get(name)
    if why is not None:
        what, _, place = why.removesuffix(")").rpartition(" (")
        return fail(
            "E0805",
            f"parameter '{name}' cannot be set for a run: it decides {what} "
            f"({program.place(place)})",
            help="change its value in the text; the model is then compiled again",
        )
    near = get_close_matches(name, names, 1)
    item = _ITEM.fullmatch(name)
    if item is not None and item[1] in names:
        near = [max((n for n in names if n.startswith(f"{item[1]}[")), default=item[1])]
    listed = ", ".join(n for n in names if not _ITEM.fullmatch(n)) or "none"
    return fail(
        "E0805",
        f"model '{program.name}' has no {what} '{name}'",
        notes=(f"{what}s: {listed}",),
        help=f"did you mean '{near[0]}'?" if near else "",
    )


def _whole(name: str, items: list[ParameterInfo], value: object) -> list[float]:
    """The values of all items of an array, by rows."""
    last = _ITEM.fullmatch(items[-1].name)
    assert last is not None
    shape = tuple(int(n) for n in last[2].split(","))
    if isinstance(value, str) and value.strip()[:1] in ("(", "{", "["):
        found = _items_of_text(name, items[0], value, shape)
    elif isinstance(value, (list, tuple)):
        found = _nested(value)
    else:
        return [parameter_value(item, value) for item in items]
    if found[1] != shape:
        sizes, wanted = ("x".join(map(str, s)) for s in (found[1], shape))
        raise fail(
            "E0806",
            f"bad value of '{name}': {sizes} items, expected {wanted}",
            help="the size of an array is fixed in the text",
        )
    return [parameter_value(item, one) for item, one in zip(items, found[0], strict=True)]


def _nested(value: object) -> tuple[list[object], tuple[int, ...]]:
    """The items of nested sequences by rows, and their sizes: empty where rows differ."""
    if not isinstance(value, (list, tuple)):
        return [value], ()
    rows = [_nested(_plain(row)) for row in value]
    inner = {shape for _, shape in rows}
    shape = (len(rows), *inner.pop()) if len(inner) == 1 else (len(rows), 0)
    return [item for items, _ in rows for item in items], shape


def _items_of_text(
    name: str, item: ParameterInfo, text: str, shape: tuple[int, ...]
) -> tuple[list[object], tuple[int, ...]]:
    """`(1, 2) mm`, `{0.1, 0.2}` or `((1, 2), (3, 4))` as SI values, and its sizes."""
    from frot.dsl.checked.values import split_items

    pieces = split_items(text)
    if pieces is None:
        raise fail(
            "E0806",
            f"bad value of '{name}': {text!r} is no array",
            help=f"write '({', '.join(['...'] * shape[0])})', with a unit behind it or in it",
        )
    inside, unit = pieces
    tail = f" {unit}" if unit else ""
    rows = [
        _items_of_text(name, item, one + tail, shape[1:])
        if len(shape) > 1 and one[:1] in ("(", "{", "[")
        else ([parameter_value(item, one + tail)], ())
        for one in inside
    ]
    inner = {sizes for _, sizes in rows}
    sizes = (len(rows), *inner.pop()) if len(inner) == 1 else (len(rows), 0)
    return [value for values, _ in rows for value in values], sizes


def parameter_value(info: ParameterInfo, value: object) -> float:
    """A value in SI from a number, a truth value or a text such as `12 mm`; FrotError if bad."""
    try:
        if isinstance(value, str):
            number = _literal(info, value) or _from_text(info, value)
        elif isinstance(value, (bool, int, float)):
            number = float(value)
        else:
            raise ValueError(f"{value!r} is not a number")
        if not math.isfinite(number):
            raise ValueError(f"{value!r} is not a finite number")
        if info.type == "boolean" and number not in (0.0, 1.0):
            raise ValueError(f"{value!r} is not true or false")
        if info.type == "integer" and number != round(number):
            raise ValueError(f"{value!r} is not an integer")
        if info.literals and not 1 <= number <= len(info.literals):
            raise ValueError(f"{value!r} is none of its values")
    except OverflowError:
        told = f"bad value of '{info.name}': a number of so many digits is too large"
        raise fail("E0806", told, help=_expected(info)) from None
    except ValueError as error:
        raise fail("E0806", f"bad value of '{info.name}': {error}", help=_expected(info)) from None
    return number


def _expected(info: ParameterInfo) -> str:
    if info.literals:
        return f"write one of {', '.join(info.literals)}"
    if info.type == "boolean":
        return "write true or false"
    if info.type == "integer":
        return "write a whole number"
    if info.unit.name == "1":
        return "write a number"
    return f"write a number in {info.unit.name}, or one with its unit"


def _literal(info: ParameterInfo, text: str) -> int:
    """The number of a literal, written as `red` or `Colour.red`; 0 where it is none."""
    word = text.strip().rpartition(".")[2]
    return info.literals.index(word) + 1 if word in info.literals else 0


def _from_text(info: ParameterInfo, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        pass
    if info.literals:
        raise ValueError(f"{text!r} is none of its values")
    from fractions import Fraction

    from frot.dsl import parse_value
    from frot.dsl.quantities.dimensions import Dimension, Type

    of = Dimension(tuple(Fraction(e) for e in info.unit.exponents[:7]))
    return float(parse_value(text, Type(info.type, of), si=info.unit.name))  # type: ignore[arg-type]
