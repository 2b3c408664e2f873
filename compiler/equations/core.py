"""The core system: accelerations of the mechanism with all that friction reaches at once."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.reduced import Reduced
from frot.compiler.equations.structure.differentiate import Differentiated
from frot.compiler.equations.structure.eliminate import (
    Eliminated,
    Pivot,
    Residuals,
    eliminate,
    resolve_all,
)
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.mechanics.reduce import SystemMatrices
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import Chains, replace_known
from frot.dsl import Log
from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Core:
    """States (q, v) with the rates of q, and the system of z: see `Assembled`."""

    q: ca.SX
    v: ca.SX
    z: ca.SX
    lam: ca.SX
    names: tuple[str, ...]
    q_speed: tuple[int, ...]
    rates: ca.SX
    nc: int
    matrices: SystemMatrices
    known: dict[int, ca.SX]
    pivots: tuple[Pivot, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _States:
    q: list[ca.SX]
    rates: list[ca.SX]
    v: list[ca.SX]
    accelerations: list[ca.SX]
    algebraic: list[ca.SX]


def make_core(
    reduced: Reduced,
    left: Eliminated,
    found: Differentiated,
    core: set[int],
    newton: ca.SX,
    known: dict[int, ca.SX],
    given: Given,
    log: Log,
) -> Core | None:
    """Form the core of the components `core`; a fault is reported.

    `newton` are the mechanism's equations resolved, auxiliary rows last; `known` is what earlier
    components gave.
    """
    s, chains, elements = reduced.symbols, reduced.text.chains, reduced.text.elements
    states = _sort_states(found, core)
    nv, na, count = len(states.v), s.sw.numel(), s.v.numel()
    explicit = _remove_algebraic(found, states, core, known, given, chains)
    known = {**known, **explicit.resolver.known}
    algebraic = [x for x in states.algebraic if x.element_hash() not in explicit.resolver.known]
    nc = len(algebraic)
    auxiliary = ca.SX.sym("auxiliary", na)
    z = ca.vertcat(column(states.accelerations), auxiliary, column(algebraic))
    lam = ca.vertcat(s.lam, column(e.force for e in elements))
    left_over = dict(zip(explicit.numbers, explicit.residuals.values, strict=True))
    user = _in_order_of([*states.accelerations[count:], *algebraic], found, core, left_over)
    own = [left_over[i] for i in range(count)]
    equations = _ordered_equations(
        reduced, own, user, replace_known(newton[count:], known), auxiliary, nv
    )
    matrix, spread = ca.jacobian(equations, z), -ca.jacobian(equations, lam)
    for place in reduced.motion.tree.large:
        if place < count:
            matrix[place, place] -= 1
    matrix = ca.sparsify(matrix)
    rows, bias, rate = _rows(reduced, left, z, known, na, nv)
    both = ca.vertcat(z, lam)
    if both.numel() and (ca.depends_on(matrix, both) or ca.depends_on(spread, both)):
        log.report(
            "E0607",
            "equations that are not linear in accelerations, reactions and friction forces cannot "
            "be solved together with friction or the mechanism",
            _place(found, core, reduced),
            help="let such a quantity act through a state, as a filter or a spring",
        )
        return None
    coefficients = _coefficients(reduced, left, known)
    if not _are_known(coefficients, both, found, reduced, log):
        return None
    zero = ca.SX.zeros(both.shape)
    force = -ca.substitute(equations, both, zero) if both.numel() else -equations
    sizes = replace_known(
        resolve_all(reduced.motion.matrices.force_size, chains, left.resolver), known
    )
    sizes = ca.substitute(sizes, both, zero) if both.numel() else sizes
    return Core(
        q=ca.vertcat(s.q, column(states.q)),
        v=column(states.v),
        z=z,
        lam=lam,
        names=tuple(str(x.name()) for x in (*scalars_of(s.q), *states.q, *states.v)),
        q_speed=_speeds(s.q_speed, states),
        rates=ca.vertcat(s.rates, column(states.rates)),
        nc=nc,
        matrices=SystemMatrices(
            matrix=matrix,
            force=force,
            force_size=_force_sizes(sizes, force, count, nv, na),
            spread=spread,
            metric=_metric(reduced, nv, na),
            rows=rows,
            bias=bias,
            rate=rate,
            gap=ca.vertcat(reduced.motion.matrices.gap, ca.SX.ones(len(elements))),
            coefficients=coefficients,
            power=reduced.motion.matrices.power,
        ),
        known=explicit.resolver.known,
        pivots=tuple(explicit.pivots),
    )


def _ordered_equations(
    reduced: Reduced,
    own: list[ca.SX],
    user: list[ca.SX],
    auxiliary_rows: ca.SX,
    auxiliary: ca.SX,
    nv: int,
) -> ca.SX:
    """The equations in the order of z: `own` of the mechanism, `user` of the text."""
    count, na = len(own), int(auxiliary.numel())
    coupling = reduced.motion.matrices.matrix[:, count:] @ auxiliary
    equations = ca.vertcat(
        column(own) + coupling[:count], column(user), auxiliary_rows + coupling[count:]
    )
    order = [*range(count), *range(count, nv), *range(count + len(user), count + len(user) + na)]
    order += list(range(nv, count + len(user)))
    return equations[order] if order else equations


def _force_sizes(sizes: ca.SX, force: ca.SX, count: int, nv: int, na: int) -> ca.SX:
    """The sizes of the mechanism's forces, of other entries their values."""
    # as lists: an empty slice of one scalar counts as one more row in CasADi
    known, own = scalars_of(sizes), scalars_of(ca.fabs(force))
    return column([*known[:count], *own[count:nv], *known[count : count + na], *own[nv + na :]])


def _remove_algebraic(
    found: Differentiated,
    states: _States,
    core: set[int],
    known: dict[int, ca.SX],
    given: Given,
    chains: Chains,
) -> Eliminated:
    """The core's equations without the algebraic unknowns that have a formula: forces, mostly."""
    inside = [i for k in sorted(core) for i in found.components[k].equations]
    values = [replace_known(found.values[i], known) for i in inside]
    own = {chains.place[x.element_hash()][0] for x in states.algebraic}
    taken = eliminate(
        Residuals(values, [found.origins[i] for i in inside]),
        lambda i, j, _: j in own and inside[i] >= found.newton,
        chains,
        given,
    )
    return replace(taken, numbers=[inside[i] for i in taken.numbers])


def _in_order_of(
    z: list[ca.SX], found: Differentiated, core: set[int], values: dict[int, ca.SX]
) -> list[ca.SX]:
    """The text's equations of the core, each in the place of the unknown it is matched with.

    An equation is turned round where its unknown stands in it with a negative factor, so that what
    is a mass matrix looks like one.
    """
    place = {x.element_hash(): k for k, x in enumerate(z)}
    ordered: dict[int, ca.SX] = {}
    others: list[ca.SX] = []
    for k in sorted(core):
        component = found.components[k]
        for i, j in zip(component.equations, component.unknowns, strict=True):
            if i < found.newton or i not in values:
                continue
            unknown, value = found.unknown(j), values[i]
            at = place.get(unknown.element_hash())
            if at is None:
                others.append(value)
                continue
            slope = ca.jacobian(value, unknown)
            ordered[at] = -value if _looks_negative(slope) else value
    free = iter(others)
    return [ordered[k] if k in ordered else next(free) for k in range(len(z))]


def _looks_negative(slope: ca.SX) -> bool:
    symbols = ca.symvar(slope)
    value = ca.Function("slope", symbols, [slope]).call([ca.DM(1)] * len(symbols))[0]
    return float(value) < 0


def _sort_states(found: Differentiated, core: set[int]) -> _States:
    """States of the text: those whose rates the core gives are speeds."""
    states = _States([], [], [], [], [])
    chains = found.chains
    in_core = {j for k in core for j in found.components[k].unknowns}
    ordered = [*range(found.newton), *range(found.newton, len(found.chains_left))]
    for j in ordered:
        chain, order = found.chains_left[j], found.orders[j]
        symbols = [chains.symbol(chain, k) for k in range(order + 1)]
        mechanical = j < found.newton
        if j in in_core and order:
            states.v.append(symbols[order - 1])
            states.accelerations.append(symbols[order])
            below = order - 1
        else:
            below = order
            if j in in_core:
                states.algebraic.append(symbols[0])
        if not mechanical:
            for k in range(below):
                states.q.append(symbols[k])
                states.rates.append(symbols[k + 1])
    return states


def _speeds(own_speeds: tuple[int, ...], states: _States) -> tuple[int, ...]:
    """For each coordinate the speed that is its rate, or -1."""
    place = {v.element_hash(): k for k, v in enumerate(states.v)}
    own = [place.get(r.element_hash(), -1) for r in states.rates]
    return (*own_speeds, *own)


def _rows(
    reduced: Reduced,
    left: Eliminated,
    z: ca.SX,
    known: dict[int, ca.SX],
    na: int,
    nv: int,
) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Rows over z, what their accelerations have beside, and their speeds."""
    s, chains, elements = reduced.symbols, reduced.text.chains, reduced.text.elements
    count, n = s.v.numel(), reduced.motion.matrices.rows.size1()
    mechanical = ca.SX.zeros(n, z.numel())
    if n:
        mechanical[:, :count] = reduced.motion.matrices.rows[:, :count]
        mechanical[:, nv : nv + na] = reduced.motion.matrices.rows[:, count:]
    slips = resolve_all(column(e.slip for e in elements), chains, left.resolver)
    rate = resolve_all(column(e.acceleration for e in elements), chains, left.resolver)
    slips, rate = replace_known(slips, known), replace_known(rate, known)
    own = ca.jacobian(rate, z)
    free = ca.substitute(rate, z, ca.SX.zeros(z.shape)) if z.numel() else rate
    return (
        ca.vertcat(mechanical, own),
        ca.vertcat(reduced.motion.matrices.bias, free),
        ca.vertcat(reduced.motion.matrices.rate, slips),
    )


def _coefficients(reduced: Reduced, left: Eliminated, known: dict[int, ca.SX]) -> ca.SX:
    bounds = column(
        x
        for e in reduced.text.elements
        for x in (
            e.bound,
            ca.if_else(e.bound_at_rest >= e.bound, e.bound_at_rest, ca.SX.nan()),
        )
    )
    whole = ca.vertcat(reduced.motion.matrices.coefficients, bounds)
    resolved = replace_known(resolve_all(whole, reduced.text.chains, left.resolver), known)
    return column(ca.if_else(x >= 0, x, ca.SX.nan()) for x in ca.vertsplit(resolved))


def _are_known(
    coefficients: ca.SX, both: ca.SX, found: Differentiated, reduced: Reduced, log: Log
) -> bool:
    """Whether friction is bounded by what is known before it is solved for; else reported."""
    late = {found.unknown(j).element_hash() for c in found.components for j in c.unknowns}
    late |= {x.element_hash() for x in (ca.vertsplit(both) if both.numel() else ())}
    first = coefficients.numel() - 2 * len(reduced.text.elements)
    for k, value in enumerate(ca.vertsplit(coefficients) if coefficients.numel() else ()):
        unknown = [x.name() for x in ca.symvar(value) if x.element_hash() in late]
        if unknown:
            model = reduced.mechanism.model.span
            log.report(
                "E0607",
                f"a coefficient or bound of friction depends on '{unknown[0]}', which is solved "
                "for together with friction",
                reduced.text.elements[(k - first) // 2].span if k >= first else model,
                help="let such a quantity act through a state, as a filter or a spring",
            )
            return False
    return True


def _metric(reduced: Reduced, nv: int, na: int) -> ca.SX:
    """The mass matrix for the mechanism, one for the other speeds."""
    count = reduced.symbols.v.numel()
    metric = ca.SX.eye(nv + na)
    order = [*range(count), *range(nv, nv + na)]
    for a, i in enumerate(order):
        for b, j in enumerate(order):
            metric[i, j] = reduced.motion.matrices.matrix[a, b]
    return metric


def _place(found: Differentiated, core: set[int], reduced: Reduced) -> Span:
    for k in core:
        for i in found.components[k].equations:
            if i >= found.newton:
                return found.origins[i].span
    return reduced.mechanism.model.span
