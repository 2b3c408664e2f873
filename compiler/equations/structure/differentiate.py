"""Index reduction: the equations differentiated until they give every highest derivative.

What was differentiated stays as an invariant between the states, which the run projects onto: no
choice of states has to be made, and none becomes singular on the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.equations.structure.index import (
    Index,
    find_unbalanced,
    reduce_index,
    report_unbalanced,
)
from frot.compiler.equations.structure.order import Component, find_components
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.slopes import symbols_inside
from frot.compiler.translate.derivative_chains import Chains
from frot.compiler.translate.origins import Origin, Unknown
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class Differentiated:
    """The equations `values`, each differentiated as often as it must be.

    The first `newton` of them are the mechanism's. `chains_left` are the unknowns (indices of
    chains), `orders[j]` the order of the derivative of unknown j that the equations give: lower
    ones are states. `components` are in the order of solving; `users[k]` those that need k.
    """

    chains: Chains
    values: list[ca.SX]
    origins: list[Origin]
    newton: int
    chains_left: tuple[int, ...]
    orders: tuple[int, ...]
    invariants: list[ca.SX]
    invariant_origins: list[Origin]
    components: list[Component]
    users: list[list[int]]
    component_of_equation: dict[int, int]
    component_of_unknown: dict[tuple[int, int], int]

    def unknown(self, j: int) -> ca.SX:
        """The symbol of the highest derivative of unknown j."""
        return self.chains.symbol(self.chains_left[j], self.orders[j])


def differentiate(
    system: Residuals, newton: int, chains: Chains, removed: set[int], log: Log
) -> Differentiated | None:
    """Reduce the index; None after a message. `removed` are chains that are no unknowns."""
    left = tuple(j for j in range(len(chains.items)) if j not in removed)
    incidence = find_incidence(system.values, chains, left)
    if not is_balanced(incidence, left, system.origins, chains, log):
        return None
    index = reduce_index(incidence, len(left))
    values, origins = list(system.values), list(system.origins)
    invariants: list[ca.SX] = []
    of_invariants: list[Origin] = []
    for level in range(1, max(index.equations, default=0) + 1):
        due = [i for i, times in enumerate(index.equations) if times >= level]
        for i in due:
            if not _may_be_differentiated(values[i], i < newton, origins[i], chains, log):
                return None
        invariants += [values[i] for i in due]
        of_invariants += [origins[i] for i in due]
        for i, value in zip(
            due, ca.vertsplit(chains.rate(column(values[i] for i in due))), strict=True
        ):
            values[i] = value
    components = components_of(incidence, index)
    users: list[list[int]] = [[] for _ in components]
    for k, component in enumerate(components):
        for n in component.needs:
            users[n].append(k)
    return Differentiated(
        chains=chains,
        values=values,
        origins=origins,
        newton=newton,
        chains_left=left,
        orders=index.unknowns,
        invariants=invariants,
        invariant_origins=of_invariants,
        components=components,
        users=users,
        component_of_equation={i: k for k, c in enumerate(components) for i in c.equations},
        component_of_unknown={
            (left[j], index.unknowns[j]): k for k, c in enumerate(components) for j in c.unknowns
        },
    )


def components_of(incidence: Sequence[dict[int, int]], index: Index) -> list[Component]:
    """The strong components of equations that are differentiated as the index says."""
    uses = [
        [j for j, order in row.items() if order + times == index.unknowns[j]]
        for row, times in zip(incidence, index.equations, strict=True)
    ]
    solves = [-1] * len(incidence)
    for j, i in enumerate(index.solver):
        solves[i] = j
    return find_components(uses, solves)


def is_balanced(
    incidence: Sequence[dict[int, int]],
    left: Sequence[int],
    origins: Sequence[Origin],
    chains: Chains,
    log: Log,
) -> bool:
    """Whether every unknown can have an equation of its own; what has none is reported."""
    unbalanced = find_unbalanced([tuple(row) for row in incidence], len(left))
    if unbalanced is not None:
        unknowns = [Unknown(chains.items[j].name, chains.items[j].span) for j in left]
        report_unbalanced(unbalanced, unknowns, origins, log)
    return unbalanced is None


def find_incidence(
    values: Sequence[ca.SX], chains: Chains, left: Sequence[int]
) -> list[dict[int, int]]:
    """For each equation the highest order in which each unknown stands there.

    Unknowns are numbered by their place in `left`, which holds indices of chains.
    """
    place = {chain: k for k, chain in enumerate(left)}
    incidence: list[dict[int, int]] = [{} for _ in values]
    symbols, inside = symbols_inside(values)
    places = [chains.involved(s) for s in symbols]
    for row, own in zip(incidence, inside, strict=True):
        for chain, order in (pair for k in own for pair in places[k]):
            j = place[chain]
            row[j] = max(order, row.get(j, 0))
    return incidence


def _may_be_differentiated(
    value: ca.SX, of_mechanism: bool, origin: Origin, chains: Chains, log: Log
) -> bool:
    names = chains.without_rate(value, inputs_rest=origin.drives)
    if not (names or of_mechanism):
        return True
    if of_mechanism:
        log.report(
            "E0606",
            "the equations prescribe a force or a reaction in a way that needs the derivative of "
            "accelerations",
            origin.span,
            help="prescribe a position or a speed instead, or let the force follow from the motion",
        )
    else:
        log.report(
            "E0606",
            f"the equation `{origin.text}` would have to be differentiated, but {names[0]} has no "
            "derivative",
            origin.span,
            help="give the rate as an input, or let it act through a spring or a filter",
        )
    return False
