"""Solves a strong component by formulas as far as one unknown after the other goes.

What is left is iterated: a few unknowns, guessed, from which formulas give the others (tearing, H.
Elmqvist, M. Otter, 1994).
"""

from __future__ import annotations

from collections import defaultdict

import casadi as ca
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.equations.structure.tear_linear import Torn, tear_linear
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.derivative_chains import replace_known


def tear(residual: list[ca.SX], unknowns: list[ca.SX], given: Given) -> Torn:
    """Tear a component of as many equations as unknowns.

    A formula divides by a constant, or by a parameter expression that is not zero at its default;
    the one equation of a component of one unknown may divide by anything, for where that is zero
    the system has no solution anyway.
    """
    whole, z = column(residual), column(unknowns)
    jacobian = ca.jacobian(whole, z)
    alone = len(unknowns) == 1
    linear = jacobian.is_constant() or not ca.depends_on(jacobian, z)
    if alone and linear:
        rest = ca.substitute(whole, z, ca.SX.zeros(1))
        factor = jacobian[0, 0]
        formula = (unknowns[0], -rest / factor)
        return Torn((formula,), ((factor, unknowns[0], 0),), (), (), True)
    if linear:
        return tear_linear(residual, unknowns, given)
    divisors = _divisors(jacobian, given)
    steps, iterated, rest_equations = _order(jacobian, divisors)
    explicit = []
    for i, j in steps:
        others = ca.substitute(residual[i], unknowns[j], ca.SX(0))
        explicit.append((unknowns[j], -others / jacobian[i, j]))
    divided = tuple((jacobian[i, j], unknowns[j], i) for i, j in steps)
    kept = column(unknowns[j] for j in iterated)
    put = _put_in(explicit, [residual[i] for i in rest_equations])
    slope = ca.jacobian(column(put), kept)
    left = tuple(unknowns[j] for j in iterated)
    return Torn(tuple(explicit), divided, left, tuple(put), not ca.depends_on(slope, kept))


def _put_in(explicit: list[tuple[ca.SX, ca.SX]], residual: list[ca.SX]) -> list[ca.SX]:
    """The residuals with the formulas put in, each formula with those before it."""
    known: dict[int, ca.SX] = {}
    for k, (symbol, value) in enumerate(explicit):
        settled = replace_known(value, known)
        explicit[k] = (symbol, settled)
        known[symbol.element_hash()] = settled
    return [replace_known(value, known) for value in residual]


def _divisors(jacobian: ca.SX, given: Given) -> set[tuple[int, int]]:
    """Entries of the Jacobian that may be divided by."""
    rows, columns = jacobian.sparsity().get_triplet()
    if not rows:
        return set()
    values = jacobian.nz[:]
    fixed = given.fixed(values)
    numbers = given.numbers([values[k] for k in fixed])
    return {
        (rows[k], columns[k])
        for k, x in zip(fixed, numbers, strict=True)
        if x != 0 and abs(x) < float("inf")
    }


def _order(
    jacobian: ca.SX, divisors: set[tuple[int, int]]
) -> tuple[list[tuple[int, int]], list[int], list[int]]:
    """Steps (equation, unknown) in order, the unknowns to iterate, the equations left."""
    rows, columns = jacobian.sparsity().get_triplet()
    count = jacobian.size1()
    inside: list[set[int]] = [set() for _ in range(count)]
    holders: dict[int, set[int]] = defaultdict(set)
    for i, j in zip(rows, columns, strict=True):
        inside[i].add(j)
        holders[j].add(i)
    steps: list[tuple[int, int]] = []
    iterated: list[int] = []
    open_equations = set(range(count))
    ready = [i for i in range(count) if len(inside[i]) == 1]
    waiting = set(range(count))

    def settle(j: int) -> None:
        waiting.discard(j)
        for i in holders[j]:
            inside[i].discard(j)
            if i in open_equations and len(inside[i]) == 1:
                ready.append(i)

    while waiting:
        step = None
        while ready and step is None:
            i = ready.pop()
            if i in open_equations and len(inside[i]) == 1:
                j = next(iter(inside[i]))
                if (i, j) in divisors:
                    step = (i, j)
        if step is not None:
            steps.append(step)
            open_equations.discard(step[0])
            settle(step[1])
            continue
        j = max(waiting, key=lambda j: (len(holders[j] & open_equations), -j))
        iterated.append(j)
        settle(j)
    return steps, iterated, sorted(open_equations)
