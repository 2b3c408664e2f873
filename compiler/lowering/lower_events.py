"""What an event of the text does to states and discrete values, for the kernel's `update`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.equations.events import FAULT, Outcome
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.symbols import column
from frot.dsl import Log
from frot.dsl.messages.source import Span


def lower_update(system: Assembled, log: Log) -> list[ca.SX] | None:
    """Q and v after the event, the discrete values, the outcomes asked for; None if none can be."""
    events = system.reduced.events
    if not events.fired and not system.reduced.text.held:
        return None
    states = [x for part in (system.q, system.v) if part.numel() for x in ca.vertsplit(part)]
    place = {x.element_hash(): k for k, x in enumerate(states)}
    after = list(states)
    actives: dict[int, list[tuple[ca.SX, Span]]] = {}
    settled = system.reduced.variables.settled
    for active, jump in events.jumps:
        target = system.resolve(settled(jump.target))
        inside = [x for x in ca.symvar(target) if x.element_hash() in place]
        slope = ca.jacobian(target, inside[0]) if len(inside) == 1 else None
        if slope is None or ca.depends_on(slope, inside[0]):
            log.report(
                "E0608",
                "'reinit' of what is not a state, nor a multiple of one",
                jump.span,
                help="name a variable that stands under 'der', a coordinate or a speed",
            )
            continue
        rest = ca.substitute(target, inside[0], ca.SX(0))
        value = (system.resolve(settled(jump.value)) - rest) / slope
        k = place[inside[0].element_hash()]
        after[k] = ca.if_else(active, value, after[k])
        actives.setdefault(k, []).append((active, jump.span))
    for k, jumps in actives.items():
        if len(jumps) > 1:
            told = f"two `reinit`s give '{system.names[k]}' a value at one instant"
            events.outcomes.append(Outcome(FAULT, told, jumps[-1][1]))
            events.asked.append(sum((a for a, _ in jumps), ca.SX(0)) > 1)
    nq = system.q.numel()
    return [
        column(after[:nq]),
        column(after[nq:]),
        system.resolve(settled(column(events.values))),
        system.resolve(settled(column(events.asked))),
    ]
