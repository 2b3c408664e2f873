"""Parameters in the order in which they depend on each other, and all that follows from them."""

from __future__ import annotations

import functools

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.parameter_checks import Check
from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.groups import Group, Grouping
from frot.compiler.mechanics.laws.restitution import restitution_of
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.derivative_chains import replace_known
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import scalars
from frot.compiler.translate.walk import subexpressions
from frot.dsl.checked import Parameter, Reference, Variable
from frot.dsl.checked.order import in_order


def parameters_needed(parameter: Parameter, symbols: Symbols) -> list[Parameter]:
    """The scalar parameters, constants apart, that a parameter's value names."""
    return [
        one
        for node in subexpressions(parameter.value)
        if isinstance(node, Reference) and isinstance(node.target, Parameter)
        for one in symbols.items.get(node.target, ())
    ]


def lower_parameters(
    display: Lowering,
    checks: tuple[Check, ...],
    system: Assembled,
    grouping: Grouping,
    given: ca.SX,
    is_set: ca.SX,
) -> list[ca.SX]:
    """The outputs of the kernel's `parameters`.

    Friction elements are never unilateral.
    """
    reduced = system.reduced
    s = reduced.symbols
    place = {p.name: i for i, p in enumerate(s.parameters)}
    needs = {p.name: [q.name for q in parameters_needed(p, s)] for p in s.parameters}
    order, _ = in_order(needs)
    known: dict[int, ca.SX] = {}
    for name in order:
        i = place[name]
        value = given[i]
        if needs[name]:
            dependent = replace_known(display.lower(s.parameters[i].value), known)
            value = ca.if_else(is_set[i] != 0, given[i], dependent)
        known[s.p[i].element_hash()] = value
    experiment = reduced.mechanism.model.experiment
    times = [
        ca.SX.nan() if e is None else display.lower(e)
        for e in (
            experiment.start,
            experiment.stop,
            experiment.tolerance,
            experiment.interval,
            experiment.max_step,
        )
    ]
    values = [c.value if isinstance(c.value, ca.SX) else display.lower(c.value) for c in checks]
    nominal = _nominal_sizes(system.q, reduced, display)
    unilateral = [display.lower(c.unilateral) for c in reduced.mechanism.contacts]
    none = [ca.SX(0)] * len(system.elements)
    outputs = [column(values), column([*unilateral, *none]), column(times)]
    outputs += [column(nominal), column(_most_carried(g, reduced) for g in grouping.groups)]
    given_back = [restitution_of(c.liaison)[0] for c in reduced.mechanism.contacts]
    outputs.append(column([*(ca.SX(0) if e is None else display.lower(e) for e in given_back), *none]))
    return [
        column(known[s.p[i].element_hash()] for i in range(s.p.numel())),
        *(replace_known(output, known) for output in outputs),
    ]


def _most_carried(group: Group, reduced: Reduced) -> ca.SX:
    """The most that a step of the trees of a group carries, over its own mass."""
    found = {
        load.element_hash(): load
        for z in group.unknowns[: group.n_speeds]
        if group.composite and z < reduced.motion.carried.numel()
        for load in [reduced.motion.carried[z]]
    }
    return functools.reduce(ca.fmax, found.values(), ca.SX(0))


def _nominal_sizes(q: ca.SX, reduced: Reduced, display: Lowering) -> list[ca.SX]:
    """The usual size of each state: of a unit quaternion 1, else by its author, or zero.

    What rolls along a plane is as large at least as that is.
    """
    chains = reduced.text.chains
    unit = {
        reduced.symbols.q[turn.coordinate + k].element_hash()
        for turn in reduced.symbols.turns
        for k in range(4)
    }
    spots = {
        reduced.symbols.q[place].element_hash(): spot.size
        for place, spot in reduced.variables.kinematics.spots.items()
    }
    first: dict[Variable, int] = {}
    for index, item in enumerate(chains.items):
        if item.variable is not None:
            first.setdefault(item.variable, index)
    sizes = []
    for symbol in ca.vertsplit(q) if q.numel() else ():
        index, order = chains.place.get(symbol.element_hash(), (-1, 0))
        variable = chains.items[index].variable if index >= 0 else None
        if symbol.element_hash() in unit:
            sizes.append(ca.SX(1))
        elif symbol.element_hash() in spots:
            sizes.append(spots[symbol.element_hash()])
        elif variable is None or variable.nominal is None or order > 0:
            sizes.append(ca.SX(0))
        else:
            items = scalars(display.lower(variable.nominal))
            sizes.append(ca.fabs(items[index - first[variable]]))
    return sizes
