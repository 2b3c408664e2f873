"""Assembled equations to the CasADi functions of the kernel's contract (model.h)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled, Block, row_depends, terms_of_rates
from frot.compiler.equations.carried_bodies import Carried, carried_bodies
from frot.compiler.equations.parameter_checks import Check, parameter_checks
from frot.compiler.equations.reduce import Reduced
from frot.compiler.lowering.explicit_reactions import make_explicit
from frot.compiler.lowering.first_conditions import first_conditions
from frot.compiler.lowering.groups import Grouping
from frot.compiler.lowering.initial_partition import Part, Scene
from frot.compiler.lowering.initial_values import Initial, Statement, lower_initial
from frot.compiler.lowering.islands import Island, divide
from frot.compiler.lowering.jacobian import Jacobian, make_jacobian, too_full, why_explicit
from frot.compiler.lowering.lower_events import Ranks, lower_update, rank_whens
from frot.compiler.lowering.lower_parameters import lower_parameters, parameters_needed
from frot.compiler.lowering.nonfinite import Watched, watch_numbers
from frot.compiler.lowering.result_variables import FirstIntegral, Listed, list_variables
from frot.compiler.lowering.sort_conditions import sort_conditions
from frot.compiler.lowering.switching import straighten, switching_residual
from frot.compiler.lowering.time_forcing import make_pace
from frot.compiler.mechanics.geometry.vanishing import Vanishing, find_vanishing
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.symbolic.columns import column, dense
from frot.compiler.symbolic.numbers_in_sums import size_of_numbers
from frot.compiler.symbolic.shared_functions import Kind, Member, share_functions
from frot.compiler.translate.expressions import Lowering
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class Lowered:
    """The functions by their names in the contract, and their tables.

    `position_statement` and `velocity_statement` give, for each scalar initial equation, the index
    of its statement in `statements`, ~index of one that is none of the text. `n_guessed`: scalars
    whose places are guessed. `direct`: scalar equations on positions that hold where the search
    begins. `parts` and `speed_parts`: what of places and of speeds is put together alone.
    `n_followed`: unknowns of places that are followed, if one may be of an open contact.
    `blocks` are the functions of the blocks of `system`, `switching` those with the conditions on
    their own unknowns as they are, if there are any.
    Islands and parts are each of one of the `kinds`. `conditions`: the values of all; `ranks`: the
    order of the `when`s.
    """

    reduced: Reduced
    system: Assembled
    grouping: Grouping
    functions: dict[str, ca.Function]
    kinds: tuple[Kind, ...]
    islands: tuple[tuple[Island, Member], ...]
    parts: tuple[tuple[Part, Member], ...]
    speed_parts: tuple[tuple[Part, Member], ...]
    conditions: ca.SX
    blocks: tuple[ca.Function, ...]
    switching: tuple[ca.Function | None, ...]
    carried: tuple[Carried, ...]
    vanishing: tuple[Vanishing, ...]
    checks: tuple[Check, ...]
    variables: tuple[Listed, ...]
    statements: tuple[Statement, ...]
    position_statement: tuple[int, ...]
    velocity_statement: tuple[int, ...]
    n_guessed: int
    direct: tuple[bool, ...]
    kinds_of_places: tuple[int, ...]
    n_followed: int
    row_depends: tuple[tuple[bool, ...], ...]
    dependent: tuple[bool, ...]
    jacobian: Jacobian | None
    watched: tuple[Watched, ...]
    ranks: Ranks
    integrals: tuple[FirstIntegral, ...]


@dataclass(frozen=True, slots=True, eq=False)
class InitialProblem:
    """The statements of `initial`, and what lowered them.

    `display` lowers what is only looked at, `explicit` writes out the formulas of unknowns.
    """

    display: Lowering
    explicit: Callable[[ca.SX], ca.SX]
    initial: Initial


def begin(system: Assembled, log: Log) -> InitialProblem:
    """Lower the statements; those that cannot hold are reported."""
    reduced, explicit = system.reduced, make_explicit(system)
    chains, settled = reduced.text.chains, reduced.variables.settled

    def formula(value: ca.SX) -> ca.SX:
        return explicit(system.resolve(settled(value)))

    display = Lowering(
        reduced.symbols,
        reduced.variables.quantity,
        lambda value: chains.rate(formula(value)),
        log,
        variable=reduced.text.values.__getitem__,
        without_rate=lambda value: chains.without_rate(formula(value)),
    )
    return InitialProblem(display, explicit, lower_initial(system, display, explicit, log))


def lower(
    system: Assembled,
    beginning: InitialProblem,
    grouping: Grouping,
    log: Log,
    integrals: tuple[FirstIntegral, ...] = (),
    extra: tuple[Listed, ...] = (),
) -> Lowered | None:
    """Build every function; what cannot be built is reported.

    `integrals` are listed too, and `extra` after all other variables.
    """
    reduced = system.reduced
    s, resolve, settled = reduced.symbols, system.resolve, reduced.variables.settled
    display, explicit, initial = beginning.display, beginning.explicit, beginning.initial
    variables = (*list_variables(system, display, integrals), *extra)
    located = explicit(system.resolve(column(reduced.conditions.values)))
    conditions, timers = sort_conditions(system, located)
    switching = tuple(_switching(k, b, system, conditions) for k, b in enumerate(system.blocks))
    conditions = straighten(system, conditions)
    watched, equations = watch_numbers(system)
    checks = parameter_checks(reduced.mechanism, s.parameters, system.pivots)
    update = lower_update(system, log)
    values = system.at_rest(resolve(settled(column(v.value for v in variables))))
    if log.failed or not _is_known(values, system, variables, log):
        return None
    given, is_set = ca.SX.sym("given", s.p.numel()), ca.SX.sym("set", s.p.numel())
    state = state_arguments(system)
    solution = [*state, system.z, system.lam]
    islands: tuple[Island, ...] = ()
    if reduced.conditions.sensed == 0:
        grouping, islands = divide(system, grouping, conditions, state)
    outputs: dict[str, tuple[list[ca.SX], list[ca.SX]]] = {
        "parameters": (
            [given, is_set, s.u],
            lower_parameters(display, checks, system, grouping, given, is_set),
        ),
        "start": ([s.t, s.u, s.p], initial.start),
        "beginning": (
            state,
            [*initial.beginning, unsolved(first_conditions(system, display, conditions), system)],
        ),
        "sizes": (
            state,
            [system.force_size, _without_reactions(resolve(reduced.load_sizes), system)],
        ),
        "variables": ([*solution, s.energy], [values]),
        "energy": (
            state,
            [
                resolve(reduced.kinetic),
                resolve(reduced.potential),
                _without_reactions(resolve(reduced.energy_terms), system),
            ],
        ),
    }
    if not islands:
        outputs |= _whole(system, grouping, unsolved(conditions, system), state)
    if reduced.conditions.sensed:
        first = reduced.conditions.located - reduced.conditions.sensed
        outputs["sensed"] = (solution, [conditions[first : reduced.conditions.located]])
    beginnings = _beginnings_of_open(system)
    if beginnings:
        outputs["beginnings"] = (state, beginnings)
    carried = carried_bodies(system)
    if carried:
        outputs["places"] = (state, [column(body.value for body in carried)])
    lost = _vanishing(reduced)
    nowhere = next((x for x in lost if x.distance.is_zero()), None)
    if nowhere is not None:
        log.report("E0911", f"{nowhere.text} everywhere", nowhere.liaison.span)
        return None
    if lost:
        told = column(x.distance for x in lost), ca.horzcat(*(x.where for x in lost))
        outputs["vanishing"] = (state, [resolve(settled(x)) for x in told])
    if reduced.drives.nnz():
        none = ca.SX.zeros(len(system.elements))
        outputs["drives"] = (state, [ca.vertcat(resolve(reduced.drives), none)])
    terms = terms_of_rates(system)
    if terms.nnz():
        outputs["terms"] = (state, [ca.densify(terms)])
    pace = make_pace(system, conditions[: reduced.conditions.located])
    if pace is not None:
        outputs["pace"] = (state, list(pace))
    jacobian = make_jacobian(system, grouping, state)
    if reduced.mechanism.model.experiment.method == "implicit" and jacobian is None:
        why = why_explicit(system) or too_full(system)
        log.report(
            "E0701",
            f"the method 'implicit' is not supported for {why}",
            reduced.mechanism.model.experiment.span,
            help="`auto` and `explicit` are supported",
        )
        return None
    if jacobian is not None:
        outputs["jacobian"] = (jacobian.arguments, jacobian.results)
    if system.late:
        outputs["rates"] = (solution, [system.rates, system.power])
    if system.invariants.origins:
        outputs["invariants"] = (state, _invariants(system))
    if update is not None:
        events = reduced.events
        outputs["update"] = ([*solution, column(events.fired), column(events.before)], update)
    if watched.numel():
        outputs["watched"] = (solution, [watched])
    if reduced.conditions.timed:
        outputs["timers"] = ([s.u, s.p, state[5]], timers)
    functions = {
        name: ca.Function(f"frot_{name}_at", arguments, _clean(results))
        for name, (arguments, results) in outputs.items()
    }
    scene = Scene(system, grouping, islands, initial, _sides(system), state)
    places, speeds = scene.places(), scene.speeds()
    kinds, members = share_functions([*islands, *places, *speeds])
    own = iter(members)
    return Lowered(
        reduced=reduced,
        system=system,
        grouping=grouping,
        functions=functions,
        kinds=kinds,
        islands=tuple((x, next(own)) for x in islands),
        parts=tuple((x, next(own)) for x in places),
        speed_parts=tuple((x, next(own)) for x in speeds),
        conditions=conditions,
        blocks=tuple(_block(f"block_{k}", b, system) for k, b in enumerate(system.blocks)),
        switching=switching,
        carried=carried,
        vanishing=lost,
        checks=checks,
        variables=variables,
        statements=initial.statements,
        position_statement=initial.position_statement,
        velocity_statement=initial.velocity_statement,
        n_guessed=initial.guessed[0].numel() if initial.guessed else 0,
        direct=initial.direct,
        kinds_of_places=initial.kinds,
        n_followed=beginnings[0].numel() if beginnings else 0,
        row_depends=row_depends(system),
        dependent=tuple(bool(parameters_needed(parameter, s)) for parameter in s.parameters),
        jacobian=jacobian,
        watched=tuple(equations),
        ranks=rank_whens(system, conditions, update),
        integrals=integrals,
    )


def _whole(
    system: Assembled, grouping: Grouping, conditions: ca.SX, state: list[ca.SX]
) -> dict[str, tuple[list[ca.SX], list[ca.SX]]]:
    """What islands have of their own where there are several."""
    no_rates = ca.SX.zeros(system.rates.shape)
    outputs = {
        "kinematics": (state, [system.gap, grouping.rows, system.rate, conditions]),
        "dynamics": (
            state,
            [
                no_rates if system.late else system.rates,
                grouping.matrix,
                system.force,
                grouping.rows,
                system.bias,
                system.rate,
                system.gap,
                conditions[: system.reduced.conditions.located],
                system.coefficients,
                ca.SX(0) if system.late else system.power,
            ],
        ),
    }
    if not grouping.is_mass_matrix:
        outputs["spread"] = (state, [grouping.spread, grouping.metric])
    if any(g.composite for g in grouping.groups):
        outputs["wide"] = (state, [grouping.matrix, system.force, grouping.rows])
    return outputs


def _vanishing(reduced: Reduced) -> tuple[Vanishing, ...]:
    """What the figures of the liaisons may lose."""
    own = reduced.variables
    return tuple(find_vanishing(own.links, own.geometry, own.kinematics))


def _sides(system: Assembled) -> tuple[ca.SX, ca.SX]:
    """What chooses the sides, and the reaches; an element of the text has none to choose from."""
    none, reduced = len(system.elements), system.reduced
    return (
        ca.vertcat(system.resolve(reduced.witness), ca.SX.ones(3 * none)),
        ca.vertcat(system.resolve(reduced.reach), ca.SX.zeros(none)),
    )


def _without_reactions(sizes: ca.SX, system: Assembled) -> ca.SX:
    """Sizes of loads as the state gives them, without what accelerations and reactions add."""
    solved = ca.vertcat(system.z, system.lam)
    if not (sizes.numel() and solved.numel()):
        return sizes
    return ca.substitute(sizes, solved, ca.SX.zeros(solved.shape))


def state_arguments(system: Assembled) -> list[ca.SX]:
    """t, q, v, u, p, d, y."""
    s = system.reduced.symbols
    no_sides = ca.SX.sym("no_side", len(system.elements))
    flags = column(system.reduced.conditions.flags)
    d = ca.vertcat(flags, s.sides, no_sides, system.discrete)
    return [s.t, system.q, system.v, s.u, s.p, d, system.y]


def _clean(outputs: list[ca.SX]) -> list[ca.SX]:
    """Dense outputs with common subexpressions shared."""
    return [dense(x) for x in ca.cse([x if type(x) is ca.SX else ca.SX(x) for x in outputs])]


def unsolved(conditions: ca.SX, system: Assembled) -> ca.SX:
    """The values of conditions; -1 for those that follow from accelerations or reactions."""
    later = ca.vertcat(system.z, system.lam, system.y[system.early :, :])
    if not (conditions.numel() and later.numel()):
        return conditions
    return column(
        ca.SX(-1) if ca.depends_on(value, later) else value for value in ca.vertsplit(conditions)
    )


def _is_known(values: ca.SX, system: Assembled, variables: tuple[Listed, ...], log: Log) -> bool:
    """Whether the variables hold nothing but what the kernel knows: no third derivatives."""
    known = {
        x.element_hash()
        for part in (*state_arguments(system), system.z, system.lam, system.reduced.symbols.energy)
        for x in (ca.vertsplit(part) if part.numel() else ())
    }
    if all(x.element_hash() in known for x in ca.symvar(values)):
        return True
    for variable, value in zip(variables, ca.vertsplit(values), strict=True):
        unknown = [x.name() for x in ca.symvar(value) if x.element_hash() not in known]
        if unknown:
            log.report(
                "E0701",
                f"'{variable.name}' needs {unknown[0]}, a derivative of an acceleration: it is not "
                "supported yet",
                system.reduced.mechanism.model.span,
                help="leave it out",
            )
            break
    return False


def _block(name: str, block: Block, system: Assembled) -> ca.Function:
    """Residual, its Jacobian in the block's own unknowns, the size of its terms."""
    own = system.y[block.first : block.first + block.residual.numel()]
    slope = ca.jacobian(block.residual, own)
    size = block.size
    if size is None:
        size = ca.fabs(slope) @ ca.fabs(own) + ca.fabs(block.residual)
        size += size_of_numbers(block.residual, own)
    arguments = state_arguments(system)
    if block.late:
        arguments += [system.z, system.lam]
    return ca.Function(f"frot_{name}", arguments, _clean([block.residual, slope, size]))


def _switching(
    index: int, block: Block, system: Assembled, conditions: ca.SX
) -> ca.Function | None:
    """The same where the conditions on the block's own unknowns are as they are."""
    residual = switching_residual(block, system, conditions)
    if residual is None:
        return None
    return _block(f"switching_{index}", replace(block, residual=residual), system)


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
