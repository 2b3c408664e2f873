"""Warns of angles that are surely meant in degrees: a bare number of more than a turn."""

from __future__ import annotations

import math
from collections.abc import Iterator

from frot.dsl import checked
from frot.dsl.messages.diagnostics import Log


def warn_angles(model: checked.Model, log: Log) -> None:
    """Report bare numbers beyond one turn where an angle is given; a bare number is in radians."""
    for value in _angles(model):
        literal = value.operand if isinstance(value, checked.Unary) else value
        if not isinstance(literal, checked.Literal) or literal.unit:
            continue
        number = float(literal.value)
        if number <= 2 * math.pi or value.span.source is not model.files[0]:
            continue
        log.report(
            "W0105",
            f"this angle is {value.span.text} rad, {number / (2 * math.pi):.3g} turns",
            value.span,
            help=f"write '{value.span.text} deg', or '{value.span.text} rad' if that is meant",
        )


def _angles(model: checked.Model) -> Iterator[checked.Expression]:
    for parameter in model.parameters:
        if parameter.quantity == "Angle":
            yield parameter.value
    for given in model.inputs:
        if given.quantity == "Angle":
            yield given.start
    for variable in model.variables:
        if variable.quantity == "Angle" and variable.start is not None:
            yield variable.start
    for frame in model.frames:
        if frame.angle is not None:
            yield frame.angle
    for equation in model.initial:
        if _is_angle(equation.left):
            yield equation.right


def _is_angle(node: checked.Expression) -> bool:
    match node:
        case checked.Quantity(name="angle"):
            return True
        case checked.Reference(target=target):
            return target.quantity == "Angle"
    return False
