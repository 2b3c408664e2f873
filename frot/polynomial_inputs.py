"""Inputs that are polynomials of time in a checked model.

The reference to an input F stands for F@0 + s (F@1 + s (F@2 + s F@3)) with s = time - F@from, so
that rates of what it drives are those of the polynomial. The five are inputs of the program, which
the run changes at the knots of a table; the program does not depend on the numbers of the table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from frot.dsl import checked
from frot.dsl.catalogue import TYPES
from frot.dsl.quantities.dimensions import REAL, Type, dimension
from frot.runtime.scheduled import COEFFICIENTS, coefficient_name, knot_name


def with_time(model: checked.Model, names: frozenset[str]) -> checked.Model:
    """The model with inputs of these names replaced by polynomials of time."""
    inputs: list[checked.Input] = []
    given: dict[checked.Input, checked.Expression] = {}
    for one in model.inputs:
        if one.name not in names:
            inputs.append(one)
            continue
        parts, expression = _polynomial(one)
        inputs += parts
        given[one] = expression
    changed: checked.Model = _Rewriting(given).of(replace(model, inputs=()))
    return replace(changed, inputs=tuple(inputs))


def _polynomial(of: checked.Input) -> tuple[list[checked.Input], checked.Expression]:
    """The inputs that stand for one, and what a reference to it stands for."""
    span, second = of.span, dimension(s=1)
    time = TYPES["Time"]

    def made(name: str, kind: Type, start: checked.Expression) -> checked.Input:
        return checked.Input(name, kind, start, span)

    def product(op: str, a: checked.Expression, b: checked.Expression) -> checked.Expression:
        kind = a.type if op in "+-" else Type(dimension=a.type.dimension * b.type.dimension)
        return checked.Binary(op, a, b, kind, span)

    kinds = [of.type]
    for _ in range(1, COEFFICIENTS):
        kinds.append(Type(dimension=kinds[-1].dimension / second))
    nothing = checked.Literal(0.0, REAL, span)
    parts = [
        made(coefficient_name(of.name, k), kind, of.start if k == 0 else nothing)
        for k, kind in enumerate(kinds)
    ]
    knot = made(knot_name(of.name), time, nothing)
    references = [checked.Reference(x, x.type, span) for x in (*parts, knot)]
    since = product("-", checked.Time(time, span), references[-1])
    value: checked.Expression = references[COEFFICIENTS - 1]
    for k in reversed(range(COEFFICIENTS - 1)):
        value = product("+", references[k], product("*", since, value))
    return [*parts, knot], value


class _Rewriting:
    """Puts expressions in the place of references, everywhere in a checked model."""

    def __init__(self, given: Mapping[checked.Input, checked.Expression]) -> None:
        self._given = given
        self._done: dict[int, tuple[Any, Any]] = {}

    def of(self, value: Any) -> Any:
        """The value with all that it holds; itself where nothing in it changes."""
        if isinstance(value, checked.Reference) and value.target in self._given:
            return self._given[value.target]  # type: ignore[index]
        if value is None or isinstance(value, (str, int, float)):
            return value
        known = self._done.get(id(value))
        if known is None:
            known = self._done[id(value)] = value, self._made(value)
        return known[1]

    def _made(self, value: Any) -> Any:
        if isinstance(value, tuple):
            items = tuple(self.of(x) for x in value)
            return items if any(a is not b for a, b in zip(items, value, strict=True)) else value
        if isinstance(value, Mapping):
            entries = {key: self.of(x) for key, x in value.items()}
            return entries if any(entries[key] is not value[key] for key in value) else value
        if not type(value).__module__.startswith("frot.dsl.checked"):
            return value
        parts = {name: getattr(value, name) for name in type(value).__dataclass_fields__}
        changed = {name: self.of(x) for name, x in parts.items()}
        own = {name: x for name, x in changed.items() if x is not parts[name]}
        return replace(value, **own) if own else value
