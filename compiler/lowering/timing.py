"""When conditions change: by the motion, at instants known before, or at events only."""

from __future__ import annotations

import casadi as ca
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.symbols import column


def sort_conditions(system: Assembled, values: ca.SX) -> tuple[ca.SX, list[ca.SX]]:
    """Sort the conditions of `system`, which have these values, into those three kinds.

    Gives the values in the new order; and of the second kind, which is linear in time, the slopes
    and the values at time zero.
    """
    reduced = system.reduced
    t, conditions = reduced.symbols.t, reduced.conditions
    moving = ca.vertcat(system.q, system.v, system.y)
    kinds: list[int] = []
    slopes: dict[int, ca.SX] = {}
    for k, value in enumerate(ca.vertsplit(values) if values.numel() else ()):
        kind = 2
        if moving.numel() and ca.depends_on(value, moving):
            kind = 0
        elif ca.depends_on(value, t):
            slopes[k] = ca.jacobian(value, t)
            kind = 0 if ca.depends_on(slopes[k], t) else 1
        kinds.append(kind)
    order = sorted(range(len(kinds)), key=lambda k: kinds[k])
    place = {k: i for i, k in enumerate(order)}
    conditions.reorder(order)
    conditions.located, conditions.timed = kinds.count(0), kinds.count(1)
    reduced.events.conditions[:] = [place[k] for k in reduced.events.conditions]
    timed = [k for k in order if kinds[k] == 1]
    at_zero = ca.substitute(column(values[k] for k in timed), t, ca.SX(0)) if timed else ca.SX(0, 1)
    return column(values[k] for k in order), [column(slopes[k] for k in timed), at_zero]
