"""The Jacobian of the rates of a model of equations alone, for the implicit method."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.lowering.sparsity import Factors, factor_pattern
from frot.compiler.lowering.symbols import column

# States up to which the matrix is dense, and pivots are chosen by size.
FEW_STATES = 12
# States up to which blocks of equations, whose elimination fills the matrix, are condensed.
MOST_CONDENSED = 300


@dataclass(frozen=True, slots=True, eq=False)
class Jacobian:
    """Results of the kernel's function `jacobian`, and the pattern of a sparse one.

    `rows` and `columns` are those of its entries. Without `factors` it is dense.
    """

    results: list[ca.SX]
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    factors: Factors | None


def make_jacobian(system: Assembled) -> Jacobian | None:
    """The Jacobian where the implicit method can run and is not forbidden, else None."""
    method = system.reduced.mechanism.model.experiment.method
    if method == "explicit" or why_explicit(system) is not None:
        return None
    q, t, n = system.q, system.reduced.symbols.t, system.q.numel()
    slope, rate = ca.jacobian(system.rates, q), ca.jacobian(system.rates, t)
    if system.early:
        y = system.y[: system.early]
        residual = column(b.residual for b in system.blocks if not b.late)
        parts = [ca.jacobian(system.rates, y), *(ca.jacobian(residual, x) for x in (q, t, y))]
        return Jacobian([slope, rate, *parts], (), (), None)
    rows, columns = (tuple(x) for x in slope.sparsity().get_triplet())
    if n <= FEW_STATES:
        return Jacobian([slope, rate], (), (), None)
    factors = factor_pattern(np.array(rows, dtype=np.intp), np.array(columns, dtype=np.intp), n)
    return Jacobian([column(ca.vertsplit(slope.nz[:])), rate], rows, columns, factors)


def why_explicit(system: Assembled) -> str | None:
    """What keeps the implicit method from a model, or None: `a model with speeds`."""
    if system.nv or system.lam.numel():
        return "a model with bodies or friction"
    if system.late:
        return "a model whose rates need what is solved last"
    if system.early and system.q.numel() > MOST_CONDENSED:
        return f"a model with blocks of equations and more than {MOST_CONDENSED} states"
    return None if system.q.numel() else "a model without states"


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
