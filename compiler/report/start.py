"""The posture at which a run starts, as the report sees it: found without a compiled program."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.initial_problem import InitialProblem
from frot.compiler.lowering.state import state_arguments, unsolved
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.report.closest_numeric import Followed
from frot.compiler.report.numbers import Floats, Numbers
from frot.compiler.report.relations import Posture, Relations
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.walk import as_number
from frot.dsl import default_values, evaluate
from numpy.typing import NDArray

_STEPS = 60
_HOLDS, _SLIGHT = 1e-10, 1e-3
_TOUCHES = 1e-9
_TRIES, _ASIDE = 6, 0.3


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """Where a run starts, in the coordinates of the reduced mechanism and in those of the system.

    `found`: the statements and relations hold there. `flags` are the conditions of the text there,
    `closed` the contacts that touch.
    """

    posture: Posture
    system_q: Floats
    flags: Floats
    discrete: Floats
    y: Floats
    closed: NDArray[np.bool_]
    found: bool


def may_part(link: Constraint, values: object) -> bool:
    """Whether a link is unilateral, at the default parameters."""
    return as_number(evaluate(link.unilateral, values)) != 0  # type: ignore[arg-type]


def find_start(system: Assembled, problem: InitialProblem) -> Start:
    """The posture that the statements of `initial` and the relations leave nearest to the guesses.

    As the kernel finds it (initial_values.c), with fewer ways out: where it is not found,
    `found` is false.
    """
    reduced, symbols = system.reduced, system.reduced.symbols
    explicit, initial = problem.explicit, problem.initial
    state = state_arguments(system)
    model = reduced.mechanism.model
    values = default_values(model, {})
    u = _numbers(evaluate(i.start, values) for i in symbols.inputs)
    p = _numbers(evaluate(k.value, values) for k in symbols.parameters)
    begin = model.experiment.start
    t = 0.0 if begin is None else as_number(evaluate(begin, values))
    begin_at = Numbers("start", [symbols.t, symbols.u, symbols.p], initial.start)
    q, discrete = (x.ravel() for x in begin_at(t, u, p))
    v, y = np.zeros(system.nv), np.zeros(system.y.numel())
    values_at = Numbers("beginning", state, initial.beginning)

    links = reduced.mechanism.contacts
    parts = np.array([may_part(x, values) for x in links], dtype=bool)
    kept = np.array([x.has_gap for x in links], dtype=bool)
    gap = system.resolve(reduced.motion.matrices.gap)
    stated, slope, size, _ = initial.position
    outputs = [stated, slope.T, size, gap, ca.jacobian(gap, system.q)]
    located = unsolved(explicit(system.resolve(column(reduced.conditions.values))), system)
    witness = system.resolve(reduced.motion.witness)
    look = Numbers("look", state, (witness, located))
    function = Numbers("position", state, outputs)
    direct = np.array(initial.direct, dtype=bool)
    if initial.guessed:
        missed, slopes, _ = initial.guessed
        guesses = Numbers("guessed", state, [missed, slopes.T])
    flags = np.zeros(len(reduced.conditions.flags))
    sides = np.ones(len(links))
    none = np.ones(len(system.elements))

    tracks = reduced.variables.kinematics.tracks.values()
    known = [system.reduced.symbols.t, system.q, system.reduced.symbols.u, symbols.p]
    followed = Followed(tracks, known, system.resolve, reduced.conditions)

    def arguments() -> list[float | Floats]:
        y[: followed.unknowns.numel()] = followed.at(t, q, u, p)
        return [t, q, v, u, p, np.concatenate([flags, sides, none, discrete]), y]

    def settle(used: NDArray[np.bool_]) -> bool:
        nonlocal q
        if not q.size:
            return True
        for _ in range(_STEPS):
            value, slopes, sizes, gaps, rows = function(*arguments())
            short = np.concatenate([value.ravel(), gaps.ravel()[used]])
            down = np.vstack([slopes.reshape(-1, q.size), rows[used].reshape(-1, q.size)])
            scale = np.concatenate([sizes.ravel(), np.abs(rows[used]) @ (np.abs(q) + 1)])
            if not (np.all(np.isfinite(short)) and np.all(np.isfinite(down))):
                return False
            if np.all(np.abs(short) <= _HOLDS * (scale + _SLIGHT)):
                return True
            step = np.linalg.lstsq(down, -short, rcond=1e-10)[0]
            longest = np.max(np.abs(step) / (1 + np.abs(q)), initial=0.0)
            q = q + step / max(1.0, longest / 0.7)
        return False

    def settle_from_elsewhere(used: NDArray[np.bool_]) -> bool:
        """From places aside too: where rods lie in a line no small step closes their loop."""
        nonlocal q
        begun, aside = q.copy(), np.random.default_rng(0)
        for k in range(_TRIES):
            if settle(used):
                return True
            q = begun + _ASIDE * (k + 1) * aside.uniform(-1, 1, q.size)
        return settle(used)

    def meet_guesses() -> None:
        nonlocal q
        for _ in range(_STEPS):
            missed, slopes = guesses(*arguments())
            value, own, *_ = function(*arguments())
            short = np.concatenate([value.ravel()[direct], missed.ravel()])
            down = np.vstack([own.reshape(-1, q.size)[direct], slopes.reshape(-1, q.size)])
            if not (np.all(np.isfinite(short)) and np.all(np.isfinite(down))):
                return
            step = np.linalg.lstsq(down, -short, rcond=1e-10)[0]
            longest = np.max(np.abs(step) / (1 + np.abs(q)))
            q = q + step / max(1.0, longest / 0.7)
            if longest <= _HOLDS:
                return

    def choose_sides() -> None:
        three = look(*arguments())[0].reshape(-1, 3)
        for k, one in enumerate(three[: len(links)]):
            known = one[np.abs(one) > _TOUCHES]
            sides[k] = np.sign(known[0]) if known.size else 1.0

    if initial.guessed:
        meet_guesses()
    v, y = (x.ravel() for x in values_at(*arguments()))
    used = np.zeros(len(links), dtype=bool)
    settle(used)
    choose_sides()
    used = kept & ~parts
    settle_from_elsewhere(used)
    choose_sides()
    lengths = 1 + np.max(np.abs(q), initial=0.0)
    for _ in range(len(links) + 1):
        found = settle_from_elsewhere(used)
        gaps = function(*arguments())[3].ravel()
        below = kept & ~used & (gaps < -_TOUCHES * lengths)
        if not below.any():
            break
        used |= below
    flags = (look(*arguments())[1].ravel() > 0).astype(float)
    gaps = function(*arguments())[3].ravel()
    own = Numbers("own", state, [system.resolve(symbols.q)])
    posture = Posture(t, own(*arguments())[0].ravel(), u, p, sides)
    closed = kept & (np.abs(gaps) <= _TOUCHES * lengths)
    return Start(posture, q, flags, discrete, y, closed, found)


def _numbers(values: Iterable[object]) -> Floats:
    return np.array([as_number(x) for x in values], dtype=np.float64)


def posture_of(relations: Relations, system: Assembled, start: Start) -> Posture:
    """The same posture in the coordinates of bodies that are free of each other."""
    variables, own = system.reduced.variables, system.reduced.symbols
    known = {x.name(): x for x in scalars_of(own.q)}
    values: list[ca.SX] = []
    for hanging in relations.mechanism.coordinates:
        for name in hanging.names:
            if name in known:
                values.append(known[name])
                continue
            part, place = _component(name.removeprefix(f"{hanging.body.name}."))
            values.append(scalars_of(variables.of_body(hanging.body, part))[place])
    for link, k in relations.mechanism.counters:
        values.append(variables.coordinate(link.liaison, k)[0])
    there = start.posture
    tracks = variables.kinematics.tracks.values()
    followed = Followed(tracks, [own.t, own.q, own.u, own.p], conditions=system.reduced.conditions)
    now = [own.t, own.q, own.u, own.p, own.sides, followed.unknowns]
    function = Numbers("free", now, [column(values)])
    places = followed.at(there.t, there.q, there.u, there.p)
    q = function(*there.arguments, places)[0].ravel()
    sides = np.ones(len(relations.links))
    return relations.sided(Posture(there.t, q, there.u, there.p, sides))


def _component(name: str) -> tuple[str, int]:
    """`position.y` is the second item of `position`, `orientation[3]` the third of its own."""
    head, _, axis = name.partition(".")
    if axis:
        return head, "xyz".index(axis)
    head, _, number = name.partition("[")
    return head, int(number.rstrip("]")) - 1 if number else 0
