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
        system.bias,
        system.coefficients,
        system.gap,
        ca.SX.zeros(0) if system.late else system.rates,
        conditions,
        *(b.residual for b in system.blocks if not b.late),
    ]
    known = ca.vertcat(system.z, system.lam, system.y[system.early :])
    found = [
        value
        for part in parts
        for value in (ca.vertsplit(part) if part.numel() else ())
        if ca.depends_on(value, t) and not (known.numel() and ca.depends_on(value, known))
    ]
    if not found:
        return None
    values = column(found)
    return values, ca.jtimes(values, t, ca.SX(1))
