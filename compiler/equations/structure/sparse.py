"""Matchings, components and factors of sparse matrices, by SciPy.

It is loaded by the first equation of a text: a mechanism without one does not wait for it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

TYPE_CHECKING = False
if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


def pattern(rows: Sequence[Sequence[int]], count: int) -> csr_matrix:
    """The matrix (len(rows) x count) of ones where row i lists column j."""
    from scipy.sparse import csr_matrix

    pointers = np.cumsum([0, *(len(row) for row in rows)])
    indices = np.array([j for row in rows for j in row], dtype=np.int32)
    ones = np.ones(len(indices), dtype=np.int8)
    return csr_matrix((ones, indices, pointers), shape=(len(rows), count))


def match(rows: Sequence[Sequence[int]], count: int) -> list[int]:
    """The column of each row in a matching of the most pairs, or -1."""
    if not rows or not count:
        return [-1] * len(rows)
    from scipy.sparse.csgraph import maximum_bipartite_matching

    matching: list[int] = maximum_bipartite_matching(
        pattern(rows, count), perm_type="column"
    ).tolist()
    return matching


def strong_components(edges: Sequence[Sequence[int]]) -> tuple[int, list[int]]:
    """How many there are where node i leads to `edges[i]`, and which one each node is in."""
    from scipy.sparse.csgraph import connected_components

    graph = pattern(edges, len(edges))
    number, labels = connected_components(graph, directed=True, connection="strong")
    return number, labels.tolist()


def pivots(matrix: np.ndarray) -> np.ndarray | None:
    """Sizes of the pivots of the sparse factors of a matrix (n x n), or None where one is zero."""
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    try:
        sizes: np.ndarray = np.abs(splu(csc_matrix(matrix)).U.diagonal())
    except RuntimeError:
        return None
    return sizes
