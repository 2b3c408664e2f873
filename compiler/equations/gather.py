"""The equations of a text to scalar residuals, branch by branch where they change with events."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import casadi as ca
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.origins import Origin
from frot.compiler.translate.text_symbols import scalars
from frot.dsl import Log
from frot.dsl.checked import Equation, IfEquations
from frot.dsl.expressions.expression import is_whole


def gather(equations: Sequence[Equation | IfEquations], lowering: Lowering, log: Log) -> Residuals:
    """One residual for every scalar equation."""
    found = [sides for equation in equations for sides in _sides(equation, lowering, log)]
    return Residuals(
        tuple(left - right for left, right, _ in found), tuple(origin for _, _, origin in found)
    )


def _sides(
    equation: Equation | IfEquations, lowering: Lowering, log: Log
) -> list[tuple[ca.SX, ca.SX, Origin]]:
    """Left and right of each scalar equation."""
    if isinstance(equation, IfEquations):
        return _branches(equation, lowering, log)
    lowering.owner = equation.owner
    left, right = lowering.lower(equation.left), lowering.lower(equation.right)
    text = equation.connection or " ".join(equation.span.text.split()).rstrip("; ")
    discrete = all(x.type.base != "real" or is_whole(x) for x in (equation.left, equation.right))
    origin = Origin(equation.span, text, equation.owner, equation.drives, discrete)
    return [(a, b, origin) for a, b in zip(scalars(left), scalars(right), strict=True)]


def _branches(
    equations: IfEquations, lowering: Lowering, log: Log
) -> list[tuple[ca.SX, ca.SX, Origin]]:
    """What stands on the left of every branch stays there: its factor does not switch."""
    conditions: list[ca.SX | None] = []
    columns: list[list[tuple[ca.SX, ca.SX, Origin]]] = []
    for condition, inner in equations.branches:
        lowering.owner = equations.owner
        conditions.append(None if condition is None else lowering.lower(condition))
        columns.append([sides for e in inner for sides in _sides(e, lowering, log)])
    found = columns[-1]
    for holds, column in reversed(list(zip(conditions, columns, strict=True))[:-1]):
        assert holds is not None
        found = [_either(holds, yes, no) for yes, no in zip(column, found, strict=True)]
    return found


def _either(
    holds: ca.SX, yes: tuple[ca.SX, ca.SX, Origin], no: tuple[ca.SX, ca.SX, Origin]
) -> tuple[ca.SX, ca.SX, Origin]:
    origin = replace(yes[2], discrete=yes[2].discrete and no[2].discrete)
    if ca.is_equal(yes[0], no[0]):
        return yes[0], ca.if_else(holds, yes[1], no[1]), origin
    return ca.if_else(holds, yes[0] - yes[1], no[0] - no[1]), ca.SX(0), origin
