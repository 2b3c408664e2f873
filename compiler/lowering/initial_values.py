"""What `initial` says, sorted for the kernel: positions, then velocities, and guesses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.initial_rates import finds_places, given_speeds, holds_at_rest
from frot.compiler.lowering.guesses import (
    guessed_halves,
    guessed_places,
    guessed_speeds,
    guessed_states,
    list_guesses,
    move_by,
    natural_places,
    natural_unknowns,
    values_of,
)
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import replace_known
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.previous_values import whole
from frot.compiler.translate.text_symbols import scalars
from frot.compiler.translate.walk import is_fixed
from frot.dsl import Log
from frot.dsl.checked import InitialEquation
from frot.dsl.messages.source import Span
from frot.dsl.quantities.dimensions import Dimension

# frot_statement_kind of the kernel.
_PLAIN, _BALANCE, _OPTIONAL, _COUNTER = range(4)


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement that the kernel can blame: its text, its place and the unit of its sides."""

    text: str
    span: Span
    unit: str


@dataclass(frozen=True, slots=True, eq=False)
class Initial:
    """Outputs of the functions of the start, and the statements behind.

    `direct`: the scalar equations on positions that hold where the search begins, whatever is
    guessed; `kinds`: what they are (frot_statement_kind). `vectors`: of each
    guessed scalar the first item of its vector.
    `guessed_dimensions`: of each guess of a speed.
    """

    start: list[ca.SX]
    beginning: list[ca.SX]
    position: list[ca.SX]
    velocity: list[ca.SX]
    statements: tuple[Statement, ...]
    position_statement: tuple[int, ...]
    velocity_statement: tuple[int, ...]
    direct: tuple[bool, ...]
    kinds: tuple[int, ...]
    guessed: list[ca.SX]
    vectors: tuple[int, ...]
    guessed_speeds: list[ca.SX]
    guessed_dimensions: tuple[Dimension, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Residual:
    """A statement that something is zero; `only`: the one unknown that is to make it so.

    `solved`: it is on an acceleration or a reaction, of which `implicit` speaks. `statement` s < 0
    is that of ~s, which is none of the text, but keeps a quaternion's length or an angle within
    half a turn of its count. `kind`: frot_statement_kind.
    `direct`: it gives a state its value, where the search begins.
    """

    value: ca.SX
    size: ca.SX
    statement: int
    only: ca.SX | None = None
    solved: bool = False
    implicit: ca.SX | None = None
    kind: int = _PLAIN
    direct: bool = False


def lower_initial(
    system: Assembled, display: Lowering, explicit: Callable[[ca.SX], ca.SX], log: Log
) -> Initial:
    """Lower the statements; one that cannot hold for positions and velocities is reported.

    `explicit` writes accelerations and reactions out where they are formulas.
    """
    model = system.reduced.mechanism.model
    statements = [_statement(e) for e in model.initial]
    found: list[_Residual] = []
    solved = (system.z, system.lam, system.y[system.early :, :])
    later = {x.element_hash() for part in solved for x in scalars_of(part)}
    for index, equation in enumerate(model.initial):
        if not equation.guess and not _sets_memory(equation, system):
            found += _residuals(index, equation, system, display, explicit, later, log)
    direct, complete = _direct(found, system)
    found = _placed(found, direct, system, statements, log)
    guesses = list_guesses(system, display)
    # values that are stated one by one are where the search begins, or all there is to find
    natural = _with(system.q, natural_places(system), guessed_halves(system, guesses) | direct)
    natural = move_by(system, [g for g in guesses if g.start], system.q, natural, direct)
    stated = direct | guessed_states(system, guesses, direct)
    natural = _with(system.q, natural, stated)
    known = direct | values_of(system.q, system.q)
    v = _with(system.v, ca.SX.zeros(system.v.shape), direct)
    v = move_by(system, [g for g in guesses if g.left.is_symbolic()], system.v, v, known)
    guessed, vectors = guessed_places(system, guesses, stated)
    moved, dimensions = guessed_speeds(system, guesses, direct)
    turns = system.reduced.symbols.turns
    kept = all(link.reduced for link in system.reduced.mechanism.contacts)
    relations = turns or not kept or system.invariants.origins
    if complete and not relations:
        found = []
    found += _kept_by_states(system, statements)
    moving = [_depends(r.value, system, system.v) for r in found]
    position = [r for r, m in zip(found, moving, strict=True) if not m]
    velocity = [r for r, m in zip(found, moving, strict=True) if m]
    known |= values_of(system.v, v)
    y_start = move_by(system, guesses, system.y, natural_unknowns(system), known)
    discrete = column(d.start for d in system.reduced.text.memory)
    return Initial(
        start=[natural, discrete],
        beginning=[v, y_start],
        position=_outputs(position, system.q, system.y),
        velocity=_outputs(velocity, system.v, system.y),
        statements=tuple(statements),
        position_statement=tuple(r.statement for r in position),
        velocity_statement=tuple(r.statement for r in velocity),
        direct=tuple(r.statement < 0 or r.direct for r in position),
        kinds=tuple(r.kind for r in position),
        guessed=guessed,
        vectors=vectors,
        guessed_speeds=moved,
        guessed_dimensions=dimensions,
    )


def _kept_by_states(system: Assembled, statements: list[Statement]) -> list[_Residual]:
    """What states keep by themselves: lengths of quaternions, counted turns, invariants.

    `statements` gains their words.
    """
    model = system.reduced.mechanism.model
    found: list[_Residual] = []
    for turn in system.reduced.symbols.turns:
        unit = system.q[turn.coordinate : turn.coordinate + 4]
        found.append(_Residual(ca.sumsqr(unit) - 1, ca.sumsqr(unit) + 1, ~len(statements)))
        name = unit[0].name().removesuffix("[1]")
        bodies = (b.span for b in model.bodies if name == f"{b.name}.orientation")
        span = next(bodies, None) or model.span
        text = f"{name} is a unit quaternion (cos(f/2), sin(f/2)*n)"
        statements.append(Statement(text, span, "1"))
    for counter, angle, link in _counted(system):
        own = ca.atan2(ca.sin(angle - counter), ca.cos(angle - counter))
        found.append(_Residual(own, ca.SX(1), ~len(statements), counter, kind=_COUNTER))
        text = f"the turns of {link.liaison.name}"
        statements.append(Statement(text, link.liaison.span, "1"))
    for value, origin in zip(
        ca.vertsplit(system.invariants.values) if system.invariants.origins else (),
        system.invariants.origins,
        strict=True,
    ):
        found.append(_Residual(value, _size(value, system), len(statements)))
        statements.append(Statement(origin.text, origin.span, "1"))
    return found


def _placed(
    found: list[_Residual],
    direct: Mapping[int, ca.SX],
    system: Assembled,
    statements: list[Statement],
    log: Log,
) -> list[_Residual]:
    """The statements, where those on accelerations that find places hold at given speeds.

    One that holds in any equilibrium is optional among those on places where others find them: a
    chain has fewer freedoms than links that are at rest.
    """
    of_places = [r.value for r in found if not r.solved and not _depends(r.value, system, system.v)]
    of_speeds = [r.value for r in found if not r.solved and _depends(r.value, system, system.v)]
    speeds = given_speeds(of_speeds, direct, system) if any(r.solved for r in found) else None
    placed: list[_Residual] = []
    for residual in found:
        moves = residual.solved and _depends(residual.value, system, system.v)
        at_rest = speeds is not None and holds_at_rest(residual.implicit, speeds, system)
        if at_rest:
            residual = replace(residual, kind=_BALANCE)
        if moves and finds_places(residual.value, of_places, system):
            if speeds is None:
                log.report(
                    "E0602",
                    "this initial statement is to find places, at speeds that follow from other "
                    "statements or from liaisons",
                    statements[residual.statement].span,
                    help="state these speeds one by one, or the places",
                )
                continue
            residual = _at(residual, speeds)
        elif moves and speeds is not None and at_rest:
            placed.append(replace(_at(residual, speeds), kind=_OPTIONAL))
        if residual.solved and not _depends(residual.value, system, system.v):
            of_places.append(residual.value)
        elif residual.solved:
            # It is zero where terms of places cancel, which no speed is a factor of.
            terms = residual.value if speeds is None else replace_known(residual.value, speeds)
            residual = replace(residual, size=residual.size + _size(terms, system))
        placed.append(residual)
    return placed


def _at(residual: _Residual, speeds: Mapping[int, ca.SX]) -> _Residual:
    value, size = (replace_known(x, speeds) for x in (residual.value, residual.size))
    return replace(residual, value=value, size=size)


def _counted(system: Assembled) -> Iterator[tuple[ca.SX, ca.SX, Constraint]]:
    """Each counter with the angle it counts, which is within half a turn of it."""
    reduced = system.reduced
    mechanism, kinematics = reduced.mechanism, reduced.variables.kinematics
    for (link, k), counter in zip(mechanism.counters, kinematics.counters.values(), strict=True):
        angle, _ = reduced.variables.coordinate(link.liaison, k)
        yield counter, reduced.variables.without_auxiliary(angle), link


def _statement(equation: InitialEquation) -> Statement:
    from frot.compiler.lowering.units import unit_of

    text = " ".join(equation.span.text.split()).rstrip("; ")
    text = f"{text} {equation.place}".rstrip()
    return Statement(text, equation.span, unit_of(equation.left.type.dimension).name)


def _sets_memory(equation: InitialEquation, system: Assembled) -> bool:
    """Whether a statement gives what changes at events only its first value."""
    named = whole(equation.left)
    if named is None:
        return False
    variable, _ = named
    own = scalars(system.reduced.text.values[variable])
    held = system.reduced.text.held
    return variable.discrete or any(ca.is_equal(h.value, x) for h in held for x in own)


def _residuals(
    index: int,
    equation: InitialEquation,
    system: Assembled,
    display: Lowering,
    explicit: Callable[[ca.SX], ca.SX],
    later: set[int],
    log: Log,
) -> list[_Residual]:
    """`later`: symbols of what is solved with the core or after it."""
    fixed = is_fixed(equation.left) and is_fixed(equation.right)
    if fixed or equation.left.type.base == "boolean":
        log.report(
            "E0602",
            "this initial statement depends on nothing that can change"
            if fixed
            else "this condition follows from the equations: no 'when' sets it",
            equation.span,
            help="state a coordinate, a speed or a state, or leave it out",
        )
        return []
    without_auxiliary = system.reduced.variables.without_auxiliary
    left = system.resolve(without_auxiliary(display.lower(equation.left)))
    right = system.resolve(without_auxiliary(display.lower(equation.right)))
    implicit = left - right
    solved = ca.depends_on(implicit, ca.vertcat(system.z, system.lam))
    left, right = explicit(left), explicit(right)
    difference = left - right
    if any(x.element_hash() in later for x in ca.symvar(difference)):
        log.report(
            "E0602",
            "this initial statement is on an acceleration, a reaction or what follows from them, "
            "which friction, a contact that parts or the equations decide when the state is known",
            equation.span,
            help="state positions and velocities",
        )
        return []
    sizes = ca.fabs(left) + ca.fabs(right)
    return [
        _Residual(value, size, index, solved=solved, implicit=own if solved else None)
        for value, size, own in zip(
            scalars(difference),
            scalars(ca.SX.zeros(difference.shape) + sizes),
            scalars(implicit),
            strict=True,
        )
    ]


def _direct(found: list[_Residual], system: Assembled) -> tuple[dict[int, ca.SX], bool]:
    """The values of states that statements give one by one, and whether all statements do that.

    One may speak of states that others give (the angle of a body at the end of a chain): each is
    taken when one state of it is left, so that large trees need no system for all of them.
    Those that do are marked in `found`.
    """
    states = {s.element_hash() for s in (*scalars_of(system.q), *scalars_of(system.v))}
    moving = states | {s.element_hash() for s in scalars_of(system.y)}
    known = system.reduced.symbols
    given = {s.element_hash() for part in (known.t, known.u, known.p) for s in scalars_of(part)}
    symbols = [{s.element_hash(): s for s in ca.symvar(r.value)} for r in found]
    left = [own.keys() & moving for own in symbols]
    behind: dict[int, list[int]] = {}
    for i, own in enumerate(left):
        for key in own:
            behind.setdefault(key, []).append(i)
    values: dict[int, ca.SX] = {}
    named: list[ca.SX] = []
    ready = [i for i, own in enumerate(left) if len(own) == 1]
    for i in ready:  # grows
        if len(left[i]) != 1:
            continue
        key = next(iter(left[i]))
        symbol = symbols[i][key]
        slope = ca.jacobian(found[i].value, symbol)
        # What coordinates keep says nothing of them, though its terms are still there.
        if not slope.is_constant() or slope.is_zero() or key not in states:
            continue
        value = -ca.substitute(found[i].value, symbol, ca.SX(0)) / slope
        # What conditions switch is known only with the values that they look at.
        if not all(s in given or s in values for s in symbols[i].keys() - {key}):
            continue
        values[key] = value
        found[i] = replace(found[i], direct=True)
        named.append(symbol)
        for k in behind[key]:
            left[k] = left[k] - {key}
            if len(left[k]) == 1:
                ready.append(k)
    if named:
        written, _ = ca.substitute_inplace(named, list(values.values()), [], False)
        values = dict(zip(values, written, strict=True))
    return values, len(values) == len(found)


def _with(symbols: ca.SX, guess: ca.SX, direct: dict[int, ca.SX]) -> ca.SX:
    """The guess, replaced where a value is given."""
    pairs = zip(scalars_of(symbols), scalars_of(guess), strict=True)
    return column(direct.get(s.element_hash(), g) for s, g in pairs)


def _size(value: ca.SX, system: Assembled) -> ca.SX:
    """Size of the terms of a relation: what each state could change in it."""
    states = ca.vertcat(system.q, system.v)
    slope = ca.jacobian(value, states)
    return ca.fabs(slope) @ ca.fabs(states)


def _depends(value: ca.SX, system: Assembled, on: ca.SX) -> bool:
    """Whether a value depends on speeds, itself or through the blocks."""
    if not on.numel():
        return False
    if ca.depends_on(value, on):
        return True
    early = [b for b in system.blocks if not b.late]
    if not early or not ca.depends_on(value, system.y[: system.early, :]):
        return False
    return any(bool(ca.depends_on(b.residual, on)) for b in early)


def _outputs(residuals: list[_Residual], unknown: ca.SX, y: ca.SX) -> list[ca.SX]:
    values = column(r.value for r in residuals)
    slopes, by_y = ca.jacobian(values, unknown), ca.jacobian(values, y)
    for i, residual in enumerate(residuals):
        if residual.only is not None:
            slopes[i, :], by_y[i, :] = -ca.jacobian(residual.only, unknown), 0
    return [
        values,
        ca.sparsify(slopes).T,
        column(r.size for r in residuals),
        ca.sparsify(by_y).T,
    ]
