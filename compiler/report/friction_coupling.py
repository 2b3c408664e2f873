"""How much the friction of a liaison changes the reaction that bounds it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.report.numeric_dynamics import Dynamics, State
from frot.compiler.report.relations import Floats
from numpy.typing import NDArray
from scipy.linalg import null_space

# Of mu c: friction that does not change its reaction.
NO_COUPLING = 1e-9
# Turns of the search for the worst direction of a slip of several components.
_TURNS = 30
# Remainder of a row that depends on others.
_DEPENDS = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class SlidingLaw:
    """A law of friction of link `index`, its block `block`; `beside` are closed contacts.

    `numbers` gives its coefficient, times the `radius` of a pin, else 1.
    `others` of these, and of what cannot part, slip too, with their coefficients: laws of one
    component and of a normal reaction. `used` links hold, but for those that coordinates keep.
    """

    dynamics: Dynamics
    index: int
    block: int
    numbers: ca.Function
    radius: float
    used: NDArray[np.bool_]
    others: tuple[SlidingLaw, ...] = ()
    beside: tuple[int, ...] = ()

    @property
    def link(self) -> Constraint:
        """The liaison, or the relation of one."""
        return self.dynamics.reduced.mechanism.contacts[self.index]

    @property
    def rows(self) -> tuple[int, ...]:
        """The rows along which it acts."""
        return self.dynamics.reduced.contact_rows[self.index].of_laws[self.block]

    @property
    def is_unilateral(self) -> bool:
        """Whether its contact can part, so that its reaction has one sign."""
        return is_unilateral(self.link.liaison)

    @property
    def can_be_other(self) -> bool:
        """Whether its reaction has a sign, and its slip."""
        return self.link.has_normal and len(self.rows) == 1

    def coefficient(self, state: State) -> float:
        """The coefficient of the text."""
        value = float(self.numbers(*self.dynamics.numbers(state)))
        return value / self.radius if self.radius else float("nan")

    def coupling(self, state: State) -> float | None:
        """The largest |c| over the directions of the slip, times the radius of a pin.

        c = dN/df under a friction f alone; with a pin or a guide the change of the sum of |R|.
        Others slip with their coefficients: with D_j = mu_j times the sign of slip and reaction,
        N = C f and f_j = -D_j N_j the liaison has c = ((1 + C D)^-1 C)_kk (`_with_others`).
        """
        own = self._pushed(state, self)
        if own is None:
            return None
        if not self.others:
            return _largest(own, self.link.norms)
        if not self.can_be_other:
            return None
        return self._with_others(state)

    def _with_others(self, state: State) -> float | None:
        """The largest |c| over the signs D that friction may have; see `_agrees`."""
        laws = (self, *self.others)
        columns = [[self._pushed(state, read, by) for read in laws] for by in laws]
        if any(x is None for column in columns for x in column):
            return None
        matrix = np.array([[float(np.ravel(x)[0]) for x in c if x is not None] for c in columns]).T
        sizes = np.array([0.0, *(law.coefficient(state) for law in self.others)])
        slips, found = self._slips(state), [0.0]
        for signs in itertools.product((1.0, -1.0), repeat=len(self.others)):
            s = np.array([0.0, *signs])
            whole = np.eye(len(laws)) + matrix @ np.diag(s * sizes)
            if not np.linalg.det(whole) > NO_COUPLING:  # beyond already, whatever this one is
                continue
            normals = np.linalg.solve(whole, matrix[:, 0])
            if slips is None or self._agrees(s, slips, normals):
                found.append(abs(float(normals[0])))
        return max(found)

    def _agrees(self, signs: Floats, slips: Floats, normals: Floats) -> bool:
        """Whether all frictions oppose the one motion that is left, which has these slips.

        `normals` under a unit of the own friction. A contact that can part presses: its sign is
        that of its slip, and the law jams where c times the sign of its own slip is negative. A
        reaction that may have either sign has that of its change.
        """
        ways = [-np.sign(normals[0])] if self.is_unilateral else [1.0, -1.0]
        parts = list(zip(self.others, signs[1:], slips[1:], normals[1:], strict=True))
        fits = all(s * n * v * slips[0] <= 0 for law, s, v, n in parts if not law.is_unilateral)
        return fits and any(
            all(s * v * way * slips[0] >= 0 for law, s, v, _ in parts if law.is_unilateral)
            for way in ways
        )

    def _pushed(
        self, state: State, read: SlidingLaw, by: SlidingLaw | None = None
    ) -> Floats | None:
        """Reactions that bound `read` (rows) under units of the friction of `by`, times radii.

        None where they are not determined.
        """
        by = self if by is None else by
        (mass, rows), held = self.dynamics.masses(state), self.dynamics.held(self.used)
        nv = self.dynamics.reduced.symbols.v.numel()
        pushes = rows[list(by.rows)].T
        solved = _response(mass[:nv, :nv], rows[held, :nv], pushes[:nv])
        if solved is None:
            return None
        accelerations, reactions = solved
        own, radius = self.dynamics.reduced.contact_rows[read.index], read.radius
        if not read.link.reduced:
            return radius * reactions[[held.index(r) for r in read.link.bounding(own)]]
        readings = mass[nv:, :nv] @ accelerations - rows[held, nv:].T @ reactions - pushes[nv:]
        bounding = read.link.bounding(own)
        at = [int(np.argmax(np.abs(rows[r, nv:]))) for r in bounding]
        signs = [-np.sign(rows[r, nv + k]) for r, k in zip(bounding, at, strict=True)]
        return np.asarray(radius * readings[at] * np.array(signs)[:, None])

    def _slips(self, state: State) -> Floats | None:
        """Slips of the liaison and the others; None where more than one motion is left."""
        (_, rows), held = self.dynamics.masses(state), self.dynamics.held(self.used)
        nv = self.dynamics.reduced.symbols.v.numel()
        free = null_space(rows[held, :nv]) if held else np.eye(nv)
        if free.shape[1] != 1:
            return None
        laws = (self, *self.others)
        return np.array([float(rows[x.rows[0], :nv] @ free[:, 0]) for x in laws])


def _response(mass: Floats, rows: Floats, pushes: Floats) -> tuple[Floats, Floats] | None:
    """Accelerations and reactions of the held rows under unit pushes (columns)."""
    try:
        factor = np.linalg.cholesky(mass)
    except np.linalg.LinAlgError:
        return None
    own = np.linalg.solve(factor, pushes)
    even = np.linalg.solve(factor, rows.T)
    reactions = (
        -np.linalg.lstsq(even, own, rcond=_DEPENDS)[0]
        if len(rows)
        else np.zeros((0, pushes.shape[1]))
    )
    return np.linalg.solve(factor.T, own + even @ reactions), reactions


def _largest(matrix: Floats, norms: tuple[int, ...]) -> float:
    """The largest sum of lengths of the parts of matrix f over unit vectors f.

    The sum is convex, so that f <- the gradient there never decreases it.
    """
    ends = np.cumsum(norms or (len(matrix),))[:-1]
    parts = np.split(matrix, ends)
    if not np.all(np.isfinite(matrix)):
        return float("nan")
    if len(parts) == 1:
        return float(np.linalg.norm(matrix, 2))
    best = 0.0
    for f in (*np.eye(matrix.shape[1]), *np.linalg.svd(matrix)[2]):
        for _ in range(_TURNS if matrix.shape[1] > 1 else 1):
            sums = [np.linalg.norm(part @ f) for part in parts]
            best = max(best, float(sum(sums)))
            slope = sum(p.T @ (p @ f) / s for p, s in zip(parts, sums, strict=True) if s > 0)
            size = np.linalg.norm(slope)
            if not size > 0:
                break
            f = slope / size
    return best
