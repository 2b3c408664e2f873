"""Order and pattern of the factors of a sparse matrix that is factored without pivoting."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.csgraph import reverse_cuthill_mckee
from scipy.sparse.linalg import splu

Integers = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Factors:
    """Pattern of L + U of a matrix whose rows and columns are taken in `order`.

    `starts` (n + 1) and `columns` list the columns of each row in ascending order, `diagonal` (n)
    where its diagonal stands, `places` where the entries of the matrix go.
    """

    order: tuple[int, ...]
    starts: tuple[int, ...]
    columns: tuple[int, ...]
    diagonal: tuple[int, ...]
    places: tuple[int, ...]

    @property
    def work(self) -> int:
        """Multiplications of one factorisation."""
        upper = [end - at for end, at in zip(self.starts[1:], self.diagonal, strict=True)]
        lower = (
            self.columns[e] for k, at in enumerate(self.diagonal) for e in range(self.starts[k], at)
        )
        return sum(upper[j] for j in lower)


def factor_pattern(rows: Integers, columns: Integers, n: int) -> Factors:
    """The factors' pattern for a matrix (n x n) with these entries and a full diagonal.

    Of the natural order, reverse Cuthill-McKee and minimum degree, the one with the least work.
    """
    natural = np.arange(n)
    whole = sp.csr_matrix((np.ones(len(rows)), (rows, columns)), (n, n)) + sp.eye(n)
    both = sp.csr_matrix(whole + whole.T)
    cuthill_mckee = reverse_cuthill_mckee(both, symmetric_mode=True).astype(np.intp)
    best = _eliminate(rows, columns, _minimum_degree(both, n), n)
    assert best is not None
    for order in (cuthill_mckee, natural):
        best = _eliminate(rows, columns, order, n, best.work) or best
    return _eliminate(rows, columns, _by_levels(best), n, best.work + 1) or best


def _by_levels(factors: Factors) -> Integers:
    """The order with rows together that do not wait for each other.

    The processor then works at several of them at a time.
    """
    level: list[int] = []
    for k, at in enumerate(factors.diagonal):
        needed = factors.columns[factors.starts[k] : at]
        level.append(1 + max((level[j] for j in needed), default=-1))
    return np.array(factors.order, dtype=np.intp)[np.argsort(level, kind="stable")]


def _minimum_degree(both: sp.csr_matrix, n: int) -> Integers:
    """Multiple minimum degree, as SuperLU finds it."""
    dominant = sp.csc_matrix(both, copy=True)
    dominant.data[:] = -1.0
    dominant.setdiag(2.0 * n + 2.0)
    position = splu(
        dominant,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    ).perm_c
    return np.argsort(position).astype(np.intp)


def _eliminate(
    rows: Integers, columns: Integers, order: Integers, n: int, limit: int | None = None
) -> Factors | None:
    """Fill-in, row by row: what row k takes over from each row j < k that it is reduced by.

    None as soon as the work comes to `limit`: a bad order fills the matrix.
    """
    position = np.empty(n, dtype=np.intp)
    position[order] = np.arange(n)
    own: list[set[int]] = [{k} for k in range(n)]
    for i, j in zip(position[rows].tolist(), position[columns].tolist(), strict=True):
        own[i].add(j)
    upper: list[list[int]] = []
    starts, listed, diagonal = [0], list[int](), list[int]()
    work = 0
    for k in range(n):
        filled = own[k]
        waiting = sorted((j for j in filled if j < k), reverse=True)
        while waiting:
            above = upper[waiting.pop()]
            work += 1 + len(above)
            if limit is not None and work >= limit:
                return None
            new = [c for c in above if c not in filled]
            filled.update(new)
            below = [c for c in new if c < k]
            if below:
                waiting = sorted((*waiting, *below), reverse=True)
        row = sorted(filled)
        diagonal.append(starts[-1] + row.index(k))
        upper.append(row[row.index(k) + 1 :])
        listed.extend(row)
        starts.append(len(listed))
    where = {(k, listed[e]): e for k in range(n) for e in range(starts[k], starts[k + 1])}
    places = (
        where[i, j]
        for i, j in zip(position[rows].tolist(), position[columns].tolist(), strict=True)
    )
    return Factors(
        tuple(int(i) for i in order),
        tuple(starts),
        tuple(listed),
        tuple(diagonal),
        tuple(places),
    )
