"""Large trees of bodies that the equations of a text move by forces alone.

The kernel goes along such a tree with no matrix written out, which it can as long as nothing else
is solved for together with its accelerations: no equation prescribes its motion, what drives it
follows from states, and no friction of the text acts on it or slips with it. What only reads its
motion, accelerations and reactions among them, is solved afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
from frot.compiler.equations.structure.differentiate import components_of, find_incidence
from frot.compiler.equations.structure.eliminate import Residuals
from frot.compiler.equations.structure.index import find_unbalanced, reduce_index
from frot.compiler.equations.structure.order import closure
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import TextTable


def moved_by_forces(
    trees: Sequence[Sequence[int]],
    large: frozenset[int],
    forces: ca.SX,
    equations: Residuals,
    text: TextTable,
    symbols: Symbols,
) -> frozenset[int]:
    """The speeds of those large trees.

    `trees` are all, each given by the places of its speeds, `large` the speeds of large ones,
    `forces` all that the text applies.
    """
    nv = symbols.v.numel()
    tree_of = {k: n for n, own in enumerate(trees) for k in own if k < nv}
    pushed = ca.sumsqr(forces)
    # in place of the equations of motion: all they depend on, as far as accelerations go
    motion = [
        ca.sum1(symbols.a[[j for j in trees[tree_of[k]] if j < nv]]) + pushed for k in range(nv)
    ]
    values = [*motion, *equations.values]
    chains = text.chains
    everything = range(len(chains.items))
    incidence = find_incidence(values, chains, everything)
    if find_unbalanced([tuple(row) for row in incidence], len(everything)) is not None:
        return frozenset()
    index = reduce_index(incidence, len(everything))
    components = components_of(incidence, index)
    needs = [c.needs for c in components]
    holder = {i: k for k, c in enumerate(components) for i in c.equations}
    reactions = ca.vertcat(symbols.lam, column(e.force for e in text.elements))
    reads = set(ca.jacobian_sparsity(column(values), reactions).row()) if reactions.numel() else {}
    slips = {
        k
        for k, c in enumerate(components)
        for j in c.unknowns
        for e in text.elements
        if chains.place[e.acceleration.element_hash()][0] == j
    }
    before_slips = closure(slips, needs)

    def is_apart(n: int) -> bool:
        own = {k for k in range(nv) if tree_of[k] == n}
        start = {holder[i] for i in own}
        if start & before_slips:
            return False
        inside = {i for k in closure(start, needs) for i in components[k].equations}
        together = {i for k in start for i in components[k].equations}
        return (
            together == own
            and all(index.equations[i] == 0 and index.unknowns[i] == 2 for i in own)
            and not any(i < nv for i in inside - own)
            and not inside.intersection(reads)
        )

    return frozenset(
        k for n, own in enumerate(trees) if not large.isdisjoint(own) and is_apart(n) for k in own
    )
