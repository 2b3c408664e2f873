"""Numbers that stand in sums with unknowns, which have the rounding of a sum that they leave.

Of `exp(v/0.025) - 1` nothing is left at v = 0 but the rounding of 1.
"""

from __future__ import annotations

import casadi as ca
from frot.compiler.symbolic.columns import column

_SUMS = (ca.OP_ADD, ca.OP_SUB)


def size_of_numbers(values: ca.SX, unknowns: ca.SX) -> ca.SX:
    """What the numbers that are added to what follows from the unknowns are in each value."""
    inputs = ca.symvar(values)
    function = ca.Function("f", [column(inputs)], [values])
    marked = {x.element_hash() for x in ca.vertsplit(unknowns)}
    terms = [ca.SX(0)] * function.sz_w()
    moves = [False] * function.sz_w()
    found: list[ca.SX] = []
    numbers: list[float] = []
    whole = ca.SX.zeros(values.numel())
    rows = values.sparsity().row()
    for k in range(function.n_instructions()):
        operation, to = function.instruction_id(k), function.instruction_output(k)
        places = function.instruction_input(k)
        if operation == ca.OP_OUTPUT:
            whole[rows[to[1]]] = terms[places[0]]
        elif operation == ca.OP_CONST:
            terms[to[0]], moves[to[0]] = ca.SX(function.instruction_constant(k)), False
        elif operation == ca.OP_INPUT:
            x = inputs[places[1]]
            terms[to[0]], moves[to[0]] = x, x.element_hash() in marked
        else:
            of = [terms[i] for i in places]
            moved = [moves[i] for i in places]
            if operation in _SUMS and any(moved):
                for i, x in enumerate(of):
                    if x.is_constant() and not x.is_zero():
                        found.append(ca.SX.sym("number"))
                        numbers.append(float(x))
                        of[i] = found[-1]
            made = ca.SX.unary(operation, *of) if len(of) == 1 else ca.SX.binary(operation, *of)
            terms[to[0]], moves[to[0]] = made, any(moved)
    if not found:
        return ca.SX.zeros(values.shape)
    symbols, own = column(found), ca.DM(numbers)
    slopes = ca.fabs(ca.jacobian(whole, symbols))
    return ca.substitute(slopes, symbols, ca.SX(own)) @ ca.fabs(own)
