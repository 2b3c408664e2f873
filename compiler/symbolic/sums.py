"""Sizes of the terms of values that are sums: what rounding makes of a sum is part of them."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
from frot.compiler.symbolic.columns import column


def sizes_of_terms(values: ca.SX) -> ca.SX:
    """The sum of the sizes of the terms of each value (a column), 0 where it is no sum.

    Terms are followed into sums, products and quotients of sums, and branches; a function of a sum
    is one term.
    """
    inputs = ca.symvar(values)
    function = ca.Function("f", [column(inputs)], [values])
    terms = [ca.SX(0)] * function.sz_w()
    sizes: list[ca.SX | None] = [None] * function.sz_w()
    whole = ca.SX(values.numel(), 1)
    rows = values.sparsity().row()
    for k in range(function.n_instructions()):
        operation, to = function.instruction_id(k), function.instruction_output(k)
        places = function.instruction_input(k)
        if operation == ca.OP_OUTPUT:
            size = sizes[places[0]]
            whole[rows[to[1]]] = 0 if size is None else size
            continue
        if operation == ca.OP_CONST:
            made, size = ca.SX(function.instruction_constant(k)), None
        elif operation == ca.OP_INPUT:
            made, size = inputs[places[1]], None
        else:
            of, own = [terms[i] for i in places], [sizes[i] for i in places]
            made = ca.SX.unary(operation, *of) if len(of) == 1 else ca.SX.binary(operation, *of)
            size = _size(operation, of, own)
        terms[to[0]], sizes[to[0]] = made, size
    return whole


def _size(operation: int, of: Sequence[ca.SX], own: Sequence[ca.SX | None]) -> ca.SX | None:
    """The size of the terms of an operation on values with these sizes, None where it is no sum."""
    sizes = [ca.fabs(x) if size is None else size for x, size in zip(of, own, strict=True)]
    if operation in (ca.OP_ADD, ca.OP_SUB):
        return sizes[0] + sizes[1]
    if all(size is None for size in own):
        return None
    if operation == ca.OP_MUL:
        return sizes[0] * sizes[1]
    if operation == ca.OP_DIV:
        return None if own[0] is None else sizes[0] / ca.fabs(of[1])
    if operation == ca.OP_NEG:
        return sizes[0]
    if operation == ca.OP_TWICE:
        return 2 * sizes[0]
    if operation == ca.OP_IF_ELSE_ZERO:
        return ca.if_else(of[0], sizes[1], 0)
    return None
