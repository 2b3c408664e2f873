"""Rates of turning and frequencies: both are in 1/s, but 1 Hz is one turn a second, 2 pi rad/s.

A number in Hz where an angular velocity is meant, or in rpm where a frequency is, is the same rate
in other words: it is converted, alone, in sums, or times a number. What is no number with its unit,
but surely the other kind of rate (`w = f`), is a fault: the factor 2 pi is the author's to write.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from frot.dsl import checked
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
_ANGLE_UNITS = ("rad", "mrad", "deg", "°", "rev", "tr", "tour")
_HELP = {CYCLES: "a frequency is 'w/(2*pi)'", TURNING: "an angular velocity is '2*pi*f'"}
# Functions whose value is of the kind of their last operand, as that of any other they take.
_KEEPING = ("abs", "max", "min", "mod", "norm", "hypot", "noEvent", "smooth")
_DEEP = 8  # levels of operands that are examined
# Numbers with pi between the two rates, as 6.28, 0.159 or 9.55.
_FACTORS = tuple(
    x for part in (0.5, 1, 2, 4, 1 / 30) for x in (part * math.pi, 1 / (part * math.pi))
)


def rate_of(node: checked.Expression, depth: int = _DEEP) -> str:
    """The kind of rate that an expression surely is.

    A product with a number keeps it, unless that number may hold the factor 2 pi.
    """
    if node.type.dimension != RATE or depth == 0:
        return ""
    match node:
        case checked.Literal(unit=unit):
            return rate_of_unit(unit, RATE)
        case checked.Reference(target=target):
            return rate_of_kind(target.quantity, target.unit, RATE)
        case checked.Quantity(name=name):
            return _QUANTITIES.get(name, "")
        case checked.Derivative(operand=operand):
            return TURNING if _is_angle(operand) else ""
    inner = _alike(node)
    if not inner and isinstance(node, checked.Binary) and node.op == "/" and _is_angle(node.left):
        return TURNING
    return next((found for each in inner if (found := rate_of(each, depth - 1))), "")


def _alike(node: checked.Expression) -> tuple[checked.Expression, ...]:
    """The operands that are of one kind of rate with the expression."""
    match node:
        case checked.Unary(operand=inner) | checked.Element(operand=inner):
            return (inner,)
        case checked.Binary(op="+" | "-", left=left, right=right):
            return left, right
        case checked.Binary(op="*", left=left, right=right):
            # The unit of a tuple is a factor in the place of its item.
            if left.span is right.span or _is_plain(left):
                return (right,)
            return (left,) if _is_plain(right) else ()
        case checked.Binary(op="/", left=left, right=right) if _is_plain(right):
            return (left,)
        case checked.If(yes=yes, no=no):
            return yes, no
        case checked.Vector(items=items):
            return items
        case checked.Call(function=function, arguments=arguments) if function in _KEEPING:
            return tuple(a for a in arguments if a.type.dimension == RATE)
    return ()


def _is_angle(node: checked.Expression) -> bool:
    match node:
        case checked.Literal(unit=unit):
            return unit in _ANGLE_UNITS
        case checked.Reference(target=target):
            return target.quantity in _ANGLE_NAMES
        case checked.Quantity(name=name):
            return name in _ANGLE_NAMES
    return False


def _is_plain(node: checked.Expression, depth: int = _DEEP) -> bool:
    """Whether it is a number without unit that does not hold pi: no factor between the rates."""
    if depth == 0 or not (node.type.is_scalar and node.type.dimension.is_one):
        return False
    match node:
        case checked.Literal(value=value, unit=""):
            return not _holds_pi(float(value))
        case checked.Reference(target=checked.Parameter(value=value, quantity=quantity)):
            return quantity not in _ANGLE_NAMES and _is_plain(value, depth - 1)
        case checked.Unary(operand=inner):
            return _is_plain(inner, depth - 1)
        case checked.Binary(left=left, right=right):
            return _is_plain(left, depth - 1) and _is_plain(right, depth - 1)
    return node.type.base == "integer"


def _holds_pi(value: float) -> bool:
    """Whether a number is, to three digits, one by which people go from one rate to the other."""
    return any(abs(abs(value) - factor) < 6e-4 * factor for factor in _FACTORS)


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


def all_alike(items: Sequence[checked.Expression], scope: Scope) -> list[checked.Expression] | None:
    """Operands, branches or items as one kind of rate; None after a message."""
    kinds = [rate_of(item) for item in items]
    if len({kind for kind in kinds if kind}) < 2:
        return list(items)
    # What is no number with its unit decides.
    fixed = (k for k, item in zip(kinds, items, strict=True) if k and _converted(item, 1) is None)
    wanted = next(fixed, "") or next(kind for kind in kinds if kind)
    made = [as_rate(item, wanted, scope) for item in items]
    found = [item for item in made if item is not None]
    return found if len(found) == len(made) else None


def _converted(node: checked.Expression, factor: float) -> checked.Expression | None:
    """Numbers with their units in the other rate; None for any other."""
    if isinstance(node, checked.Literal):
        unit = "Hz" if factor < 1 else "rad/s"
        return replace(node, value=float(node.value) * factor, unit=unit)
    alike = _alike(node)
    made = {id(item): _converted(item, factor) for item in alike}
    if not alike or None in made.values():
        return None

    def turned(item: checked.Expression) -> checked.Expression:
        return made.get(id(item)) or item

    match node:
        case checked.Unary(operand=inner) | checked.Element(operand=inner):
            return replace(node, operand=turned(inner))
        case checked.Binary(left=left, right=right):
            return replace(node, left=turned(left), right=turned(right))
        case checked.If(yes=yes, no=no):
            return replace(node, yes=turned(yes), no=turned(no))
        case checked.Vector(items=items):
            return replace(node, items=tuple(turned(item) for item in items))
        case checked.Call(arguments=arguments):
            return replace(node, arguments=tuple(turned(item) for item in arguments))
    return None
