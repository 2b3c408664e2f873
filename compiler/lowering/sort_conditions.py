"""When conditions change: by the motion, at instants known before, or at events only.

Of those that change by the motion some read what the motion is solved for: accelerations,
reactions, and what follows from these.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column

MOVED, SENSED, TIMED, AT_EVENTS = range(4)


@dataclass(frozen=True, slots=True, eq=False)
class SortedConditions:
    """The values of the conditions in their new order.

    `timers`: of those at instants known before, which are linear in time, the slopes and the
    values at time zero.
    """

    values: ca.SX
    timers: list[ca.SX]


def sort_conditions(
    system: Assembled, explicit: Callable[[ca.SX], ca.SX]
) -> tuple[Assembled, SortedConditions]:
    """The system with its conditions sorted into those kinds."""
    reduced = system.reduced
    t, conditions, events = reduced.symbols.t, reduced.conditions, reduced.events
    values = explicit(system.resolve(column(conditions.values)))
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
    moved, sensed, timed = (kinds.count(kind) for kind in (MOVED, SENSED, TIMED))
    reduced = replace(
        reduced,
        conditions=conditions.sorted(order, moved + sensed, sensed, timed),
        events=replace(events, conditions=tuple(place[k] for k in events.conditions)),
    )
    late = [k for k in order if kinds[k] == TIMED]
    at_zero = ca.substitute(column(values[k] for k in late), t, ca.SX(0)) if late else ca.SX(0, 1)
    timers = [column(slopes[k] for k in late), at_zero]
    found = SortedConditions(column(values[k] for k in order), timers)
    return replace(system, reduced=reduced), found
