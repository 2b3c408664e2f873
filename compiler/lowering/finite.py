"""Equations of the text that may give no finite number, and where each does so by itself.

The residual of an equation is evaluated with the values of its variables, where those that have no
finite value, since another equation gives none, are replaced by one: so the first of the equations
whose residual is not finite then is the one that fails.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.origins import Origin
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.symbols import column

_RISKY = {
    getattr(ca, f"OP_{name}")
    for name in (
        *("DIV", "INV", "SQRT", "LOG", "POW", "CONSTPOW", "EXP", "TAN", "SINH", "COSH"),
        *("ASIN", "ACOS", "ACOSH", "ATANH", "LOG1P", "EXPM1"),
    )
    if hasattr(ca, f"OP_{name}")
}
_LARGEST = 1e300


def watch_numbers(system: Assembled) -> tuple[ca.SX, list[Origin]]:
    """The residuals to look at when a number is missed, and the equations they belong to."""
    equations = system.reduced.equations
    values: list[ca.SX] = []
    origins: list[Origin] = []
    for value, origin in zip(equations.values, equations.origins, strict=True):
        inside = ca.symvar(value)
        if not inside or not _is_risky(value, inside):
            continue
        known = system.resolve(system.reduced.variables.settled(column(inside)))
        guarded = ca.if_else(ca.fabs(known) < _LARGEST, known, 1)
        values.append(ca.substitute(value, column(inside), guarded))
        origins.append(origin)
    return column(values), origins


def _is_risky(value: ca.SX, inside: list[ca.SX]) -> bool:
    function = ca.Function("f", inside, [value])
    return any(function.instruction_id(k) in _RISKY for k in range(function.n_instructions()))
