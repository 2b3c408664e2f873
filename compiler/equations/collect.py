"""Sums in which what stands in several terms is one: what cancels out leaves no rounding."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
from frot.compiler.lowering.symbols import column

NOTHING = 1e-10  # of weights of order one


def collect(terms: Sequence[tuple[ca.SX, float]]) -> ca.SX:
    """The sum of values times weights, each term of it once.

    The currents through a switch would leave their rounding where they cancel out.
    """
    shared = ca.vertsplit(ca.cse(column(x for x, _ in terms)))
    weights = [(x, weight) for x, (_, weight) in zip(shared, terms, strict=True)]
    total = ca.SX(0)
    for x, weight in _weigh(weights):
        if abs(weight) > NOTHING:
            total += x if weight == 1 else weight * x
    return total


def without_what_cancels(value: ca.SX) -> ca.SX:
    """The value; without the symbols that cancel out of it where there are such.

    Potentials do that were drops of voltage are added up: `(a - p) + (p - b)`.
    """
    if not _summands(value):
        return value
    gone = [x for x, weight in _weigh([(value, 1.0)]) if weight == 0 and x.is_symbolic()]
    return ca.substitute(value, column(gone), ca.SX.zeros(len(gone))) if gone else value


def _weigh(terms: Sequence[tuple[ca.SX, float]]) -> list[tuple[ca.SX, float]]:
    """What a weighted sum is made of in the end, each with its weight."""
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
    return found


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
