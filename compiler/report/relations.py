"""The relations of a mechanism as numbers: gaps, rows and what the rates are at rest, anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.make_symbols import make_symbols
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.tree_step import place_bodies
from frot.compiler.report.closest_numeric import Followed
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.symbols import Symbols
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# Of a gap, beside the lengths of the mechanism: the posture satisfies the relations.
_CLOSED = 1e-11
_STEPS = 40


@dataclass(frozen=True, slots=True)
class Posture:
    """Time, coordinates, inputs, parameters and sides, as numbers in SI."""

    t: float
    q: Floats
    u: Floats
    p: Floats
    sides: Floats

    @property
    def arguments(self) -> tuple[float | Floats, ...]:
        """In the order of the functions' arguments."""
        return self.t, self.q, self.u, self.p, self.sides


@dataclass(frozen=True, slots=True)
class RelationRows:
    """The relations at a posture: gaps, rows (one a relation) by speeds, rates at rest, N(q)."""

    gap: Floats
    rows: Floats
    own: Floats
    moves: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Relations:
    """The relations of a mechanism that has a row for each of its links.

    `holds`: the relations that always hold; `geometric`: those that keep a gap at zero. `turning`
    tells the speeds that are angular. `size` is a length of the mechanism (m). `function`
    gives gaps, rows, rates at rest, N(q), and the rates by speeds and at rest of the places that
    are `followed`.
    """

    mechanism: Mechanism
    symbols: Symbols
    kinematics: Kinematics
    links: tuple[Constraint, ...]
    holds: NDArray[np.bool_]
    geometric: NDArray[np.bool_]
    turning: NDArray[np.bool_]
    row: ca.SX
    function: ca.Function
    witness: ca.Function
    followed: Followed
    size: float = 1.0

    def places(self, posture: Posture) -> Floats:
        """Where figures touch that no formula tells."""
        return self.followed.at(posture.t, posture.q, posture.u, posture.p)

    def at(self, posture: Posture) -> RelationRows:
        """Evaluate the rows."""
        found = self.function(*posture.arguments, self.places(posture))
        gap, rows, own, moves, *_ = (np.array(x) for x in found)
        return RelationRows(gap.ravel(), rows, own.ravel(), moves)

    def scaled(self, rows: Floats) -> Floats:
        """Rows of one size in speeds of one size: angular ones times the length."""
        even = rows / np.where(self.turning, self.size, 1.0)
        sizes = np.linalg.norm(even, axis=1, keepdims=True)
        return np.asarray(even / np.where(sizes > 0, sizes, 1.0))

    def measured(self, posture: Posture) -> Relations:
        """With the length that couples have beside forces at this posture."""
        rows = self.at(posture).rows
        turning, sliding = (
            np.sqrt(np.mean(part**2)) if part.size else 0.0
            for part in (rows[:, self.turning], rows[:, ~self.turning])
        )
        size = turning / sliding if turning > 0 and sliding > 0 else 1.0
        return replace(self, size=float(np.clip(size, 1e-6, 1e6)))

    def sided(self, posture: Posture) -> Posture:
        """With the sides on which the places are."""
        found = self.witness(*posture.arguments, self.places(posture))
        witness = np.array(found).reshape(-1, 3)
        sides = np.ones(len(self.links))
        for k, three in enumerate(witness):
            known = three[np.abs(three) > 1e-9 * max(self.size, 1e-3)]
            sides[k] = np.sign(known[0]) if known.size else 1.0
        return replace(posture, sides=sides)

    def moved(self, posture: Posture, way: Floats) -> Posture:
        """The posture after a small motion."""
        moves = self.at(posture).moves
        return replace(posture, q=self._unit(posture.q + moves @ way))

    def closed(
        self, posture: Posture, used: NDArray[np.bool_], held: int | None = None
    ) -> Posture | None:
        """The posture nearby where the `used` relations hold; None where none is found.

        What moves by the speed `held` stays.
        """
        used = used & self.geometric
        weights = np.where(self.turning, 1 / self.size, 1.0)
        if held is not None:
            weights[held] = 0
        for _ in range(_STEPS):
            now = self.at(posture)
            if not (np.all(np.isfinite(now.gap)) and np.all(np.isfinite(now.rows))):
                return None
            rows, gap = now.rows[used], now.gap[used]
            sizes = np.linalg.norm(rows * weights, axis=1)
            sizes[sizes == 0] = 1
            if gap.size == 0 or np.max(np.abs(gap) / sizes) < _CLOSED * self.size:
                return posture
            scaled = (rows * weights) / sizes[:, None]
            step = weights * np.linalg.lstsq(scaled, -gap / sizes, rcond=1e-7)[0]
            longest = np.max(np.abs(step) * np.where(self.turning, 1.0, 1 / self.size), initial=0.0)
            posture = self.moved(posture, step / max(1.0, longest / 0.5))
        return None

    def beside(self, posture: Posture, far: float, random: np.random.Generator) -> Posture | None:
        """A posture in general position, `far` (rad, or of the size) away along the relations.

        What moves most is held there: out of a dead centre, or relations would lead back to it.
        """
        here: Posture | None = posture
        for _ in range(3):
            if here is None:
                return None
            now, used = self.at(here), self.holds & self.geometric
            free = null_space(self.scaled(now.rows[used]))
            held: int | None = None
            if free.shape[1]:
                even = free @ random.standard_normal(free.shape[1])
                held = int(np.argmax(np.abs(even)))
                even *= far * self.size / np.max(np.abs(even))
                here = self.moved(here, even / np.where(self.turning, self.size, 1.0))
            pace = np.max(np.abs(now.own[used]), initial=0.0)
            if pace > 0:
                here = replace(here, t=here.t + far * random.random() * self.size / pace)
            there = self.closed(here, self.holds, held)
            here = self.closed(here, self.holds) if there is None else there
        return here

    def _unit(self, q: Floats) -> Floats:
        q = q.copy()
        for turn in self.symbols.turns:
            part = slice(turn.coordinate, turn.coordinate + 4)
            q[part] /= np.linalg.norm(q[part])
        return q


# Below this part of the largest, a singular value of rows of one size counts as zero. A start in a
# dead centre is a double root of its relations: it is known to the root of their rounding only.
DEPENDENT = 3e-6


def rank(rows: Floats) -> int:
    """The number of independent rows."""
    if not rows.size:
        return 0
    values = np.linalg.svd(rows, compute_uv=False)
    return int(np.sum(values > DEPENDENT * values[0])) if values[0] > 0 else 0


def null_space(rows: Floats) -> Floats:
    """An orthonormal basis (columns) of what the rows leave."""
    count = rows.shape[1]
    if not rows.size:
        return np.eye(count)
    _, values, right = np.linalg.svd(rows)
    kept = int(np.sum(values > DEPENDENT * values[0])) if values[0] > 0 else 0
    return np.asarray(right[kept:].T)


def make_relations(mechanism: Mechanism, unilateral: Mapping[Constraint, bool]) -> Relations:
    """The relations of a mechanism without laws; `unilateral` tells which links may part."""
    symbols = make_symbols(mechanism)
    kinematics = place_bodies(mechanism, symbols, Constants(symbols))
    world = mechanism.model.world
    links = mechanism.contacts
    found = [x.geometry(kinematics, symbols.sides[k], world) for k, x in enumerate(links)]
    rates = column(rate for g in found for rate in g.rates(kinematics))
    gaps = column(g.gap for g in found)
    still = ca.SX.zeros(symbols.v.shape)
    state = [symbols.t, symbols.q, symbols.u, symbols.p]
    followed = Followed(kinematics.tracks.values(), state)
    goes = column(kinematics.track_rates.values())
    arguments = [*state, symbols.sides, followed.unknowns]
    rows = ca.jacobian(rates, symbols.v)
    own = ca.substitute(rates, symbols.v, still) if symbols.v.numel() else rates
    # a counter of turns stays: no small motion is half a turn
    counters = ca.SX(len(mechanism.counters), symbols.v.numel())
    moves = ca.vertcat(ca.jacobian(symbols.rates, symbols.v), counters)
    drift = ca.substitute(goes, symbols.v, still) if symbols.v.numel() else goes
    parts = [gaps, rows, own, moves, ca.jacobian(goes, symbols.v), drift]
    outputs = [ca.densify(x) for x in ca.cse(parts)]
    witness = ca.densify(column(g.witness for g in found))
    return Relations(
        mechanism=mechanism,
        symbols=symbols,
        kinematics=kinematics,
        links=links,
        holds=np.array([not unilateral[x] for x in links], dtype=bool),
        geometric=np.array([not x.kinematic for x in links], dtype=bool),
        turning=turning_speeds([m for h in mechanism.coordinates for m in h.motions]),
        row=rows,
        function=ca.Function("relations", arguments, outputs),
        witness=ca.Function("witness", arguments, [witness]),
        followed=followed,
    )


def turning_speeds(motions: list[Motion]) -> NDArray[np.bool_]:
    """Which speeds are angular; along a curve they are taken as lengths."""
    found: list[bool] = []
    for motion in motions:
        found += [motion.turns] * motion.speed_count
    return np.array(found, dtype=bool)
