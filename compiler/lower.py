"""Reduced equations to the CasADi functions of the kernel's contract (runtime/kernel/frot.h)."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.checks import Check, parameter_checks
from frot.compiler.expressions import Lowering
from frot.compiler.listing import Listed, list_variables
from frot.compiler.reduce import Reduced
from frot.compiler.symbols import column
from frot.compiler.walk import is_fixed, subexpressions
from frot.dsl import Log
from frot.dsl.checked import InitialEquation, Parameter, Reference


@dataclass(frozen=True, slots=True, eq=False)
class Lowered:
    """The functions by their names in the contract, and their tables.

    `position_statement` and `velocity_statement` give, for each scalar initial equation, the index
    of its statement in `statements`.
    """

    reduced: Reduced
    functions: dict[str, ca.Function]
    checks: tuple[Check, ...]
    variables: tuple[Listed, ...]
    statements: tuple[InitialEquation, ...]
    position_statement: tuple[int, ...]
    velocity_statement: tuple[int, ...]
    row_depends: tuple[tuple[bool, ...], ...]
    dependent: tuple[bool, ...]


def lower(reduced: Reduced, log: Log) -> Lowered | None:
    """Build every function; what cannot be built is reported."""
    s = reduced.symbols
    flags = column(reduced.conditions.flags)
    d = ca.vertcat(flags, s.sides)
    y = ca.SX.sym("y", 0)
    state = [s.t, s.q, s.v, s.u, s.p, d, y]
    z = ca.SX.sym("z", s.v.numel() + s.w.numel())
    looking = Lowering(s, reduced.variables.quantity, reduced.variables.rate, log)
    initial = _initial(reduced, looking, log)
    variables = list_variables(reduced, looking)
    checks = parameter_checks(reduced.mechanism)
    given, is_set = ca.SX.sym("given", s.p.numel()), ca.SX.sym("set", s.p.numel())
    if log.failed:
        return None
    settled = reduced.variables.settled
    conditions = column(reduced.conditions.values)
    rows = reduced.rows.T
    functions = {
        "parameters": ca.Function(
            "frot_parameters",
            [given, is_set, s.u],
            _clean(_parameters(reduced, looking, checks, given, is_set)),
        ),
        "start": ca.Function("frot_start_guess", [s.t, s.u, s.p], _clean(initial.guess)),
        "initial_position": ca.Function("frot_initial_position", state, _clean(initial.position)),
        "initial_velocity": ca.Function("frot_initial_velocity", state, _clean(initial.velocity)),
        "kinematics": ca.Function(
            "frot_kinematics_at",
            state,
            _clean([reduced.gap, rows, reduced.rate, conditions, reduced.distance]),
        ),
        "dynamics": ca.Function(
            "frot_dynamics_at",
            state,
            _clean(
                [
                    s.v,
                    reduced.mass,
                    reduced.force,
                    rows,
                    reduced.bias,
                    reduced.rate,
                    reduced.gap,
                    conditions,
                    reduced.coefficients,
                    reduced.power,
                ]
            ),
        ),
        "sizes": ca.Function(
            "frot_sizes_at", state, _clean([reduced.force_size, reduced.load_sizes])
        ),
        "variables": ca.Function(
            "frot_variables_at",
            [*state, z, s.lam, s.energy],
            _clean([_of_solution(settled(column([v.value for v in variables])), s.a, z)]),
        ),
        "energy": ca.Function(
            "frot_energy_at", state, _clean([reduced.kinetic, reduced.potential])
        ),
    }
    return Lowered(
        reduced,
        functions,
        checks,
        variables,
        reduced.mechanism.model.initial,
        initial.position_statement,
        initial.velocity_statement,
        _row_depends(reduced),
        tuple(_depends_on_parameters(parameter) for parameter in s.parameters),
    )


def _of_solution(values: ca.SX, accelerations: ca.SX, z: ca.SX) -> ca.SX:
    """Values of the accelerations as values of z, which begins with them."""
    return ca.substitute(values, accelerations, z[: accelerations.numel()])


def _clean(outputs: list[ca.SX]) -> list[ca.SX]:
    """Dense outputs with common subexpressions shared."""
    return [ca.densify(x) for x in ca.cse([ca.SX(x) for x in outputs])]


def _depends_on_parameters(parameter: Parameter) -> bool:
    return any(
        isinstance(node, Reference)
        and isinstance(node.target, Parameter)
        and not node.target.constant
        for node in subexpressions(parameter.value)
    )


def _parameters(
    reduced: Reduced, looking: Lowering, checks: tuple[Check, ...], given: ca.SX, is_set: ca.SX
) -> list[ca.SX]:
    """Parameters in the order in which they depend on each other, then all that depends on them."""
    s = reduced.symbols
    resolved: dict[Parameter, ca.SX] = {}

    def resolve(parameter: Parameter) -> ca.SX:
        if parameter in resolved:
            return resolved[parameter]
        i = s.parameters.index(parameter)
        if not _depends_on_parameters(parameter):
            resolved[parameter] = given[i]
            return given[i]
        for node in subexpressions(parameter.value):
            if isinstance(node, Reference) and node.target in s.parameters:
                resolve(node.target)
        value = complete(looking.lower(parameter.value))
        resolved[parameter] = ca.if_else(is_set[i] != 0, given[i], value)
        return resolved[parameter]

    def complete(value: ca.SX) -> ca.SX:
        """The value with every parameter in it replaced by what it is."""
        known = list(resolved)
        symbols = column([s.p[s.parameters.index(p)] for p in known])
        return ca.substitute(value, symbols, column([resolved[p] for p in known]))

    for parameter in s.parameters:
        resolve(parameter)
    experiment = reduced.mechanism.model.experiment
    times = [
        ca.SX.nan() if e is None else looking.lower(e)
        for e in (experiment.start, experiment.stop, experiment.tolerance, experiment.interval)
    ]
    outputs = [
        column([looking.lower(check.value) for check in checks]),
        column([looking.lower(c.unilateral) for c in reduced.mechanism.contacts]),
        column(times),
    ]
    return [
        column([resolved[p] for p in s.parameters]),
        *(complete(output) for output in outputs),
    ]


@dataclass(frozen=True, slots=True, eq=False)
class _Initial:
    guess: list[ca.SX]
    position: list[ca.SX]
    velocity: list[ca.SX]
    position_statement: tuple[int, ...]
    velocity_statement: tuple[int, ...]


def _initial(reduced: Reduced, looking: Lowering, log: Log) -> _Initial:
    """Initial equations sorted into those of positions and those of velocities."""
    s = reduced.symbols
    residuals: dict[bool, list[ca.SX]] = {False: [], True: []}
    sizes: dict[bool, list[ca.SX]] = {False: [], True: []}
    statements: dict[bool, list[int]] = {False: [], True: []}
    for index, equation in enumerate(reduced.mechanism.model.initial):
        if equation.guess:
            continue
        if is_fixed(equation.left) and is_fixed(equation.right):
            log.report(
                "E0602",
                "this initial statement depends on nothing that can change",
                equation.span,
                help="state a coordinate or a velocity of a body or liaison, or leave it out",
            )
            continue
        left = reduced.variables.settled(looking.lower(equation.left))
        right = reduced.variables.settled(looking.lower(equation.right))
        difference = left - right
        if any(x.numel() and ca.depends_on(difference, x) for x in (s.a, s.lam)):
            log.report(
                "E0701",
                "an initial statement on an acceleration or a reaction is not supported yet",
                equation.span,
                help="state positions and velocities",
            )
            continue
        for i in range(difference.numel()):
            moving = bool(s.v.numel() and ca.depends_on(difference[i], s.v))
            residuals[moving].append(difference[i])
            sizes[moving].append(ca.fabs(left[i]) + ca.fabs(right[i]))
            statements[moving].append(index)
    position, velocity = column(residuals[False]), column(residuals[True])
    return _Initial(
        [
            _guess(reduced, looking, s.q, log),
            _guess(reduced, looking, s.v, log),
            ca.SX(0, 1),
            ca.SX(0, 1),
        ],
        [position, ca.jacobian(position, s.q).T, column(sizes[False]), ca.SX(0, len(sizes[False]))],
        [velocity, ca.jacobian(velocity, s.v).T, column(sizes[True]), ca.SX(0, len(sizes[True]))],
        tuple(statements[False]),
        tuple(statements[True]),
    )


def _guess(reduced: Reduced, looking: Lowering, unknown: ca.SX, log: Log) -> ca.SX:
    """Where the search for the nearest values starts: zero, moved by the `guess` statements."""
    s = reduced.symbols
    value = ca.SX.zeros(unknown.numel())
    for equation in reduced.mechanism.model.initial:
        if not equation.guess or not is_fixed(equation.right):
            continue
        left = reduced.variables.settled(looking.lower(equation.left))
        right = looking.lower(equation.right)
        for i in range(left.numel()):
            if not unknown.numel() or not ca.depends_on(left[i], unknown):
                continue
            if unknown is s.q and s.v.numel() and ca.depends_on(left[i], s.v):
                continue
            zero = [ca.SX.zeros(s.q.shape), ca.SX.zeros(s.v.shape)]
            here, slope = ca.substitute([left[i], ca.jacobian(left[i], unknown)], [s.q, s.v], zero)
            square = ca.sumsqr(slope)  # zero where the pose shows no way to the value guessed
            value += ca.if_else(square > 0, slope.T * (right[i] - here) / square, 0)
    return value


def _row_depends(reduced: Reduced) -> tuple[tuple[bool, ...], ...]:
    """For each row: on which coordinates, and last whether on time, its Jacobian depends."""
    s = reduced.symbols
    table: list[tuple[bool, ...]] = []
    for r in range(reduced.rows.size1()):
        row = reduced.rows[r, :]
        table.append(
            (
                *(bool(ca.depends_on(row, s.q[k])) for k in range(s.q.numel())),
                bool(ca.depends_on(ca.horzcat(row, reduced.rate[r]), s.t)),
            )
        )
    return tuple(table)
