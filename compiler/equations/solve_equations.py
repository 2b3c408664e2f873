"""Orders the equations of a text for solving: explicit formulas, blocks, and the core system.

The core holds the accelerations of the mechanism, and every unknown that friction changes and that
in turn changes the motion friction opposes. What does not depend on it is solved before, what
depends on it after.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import casadi as ca
from frot.compiler.equations.assembled import (
    Assembled,
    Block,
    Invariants,
    Solution,
    followed_blocks,
)
from frot.compiler.equations.core import Core, make_core
from frot.compiler.equations.reduced import Reduced
from frot.compiler.equations.structure.combine import combine
from frot.compiler.equations.structure.differentiate import (
    Differentiated,
    differentiate,
    find_incidence,
    is_balanced,
)
from frot.compiler.equations.structure.eliminate import (
    Eliminated,
    Entries,
    Pivot,
    Residuals,
    eliminate,
    resolve_all,
)
from frot.compiler.equations.structure.index import Index, reduce_index
from frot.compiler.equations.structure.order import Component, closure
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.equations.structure.roots import Roots
from frot.compiler.equations.structure.tear import tear
from frot.compiler.equations.structure.undetermined_potentials import is_tied_down
from frot.compiler.mechanics.reduce import BodyTrees
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.symbolic.slopes import without_what_cancels
from frot.compiler.translate.derivative_chains import Chains, replace_known
from frot.compiler.translate.origins import Origin
from frot.compiler.translate.walk import as_number
from frot.dsl import Log, default_values, evaluate


@dataclass(slots=True, eq=False)
class Solving:
    """What is known while the components are gone through."""

    roots: Roots
    known: dict[int, ca.SX] = field(default_factory=dict)
    y: list[ca.SX] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    pivots: list[Pivot] = field(default_factory=list)
    divisors: list[Pivot] = field(default_factory=list)


@dataclass(frozen=True, slots=True, eq=False)
class Posed:
    """The equations of motion and of the text with their index, as they are to be solved.

    `newton` are the first of them, auxiliary rows beside; `given` the parameters with defaults.
    """

    reduced: Reduced
    given: Given
    newton: ca.SX
    index: Index

    @property
    def count(self) -> int:
        """The number of equations of motion, auxiliary ones left out."""
        return int(self.reduced.symbols.v.numel())


@dataclass(frozen=True, slots=True, eq=False)
class Ordered:
    """Equations in the order in which they are solved.

    `forces` are the equations of motion with the removed unknowns replaced; `core` and `late` are
    the components that friction acts on, and those that follow from these.
    """

    forces: ca.SX
    found: Differentiated
    core: set[int]
    late: set[int]


def pose_equations(reduced: Reduced, log: Log) -> Posed | None:
    """The equations with their index; those that cannot be balanced are reported."""
    chains, s = reduced.text.chains, reduced.symbols
    values = default_values(reduced.mechanism.model, {})
    given = Given(s.p, [as_number(evaluate(p.value, values)) for p in s.parameters])
    newton, count = _newton(reduced), s.v.numel()
    own = motion_origins(reduced)
    raw = Residuals(
        [*(ca.vertsplit(newton[:count]) if count else ()), *reduced.equations.values],
        [*own, *reduced.equations.origins],
    )
    everything = range(len(chains.items))
    incidence = find_incidence(raw.values, chains, everything)
    if not is_balanced(incidence, everything, raw.origins, chains, log):
        return None
    if not is_tied_down(raw.values, chains, reduced.mechanism.model, log):
        return None
    return Posed(reduced, given, newton, reduce_index(incidence, len(everything)))


def remove_definitions(posed: Posed, log: Log) -> Eliminated | None:
    """Remove the unknowns that an equation defines; what is left must be equations."""
    reduced, index = posed.reduced, posed.index
    chains = reduced.text.chains

    def may_define(i: int, j: int, entries: Entries) -> bool:
        """States only where the equation is differentiated as often; other unknowns if aliases.

        What is no real number follows from an equation between such values only.
        """
        states, variable = index.unknowns[j], chains.items[j].variable
        real = variable is None or variable.type.base == "real"
        if not real and not reduced.equations.origins[i].discrete:
            return False
        alias = len(entries) <= 2 and not any(entries.values())
        return index.equations[posed.count + i] == states and (states > 0 or alias)

    left = eliminate(reduced.equations, may_define, chains, posed.given)
    return left if _are_equations(left, chains, log) else None


def order_equations(posed: Posed, left: Eliminated, log: Log) -> Ordered | None:
    """Differentiate what hides the derivatives of states; find the components and the core."""
    reduced, count = posed.reduced, posed.count
    chains = reduced.text.chains
    forces = resolve_all(posed.newton, chains, left.resolver)
    residuals = left.residuals
    system = Residuals(
        [*ca.vertsplit(forces[:count]), *residuals.values] if count else residuals.values,
        [*motion_origins(reduced), *residuals.origins],
    )
    unknowns = [j for j in range(len(chains.items)) if j not in left.removed]
    found = differentiate(
        combine(system, count, chains, unknowns), count, chains, left.removed, log
    )
    if found is None:
        return None
    return Ordered(forces, found, *_core_components(found, reduced))


def solve_in_order(posed: Posed, left: Eliminated, ordered: Ordered, log: Log) -> Assembled | None:
    """The kernel's system: what comes before the core, the core, and what follows from it."""
    reduced, found, given = posed.reduced, ordered.found, posed.given
    y, blocks = followed_blocks(reduced)
    conditions = reduced.conditions
    roots = Roots(conditions.flags, conditions.values, given, left.resolver)
    solving = Solving(roots, y=scalars_of(y), blocks=list(blocks))
    for k, component in enumerate(found.components):
        if k not in ordered.core and k not in ordered.late:
            _solve(component, found, solving, False, given)
    built = make_core(reduced, left, found, ordered.core, ordered.forces, solving.known, given, log)
    if built is None:
        return None
    solving.known.update(built.known)
    for k, component in enumerate(found.components):
        if k in ordered.late:
            _solve(component, found, solving, True, given)
    return _finish(reduced, left, found, solving, built)


def motion_origins(reduced: Reduced) -> list[Origin]:
    """The origins of the equations of motion, auxiliary ones left out."""
    span, count = reduced.mechanism.model.span, int(reduced.symbols.v.numel())
    return [Origin(span, "the equations of motion", "")] * count


def _newton(reduced: Reduced) -> ca.SX:
    """M a - h - J' lam, auxiliary accelerations at zero; the auxiliary rows last.

    In place of the mass matrix of large trees stands one, which the core takes out again.
    """
    s = reduced.symbols
    accelerations = ca.vertcat(s.a, ca.SX.zeros(s.sw.shape))
    alone = ca.SX.zeros(accelerations.shape)
    for place in reduced.motion.tree.large:
        alone[place] = accelerations[place]
    return (
        reduced.motion.matrices.matrix @ accelerations
        + alone
        - reduced.motion.matrices.force
        - reduced.motion.matrices.rows.T @ s.lam
    )


def _are_equations(left: Eliminated, chains: Chains, log: Log) -> bool:
    """Whether every equation left still holds an unknown, and every condition is defined."""
    good = True
    for j, chain in enumerate(chains.items):
        variable = chain.variable
        if j not in left.removed and variable is not None and variable.type.base != "real":
            log.report(
                "E0610",
                f"'{chain.name}' is neither set by a 'when' nor given by an equation of its own",
                variable.span,
                help=f"write '{chain.name} = ...' in the equations, or in a 'when', with nothing "
                f"in it that follows from itself; what it was before is 'pre({chain.name})'",
            )
            good = False
    for value, origin in zip(left.residuals.values, left.residuals.origins, strict=True):
        if value.is_constant():
            zero = value.is_zero()
            log.report(
                "E0604",
                f"the equation `{origin.text}` "
                + ("follows from the others" if zero else "contradicts the others"),
                origin.span,
                notes=(f"in component '{origin.owner}'",) if origin.owner else (),
                help="leave it out, or an equation that says the same",
            )
            good = False
    return good


def _core_components(found: Differentiated, reduced: Reduced) -> tuple[set[int], set[int]]:
    """Components between what friction acts on and what its slip depends on; those after them."""
    chains = reduced.text.chains
    elements = reduced.text.elements
    lam = ca.vertcat(reduced.symbols.lam, column(e.force for e in elements))
    mechanism = {
        k
        for k, c in enumerate(found.components)
        if min(c.equations) < found.newton or min(c.unknowns) < found.newton
    }
    sources, sinks = set(mechanism), set(mechanism)
    if lam.numel():
        acted_on = set(ca.jacobian_sparsity(column(found.values), lam).row())
        sources |= {found.component_of_equation[i] for i in acted_on}
    for element in elements:
        place = chains.place[element.acceleration.element_hash()]
        if place in found.component_of_unknown:
            sinks.add(found.component_of_unknown[place])
    touched = closure(sources, found.users)
    core = touched & closure(sinks, [c.needs for c in found.components])
    return core, touched - core


def _solve(
    component: Component,
    found: Differentiated,
    solving: Solving,
    late: bool,
    given: Given,
) -> None:
    """Solve one component: by formulas as far as they go, the rest as a block."""
    unknowns = [found.unknown(j) for j in component.unknowns]
    residual = [found.values[i] for i in component.equations]
    if component.needs:
        residual = [replace_known(value, solving.known) for value in residual]
    origins = [found.origins[i] for i in component.equations]
    torn = tear(residual, unknowns, given)
    for factor, unknown, number in torn.divisors:
        if not factor.is_constant():
            pivot = Pivot(factor, unknown.name(), origins[number])
            fixed = all(x in given for x in ca.symvar(factor))
            (solving.pivots if fixed else solving.divisors).append(pivot)
    first = len(solving.y)
    for symbol in torn.iterated:
        solving.y.append(symbol)
    for symbol, value in torn.explicit:
        solving.known[symbol.element_hash()] = solving.roots.settle(value, solving.known)
    if torn.iterated:
        names = ", ".join(symbol.name() for symbol in torn.iterated[:4])
        more = len(torn.iterated) - 4
        solving.blocks.append(
            Block(
                column(without_what_cancels(value) for value in torn.residual),
                first,
                torn.linear,
                late,
                names + (f" and {more} more" if more > 0 else ""),
                origins[0].span,
            )
        )


def _finish(
    reduced: Reduced,
    left: Eliminated,
    found: Differentiated,
    solving: Solving,
    core: Core,
) -> Assembled:
    """The system with all that was found; what may switch is settled."""
    chains, s = reduced.text.chains, reduced.symbols

    solution = Solution(chains, left.resolver, solving.known)
    for key, value in left.resolver.known.items():
        if solving.roots.may_switch(value):
            left.resolver.known[key] = solving.roots.settle(solution.of(value), solving.known)
    rates, power = solution.of(core.rates), solution.of(reduced.motion.matrices.power)
    y, early = column(solving.y), sum(b.residual.numel() for b in solving.blocks if not b.late)
    later = ca.vertcat(core.z, core.lam, y[early:])
    late = bool(later.numel()) and any(
        value.numel() and ca.depends_on(value, later) for value in (rates, power)
    )
    invariants = solution.of(column(found.invariants))
    return Assembled(
        reduced=reduced,
        elements=tuple(reduced.text.elements),
        q=core.q,
        v=core.v,
        y=y,
        z=core.z,
        lam=core.lam,
        discrete=column(d.symbol for d in reduced.text.memory),
        names=core.names,
        q_speed=core.q_speed,
        na=s.sw.numel(),
        nc=core.nc,
        late=late,
        rates=rates,
        matrices=replace(core.matrices, power=power),
        blocks=tuple(solving.blocks),
        invariants=Invariants(invariants, tuple(found.invariant_origins)),
        pivots=(*left.pivots, *solving.pivots, *core.pivots),
        divisors=tuple(solving.divisors),
        solution=solution,
        tree=_renumbered(reduced.motion.tree, s.v.numel(), core.v.numel(), solution),
    )


def _renumbered(tree: BodyTrees, count: int, nv: int, solution: Solution) -> BodyTrees:
    """Its places among all unknowns, where auxiliary speeds follow those of the text."""
    if not tree.large:
        return tree

    def place(p: int) -> int:
        return p if p < count else p - count + nv

    steps = tuple(
        replace(
            step,
            node=replace(step.node, places=tuple(map(place, step.node.places))),
            force=solution.of(step.force),
            couple=solution.of(step.couple),
        )
        for step in tree.steps
    )
    return BodyTrees(steps, frozenset(map(place, tree.large)))
