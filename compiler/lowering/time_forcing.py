"""What changes by time alone: the kernel looks there for what a step would pass over.

Beside rates it needs sizes: what cancels out, as of a liaison that is stated twice, is rounding of
what it is made of, and so is its rate.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column, dense


def make_pace(system: Assembled, conditions: ca.SX) -> tuple[ca.SX, ca.SX] | None:
    """Sizes of what depends on time at given states, and its rates; None where nothing does."""
    t, reduced = system.reduced.symbols.t, system.reduced
    none = ca.SX.zeros(len(system.elements))
    drives = system.resolve(ca.vertcat(reduced.motion.drives, none))
    reach = system.resolve(ca.vertcat(reduced.motion.reach, none))
    parts = [
        system.matrices.bias,
        system.matrices.gap,
        system.matrices.force,
        *(x for step in system.tree.steps for x in (step.force, step.couple)),
        system.matrices.coefficients,
        ca.SX.zeros(0) if system.late else system.rates,
        conditions,
        *(b.residual for b in system.blocks if not b.late),
    ]
    known = ca.vertcat(system.z, system.lam, system.y[system.early :, :])
    values = column(ca.vec(dense(part)) for part in parts)
    found = sorted(_rows_with(values, t) - _rows_with(values, known))
    if not found:
        return None
    values, made_of = values[found], ca.vertcat(drives, reach)
    beside = column(made_of[k] if k < made_of.numel() else ca.SX(0) for k in found)
    return ca.fabs(values) + beside, ca.jtimes(values, t, ca.SX(1))


def _rows_with(values: ca.SX, symbols: ca.SX) -> set[int]:
    """The items that depend on one of the symbols."""
    if not (values.numel() and symbols.numel()):
        return set()
    return set(ca.jacobian_sparsity(values, symbols).row())
