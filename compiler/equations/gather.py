"""The equations of a text to scalar residuals, branch by branch where they change with events."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
from frot.compiler.equations.eliminate import Residuals
from frot.compiler.equations.origins import Origin
from frot.compiler.equations.text_symbols import scalars
from frot.compiler.lowering.expressions import Lowering
from frot.dsl import Log
from frot.dsl.checked import Equation, IfEquations


def gather(equations: Sequence[Equation | IfEquations], lowering: Lowering, log: Log) -> Residuals:
    """One residual for every scalar equation."""
    found = Residuals([], [])
    for equation in equations:
        for value, origin in _residuals(equation, lowering, log):
            found.values.append(value)
            found.origins.append(origin)
    return found


def _residuals(
    equation: Equation | IfEquations, lowering: Lowering, log: Log
) -> list[tuple[ca.SX, Origin]]:
    if isinstance(equation, IfEquations):
        return _branches(equation, lowering, log)
    lowering.owner = equation.owner
    difference = lowering.lower(equation.left) - lowering.lower(equation.right)
    text = equation.connection or " ".join(equation.span.text.split()).rstrip("; ")
    origin = Origin(equation.span, text, equation.owner, equation.drives)
    return [(value, origin) for value in scalars(difference)]


def _branches(equations: IfEquations, lowering: Lowering, log: Log) -> list[tuple[ca.SX, Origin]]:
    conditions: list[ca.SX | None] = []
    columns: list[list[tuple[ca.SX, Origin]]] = []
    for condition, inner in equations.branches:
        lowering.owner = equations.owner
        conditions.append(None if condition is None else lowering.lower(condition))
        columns.append([pair for e in inner for pair in _residuals(e, lowering, log)])
    found = columns[-1]
    for holds, column in reversed(list(zip(conditions, columns, strict=True))[:-1]):
        assert holds is not None
        found = [
            (ca.if_else(holds, value, other), origin)
            for (value, origin), (other, _) in zip(column, found, strict=True)
        ]
    return found
