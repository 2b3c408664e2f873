"""What scalar equations hold, their slopes and sums, in time proportional to their length.

A sum over all parts, as the balance of currents at the ground, is one long row among thousands of
short ones. CasADi finds a Jacobian by directions along which several columns are seen at once; one
long row needs as many as it has entries, each through all equations. Such rows are taken alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import casadi as ca
import numpy as np
from frot.compiler.symbolic.columns import column

# Entries of a row that is taken together with others.
_SHORT = 24
_NOTHING = 1e-10  # of weights of order one
# A sum of factors that is that part of its terms is what rounding leaves of zero, or has no digit
# that tells it from that.
CANCELS = 64 * float(np.finfo(float).eps)


def symbols_inside(values: Sequence[ca.SX]) -> tuple[list[ca.SX], list[list[int]]]:
    """All symbols that scalars hold, and for each scalar the places of its own among these."""
    whole = column(values)
    symbols = ca.symvar(whole)
    inside: list[list[int]] = [[] for _ in values]
    if symbols:
        rows, places = ca.jacobian_sparsity(whole, column(symbols)).get_triplet()
        for row, place in zip(rows, places, strict=True):
            inside[row].append(place)
    return symbols, inside


def slopes(
    values: Sequence[ca.SX], symbols: Sequence[ca.SX]
) -> tuple[list[int], list[int], list[ca.SX]]:
    """Rows, columns and values of the entries of d(values)/d(symbols), row by row."""
    inside: list[list[int]] = [[] for _ in values]
    if values and symbols:
        pattern = ca.jacobian_sparsity(column(values), column(symbols))
        for i, j in zip(*pattern.get_triplet(), strict=True):
            inside[i].append(j)
    short = [i for i, own in enumerate(inside) if 0 < len(own) <= _SHORT]
    groups: list[tuple[list[int], Sequence[int]]] = []
    if short:
        groups.append((short, range(len(symbols))))
    groups += [([i], own) for i, own in enumerate(inside) if len(own) > _SHORT]
    found: list[tuple[int, int, ca.SX]] = []
    for group, own in groups:
        along = column(symbols[j] for j in own)
        jacobian = ca.jacobian(column(values[i] for i in group), along)
        items = cast("list[ca.SX]", jacobian.nonzeros())
        for i, j, item in zip(*jacobian.sparsity().get_triplet(), items, strict=True):
            found.append((group[i], own[j], item))
    found.sort(key=lambda entry: entry[:2])
    return [i for i, _, _ in found], [j for _, j, _ in found], [x for _, _, x in found]


def collect(terms: Sequence[tuple[ca.SX, float]]) -> ca.SX:
    """The sum of values times weights, each term of it once.

    The currents through a switch would leave their rounding where they cancel out.
    """
    shared = ca.vertsplit(ca.cse(column(x for x, _ in terms)))
    weights = [(x, weight) for x, (_, weight) in zip(shared, terms, strict=True)]
    total = ca.SX(0)
    for x, weight in _weigh(weights):
        if abs(weight) > _NOTHING:
            total += x if weight == 1 else weight * x
    return total


def without_what_cancels(value: ca.SX) -> ca.SX:
    """The value; as a sum of other terms alone where symbols or numbers cancel out of it.

    Potentials do that were drops of voltage are added up: `(a - p) + (p - b)`. In a product with
    others such a symbol stays.
    """
    if not _summands(value):
        return value
    gone = any(weight == 0 and x.is_leaf() for x, weight in _weigh([(value, 1.0)]))
    return collect([(value, 1.0)]) if gone else value


def _weigh(terms: Sequence[tuple[ca.SX, float]]) -> list[tuple[ca.SX, float]]:
    """What a weighted sum is made of in the end, each with its weight; several numbers as one."""
    weights: dict[int, float] = {}
    for x, weight in terms:
        weights[x.element_hash()] = weights.get(x.element_hash(), 0.0) + weight
    found = []
    for x in reversed(_in_order([x for x, _ in terms])):
        weight = weights[x.element_hash()]
        parts = _summands(x)
        for part, sign in parts:
            key = part.element_hash()
            weights[key] = weights.get(key, 0.0) + weight * sign
        if not parts:
            found.append((x, weight))
    numbers = [weight * float(x) for x, weight in found if x.is_constant()]
    if len(numbers) < 2:
        return found
    rest = [(x, weight) for x, weight in found if not x.is_constant()]
    return [*rest, (ca.SX(sum(numbers)), 1.0 if sum(numbers) else 0.0)]


def size_of_sum(x: ca.SX) -> ca.SX:
    """The size of the terms of a scalar that is a sum, of anything else its own."""
    parts = _summands(x)
    return sum((ca.fabs(part) for part, _ in parts), ca.SX(0)) if parts else ca.fabs(x)


def _summands(x: ca.SX) -> list[tuple[ca.SX, float]]:
    """The terms of a sum and their signs, of a negative its value; of anything else nothing."""
    if x.is_op(ca.OP_ADD):
        return [(x.dep(0), 1.0), (x.dep(1), 1.0)]
    if x.is_op(ca.OP_SUB):
        return [(x.dep(0), 1.0), (x.dep(1), -1.0)]
    return [(x.dep(0), -1.0)] if x.is_op(ca.OP_NEG) else []


def _in_order(values: Sequence[ca.SX]) -> list[ca.SX]:
    """Sums and their terms to the last, every one after what it is made of."""
    order: dict[int, ca.SX] = {}
    entered: set[int] = set()
    stack = list(values)
    while stack:
        x = stack[-1]
        key = x.element_hash()
        inner = [] if key in entered else [part for part, _ in _summands(x)]
        entered.add(key)
        if inner:
            stack += inner
        else:
            order.setdefault(key, stack.pop())
    return list(order.values())
