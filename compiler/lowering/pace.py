"""What changes by time alone: the kernel looks there for what a step would pass over."""

from __future__ import annotations

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.symbols import column


def make_pace(system: Assembled, conditions: ca.SX) -> tuple[ca.SX, ca.SX] | None:
    """Values that depend on time at given states, and their rates; None where nothing does."""
    t = system.reduced.symbols.t
    parts = [
        system.force,
        *(x for step in system.tree.steps for x in (step.force, step.couple)),
        system.bias,
        system.coefficients,
        system.gap,
        ca.SX.zeros(0) if system.late else system.rates,
        conditions,
        *(b.residual for b in system.blocks if not b.late),
    ]
    known = ca.vertcat(system.z, system.lam, system.y[system.early :])
    values = column(ca.vec(ca.densify(part)) for part in parts)
    found = sorted(_rows_with(values, t) - _rows_with(values, known))
    if not found:
        return None
    values = values[found]
    return values, ca.jtimes(values, t, ca.SX(1))


def _rows_with(values: ca.SX, symbols: ca.SX) -> set[int]:
    """The items that depend on one of the symbols."""
    if not (values.numel() and symbols.numel()):
        return set()
    return set(ca.jacobian_sparsity(values, symbols).row())
