"""The functions of the kernel's contract (model.h), each by its arguments and its results."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled, terms_of_rates
from frot.compiler.equations.carried_bodies import Carried, carried_bodies
from frot.compiler.equations.parameter_checks import Check
from frot.compiler.lowering.first_conditions import first_conditions
from frot.compiler.lowering.groups import Grouping
from frot.compiler.lowering.initial_problem import InitialProblem
from frot.compiler.lowering.jacobian import Jacobian, make_jacobian, too_full, why_explicit
from frot.compiler.lowering.lower_parameters import lower_parameters
from frot.compiler.lowering.orders_in_time import MOST_IN_RUNS, MOST_OPERATIONS, make_orders
from frot.compiler.lowering.state import clean, state_arguments, unsolved
from frot.compiler.lowering.switches import Switches
from frot.compiler.lowering.time_forcing import make_pace
from frot.compiler.mechanics.geometry.parallel_lines import find_lost_normals
from frot.compiler.mechanics.geometry.vanishing import Vanishing, find_vanishing
from frot.compiler.mechanics.laws.elements import Bound
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.spatial import whole
from frot.compiler.symbolic.columns import column
from frot.dsl import Log
from frot.dsl.checked import Expression

Named = tuple[str, list[ca.SX], list[ca.SX]]


@dataclass(frozen=True, slots=True, eq=False)
class KernelFunctions:
    """The functions by their names in the contract, and what some of them are made from.

    `n_followed`: unknowns of places that are followed, if one may be of an open contact.
    `lists_motions`: a run lists its motions at events.
    """

    functions: dict[str, ca.Function]
    carried: tuple[Carried, ...]
    vanishing: tuple[Vanishing, ...]
    jacobian: Jacobian | None
    n_followed: int
    lists_motions: bool


def make_functions(
    system: Assembled,
    problem: InitialProblem,
    switches: Switches,
    grouping: Grouping,
    checks: tuple[Check, ...],
    values: ca.SX,
    divided: bool,
    log: Log,
    orders: bool = False,
) -> KernelFunctions | None:
    """Build every function of the whole; what cannot be built is reported.

    `values` are those of the variables. `divided`: islands have the functions of the motion.
    `orders`: with the derivatives along the motion of large systems too, for `motions`.
    """
    state = state_arguments(system)
    lost = _vanishing(system)
    nowhere = next((x for x in lost if x.distance.is_zero()), None)
    if nowhere is not None:
        log.report("E0911", f"{nowhere.text} everywhere", nowhere.liaison.span)
        return None
    jacobian = make_jacobian(system, grouping, state)
    if jacobian is None and not _may_be_explicit(system, log):
        return None
    in_time = None
    if _may_list_motions(system, grouping):
        in_time = make_orders(system, state, MOST_IN_RUNS)
    lists_motions = in_time is not None
    if orders and not lists_motions:
        in_time = make_orders(system, state, MOST_OPERATIONS)
    carried, beginnings = carried_bodies(system), _beginnings_of_open(system)
    named = [
        *_of_start(system, problem, switches, grouping, checks),
        *_of_values(system, values),
        *([] if divided else _of_motion(system, grouping, switches)),
        *_of_sensed(system, switches),
        *_of_places(system, carried, lost, beginnings),
        *_of_sizes(system),
        *_of_time(system, switches),
        *([] if jacobian is None else [("jacobian", jacobian.arguments, jacobian.results)]),
        *([] if in_time is None else [in_time]),
        *_of_late(system),
        *_of_events(system, switches),
        *_of_percussions(system, problem),
    ]
    functions = {
        name: ca.Function(f"frot_{name}_at", arguments, clean(results))
        for name, arguments, results in named
    }
    n_followed = beginnings[0].numel() if beginnings else 0
    return KernelFunctions(functions, carried, lost, jacobian, n_followed, lists_motions)


def _may_be_explicit(system: Assembled, log: Log) -> bool:
    """Whether the text does not ask for the implicit method, which needs a Jacobian."""
    experiment = system.reduced.mechanism.model.experiment
    if experiment.method != "implicit":
        return True
    why = why_explicit(system) or too_full(system)
    log.report(
        "E0701",
        f"the method 'implicit' is not supported for {why}",
        experiment.span,
        help="`auto` and `explicit` are supported",
    )
    return False


def _of_start(
    system: Assembled,
    problem: InitialProblem,
    switches: Switches,
    grouping: Grouping,
    checks: tuple[Check, ...],
) -> Iterator[Named]:
    """What is known before the first step: parameters, and where the search begins."""
    s, initial, display = system.reduced.symbols, problem.initial, problem.display
    given, is_set = ca.SX.sym("given", s.p.numel()), ca.SX.sym("set", s.p.numel())
    parameters = lower_parameters(display, checks, system, grouping, given, is_set)
    yield "parameters", [given, is_set, s.u], parameters
    yield "start", [s.t, s.u, s.p], initial.start
    first = first_conditions(system, display, switches.conditions)
    yield (
        "beginning",
        state_arguments(system),
        [*initial.beginning, unsolved(first, system)],
    )


def _of_values(system: Assembled, values: ca.SX) -> Iterator[Named]:
    """Variables and energies, and the sizes of loads."""
    reduced, resolve, state = system.reduced, system.resolve, state_arguments(system)
    motion = reduced.motion
    loads = _without_reactions(resolve(motion.load_sizes), system)
    yield "sizes", state, [system.matrices.force_size, loads]
    yield "variables", [*_solution(system), reduced.symbols.energy], [values]
    terms = _without_reactions(resolve(motion.energy_terms), system)
    yield "energy", state, [resolve(motion.kinetic), resolve(motion.potential), terms]


def _of_motion(system: Assembled, grouping: Grouping, switches: Switches) -> Iterator[Named]:
    """What islands have of their own where there are several."""
    state, own = state_arguments(system), system.matrices
    conditions = unsolved(switches.conditions, system)
    no_rates = ca.SX.zeros(system.rates.shape)
    yield "kinematics", state, [own.gap, grouping.rows, own.rate, conditions]
    dynamics = [
        no_rates if system.late else system.rates,
        grouping.matrix,
        own.force,
        grouping.rows,
        own.bias,
        own.rate,
        own.gap,
        conditions[: system.reduced.conditions.located],
        own.coefficients,
        ca.SX(0) if system.late else own.power,
    ]
    yield "dynamics", state, dynamics
    if not grouping.is_mass_matrix:
        yield "spread", state, [grouping.spread, grouping.metric]
    if any(g.composite for g in grouping.groups):
        yield "wide", state, [grouping.matrix, own.force, grouping.rows]


def _of_sensed(system: Assembled, switches: Switches) -> Iterator[Named]:
    """Conditions on accelerations and reactions."""
    kinds = system.reduced.conditions
    if kinds.sensed:
        first = kinds.located - kinds.sensed
        yield "sensed", _solution(system), [switches.conditions[first : kinds.located]]


def _of_places(
    system: Assembled,
    carried: Sequence[Carried],
    lost: Sequence[Vanishing],
    beginnings: list[ca.SX],
) -> Iterator[Named]:
    """Where figures touch and bodies are, and what figures may lose."""
    state, without_auxiliary = state_arguments(system), system.reduced.variables.without_auxiliary
    if beginnings:
        yield "beginnings", state, beginnings
    if carried:
        yield "places", state, [column(body.value for body in carried)]
    if lost:
        found = column(x.distance for x in lost), ca.horzcat(*(x.where for x in lost))
        yield "vanishing", state, [system.resolve(without_auxiliary(x)) for x in found]


def _of_sizes(system: Assembled) -> Iterator[Named]:
    """Sizes of what drives bring to the rows, and of the terms of rates."""
    state, drives = state_arguments(system), system.reduced.motion.drives
    if drives.nnz():
        none = ca.SX.zeros(len(system.elements))
        yield "drives", state, [ca.vertcat(system.resolve(drives), none)]
    terms = terms_of_rates(system)
    if terms.nnz():
        yield "terms", state, [ca.densify(terms)]


def _of_time(system: Assembled, switches: Switches) -> Iterator[Named]:
    """How fast time alone changes what acts."""
    pace = make_pace(system, switches.conditions[: system.reduced.conditions.located])
    if pace is not None:
        yield "pace", state_arguments(system), list(pace)


def _of_late(system: Assembled) -> Iterator[Named]:
    """What follows from accelerations and reactions, and what every step is projected onto."""
    if system.late:
        yield "rates", _solution(system), [system.rates, system.matrices.power]
    if system.invariants.origins:
        yield "invariants", state_arguments(system), _invariants(system)


def _of_events(system: Assembled, switches: Switches) -> Iterator[Named]:
    """What events do, numbers that must stay finite, and instants known before."""
    events, solution = system.reduced.events, _solution(system)
    if switches.update is not None:
        arguments = [*solution, column(events.fired), column(events.before)]
        yield "update", arguments, switches.update
    if switches.watched.numel():
        yield "watched", solution, [switches.watched]
    if system.reduced.conditions.timed:
        s = system.reduced.symbols
        yield "timers", [s.u, s.p, state_arguments(system)[5]], switches.timers


def _of_percussions(system: Assembled, problem: InitialProblem) -> Iterator[Named]:
    """Their impulses in ground axes, three components each."""
    values = [one.force.arguments["value"] for one in system.reduced.events.percussions]
    lowered = [problem.display.lower(x) for x in values if isinstance(x, Expression)]
    if lowered:
        impulses = system.resolve(column(ca.densify(whole(x)) for x in lowered))
        yield "impulses", state_arguments(system), [_without_reactions(impulses, system)]


def _solution(system: Assembled) -> list[ca.SX]:
    """The state with what is solved for there."""
    return [*state_arguments(system), system.z, system.lam]


def _may_list_motions(system: Assembled, grouping: Grouping) -> bool:
    """Whether a run may list its motions at events: those of contacts in the plane.

    Friction of pins alone is enumerated (runtime/kernel/mode_choice/listed_motions.c).
    """
    part = any(is_unilateral(x.liaison) for x in system.reduced.mechanism.contacts)
    rub = any(element.bound is not Bound.PIN for element in grouping.elements)
    return system.reduced.mechanism.model.planar and (part or rub)


def _vanishing(system: Assembled) -> tuple[Vanishing, ...]:
    """What the figures of the liaisons may lose."""
    own = system.reduced.variables
    lost = find_vanishing(own.links, own.geometry, own.kinematics)
    return (*lost, *find_lost_normals(own))


def _without_reactions(sizes: ca.SX, system: Assembled) -> ca.SX:
    """Sizes of loads as the state gives them, without what accelerations and reactions add."""
    solved = ca.vertcat(system.z, system.lam)
    if not (sizes.numel() and solved.numel()):
        return sizes
    return ca.substitute(sizes, solved, ca.SX.zeros(solved.shape))


def _beginnings_of_open(system: Assembled) -> list[ca.SX]:
    """Where the search for each place that is followed begins, if one may be of an open contact."""
    tracks = system.reduced.variables.kinematics.tracks
    if not any(is_unilateral(liaison) for liaison in tracks):
        return []
    return [column(x.start if x.elsewhere is None else x.elsewhere for x in tracks.values())]


def _invariants(system: Assembled) -> list[ca.SX]:
    """Values, slopes in the states, and the sizes of what they are the difference of."""
    values = system.invariants.values
    states, given = ca.vertcat(system.q, system.v), system.reduced.symbols.u
    slope = ca.jacobian(values, states)
    size = ca.fabs(slope) @ ca.fabs(states)
    if given.numel() and ca.depends_on(values, given):
        size += ca.fabs(ca.jacobian(values, given)) @ ca.fabs(given)
    return [values, slope.T, size]
