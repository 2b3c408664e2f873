"""The motion of a mechanism as numbers, at any state that its relations allow."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.equations.reduced import Reduced
from frot.compiler.report.closest_numeric import Followed
from frot.compiler.report.numbers import Floats, Numbers
from frot.compiler.symbolic.columns import column, scalars_of
from numpy.typing import NDArray

_CLOSED = 1e-11
# Nearer to a posture in which rows depend on each other digits are lost: no motion is reported.
_CLEAR = 1e-3
# The remainder of a row that depends on others.
_NONE = 1e-8
# Of speeds and accelerations along the rows, beside their terms.
_KEPT = 1e-9
_STEPS = 30


@dataclass(frozen=True, slots=True)
class State:
    """Numbers in the order of the functions' arguments.

    `other` is what nobody knows here, with zeros where figures touch: that is solved for.
    """

    t: float
    q: Floats
    v: Floats
    u: Floats
    p: Floats
    sides: Floats
    other: Floats


@dataclass(frozen=True, slots=True)
class Terms:
    """M a = h + J' lam, J a + c = 0, with the gaps and the rates of the rows.

    With the lines of auxiliary speeds: `mass` and `rows` have columns for these after the others.
    """

    mass: Floats
    force: Floats
    rows: Floats
    bias: Floats
    rate: Floats
    gap: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Dynamics:
    """The equations of a reduced mechanism as a function of numbers.

    `reaction` are the rows of what closes loops and of contacts, each with the link it is of;
    `friction` those along which laws act. `others` are the symbols of the text, of conditions, of
    solutions that forces hang on and, at `places`, of where figures touch, which `followed` solves
    for.
    """

    reduced: Reduced
    function: Numbers
    relations: Numbers
    matrices: Numbers
    others: ca.SX
    followed: Followed
    places: tuple[int, ...]
    reaction: tuple[tuple[int, int], ...]
    friction: tuple[tuple[int, int], ...]
    rates: Numbers

    @property
    def arguments(self) -> list[ca.SX]:
        """The symbols of a state."""
        s = self.reduced.symbols
        return [s.t, s.q, s.v, s.u, s.p, s.sides, self.others]

    def numbers(self, state: State) -> tuple[float | Floats, ...]:
        """The values of the arguments, no numbers where the figures touch nowhere."""
        other = state.other
        if self.places:
            other = other.copy()
            other[list(self.places)] = self.followed.at(state.t, state.q, state.u, state.p)
        return state.t, state.q, state.v, state.u, state.p, state.sides, other

    def at(self, state: State) -> Terms:
        """Evaluate the terms."""
        mass, force, rows, bias, rate, gap = self.function(*self.numbers(state))
        return Terms(mass, force.ravel(), rows, bias.ravel(), rate.ravel(), gap.ravel())

    def masses(self, state: State) -> tuple[Floats, Floats]:
        """The mass matrix and the rows, with the columns of auxiliary speeds."""
        mass, rows = self.matrices(*self.numbers(state))
        return mass, rows

    def moved(self, state: State, way: Floats) -> State:
        """After a small motion, quaternions of size one."""
        [moves] = self.rates(*self.numbers(state))
        q = state.q + moves @ way
        for turn in self.reduced.symbols.turns:
            part = slice(turn.coordinate, turn.coordinate + 4)
            q[part] /= np.linalg.norm(q[part])
        return replace(state, q=q)

    def held(self, used: NDArray[np.bool_]) -> list[int]:
        """The rows of reactions of the `used` links."""
        return [row for row, link in self.reaction if used[link]]

    def allowed(self, state: State, used: NDArray[np.bool_]) -> State | None:
        """The state nearby that the `used` links allow; None where none is found."""
        nv = self.reduced.symbols.v.numel()
        held = self.held(used)
        if not held:
            return state
        links = self.reduced.mechanism.contacts
        places = [x for x in self.reaction if used[x[1]] and not links[x[1]].kinematic]
        still = replace(state, v=0 * state.v)
        for _ in range(_STEPS):
            rows, rate, gap = self.relations(*self.numbers(still))
            held_rows, own = rows[held, :nv], rate.ravel()[held]
            rows = rows[[r for r, _ in places], :nv]
            short = gap.ravel()[[k for _, k in places]]
            sizes = np.linalg.norm(rows, axis=1)
            sizes[sizes == 0] = 1
            if not (np.all(np.isfinite(short)) and np.all(np.isfinite(held_rows))):
                return None
            if np.max(np.abs(short) / sizes, initial=0.0) < _CLOSED:
                break
            step = np.linalg.lstsq(rows / sizes[:, None], -short / sizes, rcond=1e-8)[0]
            still = self.moved(still, step / max(1.0, 2 * np.max(np.abs(step))))
        else:
            return None
        missing = held_rows @ state.v + own
        change, _, _, values = np.linalg.lstsq(held_rows, missing, rcond=_NONE)
        if not _is_clear(np.asarray(values, dtype=float)):
            return None
        v = state.v - change
        wrong = np.abs(held_rows @ v + own)
        if np.any(wrong > _KEPT * (1 + np.abs(held_rows) @ np.abs(v) + np.abs(own))):
            return None
        return replace(still, v=v)

    def accelerations(
        self, state: State, used: NDArray[np.bool_], pushes: Floats
    ) -> tuple[Floats, Floats] | None:
        """Rates of the speeds with the sizes of their terms, under friction `pushes`.

        These are beside the largest of the other loads.
        """
        now, held = self.at(state), self.held(used)
        nv = self.reduced.symbols.v.numel()
        load = now.force[:nv].copy()
        read = [*held, *(row for row, _ in self.friction)]
        made_of = load, now.mass, now.rows[read], now.bias[held]
        if not all(np.all(np.isfinite(x)) for x in made_of):
            return None
        strength = 1 + np.max(np.abs(load), initial=0.0)
        for (row, _), push in zip(self.friction, pushes, strict=True):
            load += now.rows[row, :nv] * (push * strength)
        return solve(now.mass[:nv, :nv], now.rows[held, :nv], load, -now.bias[held])


def _is_clear(values: Floats) -> bool:
    """Whether each row depends on the others or is far from doing so, by the singular values."""
    kept = values[values > _NONE * values[0]]
    return bool(np.min(kept, initial=values[0]) >= _CLEAR * values[0])


def solve(mass: Floats, rows: Floats, load: Floats, wanted: Floats) -> tuple[Floats, Floats] | None:
    """The a with `mass` a = `load` + `rows`' lam, `rows` a = `wanted`; sizes of its terms."""
    try:
        factor = np.linalg.cholesky(mass)
        free = np.linalg.solve(mass, load)
    except np.linalg.LinAlgError:
        return None
    if not rows.size:
        return np.asarray(free), np.asarray(np.abs(free))
    even = np.linalg.solve(factor, rows.T)
    sizes = np.linalg.norm(even, axis=0)
    largest = np.max(sizes)
    sizes[sizes <= _NONE * largest] = largest or 1  # a row that vanishes, but for rounding
    left, values, right = np.linalg.svd(even / sizes, full_matrices=False)
    if not _is_clear(values):
        return None
    kept = values > _NONE * values[0]
    short = (right @ ((wanted - rows @ free) / sizes))[kept]
    bound = np.linalg.solve(factor.T, left[:, kept] @ (short / values[kept]))
    found = free + bound
    wrong = np.abs(rows @ found - wanted)
    if np.any(wrong > _KEPT * (1 + np.abs(rows) @ np.abs(found) + np.abs(wanted))):
        return None
    return np.asarray(found), np.asarray(np.abs(free) + np.abs(bound))


def make_dynamics(reduced: Reduced) -> Dynamics:
    """The functions of a reduced mechanism."""
    s, links = reduced.symbols, reduced.mechanism.contacts
    mass, force = reduced.motion.tree.in_full(
        reduced.motion.matrices.matrix, reduced.motion.matrices.force, s.v.numel()
    )
    outputs = [
        mass,
        force,
        reduced.motion.matrices.rows,
        reduced.motion.matrices.bias,
        reduced.motion.matrices.rate,
        reduced.motion.matrices.gap,
    ]
    looked = ca.veccat(
        *outputs,
        reduced.motion.kinetic,
        reduced.motion.potential,
        reduced.motion.matrices.coefficients,
    )
    known = {x.element_hash() for part in (s.t, s.q, s.v, s.u, s.p, s.sides) for x in _items(part)}
    tracks = reduced.variables.kinematics.tracks.values()
    looked = ca.veccat(looked, *(x.unknowns for x in tracks))
    others = column(x for x in ca.symvar(looked) if x.element_hash() not in known)
    arguments = [s.t, s.q, s.v, s.u, s.p, s.sides, others]
    followed = Followed(tracks, [s.t, s.q, s.u, s.p], conditions=reduced.conditions)
    at = {x.element_hash(): k for k, x in enumerate(scalars_of(others))}
    reaction: list[tuple[int, int]] = []
    friction: list[tuple[int, int]] = []
    for k, (link, rows) in enumerate(zip(links, reduced.contact_rows, strict=True)):
        if not link.reduced:
            reaction += [(row, k) for row in rows.reaction]
        friction += [(row, k) for own in rows.of_laws for row in own]
    return Dynamics(
        reduced=reduced,
        function=Numbers("motion", arguments, outputs),
        matrices=Numbers("matrices", arguments, (mass, reduced.motion.matrices.rows)),
        relations=Numbers(
            "relations",
            arguments,
            (
                reduced.motion.matrices.rows,
                reduced.motion.matrices.rate,
                reduced.motion.matrices.gap,
            ),
        ),
        others=others,
        followed=followed,
        places=tuple(at[x.element_hash()] for x in scalars_of(followed.unknowns)),
        reaction=tuple(reaction),
        friction=tuple(friction),
        rates=Numbers("rates", arguments, [ca.jacobian(s.rates, s.v)]),
    )


def _items(part: ca.SX) -> Iterator[ca.SX]:
    return iter(scalars_of(part))
