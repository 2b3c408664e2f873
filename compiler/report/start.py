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
    `found` is false. tests/report/test_start_of_the_report.py compares both.
    """
    search = _StartSearch(system, problem)
    return search.found()


class _StartSearch:
    """The state of the search: `q`, `v`, `y`, flags and sides are those of the last try."""

    def __init__(self, system: Assembled, problem: InitialProblem) -> None:
        reduced, initial = system.reduced, problem.initial
        symbols, links = reduced.symbols, reduced.mechanism.contacts
        model, state = reduced.mechanism.model, state_arguments(system)
        values = default_values(model, {})
        self._system = system
        self.u = _numbers(evaluate(i.start, values) for i in symbols.inputs)
        self.p = _numbers(evaluate(k.value, values) for k in symbols.parameters)
        start = model.experiment.start
        self.t = 0.0 if start is None else as_number(evaluate(start, values))
        first = Numbers("start", [symbols.t, symbols.u, symbols.p], initial.start)
        self.q, self.discrete = (x.ravel() for x in first(self.t, self.u, self.p))
        self.v, self.y = np.zeros(system.nv), np.zeros(system.y.numel())
        self.flags = np.zeros(len(reduced.conditions.flags))
        self._ends = np.array([k >= 0 for k in reduced.conditions.contacts], dtype=bool)
        self.sides, self._none = np.ones(len(links)), np.ones(len(system.elements))
        self._parts = np.array([may_part(x, values) for x in links], dtype=bool)
        self._kept = np.array([x.has_gap for x in links], dtype=bool)
        self._direct = np.array(initial.direct, dtype=bool)
        gap = system.resolve(reduced.motion.matrices.gap)
        stated, slope, size, _ = initial.position
        outputs = [stated, slope.T, size, gap, ca.jacobian(gap, system.q)]
        self._position = Numbers("position", state, outputs)
        conditions = problem.explicit(system.resolve(column(reduced.conditions.values)))
        witness = system.resolve(reduced.motion.witness)
        self._look = Numbers("look", state, (witness, unsolved(conditions, system)))
        self._beginning = Numbers("beginning", state, initial.beginning)
        self._guesses = None
        if initial.guessed:
            missed, slopes, _ = initial.guessed
            self._guesses = Numbers("guessed", state, [missed, slopes.T])
        tracks = reduced.variables.kinematics.tracks.values()
        known = [symbols.t, system.q, symbols.u, symbols.p]
        self._followed = Followed(tracks, known, system.resolve, reduced.conditions)

    def found(self) -> Start:
        """The start, whether all hold there or not."""
        if self._guesses is not None:
            self._meet_guesses(self._guesses)
        self.v, self.y = (x.ravel() for x in self._beginning(*self._state()))
        self._settle(np.zeros(len(self.sides), dtype=bool))
        self._choose_sides()
        used = self._kept & ~self._parts
        self._settle_from_elsewhere(used)
        self._choose_sides()
        lengths = 1 + np.max(np.abs(self.q), initial=0.0)
        for _ in range(len(self.sides) + 1):
            found = self._settle_from_elsewhere(used)
            self._pass_ends()
            below = self._kept & ~used & (self._gaps() < -_TOUCHES * lengths)
            if not below.any():
                break
            used |= below
        self.flags = (self._look(*self._state())[1].ravel() > 0).astype(float)
        closed = self._kept & (np.abs(self._gaps()) <= _TOUCHES * lengths)
        symbols = self._system.reduced.symbols
        own = Numbers("own", state_arguments(self._system), [self._system.resolve(symbols.q)])
        q = own(*self._state())[0].ravel()
        posture = Posture(self.t, q, self.u, self.p, self.sides)
        return Start(posture, self.q, self.flags, self.discrete, self.y, closed, found)

    def _state(self) -> list[float | Floats]:
        """The arguments of the kernel's functions, with figures where they touch."""
        self.y[: self._followed.unknowns.numel()] = self._followed.at(
            self.t, self.q, self.u, self.p
        )
        d = np.concatenate([self.flags, self.sides, self._none, self.discrete])
        return [self.t, self.q, self.v, self.u, self.p, d, self.y]

    def _gaps(self) -> Floats:
        return self._position(*self._state())[3].ravel()

    def _settle(self, used: NDArray[np.bool_]) -> bool:
        """Let statements and the gaps `used` hold, by the shortest steps; whether they do."""
        if not self.q.size:
            return True
        for _ in range(_STEPS):
            value, slopes, sizes, gaps, rows = self._position(*self._state())
            short = np.concatenate([value.ravel(), gaps.ravel()[used]])
            down = np.vstack([slopes.reshape(-1, self.q.size), rows[used].reshape(-1, self.q.size)])
            scale = np.concatenate([sizes.ravel(), np.abs(rows[used]) @ (np.abs(self.q) + 1)])
            if not (np.all(np.isfinite(short)) and np.all(np.isfinite(down))):
                return False
            if np.all(np.abs(short) <= _HOLDS * (scale + _SLIGHT)):
                return True
            step = np.linalg.lstsq(down, -short, rcond=1e-10)[0]
            longest = np.max(np.abs(step) / (1 + np.abs(self.q)), initial=0.0)
            self.q = self.q + step / max(1.0, longest / 0.7)
        return False

    def _settle_from_elsewhere(self, used: NDArray[np.bool_]) -> bool:
        """From places aside too: where rods lie in a line no small step closes their loop."""
        begun, aside = self.q.copy(), np.random.default_rng(0)
        for k in range(_TRIES):
            if self._settle(used):
                return True
            self.q = begun + _ASIDE * (k + 1) * aside.uniform(-1, 1, self.q.size)
        return self._settle(used)

    def _meet_guesses(self, guesses: Numbers) -> None:
        """Go to the places guessed, with the statements that give states their values."""
        for _ in range(_STEPS):
            missed, slopes = guesses(*self._state())
            value, own, *_ = self._position(*self._state())
            short = np.concatenate([value.ravel()[self._direct], missed.ravel()])
            stated = own.reshape(-1, self.q.size)[self._direct]
            down = np.vstack([stated, slopes.reshape(-1, self.q.size)])
            if not (np.all(np.isfinite(short)) and np.all(np.isfinite(down))):
                return
            step = np.linalg.lstsq(down, -short, rcond=1e-10)[0]
            longest = np.max(np.abs(step) / (1 + np.abs(self.q)))
            self.q = self.q + step / max(1.0, longest / 0.7)
            if longest <= _HOLDS:
                return

    def _pass_ends(self) -> None:
        """Set the flags of what is beyond the ends of figures."""
        beyond = self._look(*self._state())[1].ravel() > 0
        self.flags[self._ends] = beyond[self._ends]

    def _choose_sides(self) -> None:
        """The sign of the first witness that is not zero, of each contact."""
        three = self._look(*self._state())[0].reshape(-1, 3)
        for k, one in enumerate(three[: len(self.sides)]):
            known = one[np.abs(one) > _TOUCHES]
            self.sides[k] = np.sign(known[0]) if known.size else 1.0


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
