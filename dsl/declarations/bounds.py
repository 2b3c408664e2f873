"""`min` and `max` of what is declared: those of what moves are assertions."""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.checked.arrays import component_names, scalars
from frot.dsl.names.scope import Scope
from frot.dsl.names.types import Kind
from frot.dsl.quantities.dimensions import BOOLEAN

Bounds = tuple[tuple[str, checked.Expression], ...]
_ORDER = {"min": ">=", "max": "<="}


def hold(value: checked.Expression, name: str, bounds: Bounds, kind: Kind, scope: Scope) -> None:
    """Assert that a value of a kind, called `name`, keeps its bounds."""
    spans = {word: given.span for word, given in kind.bounds}
    for word, bound in bounds:
        span = spans[word]
        names = component_names(name, value.type.shape)
        limits = scalars(bound) if bound.type.shape else [bound] * len(names)
        for item, told, limit in zip(scalars(value), names, limits, strict=True):
            inside = checked.Binary(_ORDER[word], item, limit, BOOLEAN, span)
            side = "below its min" if word == "min" else "above its max"
            text = f"'{told}' is {side}, {' '.join(bound.span.text.split())}"
            owner = scope.instance.name
            scope.build.assertions.append(checked.Assertion(inside, text, "error", span, owner))
