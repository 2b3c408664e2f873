"""Mechanism to reduced equations: M a = h + J' lam with the rows of the contacts.

Auxiliary speeds along the normals of reduced liaisons (T. Kane, D. Levinson, Dynamics: Theory and
Applications, 1985, sect. 4.9) bring their reactions to light without adding a coordinate: they are
zero, and so are their accelerations, in every motion.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.events import Events, gather_events
from frot.compiler.equations.gather import gather
from frot.compiler.equations.separable_trees import moved_by_forces
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.equations.text_of_motion import (
    add_slip_accelerations,
    chains_of_motion,
    first_values,
    friction_maker,
    give_rates_of_tracks,
)
from frot.compiler.equations.text_slips import give_slip_modes
from frot.compiler.mechanics.cancelling import (
    biases_without_rounding,
    rows_without_rounding,
    sizes_of_drives,
)
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry, Rows
from frot.compiler.mechanics.dynamics import (
    Step,
    heaviest_loads,
    large_speeds,
    speeds_by_tree,
    write_out,
)
from frot.compiler.mechanics.geometry.end_events import find_leaving
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.loads import applied_loads, sum_loads
from frot.compiler.mechanics.make_symbols import link_rows, make_symbols
from frot.compiler.mechanics.masses import make_masses
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.tree_step import place_bodies
from frot.compiler.mechanics.undetermined_spin import refuse_idle_spins
from frot.compiler.mechanics.variables import Variables, may_be_held
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.expressions import Conditions, Lowering
from frot.compiler.translate.previous_values import Before
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import (
    TextSymbols,
    scalars,
)
from frot.compiler.translate.walk import compared_quantities, quantities_in, read_quantities
from frot.dsl import Log
from frot.dsl.checked import Liaison, Quantity
from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """The steps of the tree, none where no tree is large; the speeds of large trees."""

    steps: tuple[Step, ...]
    large: frozenset[int]

    def in_full(self, mass: ca.SX, force: ca.SX, nv: int) -> tuple[ca.SX, ca.SX]:
        """A mass matrix and a force of `nv` speeds, then others, with those of large trees."""
        if not self.large:
            return mass, force
        others = {p for step in self.steps for p in step.node.places} - self.large
        whole = write_out(self.steps, nv, mass.size1(), frozenset(others))
        own = ca.SX(force)
        for place in self.large:
            if place < nv:
                own[place] += whole.force[place]
        return mass + whole.mass, own


@dataclass(frozen=True, slots=True, eq=False)
class Reduced:
    """Equations of the motion in CasADi expressions, auxiliary speeds at zero.

    `text`, `equations` and `events` are what the text adds with its variables, which `force` and
    the others may hold too. `mass` (nw x nw), `force` (nw) and `force_size`, the sum of the sizes
    of its terms, `load_sizes` of the applied forces, `rows` (n_rows x nw), `bias` (n_rows: J a +
    bias is the rows' acceleration), `drives` (n_rows: sizes of what drives bring to it), `rate`
    (n_rows), `gap` (n_contacts), `witness` (3 each) and `reach` (see contacts.py), `tree`: the
    speeds of large trees have no entries in `mass`, nor what their bodies weigh in `force`;
    `carried`: of each speed the most that a step of its tree carries, over its own mass;
    `plain`: the text adds nothing to the equations of motion, `coefficients` (of motion and of
    rest, of each element),
    `power` of the loads without potential, `kinetic`, `potential`; `energy_terms`: sizes of the
    forces times those of the places they act at, whose rounding no energy can be told from.
    """

    mechanism: Mechanism
    symbols: Symbols
    text: TextSymbols
    equations: Residuals
    events: Events
    contact_rows: tuple[Rows, ...]
    variables: Variables
    conditions: Conditions
    mass: ca.SX
    force: ca.SX
    force_size: ca.SX
    load_sizes: ca.SX
    rows: ca.SX
    bias: ca.SX
    drives: ca.SX
    rate: ca.SX
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    tree: Tree
    carried: ca.SX
    plain: bool
    coefficients: ca.SX
    power: ca.SX
    kinetic: ca.SX
    potential: ca.SX
    energy_terms: ca.SX


def reduce(mechanism: Mechanism, log: Log) -> Reduced | None:
    """Form the equations; what cannot be lowered is reported."""
    symbols = make_symbols(mechanism)
    conditions = Conditions()
    kinematics = place_bodies(mechanism, symbols, Constants(symbols), conditions)
    symbols = kinematics.symbols
    text = chains_of_motion(mechanism, symbols)
    geometry = _geometry(mechanism, kinematics)
    variables = _variables(mechanism, kinematics, text, geometry)
    give_rates_of_tracks(kinematics, text)
    moving, display = (
        Lowering(
            symbols,
            variables.quantity,
            variables.rate,
            log,
            located,
            variable=text.values.__getitem__,
            without_rate=text.chains.without_rate,
        )
        for located in (conditions, None)
    )
    first = first_values(mechanism.model, text, symbols, display, log)
    moving.before = Before(text, first)
    _give_modes(mechanism, variables, text)
    moving.holds, moving.at_rest = variables.holds, variables.at_rest
    for variable in mechanism.model.variables:
        if variable.discrete:
            symbols_of = scalars(text.values[variable])
            for symbol, start in zip(symbols_of, first(variable), strict=True):
                text.add_discrete(symbol.name(), symbol, start)
    rates = column(rate for g in geometry for rate in g.rates(kinematics))
    speeds = ca.vertcat(symbols.v, symbols.sw)
    applied = applied_loads(mechanism, variables, moving)
    coefficients = _coefficients(mechanism.contacts, moving, symbols, log)
    moving.friction = friction_maker(text)
    equations = gather(mechanism.model.equations, moving, log)
    moving.friction = None
    add_slip_accelerations(equations, text)
    give_slip_modes(variables, text, len(mechanism.contacts))
    events = gather_events(
        mechanism.model,
        text,
        [symbol for _, symbol in variables.modes.values()],
        conditions,
        _faults(variables, moving),
        moving=moving,
        display=display,
        log=log,
    )
    if log.failed:
        return None
    has_text = bool(mechanism.model.variables or mechanism.model.equations or text.memory)
    forces = column(ca.vec(action.force) for x in applied for action in x.actions)
    plain = not has_text and not _reads_solution(forces, symbols)
    large = large_speeds(kinematics.nodes, symbols.v.numel())
    if large and not plain:
        trees = speeds_by_tree(kinematics.nodes)
        large = moved_by_forces(trees, large, forces, equations, text, symbols)
    loads = sum_loads(mechanism, variables, applied, large)
    steps, potential, terms = make_masses(mechanism, variables, loads.pushes)
    motion = write_out(steps, symbols.v.numel(), speeds.numel(), large)
    if not large:
        refuse_idle_spins(mechanism, variables, motion.mass, log)
    settled = variables.settled
    rows = rows_without_rounding(settled(ca.jacobian(rates, speeds)), mechanism, geometry)
    biases = settled(_biases(mechanism.contacts, geometry, rates, variables))
    conditions.values = [settled(value) for value in conditions.values]
    equations.values[:] = [settled(value) for value in equations.values]
    return Reduced(
        mechanism=mechanism,
        symbols=_with_counters(symbols, mechanism, variables),
        text=text,
        equations=equations,
        events=events,
        contact_rows=link_rows(mechanism.contacts),
        variables=variables,
        conditions=conditions,
        mass=settled(motion.mass),
        force=settled(motion.force + loads.force),
        force_size=settled(motion.size + loads.size),
        load_sizes=settled(column(loads.sizes)),
        rows=rows,
        bias=biases_without_rounding(biases, rows, mechanism, geometry),
        drives=settled(sizes_of_drives(mechanism, kinematics, geometry)),
        rate=settled(rates),
        gap=settled(column(g.gap for g in geometry)),
        witness=settled(column(g.witness for g in geometry)),
        reach=settled(column(g.reach for g in geometry)),
        tree=Tree(_settled_steps(steps, large, settled), large),
        carried=ca.substitute(
            heaviest_loads(steps, symbols.v.numel()), symbols.v, ca.SX.zeros(symbols.v.shape)
        ),
        plain=plain,
        coefficients=settled(coefficients),
        power=settled(loads.power),
        kinetic=settled(
            sum((variables.of_body(b, "kinetic_energy") for b in mechanism.model.bodies), ca.SX(0))
        ),
        potential=settled(potential + loads.potential),
        energy_terms=settled(terms + loads.terms),
    )


def _faults(variables: Variables, moving: Lowering) -> Iterator[tuple[ca.SX, str, Span]]:
    """That what cannot part comes to the end of a curve."""
    for one in find_leaving(variables):
        kept = ca.SX(1) if one.parts is None else 1 - moving.lower(one.parts)
        value = variables.settled(one.value)
        yield ca.if_else(kept, value, -1), one.text, one.liaison.span


def _biases(
    links: Iterable[Constraint],
    geometry: Iterable[Geometry],
    rates: ca.SX,
    variables: Variables,
) -> ca.SX:
    """What moves the rows while no speed changes; of what does not slip, along their directions."""
    slips = {
        rows.reaction[0]: g.still
        for rows, g in zip(link_rows(tuple(links)), geometry, strict=True)
        if g.still is not None
    }
    moved = [slips[k][0] if k in slips else rates[k] for k in range(rates.numel())]
    found = variables.kinematics.rate(variables.settled(column(moved)))
    ends = itertools.accumulate((x.numel() for x in moved), initial=0)
    parts = (found[first : first + x.numel()] for first, x in zip(ends, moved, strict=False))
    return column(ca.dot(slips[k][1], part) if k in slips else part for k, part in enumerate(parts))


def _with_counters(symbols: Symbols, mechanism: Mechanism, variables: Variables) -> Symbols:
    """With the rates of the counters too."""
    if not mechanism.counters:
        return symbols
    seen = (variables.coordinate(link.liaison, k)[1] for link, k in mechanism.counters)
    return replace(symbols, rates=column((symbols.rates, *map(variables.settled, seen))))


def _geometry(mechanism: Mechanism, kinematics: Kinematics) -> list[Geometry]:
    """That of each of the mechanism's contacts."""
    world, sides = mechanism.model.world, kinematics.symbols.sides
    return [link.geometry(kinematics, sides[k], world) for k, link in enumerate(mechanism.contacts)]


def _variables(
    mechanism: Mechanism,
    kinematics: Kinematics,
    text: TextSymbols,
    found: list[Geometry],
) -> Variables:
    """`found` is the geometry of the mechanism's contacts."""
    world, symbols = mechanism.model.world, kinematics.symbols
    geometry: dict[Liaison, Geometry] = {}
    sides: dict[Liaison, ca.SX] = {}
    links: dict[Liaison, Constraint] = {}
    reactions: dict[Liaison, Rows] = {}
    for k, (link, rows, own) in enumerate(
        zip(mechanism.contacts, link_rows(mechanism.contacts), found, strict=True)
    ):
        sides.setdefault(link.liaison, symbols.sides[k])
        before = reactions.get(link.liaison)
        all_rows = (*(before.reaction if before else ()), *rows.reaction)
        reactions[link.liaison] = Rows(all_rows, rows.tangent, rows.rolling)
        links[link.liaison] = link.whole
        if link.whole is link:
            geometry[link.liaison] = own
    for link in mechanism.ideal:  # what rolls has a row, but its reaction is not asked for
        reactions.pop(link.liaison, None)
    for link in (*mechanism.ideal, *tuple(links.values())):
        if link.liaison not in geometry:
            side = sides.get(link.liaison, ca.SX(1))
            geometry[link.liaison] = link.geometry(kinematics, side, world)
        links[link.liaison] = link
    drives: dict[Liaison, list[tuple[str, ca.SX]]] = {}
    for flange in mechanism.model.flanges:
        if flange.drives:
            effort = text.values[flange.effort]
            drives.setdefault(flange.liaison, []).append((flange.coordinate, effort))
    return Variables(
        symbols=symbols,
        chains=text.chains,
        kinematics=kinematics,
        geometry=geometry,
        links=links,
        reactions=reactions,
        drives=drives,
        corners=mechanism.corners,
        values=text.values,
    )


def _give_modes(mechanism: Mechanism, variables: Variables, text: TextSymbols) -> None:
    """The modes that the text reads are its first discrete values: the kernel writes them."""
    numbers: dict[Liaison, int] = {}
    for k, link in enumerate(mechanism.contacts):
        numbers.setdefault(link.liaison, k)
    model = mechanism.model

    def give(read: Iterable[Quantity]) -> None:
        owners = (x.owner for x in read if isinstance(x.owner, Liaison))
        for one in dict.fromkeys(c for x in owners for c in mechanism.corners.get(x, (x,))):
            if one in numbers and one not in variables.modes:  # what keeps nothing is open
                symbol = ca.SX.sym(f"{one.name}.mode")
                variables.modes[one] = numbers[one], symbol
                text.add_discrete(symbol.name(), symbol, ca.SX(0))

    give(x for x in read_quantities(model) if x.name == "mode")
    give(filter(may_be_held, compared_quantities(model)))
    variables.located_modes.extend(variables.modes)
    give(x for output in model.outputs for x in quantities_in(output.value) if may_be_held(x))


def _settled_steps(
    steps: tuple[Step, ...], large: frozenset[int], settled: Callable[[ca.SX], ca.SX]
) -> tuple[Step, ...]:
    """Those of large trees with auxiliary speeds at zero; only forces hold speeds."""
    if not large:
        return ()
    return tuple(
        replace(step, force=settled(step.force), couple=settled(step.couple)) for step in steps
    )


def _reads_solution(value: ca.SX, symbols: Symbols) -> bool:
    return any(
        s.numel() and value.numel() and ca.depends_on(value, s) for s in (symbols.a, symbols.lam)
    )


def _coefficients(
    contacts: tuple[Constraint, ...], moving: Lowering, symbols: Symbols, log: Log
) -> ca.SX:
    """For each element its coefficient of motion and of rest, times the radius of a pin.

    A negative one is no number, so that it is seen.
    """
    values: list[ca.SX] = []
    for contact in contacts:
        for friction in contact.frictions:
            arm = ca.SX(1) if friction.arm is None else moving.lower(friction.arm)
            for expression in friction.coefficients:
                value = moving.lower(expression)
                if _reads_solution(value, symbols) or _reads_speed(value, symbols):
                    log.report(
                        "E0701",
                        f"a coefficient of liaison '{contact.liaison.name}' that depends on the "
                        "motion otherwise than by positions is not supported yet",
                        expression.span,
                    )
                values.append(ca.if_else(value >= 0, arm * value, ca.SX.nan()))
    return column(values)


def _reads_speed(value: ca.SX, symbols: Symbols) -> bool:
    return bool(symbols.v.numel() and ca.depends_on(value, symbols.v))
