"""Bounds of what is declared: those of what moves are assertions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from frot.dsl import checked
from frot.dsl.catalogue import Argument
from frot.dsl.catalogue.types import LENGTH
from frot.dsl.checked.arrays import component_names, scalars
from frot.dsl.checked.evaluation import constant
from frot.dsl.expressions.known import known
from frot.dsl.names.flanges import parameter_type
from frot.dsl.names.scope import Scope
from frot.dsl.names.types import Kind
from frot.dsl.quantities.dimensions import BOOLEAN, REAL

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
        zero = checked.Literal(0.0, value.type, value.span)
        inside = checked.Binary(">", value, zero, BOOLEAN, value.span)
        _assert(inside, f"{kind.name} of {what} is not positive any more", scope)


def keep_on_curve(made: checked.Liaison, scope: Scope) -> None:
    """Assert that a point stays between the ends of a curve that has ends, while it is on it."""
    place = made.b
    if not made.kind.along_curve:
        return
    span, name, closed = made.span, "", ""
    ends: tuple[checked.Expression, ...] = ()
    if isinstance(place, checked.BodyGeometry) and place.name == "axis":
        length = place.body.arguments["length"]
        half = checked.Binary("/", length, checked.Literal(2.0, REAL, span), LENGTH, span)
        ends, name = (checked.Unary("-", half, LENGTH, span), half), f"{place.body.name}.axis"
    if isinstance(place, checked.CurvePlace) and place.curve.kind == "parametric":
        given, kind = place.curve.arguments, parameter_type(place.curve)
        if known(given["periodic"], scope) is not True:
            at = known(given["u"], scope)
            back = isinstance(at, tuple) and float(at[0]) > float(at[1])
            both = (1, 0) if back else (0, 1)
            ends = tuple(checked.Element(given["u"], k, kind, span) for k in both)
        name, closed = place.curve.name, " (unless it says `periodic = true`)"
    for order, end in zip((">=", "<="), ends, strict=False):
        u = checked.Quantity(made, "u", end.type, span)
        inside = checked.Binary(order, u, end, BOOLEAN, span)
        option = made.options["unilateral"]
        if not (isinstance(option, checked.Literal) and option.value is False):
            gap = checked.Quantity(made, "gap", LENGTH, span)
            apart = checked.Binary(">", gap, checked.Literal(0.0, LENGTH, span), BOOLEAN, span)
            inside = checked.Binary("or", inside, apart, BOOLEAN, span)
        _assert(inside, f"liaison '{made.name}' leaves '{name}', which ends there{closed}", scope)


def _written(value: checked.Expression) -> str:
    return " ".join(value.span.text.split())


def _assert(inside: checked.Binary, text: str, scope: Scope) -> None:
    found = checked.Assertion(inside, text, "error", inside.span, scope.instance.name)
    scope.build.assertions.append(found)
