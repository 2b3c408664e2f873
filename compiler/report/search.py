"""Random states of a mechanism, and what functions of the state do there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.report.numbers import Floats, Numbers
from frot.compiler.report.numeric_dynamics import Dynamics, State
from frot.compiler.report.relations import Posture, turning_speeds
from frot.compiler.symbolic.columns import scalars_of
from frot.compiler.translate.walk import as_number
from frot.dsl import default_values, evaluate
from frot.dsl.messages.interrupts import raise_noted_interrupt
from numpy.typing import NDArray

# Rates and values that are zero beside the sizes of their terms.
ZERO = 1e-9
# How far from the start states are drawn, the next where the relations do not close.
_FAR = (0.4, 0.1, 0.02)
_TRIES = 3
# Parts of the way to a drawn state, after each of which the relations are made to hold.
_PARTS = 4


@dataclass(frozen=True, slots=True, eq=False)
class Looked:
    """Functions at states: values, rates, sizes of the terms of the rates (states x all)."""

    values: Floats
    rates: Floats
    sizes: Floats

    def constant(self, weights: Floats | None = None) -> NDArray[np.bool_]:
        """Whose rates are zero: of each function, or of combinations of them (columns)."""
        rates, sizes = self.rates, self.sizes
        if weights is not None:
            rates, sizes = rates @ weights, sizes @ np.abs(weights)
        return np.asarray(np.all(np.abs(rates) <= ZERO * sizes, axis=0))


class Search:
    """Looks at functions of (t, q, v, p) where the motion goes."""

    def __init__(self, dynamics: Dynamics, functions: ca.SX, start: Posture) -> None:
        """States are drawn around the start."""
        s = dynamics.reduced.symbols
        self.dynamics, self.start = dynamics, start
        state = ca.vertcat(s.t, s.q, s.v)
        slope = ca.jacobian(functions, state)
        self._function = Numbers("functions", dynamics.arguments, (functions, slope))
        self._parts = self._unilateral()
        motions = [m for h in dynamics.reduced.mechanism.coordinates for m in h.motions]
        self._turning = turning_speeds(motions)
        self._closing = np.array([not x.reduced for x in dynamics.reduced.mechanism.contacts], bool)

    def _unilateral(self) -> NDArray[np.bool_]:
        mechanism = self.dynamics.reduced.mechanism
        values = default_values(mechanism.model, {})
        return np.array(
            [as_number(evaluate(x.unilateral, values)) != 0 for x in mechanism.contacts],
            dtype=bool,
        )

    def look(self, p: Floats, count: int, seed: int = 1) -> Looked | None:
        """At `count` states with the parameters `p`; None where states are not found."""
        random = np.random.default_rng(seed)
        found: list[tuple[Floats, Floats, Floats]] = []
        for far in _FAR:
            for tried in range(_TRIES * count):
                raise_noted_interrupt()
                one = self._at(p, far, random)
                if one is not None:
                    found.append(one)
                if len(found) == count:
                    return Looked(*(np.array(x) for x in zip(*found, strict=True)))
                if not found and tried >= _TRIES:
                    break
        return None

    def _at(
        self, p: Floats, far: float, random: np.random.Generator
    ) -> tuple[Floats, Floats, Floats] | None:
        """Values, rates and sizes at one state."""
        open_ = self._parts & (random.random(self._parts.size) < 0.5)
        used = self._closing & ~open_
        state = self._reached(self._draw(p, far, random), used)
        if state is None:
            return None
        pushes = random.standard_normal(len(self.dynamics.friction))
        pushes[[open_[link] for _, link in self.dynamics.friction]] = 0
        solved = self.dynamics.accelerations(state, used, pushes)
        if solved is None:
            return None
        acceleration, terms = solved
        values, slope = self._function(*self.dynamics.numbers(state))
        [moves] = self.dynamics.rates(*self.dynamics.numbers(state))
        rate = np.concatenate([[1.0], moves @ state.v, acceleration])
        size = np.concatenate([[1.0], np.abs(moves) @ np.abs(state.v), self._sizes(state, terms)])
        if not (np.all(np.isfinite(values)) and np.all(np.isfinite(slope))):
            return None
        return values.ravel(), slope @ rate, np.abs(slope) @ size

    def _reached(self, drawn: State, used: NDArray[np.bool_]) -> State | None:
        """The state near the drawn one that the relations allow, on a way along them.

        At once they would often close in another assembly, mirrored, where the motion never goes.
        """
        start, reached = self.start, replace(drawn, q=self.start.q)
        for k in range(1, _PARTS + 1):
            t = start.t + (drawn.t - start.t) * k / _PARTS
            q = self._even(reached.q + (drawn.q - start.q) / _PARTS)
            found = self.dynamics.allowed(replace(drawn, t=t, q=q), used)
            if found is None:
                return None
            reached = found
        return reached

    def _even(self, q: Floats) -> Floats:
        """The coordinates with quaternions of size one."""
        q = q.copy()
        for turn in self.dynamics.reduced.symbols.turns:
            part = slice(turn.coordinate, turn.coordinate + 4)
            q[part] /= np.linalg.norm(q[part])
        return q

    def _sizes(self, state: State, terms: Floats) -> Floats:
        """Of accelerations: what others of their kind have, for some are zero but for rounding."""
        turning = self._turning
        fast = 1e-3 * np.max(np.abs(state.v), initial=0.0) ** 2
        sizes = terms + fast
        for kind in (turning, ~turning):
            sizes[kind] = np.max(terms[kind], initial=0.0) + fast
        return np.asarray(sizes)

    def _draw(self, p: Floats, far: float, random: np.random.Generator) -> State:
        start, symbols = self.start, self.dynamics.reduced.symbols
        q = self._even(start.q + far * random.standard_normal(start.q.size))
        others = random.standard_normal(self.dynamics.others.numel())
        for k, symbol in enumerate(scalars_of(self.dynamics.others)):
            if symbol.name().startswith("condition_"):
                others[k] = float(others[k] > 0)
        return State(
            t=start.t + far * random.random(),
            q=q,
            v=random.standard_normal(symbols.v.numel()),
            u=start.u + (1 + np.abs(start.u)) * random.standard_normal(start.u.size),
            p=p,
            sides=start.sides,
            other=others,
        )

    def other_parameters(self, seed: int = 2) -> Floats:
        """Values beside the defaults: real ones a little different, zero ones no longer so."""
        random = np.random.default_rng(seed)
        p = self.start.p.copy()
        for k, parameter in enumerate(self.dynamics.reduced.symbols.parameters):
            if parameter.type.base == "real":
                p[k] = p[k] * (1 + 0.1 * random.random()) if p[k] else 0.1 * random.random()
        return p
