"""What an event of the text does to states and discrete values, for the kernel's `update`.

And in which order the `when`s act at one instant. Modelica Language Specification 3.6, sect. 8.6:
at an event conditions and what `when`s set are found together, each after what it needs, while
values before (`pre`) stay. So a condition that reads what a `when` sets is decided after that
`when`. What needs each other in a circle acts at once, and is evaluated anew in the next round.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.events import FAULT, Outcome
from frot.compiler.symbolic.columns import column
from frot.dsl import Log
from frot.dsl.messages.source import Span


def lower_update(system: Assembled, log: Log) -> tuple[Assembled, list[ca.SX] | None]:
    """The values of the kernel's `update`, None where no event changes anything.

    These are q and v after the event, the discrete values, the outcomes required. The system has
    an outcome more for each state that two `reinit`s may set.
    """
    events = system.reduced.events
    if not events.fired and not system.reduced.text.held:
        return system, None
    outcomes, required = list(events.outcomes), list(events.required)
    states = [x for part in (system.q, system.v) if part.numel() for x in ca.vertsplit(part)]
    place = {x.element_hash(): k for k, x in enumerate(states)}
    after = list(states)
    actives: dict[int, list[tuple[ca.SX, Span]]] = {}
    without_auxiliary = system.reduced.variables.without_auxiliary
    for active, jump in events.jumps:
        target = system.resolve(without_auxiliary(jump.target))
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
        value = (system.at_rest(system.resolve(without_auxiliary(jump.value))) - rest) / slope
        k = place[inside[0].element_hash()]
        after[k] = ca.if_else(active, value, after[k])
        actives.setdefault(k, []).append((active, jump.span))
    for k, jumps in actives.items():
        if len(jumps) > 1:
            told = f"two `reinit`s give '{system.names[k]}' a value at one instant"
            outcomes.append(Outcome(FAULT, told, jumps[-1][1]))
            required.append(sum((a for a, _ in jumps), ca.SX(0)) > 1)
    nq = system.q.numel()
    update = [
        column(after[:nq]),
        column(after[nq:]),
        system.at_rest(system.resolve(without_auxiliary(column(events.values)))),
        system.at_rest(system.resolve(without_auxiliary(column(required)))),
    ]
    events = replace(events, outcomes=tuple(outcomes), required=tuple(required))
    return replace(system, reduced=replace(system.reduced, events=events)), update


@dataclass(frozen=True, slots=True)
class Ranks:
    """`whens` of the symbols that fire, `held` of the values that are kept for the next round."""

    whens: tuple[int, ...] = ()
    held: tuple[int, ...] = ()

    @property
    def count(self) -> int:
        """How many there are."""
        return 1 + max((*self.whens, *self.held), default=0)


def rank_whens(system: Assembled, conditions: ca.SX, update: list[ca.SX] | None) -> Ranks:
    """Find the ranks; `conditions` are the values of all, `update` what `lower_update` gives."""
    events, held = system.reduced.events, len(system.reduced.text.held)
    if update is None:
        return Ranks()
    flags, discrete = system.reduced.conditions.flags, ca.vertsplit(system.discrete)
    set_by_whens, values = discrete[: len(discrete) - held], ca.vertsplit(update[2])
    tests = ca.vertsplit(conditions) if flags else []
    firing = [flags[j] for j in events.conditions]
    nodes = [
        *((column([f]), test) for f, test in zip(flags, tests, strict=True)),
        *((x, v) for x, v in zip(set_by_whens, values[: len(set_by_whens)], strict=True)),
        *((None, v) for v in values[len(set_by_whens) :]),
        *_solved(system),
    ]
    needs = _needs(nodes, dict(zip(map(_hash, events.fired), map(_hash, firing), strict=True)))
    first, last = len(flags), len(flags) + len(set_by_whens)
    levels = _levels(needs, range(first, last))
    return Ranks(tuple(levels[j] for j in events.conditions), tuple(levels[last : last + held]))


def _hash(symbol: ca.SX) -> int:
    return int(symbol.element_hash())


def _solved(system: Assembled) -> list[tuple[ca.SX, ca.SX]]:
    """What blocks and the core solve for, each with all that decides it."""
    force = (x for step in system.tree.steps for x in (step.force, step.couple))
    core = [
        system.matrices.matrix,
        system.matrices.force,
        system.matrices.spread,
        system.matrices.rows,
        system.matrices.bias,
        *force,
    ]
    core += [system.matrices.coefficients]
    blocks = [(system.y[b.first : b.first + b.residual.numel()], b.residual) for b in system.blocks]
    return [*blocks, (ca.vertcat(system.z, system.lam), column(ca.vec(x) for x in core))]


def _needs(nodes: list[tuple[ca.SX | None, ca.SX]], same: dict[int, int]) -> list[list[int]]:
    """Which nodes each node needs; `same`: symbols that stand for others."""
    owner = {
        _hash(x): k
        for k, (symbols, _) in enumerate(nodes)
        if symbols is not None and symbols.numel()
        for x in ca.vertsplit(symbols)
    }
    found = []
    for _, value in nodes:
        read = (_hash(x) for x in ca.symvar(value))
        places = {owner.get(same.get(x, x), -1) for x in read}
        found.append(sorted(places - {-1}))
    return found


def _levels(needs: list[list[int]], steps: range) -> list[int]:
    """How many of `steps` lie one after the other before each node, circles counted once."""
    if not any(k in steps for row in needs for k in row):
        return [0] * len(needs)
    from frot.compiler.equations.structure.order import find_components

    count = len(needs)
    levels, components = [0] * count, find_components(needs, range(count))
    for component in components:
        inside = set(component.equations)
        before = (levels[k] + (k in steps) for i in inside for k in needs[i] if k not in inside)
        level = max(before, default=0)
        for i in inside:
            levels[i] = level
    return levels
