"""Assembled equations to the CasADi functions of the kernel's contract (model.h)."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled, row_depends
from frot.compiler.equations.parameter_checks import Check, parameter_checks
from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.groups import Grouping
from frot.compiler.lowering.initial_partition import Part, Scene
from frot.compiler.lowering.initial_problem import InitialProblem
from frot.compiler.lowering.initial_values import Initial
from frot.compiler.lowering.islands import Island, divide
from frot.compiler.lowering.kernel_functions import KernelFunctions, make_functions
from frot.compiler.lowering.lower_parameters import parameters_needed
from frot.compiler.lowering.result_variables import FirstIntegral, Listed
from frot.compiler.lowering.state import state_arguments
from frot.compiler.lowering.switches import Switches
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.shared_functions import Kind, Member, share_functions
from frot.dsl import Log


@dataclass(frozen=True, slots=True, eq=False)
class Shared:
    """Islands and parts of places and speeds, each of one of the `kinds`."""

    kinds: tuple[Kind, ...]
    islands: tuple[tuple[Island, Member], ...]
    parts: tuple[tuple[Part, Member], ...]
    speed_parts: tuple[tuple[Part, Member], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Lowered:
    """The functions of the kernel's contract, and their tables.

    `whole` are the functions of the whole model, `shared` those of its islands and parts.
    `dependent`: of each parameter, whether its default follows from others.
    """

    system: Assembled
    initial: Initial
    grouping: Grouping
    switches: Switches
    whole: KernelFunctions
    shared: Shared
    checks: tuple[Check, ...]
    variables: tuple[Listed, ...]
    row_depends: tuple[tuple[bool, ...], ...]
    dependent: tuple[bool, ...]
    integrals: tuple[FirstIntegral, ...]

    @property
    def reduced(self) -> Reduced:
        """The reduced equations that the system is made from."""
        return self.system.reduced

    @property
    def n_guessed(self) -> int:
        """The number of scalars whose places are guessed."""
        guessed = self.initial.guessed
        return int(guessed[0].numel()) if guessed else 0


def lower(
    system: Assembled,
    problem: InitialProblem,
    switches: Switches,
    grouping: Grouping,
    variables: tuple[Listed, ...],
    integrals: tuple[FirstIntegral, ...],
    log: Log,
    orders: bool = False,
) -> Lowered | None:
    """Build every function; what cannot be built is reported. `orders`: see make_functions."""
    reduced, s = system.reduced, system.reduced.symbols
    checks = parameter_checks(reduced.mechanism, s.parameters, system.pivots)
    without_auxiliary = reduced.variables.without_auxiliary
    values = system.at_rest(system.resolve(without_auxiliary(column(v.value for v in variables))))
    if log.failed or not _is_known(values, system, variables, log):
        return None
    islands: tuple[Island, ...] = ()
    if reduced.conditions.sensed == 0:
        grouping, islands = divide(system, grouping, switches.conditions, state_arguments(system))
    divided = bool(islands)
    whole = make_functions(
        system, problem, switches, grouping, checks, values, divided, log, orders=orders
    )
    if whole is None:
        return None
    return Lowered(
        system=system,
        initial=problem.initial,
        grouping=grouping,
        switches=switches,
        whole=whole,
        shared=_share(system, problem, grouping, islands),
        checks=checks,
        variables=variables,
        row_depends=row_depends(system),
        dependent=tuple(bool(parameters_needed(parameter, s)) for parameter in s.parameters),
        integrals=integrals,
    )


def _share(
    system: Assembled,
    problem: InitialProblem,
    grouping: Grouping,
    islands: tuple[Island, ...],
) -> Shared:
    """Equal islands and parts have one function."""
    state = state_arguments(system)
    scene = Scene(system, grouping, islands, problem.initial, _sides(system), state)
    places, speeds = scene.places(), scene.speeds()
    kinds, members = share_functions([*islands, *places, *speeds])
    own = iter(members)
    return Shared(
        kinds,
        tuple((x, next(own)) for x in islands),
        tuple((x, next(own)) for x in places),
        tuple((x, next(own)) for x in speeds),
    )


def _sides(system: Assembled) -> tuple[ca.SX, ca.SX]:
    """What chooses the sides, and the reaches; an element of the text has none to choose from."""
    none, reduced = len(system.elements), system.reduced
    return (
        ca.vertcat(system.resolve(reduced.motion.witness), ca.SX.ones(3 * none)),
        ca.vertcat(system.resolve(reduced.motion.reach), ca.SX.zeros(none)),
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
