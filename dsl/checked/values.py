"""Values of parameters: their defaults, and those given as text on a command line."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping

from frot.dsl import checked
from frot.dsl.checked.describe import describe
from frot.dsl.checked.evaluation import Value, evaluate
from frot.dsl.checked.order import in_order
from frot.dsl.checked.walk import nodes
from frot.dsl.quantities.dimensions import Type
from frot.dsl.quantities.spelling import corrected
from frot.dsl.quantities.turns import factor_between, rate_of_kind, rate_of_unit
from frot.dsl.quantities.units import Unit, UnknownUnit, parse_unit

_COMMA = re.compile(r"([+-]?\d+),(\d+)")
_NUMBER = re.compile(r"\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S*)\s*")


def default_values(
    model: checked.Model, overrides: Mapping[str, object] | None = None
) -> dict[checked.Parameter, object]:
    """SI values of all parameters and constants; those that depend on others follow them.

    `overrides` are SI values by name. Raises KeyError for a name that is no parameter, and
    ValueError with a sentence for a constant that is overridden and for what `evaluate` refuses.
    """
    given = dict(overrides or {})
    by_name = {p.name: p for p in model.parameters}
    for name in given:
        if name not in by_name:
            raise KeyError(name)
        if by_name[name].constant:
            why = by_name[name].structural
            reason = f"it decides {why}" if why else "it is a constant"
            raise ValueError(f"{name!r} cannot be set: {reason}")
    needs = {p.name: [q.name for q in _parameters(p.value)] for p in model.parameters}
    order, _ = in_order(needs)
    values: dict[checked.Parameter, object] = {}
    for name in order:
        parameter = by_name[name]
        values[parameter] = given[name] if name in given else evaluate(parameter.value, values)
    return {p: values[p] for p in model.parameters}


def _parameters(root: checked.Expression) -> Iterator[checked.Parameter]:
    for node in nodes(root):
        if isinstance(node, checked.Reference) and isinstance(node.target, checked.Parameter):
            yield node.target


def parse_value(text: str, kind: Type, quantity: str = "", si: str = "") -> Value:
    """The SI value written as `0.2`, `12 mm`, `20 deg`, `false` or `(1, 0) m`.

    A bare number is in SI. `quantity` is the name of its type, or `si` its unit in SI: they tell a
    frequency from an angular velocity. Raises ValueError with a sentence.
    """
    text = text.strip()
    if kind.base == "string":
        return text.strip('"')
    if kind.base == "boolean":
        if text not in ("true", "false"):
            raise ValueError(f"expected true or false, found {text!r}")
        return text == "true"
    if not kind.is_scalar:
        return _vector(text, kind, quantity, si)
    found = _NUMBER.fullmatch(text)
    comma = _COMMA.match(text)
    if comma is not None:
        raise ValueError(f"the decimal sign is a point, '{comma[1]}.{comma[2]}': found {text!r}")
    if found is None:
        raise ValueError(f"expected {describe(kind)}, found {text!r}")
    value = float(found[1])
    if found[2]:
        unit = _unit(found[2], kind)
        meant = rate_of_kind(quantity, si, kind.dimension)
        turn = factor_between(rate_of_unit(found[2], kind.dimension), meant)
        value = value * unit.factor * turn + unit.offset
    if not math.isfinite(value):
        raise ValueError(f"the number {text!r} is too large")
    if kind.base == "integer" and not value.is_integer():
        raise ValueError(f"expected a whole number, found {text!r}")
    return value


def _unit(text: str, kind: Type) -> Unit:
    try:
        unit = parse_unit(text)
    except UnknownUnit as error:
        meant = corrected(text) or error.near
        near = f"; did you mean {meant!r}?" if meant else ""
        raise ValueError(f"{error}{near}") from None
    if unit.dimension != kind.dimension:
        found = describe(Type(dimension=unit.dimension))
        raise ValueError(f"expected {describe(Type(dimension=kind.dimension))}, found {found}")
    return unit


def _vector(text: str, kind: Type, quantity: str, si: str) -> Value:
    found = split_items(text)
    if found is None:
        raise ValueError(f"expected {describe(kind)} as '(1, 0)', found {text!r}")
    items, unit = found
    if len(items) != kind.shape[0]:
        raise ValueError(f"expected {kind.shape[0]} items, found {len(items)}")
    tail = f" {unit}" if unit else ""
    item = Type(kind.base, kind.dimension, kind.shape[1:])
    return tuple(parse_value(i.strip() + tail, item, quantity, si) for i in items)


def split_items(text: str) -> tuple[list[str], str] | None:
    """The items of `(a, b) unit`, `{a, b}` or `[a, b]`, and the unit; None for another text."""
    text = text.strip().replace("{", "(").replace("}", ")").replace("[", "(").replace("]", ")")
    found = re.fullmatch(r"\((.*)\)\s*([^\s()]*)", text)
    if found is None:
        return None
    items, depth = [""], 0
    for character in found[1]:
        depth += (character == "(") - (character == ")")
        if depth < 0:
            return None
        if character == "," and depth == 0:
            items.append("")
        else:
            items[-1] += character
    return ([item.strip() for item in items], found[2]) if depth == 0 else None
