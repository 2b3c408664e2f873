"""The Jacobian of the rates of the states, for the implicit method."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.symbols import column

# What knows sparse matrices loads SciPy: only where there is one.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.lowering.sparsity import Factors

# States up to which the matrix of equations alone is dense, and pivots are chosen by size.
FEW_STATES = 12
# States up to which blocks of equations, whose elimination fills the matrix, are condensed.
MOST_CONDENSED = 300
# States up to which bodies take the implicit method, whose matrix their inertia fills.
MOST_WITH_BODIES = 120

# Operations of the values times states up to which the entries of a motion are written out.
MOST_OPERATIONS = 4_000


@dataclass(frozen=True, slots=True, eq=False)
class Jacobian:
    """Arguments and results of the kernel's function `jacobian`, and the pattern of a sparse one.

    `rows` and `columns` are those of its entries. Without `factors` the matrix that is factored is
    dense.
    """

    arguments: list[ca.SX]
    results: list[ca.SX]
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    factors: Factors | None


def make_jacobian(system: Assembled, state: list[ca.SX], *, divided: bool) -> Jacobian | None:
    """The Jacobian where the implicit method can run and may be of use, else None.

    `state`: t, q, v, u, p, d, y; `divided`: into islands.
    """
    method = system.reduced.mechanism.model.experiment.method
    if method == "explicit" or why_explicit(system, divided=divided) is not None:
        return None
    if has_motion(system):
        return _of_motion(system, state) if method == "implicit" or may_be_stiff(system) else None
    q, t, n = system.q, system.reduced.symbols.t, system.q.numel()
    slope, rate = ca.jacobian(system.rates, q), ca.jacobian(system.rates, t)
    if system.early:
        y = system.y[: system.early]
        residual = column(b.residual for b in system.blocks if not b.late)
        parts = [ca.jacobian(system.rates, y), *(ca.jacobian(residual, x) for x in (q, t, y))]
        return Jacobian(state, [slope, rate, *parts], (), (), None)
    rows, columns = (tuple(x) for x in slope.sparsity().get_triplet())
    if n <= FEW_STATES:
        return Jacobian(state, [slope, rate], (), (), None)
    from frot.compiler.lowering.sparsity import factor_pattern

    factors = factor_pattern(np.array(rows, dtype=np.intp), np.array(columns, dtype=np.intp), n)
    return Jacobian(state, [column(ca.vertsplit(slope.nz[:])), rate], rows, columns, factors)


def _of_motion(system: Assembled, state: list[ca.SX]) -> Jacobian:
    """Entries of the derivatives of what holds in a motion: runtime/kernel/frot.h, `jacobian`.

    The accelerations z and reactions lam are arguments: the kernel solves for their derivatives, in
    the mode, with the matrix by which it solves for themselves. Where all entries would be a long
    function, it is one of a direction, called for each state.
    """
    matrix, force = system.in_full()
    values = ca.vertcat(
        system.rates,
        matrix @ system.z - system.spread @ system.lam - force,
        system.rows @ system.z + system.bias,
        system.coefficients,
        *(b.residual for b in system.blocks if not b.late),
    )
    moved = ca.vertcat(system.q, system.v, system.y[: system.early])
    arguments = [*state, system.z, system.lam]
    count = int(moved.numel())
    if ca.Function("f", arguments, [values]).n_instructions() * count > MOST_OPERATIONS:
        seed = ca.SX.sym("seed", count)
        return Jacobian([*arguments, seed], [ca.jtimes(values, moved, seed)], (), (), None)
    slope = ca.sparsify(ca.jacobian(values, moved))
    rows, columns = (tuple(x) for x in slope.sparsity().get_triplet())
    entries = slope.nz[:] if slope.nnz() else ca.SX.zeros(0)
    return Jacobian(arguments, [entries], rows, columns, None)


def has_motion(system: Assembled) -> bool:
    """Whether there are accelerations or reactions to be solved for."""
    return bool(system.nv or system.lam.numel())


def may_be_stiff(system: Assembled) -> bool:
    """Whether a load depends on the motion, or equations of the text act on the bodies.

    Inertia, weight and dry friction alone have no rates that are fast beside the motion.
    """
    reduced = system.reduced
    states = any(symbol < 0 for symbol in _unturned(system))
    # blocks that say where figures touch, which have a beginning, bring no rates of their own
    blocks = any(not b.late and b.start is None for b in system.blocks)
    if states or system.nc or blocks or reduced.mechanism.model.flanges:
        return True
    if system.nv > reduced.symbols.v.numel():
        return True
    loads = system.resolve(reduced.load_sizes)
    return bool(loads.numel()) and bool(ca.depends_on(loads, ca.vertcat(system.q, system.v)))


def _unturned(system: Assembled) -> list[int]:
    """`q_speed` without the coordinates that are orientations, or count the turns of angles."""
    symbols, counters = system.reduced.symbols, len(system.reduced.mechanism.counters)
    turned = {turn.coordinate + k for turn in symbols.turns for k in range(4)}
    turned |= set(range(symbols.q.numel() - counters, symbols.q.numel()))
    return [speed for k, speed in enumerate(system.q_speed) if k not in turned]


def why_explicit(system: Assembled, *, divided: bool) -> str | None:
    """What keeps the implicit method from a model, or None: `a model without states`."""
    count = int(system.q.numel()) + system.nv
    if system.late:
        return "a model whose rates need what is solved last"
    if has_motion(system) and count > MOST_WITH_BODIES:
        return f"a model with bodies or friction and {count} states: {MOST_WITH_BODIES} at most"
    if has_motion(system) and divided:
        return "a model in independent parts"
    if system.early and system.q.numel() > MOST_CONDENSED:
        return f"a model with blocks of equations and more than {MOST_CONDENSED} states"
    return None if count else "a model without states"


def alike(system: Assembled) -> tuple[int, ...]:
    """For each state that is no coordinate the first of its dimension; itself for the others."""
    chains = system.reduced.text.chains
    first: dict[tuple[object, int], int] = {}
    table = []
    for k, symbol in enumerate(ca.vertsplit(system.q) if system.q.numel() else ()):
        chain, order = chains.place.get(symbol.element_hash(), (-1, 0))
        variable = chains.items[chain].variable if chain >= 0 else None
        if variable is None or system.q_speed[k] >= 0:
            table.append(k)
        else:
            table.append(first.setdefault((variable.type.dimension, order), k))
    return tuple(table)
