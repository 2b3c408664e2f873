"""Values that parameters must give: positive masses, finite numbers and the like."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.eliminate import Pivot
from frot.compiler.lowering.walk import is_fixed
from frot.compiler.mechanics.mechanism import Mechanism
from frot.dsl.catalogue import Argument
from frot.dsl.checked import Binary, Call, Element, Expression, Liaison, Parameter, Place, Reference
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import REAL, Type

POSITIVE, NOT_NEGATIVE, FINITE, NOT_BELOW_PREVIOUS, NOT_ZERO = range(5)


@dataclass(frozen=True, slots=True, eq=False)
class Check:
    """`value` must satisfy `rule` (frot_rule); `subject` names it in a sentence."""

    rule: int
    subject: str
    value: Expression | ca.SX
    span: Span | None


def parameter_checks(
    mechanism: Mechanism, parameters: Sequence[Parameter], pivots: Sequence[Pivot] = ()
) -> tuple[Check, ...]:
    """Every check that depends on parameters alone, in the order of the text.

    `parameters` are scalars, `pivots` divisors that came from solving equations for an unknown.
    """
    first = {p.value.element_hash(): p for p in reversed(pivots)}
    divisors = (
        Check(
            NOT_ZERO,
            f"factor of '{p.unknown}' in `{p.origin.text}`"
            + (f" of {p.origin.owner}" if p.origin.owner else ""),
            p.value,
            p.origin.span,
        )
        for p in pivots
        if first[p.value.element_hash()] is p
    )
    return (*_checks(mechanism, parameters), *divisors)


def _checks(mechanism: Mechanism, parameters: Sequence[Parameter]) -> Iterator[Check]:
    model = mechanism.model
    for parameter in parameters:
        value = Reference(parameter, parameter.type, parameter.span)
        yield Check(FINITE, f"parameter '{parameter.name}'", value, parameter.span)
    for when in model.whens:
        for condition in (c for conditions, _ in when.branches for c in conditions):
            if isinstance(condition, Call) and condition.function == "sample":
                yield Check(
                    POSITIVE, "interval of 'sample'", condition.arguments[1], condition.span
                )
    for body in model.bodies:
        if body.shape is not None:
            owner = f"body '{body.name}'"
            yield from _arguments(owner, body.shape.arguments, body.arguments)
    for curve in model.curves:
        yield from _sizes(f"curve '{curve.name}'", curve.arguments)
    for surface in model.surfaces:
        yield from _sizes(f"surface '{surface.name}'", surface.arguments)
    for frame in model.frames:
        if not isinstance(frame.axis, str) and frame.axis.type.shape:
            yield _length(f"the axis of frame '{frame.name}'", frame.axis)
    for force in model.forces:
        yield from _arguments(f"force '{force.name}'", force.kind.arguments, force.arguments)
    for liaison in model.liaisons:
        for argument in liaison.kind.arguments:
            axis = liaison.options.get(argument.name) if argument.kind == "axis" else None
            if axis is not None and axis.type.shape:
                yield _length(f"the {argument.name} of liaison '{liaison.name}'", axis)
        for law in liaison.laws:
            owner = f"liaison '{liaison.name}'"
            yield from _arguments(owner, law.kind.arguments, law.arguments)
            mu, mu_s = law.arguments.get("mu"), law.arguments.get("mu_s")
            if mu is not None and mu_s is not None and is_fixed(mu) and is_fixed(mu_s):
                yield Check(FINITE, f"mu of liaison '{liaison.name}'", mu, mu.span)
                yield Check(
                    NOT_BELOW_PREVIOUS, f"mu_s of liaison '{liaison.name}'", mu_s, mu_s.span
                )


def _length(subject: str, direction: Expression) -> Check:
    length = Call("norm", (direction,), REAL, direction.span)
    return Check(POSITIVE, f"length of {subject}", length, direction.span)


def _sizes(owner: str, given: Mapping[str, Expression]) -> Iterator[Check]:
    """No direction is zero, and sizes are positive."""
    for name, value in given.items():
        if name in ("direction", "normal", "axis") and value.type.shape:
            yield _length(f"the {name} of {owner}", value)
        elif name in ("radius", "a", "b"):
            yield Check(POSITIVE, f"{name} of {owner}", value, value.span)


def _arguments(
    owner: str, kinds: tuple[Argument, ...], values: Mapping[str, Expression | Place | Liaison]
) -> Iterator[Check]:
    rules = {"positive": POSITIVE, "nonnegative": NOT_NEGATIVE}
    for kind in kinds:
        value = values.get(kind.name)
        if value is None or isinstance(value, (Place, Liaison)) or kind.sign not in rules:
            continue
        if kind.kind == "inertia" and value.type.shape:
            yield from _moments(owner, value)
        elif is_fixed(value):
            yield Check(rules[kind.sign], f"{kind.name} of {owner}", value, value.span)


def _moments(owner: str, inertia: Expression) -> Iterator[Check]:
    """No moment is negative, nor larger than the other two together (of a tuple of three)."""
    item = inertia.type.item
    if inertia.type.shape == (3, 3):
        row = Type(item.base, item.dimension, (3,))
        for k in range(3):
            moment = Element(Element(inertia, k, row, inertia.span), k, item, inertia.span)
            yield Check(
                NOT_NEGATIVE, f"moment {k + 1} of the inertia of {owner}", moment, inertia.span
            )
        return
    moments = [Element(inertia, k, item, inertia.span) for k in range(3)]
    for k, moment in enumerate(moments):
        subject = f"moment {k + 1} of the inertia of {owner}"
        yield Check(NOT_NEGATIVE, subject, moment, inertia.span)
        others = Binary("+", moments[k - 1], moments[k - 2], item, inertia.span)
        rest = Binary("-", others, moment, item, inertia.span)
        yield Check(NOT_NEGATIVE, f"sum of the other moments less {subject}", rest, inertia.span)
