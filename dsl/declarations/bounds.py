"""Bounds of what is declared: those of what moves are assertions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from frot.dsl import checked
from frot.dsl.catalogue import Argument
from frot.dsl.checked.arrays import component_names, scalars
from frot.dsl.checked.evaluation import constant
from frot.dsl.names.declared_types import Kind
from frot.dsl.names.scope import Scope
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
            _assert(inside, f"'{told}' is {side}, {_written(bound)}", scope)


def keep_positive(
    values: Mapping[str, checked.Expression], kinds: Sequence[Argument], what: str, scope: Scope
) -> None:
    """Assert that the sizes of `what` that change stay positive; of the others it is known."""
    for kind in kinds:
        value = values.get(kind.name)
        if kind.sign != "positive" or value is None or constant(value) is None:
            continue
        zero = checked.Literal(0.0, value.type.item, value.span)
        names = component_names(kind.name, value.type.shape)
        for name, item in zip(names, scalars(value), strict=True):
            inside = checked.Binary(">", item, zero, BOOLEAN, value.span)
            _assert(inside, f"{name} of {what} is not positive any more", scope)


def _written(value: checked.Expression) -> str:
    return " ".join(value.span.text.split())


def _assert(inside: checked.Binary, text: str, scope: Scope) -> None:
    found = checked.Assertion(inside, text, "error", inside.span, scope.instance.name)
    scope.build.assertions.append(found)
