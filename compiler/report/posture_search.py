"""The posture with the largest value that a search finds: from many places uphill."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.report.numeric_dynamics import Dynamics, State
from frot.compiler.report.relations import Floats
from frot.compiler.symbolic.columns import scalars_of
from numpy.typing import NDArray
from scipy.linalg import null_space

_DRAWN, _CLIMBED = 24, 4
# Of the steps uphill, in rad and in radii of gyration.
_FIRST, _LAST = 0.3, 1e-4
# Postures tried from one place: a maximum of the worked models takes 200; a value that grows with
# the distance has none.
_MOST_POSTURES = 1000
# Part by which a maximum is above another.
_EQUAL = 1e-6
# Of a gap below zero, beside the radius of gyration.
_INSIDE = 1e-9
# Of the steps to neighbours that tell on which coordinates a value depends, and of the changes.
_STEP, _TELLS, _ROUNDING = 0.005, 1e-3, 1e-8


@dataclass(frozen=True, slots=True, eq=False)
class Postures:
    """The postures that the `used` links allow and in which no other contact is entered.

    `value` is what is looked for, None where it has no number; `closed` are the contacts that
    touch, of those that can part.
    """

    dynamics: Dynamics
    value: Callable[[State], float | None]
    used: NDArray[np.bool_]
    closed: tuple[int, ...]

    def worst(self, start: State) -> tuple[float, State] | None:
        """The largest value and its posture, 0 where no posture is allowed.

        None where there is no maximum within reach.

        Random places about the start are brought to the nearest allowed posture. From the best
        ones, and from the start, the search goes uphill along single speeds with ever smaller
        steps.
        """
        random, scales = np.random.default_rng(5), self._scales(start)
        found = [self._at(start, 0 * scales)]
        for _ in range(_DRAWN):
            first, second = 2 * scales * random.standard_normal((2, scales.size))
            found.append(self._at(self.dynamics.moved(start, first), second))
        # where places of contact are solved for, an evaluation takes fifty times as long
        most = 1 if self.dynamics.places else _CLIMBED
        tops = sorted(found[1:], key=lambda x: -x[0])[:most]
        best: tuple[float, State] | None = None
        for place in (found[0], *tops):
            climbed = self._climb(place, scales) if place[0] >= 0 else place
            if climbed is None:
                return None
            # of equal ones the nearest to the start, which is the first
            if climbed[0] >= 0 and (best is None or climbed[0] > best[0] * (1 + _EQUAL)):
                best = climbed
        return (0.0, start) if best is None else best

    def _climb(self, best: tuple[float, State], scales: Floats) -> tuple[float, State] | None:
        """The maximum near a place; None where `_MOST_POSTURES` reach none."""
        chosen = self._telling_speeds(best[1])
        step, tried = _FIRST, 0
        while step > _LAST:
            before = best[0]
            tried += 2 * len(chosen)
            if tried > _MOST_POSTURES:
                return None
            free = self._free(best[1], scales)
            for k in chosen:
                way = scales * (free @ free[k])
                size = np.linalg.norm(free[k])
                for sign in (step, -step) if size > _TELLS else ():
                    best = max(best, self._at(best[1], sign / size * way), key=lambda x: x[0])
            if best[0] <= before * (1 + 1e-14):
                step /= 2
        return best

    def _at(self, state: State, way: Floats, anywhere: bool = False) -> tuple[float, State]:
        """The value at the posture near one moved a little, -1 where there is none.

        `anywhere`: also where another contact is entered.
        """
        there = self.dynamics.allowed(self.dynamics.moved(state, way), self.used)
        if there is None or not (anywhere or self._is_outside(there)):
            return -1.0, state
        value = self.value(there)
        return (-1.0, state) if value is None or not np.isfinite(value) else (value, there)

    def _is_outside(self, state: State) -> bool:
        """Whether no contact is entered that can part and is not held closed."""
        links = self.dynamics.reduced.mechanism.contacts
        apart = [
            k
            for k, link in enumerate(links)
            if k not in self.closed and is_unilateral(link.liaison) and link.has_normal
        ]
        if not apart:
            return True
        gaps = self.dynamics.relations(*self.dynamics.numbers(state))[2].ravel()[apart]
        return not np.any(gaps < -_INSIDE * max(float(np.max(self._scales(state))), 1e-300))

    def _scales(self, state: State) -> Floats:
        """Of speeds that turn 1 rad, of others the radius of gyration of the whole."""
        turning = _turning(self.dynamics)
        [mass, _] = self.dynamics.masses(state)
        own = np.diag(mass)[: state.v.size]
        inertia, masses = (np.max(own[x], initial=0.0) for x in (turning, ~turning))
        radius = np.sqrt(inertia / masses) if inertia > 0 and masses > 0 else 1.0
        return np.where(turning, 1.0, radius if np.isfinite(radius) else 1.0)

    def names(self, state: State) -> Iterator[tuple[str, float]]:
        """Coordinates that fix the posture, those of turnings first, angles within a turn.

        As many as there are motions along which the value changes.
        """
        yield from _coordinates(self.dynamics, state, self._telling_speeds(state))

    def _free(self, state: State, scales: Floats) -> Floats:
        """Speeds, over their scales, that the held rows leave: orthonormal columns."""
        (_, rows), held = self.dynamics.masses(state), self.dynamics.held(self.used)
        if not held:
            return np.eye(state.v.size)
        return np.asarray(null_space(rows[held, : state.v.size] * scales, rcond=1e-9))

    def _telling_speeds(self, state: State) -> list[int]:
        """Speeds along which, independently of each other, the value changes: turnings first.

        None moves along where the value stays, so that their coordinates alone fix it; where there
        are too few of these, all that fix the whole posture.
        """
        scales = self._scales(state)
        free = self._changing(state, scales, self._free(state, scales))
        values, ways = np.linalg.eigh(self._curvature(state, scales[:, None] * free))
        least = max(_TELLS * np.max(np.abs(values), initial=0.0), _ROUNDING)
        tells = np.abs(values) > least
        telling, silent = free @ ways[:, tells], free @ ways[:, ~tells]
        turning, whole = _turning(self.dynamics), self._of_quaternions()
        still = whole | (np.linalg.norm(silent, axis=1) < _TELLS)
        order = [*np.flatnonzero(turning), *np.flatnonzero(~turning)]
        chosen = _independent(telling, [k for k in order if still[k]])
        return chosen if len(chosen) == telling.shape[1] else _independent(free, order)

    def _changing(self, state: State, scales: Floats, free: Floats) -> Floats:
        """The free motions that speeds make along which the value changes: orthonormal columns."""
        here, kept = self._at(state, 0 * state.v, True)[0], []
        for k in range(scales.size):
            way = free @ free[k]
            found = [self._at(state, step * scales * way, True)[0] for step in (_FIRST, -_LAST)]
            if any(x >= 0 and abs(x - here) > _ROUNDING * max(here, _ROUNDING) for x in found):
                kept.append(way)
        if not kept:
            return np.zeros((scales.size, 0))
        left, sizes, _ = np.linalg.svd(np.array(kept).T, full_matrices=False)
        return np.asarray(left[:, sizes > _TELLS * sizes[0]])

    def _of_quaternions(self) -> NDArray[np.bool_]:
        """Which speeds turn a quaternion, all of which is named."""
        symbols = self.dynamics.reduced.symbols
        own = [k for turn in symbols.turns for k in turn.speeds]
        return np.isin(np.arange(symbols.v.numel()), own)

    def _curvature(self, state: State, ways: Floats) -> Floats:
        """Second derivatives and products of the first ones along ways, over the value."""
        here = self._at(state, 0 * state.v, True)[0]
        if not here > 0:
            here = 1.0

        def change(*steps: Floats) -> float:
            found = self._at(state, np.sum(steps, axis=0) * _STEP, True)[0]
            return found / here - 1 if found >= 0 else 0.0

        there = [change(way) for way in ways.T]
        back = [change(-way) for way in ways.T]
        found = np.zeros((len(there), len(there)))
        for i, one in enumerate(ways.T):
            for j, other in enumerate(ways.T[:i]):
                mixed = change(one, other) + change(-one, -other)
                mixed -= change(one, -other) + change(-one, other)
                found[i, j] = found[j, i] = mixed / 4
            found[i, i] = there[i] + back[i]
        slope = (np.array(there) - np.array(back)) / 2
        size = np.linalg.norm(slope)
        return found + (np.outer(slope, slope) / size if size > _ROUNDING else 0)


def _independent(rows: Floats, order: list[int]) -> list[int]:
    """Rows that do not depend on those before them, in this order."""
    chosen: list[int] = []
    for k in order:
        if np.linalg.matrix_rank(rows[[*chosen, k]], tol=_TELLS) > len(chosen):
            chosen.append(int(k))
    return chosen


def _turning(dynamics: Dynamics) -> NDArray[np.bool_]:
    """Which speeds turn."""
    motions = (m for h in dynamics.reduced.mechanism.coordinates for m in h.motions)
    found = [m.turns for m in motions for _ in range(m.speed_count)]
    count = dynamics.reduced.symbols.v.numel()
    return np.array((found + count * [False])[:count], dtype=bool)


def _coordinates(
    dynamics: Dynamics, state: State, speeds: list[int]
) -> Iterator[tuple[str, float]]:
    """The coordinates whose rates speeds are; of a quaternion all four."""
    symbols = dynamics.reduced.symbols
    names = [x.name() for x in scalars_of(symbols.q)]
    places = [k for speed in speeds for k, own in enumerate(symbols.q_speed) if own == speed]
    for turn in symbols.turns:
        if set(turn.speeds) & set(speeds):
            places += range(turn.coordinate, turn.coordinate + 4)
    for k in dict.fromkeys(places):
        value = float(state.q[k])
        if names[k].rpartition(".")[2].startswith("angle"):
            value = float(np.remainder(value + np.pi, 2 * np.pi) - np.pi)
        yield names[k], value
