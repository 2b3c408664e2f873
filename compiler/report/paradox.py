"""From which coefficient of friction a liaison may have no motion, or several (P. Painlevé 1895).

A reaction N bounds the friction f that acts with it, and friction changes the reaction:
N = N0 + c f with everything else held. With f = mu |N| against the slip this has one solution,
whatever N0 is, as long as mu |c| < 1. Of a contact c = (n M^-1 t)/(n M^-1 n), so that
n M^-1 (n - mu t) = 0 at the coefficient named here; of a pin, whose couple is mu r |R|, c is
|dR/df| and r counts.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.equations.reduced import Reduced
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.report.numeric_dynamics import Dynamics, State, make_dynamics
from frot.compiler.report.relations import Floats, Posture
from frot.compiler.symbolic.columns import scalars_of
from frot.dsl.checked import Liaison
from numpy.typing import NDArray
from scipy.linalg import null_space

# Of mu c: friction that does not change its reaction.
_NONE = 1e-9
_MOST_SPEEDS, _MOST_LIAISONS = 8, 4
_DRAWN = 12
# Of the steps uphill (rad, m).
_FIRST, _LAST = 0.3, 1e-3
# Postures tried by one search: a maximum of the worked models takes 110; a |c| that grows with the
# distance has none.
_MOST_POSTURES = 1000


@dataclass(frozen=True, slots=True, eq=False)
class Paradox:
    """A liaison whose friction may leave no motion, or several, from a coefficient on.

    `start`: from which one at the posture of the start, `least` in the worst posture that was found
    (None where there was no search, or where it ended at no maximum), `where` its coordinates that
    matter; `mu` is the coefficient that the text has at the start. Infinite: at none.
    """

    liaison: Liaison
    mu: float
    start: float
    least: float | None
    where: tuple[tuple[str, float], ...] = ()


def find_paradoxes(reduced: Reduced, start: Posture) -> tuple[Paradox, ...]:
    """Liaisons with friction in which a paradox is possible.

    Each with the coefficients that the others have, if these are normal ones and cannot part.

    Contacts that may part are examined one by one, the others open.
    """
    links = reduced.mechanism.contacts
    dry = [
        k
        for k, x in enumerate(links)
        if any(f.components == 1 and not f.turns for f in x.frictions)
    ]
    if not (dry and reduced.symbols.v.numel()):
        return ()
    dynamics = make_dynamics(reduced)
    state = _still(dynamics, start)
    wide = reduced.symbols.v.numel() <= _MOST_SPEEDS and len(dry) <= _MOST_LIAISONS
    found: list[Paradox] = []
    sliding = [k for k in dry if links[k].has_normal and not is_unilateral(links[k].liaison)]
    for k in dry:
        one = _Watched(dynamics, k)
        if k in sliding and len(sliding) <= _MOST_LIAISONS:
            one.others = tuple(_Watched(dynamics, j) for j in sliding if j != k)
        here = one.coupling(state)
        mu = one.coefficient(state)
        worst = one.worst(state) if wide and here is not None else None
        least = None if worst is None else _inverse(worst[0])
        at_start = np.inf if here is None else _inverse(here)
        if min(at_start, np.inf if least is None else least) < np.inf:
            where = () if worst is None else tuple(one.posture(worst[1]))
            found.append(Paradox(links[k].liaison, mu, at_start, least, where))
    return tuple(found)


def _inverse(coupling: float) -> float:
    return 1 / coupling if coupling > _NONE else float("inf")


def _still(dynamics: Dynamics, start: Posture) -> State:
    nothing = np.zeros(dynamics.others.numel())
    v = np.zeros(dynamics.reduced.symbols.v.numel())
    return State(start.t, start.q, v, start.u, start.p, start.sides, nothing)


class _Watched:
    """One liaison with friction."""

    def __init__(self, dynamics: Dynamics, index: int) -> None:
        reduced = dynamics.reduced
        links = reduced.mechanism.contacts
        self.dynamics, self.link = dynamics, links[index]
        self.rows = reduced.contact_rows[index]
        self.used: NDArray[np.bool_] = np.array(
            [
                not x.reduced and (k == index or not is_unilateral(x.liaison))
                for k, x in enumerate(links)
            ]
        )
        arm, lower = self.link.frictions[0].arm, reduced.variables.kinematics.fixed.lower
        self.radius = ca.SX(1) if arm is None else lower(arm)
        self.others: tuple[_Watched, ...] = ()
        before = sum(f.components for x in links[:index] for f in x.frictions)
        self.alone = not self.dynamics.held(self.used & (np.arange(len(links)) != index))
        self._numbers = ca.Function(
            "coefficient",
            dynamics.arguments,
            [reduced.motion.matrices.coefficients[2 * before], self.radius],
        )

    def coefficient(self, state: State) -> float:
        """The coefficient of the text."""
        value, radius = (float(x) for x in self._numbers(*self.dynamics.numbers(state)))
        return value / radius if radius else float("nan")

    def coupling(self, state: State) -> float | None:
        """The largest |c| of the liaison, times the radius of a pin.

        Others that cannot part slip with their coefficients: with signs of the reactions D = +-mu,
        N = C f and f_j = D_j N_j of the others the liaison has c = ((1 - C D)^-1 C)_kk. Only signs
        count by which all frictions oppose the slips.
        """
        own = self._pushed(state, self, (self, *self.others))
        if own is None:
            return None
        ends = np.cumsum(self.link.norms or (len(own[0]),))[:-1]
        alone = float(sum(np.linalg.norm(part) for part in np.split(own[0], ends)))
        if not self.others:
            return alone
        columns = [self._pushed(state, x, (self, *self.others)) for x in self.others]
        slips = self._slips(state)
        found = []
        for signs in itertools.product((1.0, -1.0), repeat=len(self.others)):
            matrix = np.eye(1 + len(self.others))
            rest = zip(columns, signs, self.others, strict=True)
            for j, (column, sign, other) in enumerate(rest):
                if column is None:
                    return alone
                matrix[:, j + 1] -= np.ravel(column) * sign * other.coefficient(state)
            if np.linalg.det(matrix) < _NONE:  # beyond already, whatever this one is
                continue
            normals = np.linalg.solve(matrix, np.ravel(own))
            if slips is None or all(
                sign * normal * slip * slips[0] >= 0
                for sign, normal, slip in zip(signs, normals[1:], slips[1:], strict=True)
            ):
                found.append(abs(float(normals[0])))
        return max(found, default=0.0)

    def _pushed(
        self, state: State, by: _Watched, read: tuple[_Watched, ...]
    ) -> list[Floats] | None:
        """Reactions of liaisons under a unit of the friction of another, times radii of pins."""
        (mass, rows), held = self.dynamics.masses(state), self.dynamics.held(self.used)
        nv = self.dynamics.reduced.symbols.v.numel()
        push = rows[by.rows.tangent[0]]
        solved = _response(mass[:nv, :nv], rows[held, :nv], push[:nv])
        if solved is None:
            return None
        acceleration, reactions = solved
        readings = mass[nv:, :nv] @ acceleration - rows[held, nv:].T @ reactions - push[nv:]
        found = []
        for one in read:
            _, radius = (float(x) for x in one._numbers(*self.dynamics.numbers(state)))
            if not one.link.reduced:
                found.append(reactions[[held.index(one.rows.reaction[0])]] * radius)
                continue
            bounding = one.link.bounding(one.rows)
            at = [int(np.argmax(np.abs(rows[r, nv:]))) for r in bounding]
            signs = [-np.sign(rows[r, nv + k]) for r, k in zip(bounding, at, strict=True)]
            found.append(readings[at] * np.array(signs) * radius)
        return found

    def _slips(self, state: State) -> Floats | None:
        """Slips of the liaison and the others; None where more than one motion is left."""
        (_, rows), held = self.dynamics.masses(state), self.dynamics.held(self.used)
        nv = self.dynamics.reduced.symbols.v.numel()
        free = null_space(rows[held, :nv]) if held else np.eye(nv)
        if free.shape[1] != 1:
            return None
        return np.array(
            [float(rows[x.rows.tangent[0], :nv] @ free[:, 0]) for x in (self, *self.others)]
        )

    def worst(self, state: State) -> tuple[float, State] | None:
        """The posture with the largest |c| that is found: uphill from the best of some.

        None where no posture is allowed, or where `_MOST_POSTURES` reach no maximum.
        """
        random = np.random.default_rng(5)
        drawn = (state.q + 2 * random.standard_normal(state.q.size) for _ in range(_DRAWN))
        best = max((self._at(state, q) for q in drawn), key=lambda x: x[0])
        telling = [k for k in range(state.q.size) if self._matters(best, k)]
        step, tried = _FIRST, 0
        while step > _LAST:
            before = best[0]
            tried += 2 * len(telling)
            if tried > _MOST_POSTURES:
                return None
            for k in telling:
                for way in (step, -step):
                    q = best[1].q.copy()
                    q[k] += way
                    best = max(best, self._at(best[1], q), key=lambda x: x[0])
            if best[0] <= before:
                step /= 2
        return best if best[0] >= 0 else None

    def _at(self, state: State, q: Floats) -> tuple[float, State]:
        """The |c| at the posture near `q` that the relations allow, -1 where there is none."""
        there = self.dynamics.allowed(replace(state, q=q), self.used)
        value = None if there is None else self.coupling(there)
        if there is None or value is None or not np.isfinite(value):
            return -1.0, state
        return value, there

    def _matters(self, best: tuple[float, State], k: int) -> bool:
        q = best[1].q.copy()
        q[k] += _FIRST
        return abs(self._at(best[1], q)[0] - best[0]) > 1e-9 * max(best[0], _NONE)

    def posture(self, state: State) -> Iterator[tuple[str, float]]:
        """The coordinates on which |c| hangs, angles within a turn; none where loops close."""
        if not self.alone:
            return
        here = self.coupling(state) or 0.0
        for k, symbol in enumerate(scalars_of(self.dynamics.reduced.symbols.q)):
            q = state.q.copy()
            q[k] += 0.1
            there = self.coupling(replace(state, q=q))
            if there is not None and abs(there - here) > 1e-6 * max(here, 1.0):
                name = symbol.name()
                turns = name.rpartition(".")[2].startswith("angle")
                value = float(q[k] - 0.1)
                yield (
                    name,
                    float(np.remainder(value + np.pi, 2 * np.pi) - np.pi) if turns else value,
                )


def _response(mass: Floats, rows: Floats, push: Floats) -> tuple[Floats, Floats] | None:
    """Accelerations and reactions of the held rows under one unit of a push."""
    try:
        factor = np.linalg.cholesky(mass)
    except np.linalg.LinAlgError:
        return None
    own = np.linalg.solve(factor, push)
    even = np.linalg.solve(factor, rows.T)
    reactions = -np.linalg.lstsq(even, own, rcond=1e-9)[0] if len(rows) else np.zeros(0)
    return np.linalg.solve(factor.T, own + even @ reactions), reactions
