"""Equations that look independent and are not: the combination that shows what they say.

Capacitors in a loop, say, hide the relation of their voltages among the potentials of the nodes.
Where the highest derivatives of some equations are dependent, whatever the values, a combination
of the equations without them takes the place of one of these: the method of linear combinations of
G. Tan, N. S. Nedialkov, J. D. Pryce (2017).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca
import numpy as np
from frot.compiler.equations.structure.differentiate import find_incidence
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.equations.structure.index import Index, find_unbalanced, reduce_index
from frot.compiler.equations.structure.order import find_components
from frot.compiler.equations.structure.sparse import pivots
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.random_tests import at_random
from frot.compiler.symbolic.slopes import collect, slopes, symbols_inside
from frot.compiler.translate.derivative_chains import Chains

NEGLIGIBLE = 1e-10  # of numbers of order one that should be nothing but rounding
PLAIN = 1e-6  # pivots above it, in the largest, tell a matrix that has an inverse
ECHELON = 1e-6  # below it an item of a vector of length one is no pivot


def combine(system: Residuals, newton: int, chains: Chains, left: Sequence[int]) -> Residuals:
    """The system, the first `newton` equations as they are, without hidden dependences.

    `left` are the chains that are its unknowns.
    """
    values = list(system.values)
    for _ in values:
        incidence = find_incidence(values, chains, left)
        if find_unbalanced([tuple(row) for row in incidence], len(left)) is not None:
            break
        index = reduce_index(incidence, len(left))
        found = next(_dependences(values, incidence, index, newton, chains, left), None)
        if found is None:
            break
        place, value = found
        values[place] = value
    return Residuals(values, system.origins)


def _dependences(
    values: list[ca.SX],
    incidence: Sequence[dict[int, int]],
    index: Index,
    newton: int,
    chains: Chains,
    left: Sequence[int],
) -> Iterator[tuple[int, ca.SX]]:
    """Equations to replace, each with what takes its place."""
    uses = [
        [j for j, order in row.items() if order + times == index.unknowns[j]]
        for row, times in zip(incidence, index.equations, strict=True)
    ]
    solves = [-1] * len(values)
    for j, i in enumerate(index.solver):
        solves[i] = j
    for component in find_components(uses, solves):
        rows = component.equations
        if len(rows) < 2 or min(rows) < newton:
            continue
        weights = _weights(values, component.unknowns, rows, index, chains, left)
        if weights is None:
            continue
        inside = {i: w for i, w in zip(rows, weights, strict=True) if abs(w) > NEGLIGIBLE}
        lowest = min(index.equations[i] for i in inside)
        least = [i for i in inside if index.equations[i] == lowest]
        place = max(least, key=lambda i: abs(inside[i]))
        terms: list[tuple[ca.SX, float]] = []
        for i, weight in inside.items():
            if index.equations[i] > lowest and chains.without_rate(values[i]):
                break
            term = values[i]
            for _ in range(index.equations[i] - lowest):
                term = chains.rate(term)
            terms.append((term, weight / inside[place]))
        else:
            yield place, _without_nothing(collect(terms), chains)


def _weights(
    values: list[ca.SX],
    unknowns: Sequence[int],
    rows: Sequence[int],
    index: Index,
    chains: Chains,
    left: Sequence[int],
) -> np.ndarray | None:
    """What the equations must be multiplied with to lose their highest derivatives; None: cannot.

    They must be the same whatever the values of variables and parameters.
    """
    own = [values[i] for i in rows]
    inside = [s for s in symbols_inside(own)[0] if s.element_hash() in chains.place]
    at = {left[j]: k for k, j in enumerate(unknowns)}
    places: list[tuple[int, int]] = []
    entries: list[ca.SX] = []
    for row, place, item in zip(*slopes(own, inside), strict=True):
        chain, order = chains.place[inside[place].element_hash()]
        k = at.get(chain)
        if k is not None and order == index.unknowns[unknowns[k]] - index.equations[rows[row]]:
            places.append((row, k))
            entries.append(item)
    found: list[np.ndarray] = []
    where = tuple(np.array(places, dtype=int).reshape(-1, 2).T)
    for numbers in at_random(column(entries)):
        matrix = np.zeros((len(rows), len(unknowns)))
        matrix[where] = numbers.ravel()
        if np.isfinite(matrix).all() and _has_inverse(matrix):
            return None
        sizes = np.abs(matrix).max(axis=0)
        if not np.isfinite(matrix).all() or not sizes.all():
            return None
        u, s, _ = np.linalg.svd(matrix / sizes)
        if s[-1] > NEGLIGIBLE * s[0]:
            return None
        null = _sparsest(u[:, s <= NEGLIGIBLE * s[0]])
        found.append(null)
    if not found or any(np.abs(one - found[0]).max() > NEGLIGIBLE for one in found):
        return None
    near = np.round(found[0])
    return near if np.abs(near - found[0]).max() < NEGLIGIBLE else found[0]


def _has_inverse(matrix: np.ndarray) -> bool:
    """Whether a matrix is seen to be far from singular, by its sparse factors.

    That takes time in proportion to what they hold; singular values, the cube of the size.
    """
    sizes = np.abs(matrix).max(axis=0)
    if not sizes.all():
        return False
    found = pivots(matrix / sizes)
    return found is not None and bool(found.min() > PLAIN * found.max())


def _sparsest(basis: np.ndarray) -> np.ndarray:
    """The last row of the reduced echelon form of the space that the columns of `basis` span.

    It is the same for every basis of the space.
    """
    space = basis.T.copy()
    row = 0
    for at in range(space.shape[1]):
        best = row + int(np.argmax(np.abs(space[row:, at])))
        if abs(space[best, at]) < ECHELON:
            continue
        space[[row, best]] = space[[best, row]]
        space[row] /= space[row, at]
        others = np.arange(len(space)) != row
        space[others] -= np.outer(space[others, at], space[row])
        row += 1
        if row == len(space):
            break
    return np.asarray(space[-1])


def _without_nothing(value: ca.SX, chains: Chains) -> ca.SX:
    """The value without the unknowns on which it depends in writing only."""
    own = [s for s in ca.symvar(value) if s.element_hash() in chains.place]
    if not own:
        return value
    slopes = at_random(ca.jacobian(value, column(own)))
    if not slopes:
        return value
    idle = [
        s
        for s, size in zip(own, np.abs(np.vstack(slopes)).max(axis=0), strict=True)
        if size < NEGLIGIBLE
    ]
    if not idle:
        return value
    return ca.substitute(value, column(idle), ca.SX.zeros(len(idle)))
