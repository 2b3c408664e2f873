"""Rates of turning and frequencies: both are in 1/s, but 1 Hz is one turn a second, 2 pi rad/s.

A number in Hz where an angular velocity is meant, or in rpm where a frequency is, is the same rate
in other words: it is converted. What is no number with its unit, but surely the other kind of rate
(`w = f`), is a fault: the factor 2 pi is the author's to write.
"""

from __future__ import annotations

from frot.dsl import checked
from frot.dsl.data.classes import replace
from frot.dsl.names.scope import Scope
from frot.dsl.quantities.turns import (
    CYCLES,
    RATE,
    TURNING,
    factor_between,
    rate_of_kind,
    rate_of_unit,
)

_QUANTITIES = {"angular_velocity": TURNING, "speed": TURNING}
_ANGLE_NAMES = ("Angle", "angle")
_HELP = {CYCLES: "a frequency is 'w/(2*pi)'", TURNING: "an angular velocity is '2*pi*f'"}


def rate_of(node: checked.Expression) -> str:
    """The kind of rate that an expression surely is; products may hold the factor 2 pi."""
    for _ in range(20):
        if node.type.dimension != RATE:
            return ""
        match node:
            case checked.Literal(unit=unit):
                return rate_of_unit(unit, RATE)
            case checked.Reference(target=target):
                return rate_of_kind(target.quantity, target.unit, RATE)
            case checked.Quantity(name=name):
                return _QUANTITIES.get(name, "")
            case checked.Derivative(operand=checked.Reference(target=target)):
                return TURNING if target.quantity in _ANGLE_NAMES else ""
            case checked.Derivative(operand=checked.Quantity(name=name)):
                return TURNING if name in _ANGLE_NAMES else ""
            case checked.Unary(operand=inner) | checked.Element(operand=inner):
                node = inner
            case checked.Binary(op="+" | "-", left=left, right=right):
                found = rate_of(left)
                if found:
                    return found
                node = right
            case checked.If(yes=yes, no=no):
                found = rate_of(yes)
                if found:
                    return found
                node = no
            case checked.Vector(items=items) if items:
                node = items[0]
            case _:
                return ""
    return ""


def as_rate(found: checked.Expression, wanted: str, scope: Scope) -> checked.Expression | None:
    """The expression as the kind of rate that is wanted; None after a message."""
    rate = rate_of(found) if wanted else ""
    if not rate or rate == wanted:
        return found
    converted = _converted(found, factor_between(rate, wanted))
    if converted is None:
        scope.log.report(
            "E0301",
            f"expected {wanted}, found {rate}",
            found.span,
            caret=rate,
            notes=("one turn a second is 1 Hz and 2*pi rad/s",),
            help=_HELP[wanted],
        )
    return converted


def rates_alike(
    left: checked.Expression, right: checked.Expression, scope: Scope
) -> tuple[checked.Expression, checked.Expression] | None:
    """Both sides of a sum or comparison as one kind of rate; None after a message."""
    first, second = rate_of(left), rate_of(right)
    if not (first and second) or first == second:
        return left, right
    turned = _converted(left, factor_between(first, second))
    if turned is not None and _converted(right, 1) is None:
        return turned, right
    found = as_rate(right, first, scope)
    return None if found is None else (left, found)


def _converted(node: checked.Expression, factor: float) -> checked.Expression | None:
    """Numbers with their units in the other rate; None for what holds anything else."""
    match node:
        case checked.Literal(value=value):
            unit = "Hz" if factor < 1 else "rad/s"
            return replace(node, value=float(value) * factor, unit=unit)
        case checked.Unary(op="-", operand=operand):
            inner = _converted(operand, factor)
            return None if inner is None else replace(node, operand=inner)
        case checked.Binary(op="+" | "-", left=left, right=right):
            first, second = _converted(left, factor), _converted(right, factor)
            if first is None or second is None:
                return None
            return replace(node, left=first, right=second)
        case checked.Vector(items=items):
            made = [_converted(item, factor) for item in items]
            found = tuple(item for item in made if item is not None)
            return replace(node, items=found) if len(found) == len(items) else None
    return None
