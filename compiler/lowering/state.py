"""The arguments of the kernel's functions, and what is known before accelerations are."""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column, dense


def state_arguments(system: Assembled) -> list[ca.SX]:
    """t, q, v, u, p, d, y."""
    s = system.reduced.symbols
    no_sides = ca.SX.sym("no_side", len(system.elements))
    flags = column(system.reduced.conditions.flags)
    d = ca.vertcat(flags, s.sides, no_sides, system.discrete)
    return [s.t, system.q, system.v, s.u, s.p, d, system.y]


def clean(outputs: list[ca.SX]) -> list[ca.SX]:
    """Dense outputs with common subexpressions shared."""
    return [dense(x) for x in ca.cse([x if type(x) is ca.SX else ca.SX(x) for x in outputs])]


def unsolved(conditions: ca.SX, system: Assembled) -> ca.SX:
    """The values of conditions; -1 for those that follow from accelerations or reactions."""
    later = ca.vertcat(system.z, system.lam, system.y[system.early :, :])
    if not (conditions.numel() and later.numel()):
        return conditions
    return column(
        ca.SX(-1) if ca.depends_on(value, later) else value for value in ca.vertsplit(conditions)
    )
