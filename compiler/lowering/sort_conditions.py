"""When conditions change: by the motion, at instants known before, or at events only.

Of those that change by the motion some read what the motion is solved for: accelerations,
reactions, and what follows from these.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column

MOVED, SENSED, TIMED, AT_EVENTS = range(4)


def sort_conditions(system: Assembled, values: ca.SX) -> tuple[ca.SX, list[ca.SX]]:
    """Sort the conditions of `system`, which have these values, into those kinds.

    Gives the values in the new order; and of those at instants known before, which are linear in
    time, the slopes and the values at time zero.
    """
    reduced = system.reduced
    t, conditions = reduced.symbols.t, reduced.conditions
    solved = ca.vertcat(system.z, system.lam, system.y[system.early :, :])
    moving = ca.vertcat(system.q, system.v, system.y)
    kinds: list[int] = []
    slopes: dict[int, ca.SX] = {}
    for k, value in enumerate(ca.vertsplit(values) if values.numel() else ()):
        kind = AT_EVENTS
        if solved.numel() and ca.depends_on(value, solved):
            kind = SENSED
        elif moving.numel() and ca.depends_on(value, moving):
            kind = MOVED
        elif ca.depends_on(value, t):
            slopes[k] = ca.jacobian(value, t)
            kind = MOVED if ca.depends_on(slopes[k], t) else TIMED
        kinds.append(kind)
    order = sorted(range(len(kinds)), key=lambda k: kinds[k])
    place = {k: i for i, k in enumerate(order)}
    conditions.reorder(order)
    conditions.sensed, conditions.timed = kinds.count(SENSED), kinds.count(TIMED)
    conditions.located = kinds.count(MOVED) + conditions.sensed
    reduced.events.conditions[:] = [place[k] for k in reduced.events.conditions]
    timed = [k for k in order if kinds[k] == TIMED]
    at_zero = ca.substitute(column(values[k] for k in timed), t, ca.SX(0)) if timed else ca.SX(0, 1)
    return column(values[k] for k in order), [column(slopes[k] for k in timed), at_zero]
