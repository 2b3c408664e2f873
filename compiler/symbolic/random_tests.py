"""Values at random places, which decide whether an identity holds wherever a run may come.

A condition that holds, or does not, hides the other branch; of `max(-k, 0)` nothing is seen where k
is positive. So places are drawn on random branches: what compares two values is as often one way as
the other, whatever these are, and the same way for the same values.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np
from frot.compiler.symbolic.columns import column
from numpy.typing import NDArray

PLACES = 4  # where nothing branches
BRANCHES = 16  # places where something does
TRIES = 4  # times as many are drawn until so many give numbers
DIGITS = 10  # in which two operands agree that are the same

_EQUALS = {ca.OP_EQ, ca.OP_NE}
_ORDERS = {ca.OP_LT, ca.OP_LE, ca.OP_FMIN, ca.OP_FMAX}
_SIGNS = {ca.OP_FABS, ca.OP_SIGN}
_CHOICES = _EQUALS | _ORDERS | _SIGNS
_READS_TRUTHS = {ca.OP_NOT, ca.OP_AND, ca.OP_OR, ca.OP_IF_ELSE_ZERO}


def at_random(values: ca.SX) -> list[NDArray[np.floating]]:
    """The values at several places at which all of them are numbers, on random branches.

    Symbols are of order one and, in half of the places, of either sign; those that are read as
    truths are 0 or 1.
    """
    opened, choices = _open(values)
    return _draw(opened, choices, True)


def at_positive(values: ca.SX) -> list[NDArray[np.floating]]:
    """The same where every symbol is positive, on the branches that these lead to."""
    return _draw(values, [], False)


def _draw(values: ca.SX, choices: Sequence[ca.SX], signed: bool) -> list[NDArray[np.floating]]:
    symbols = ca.symvar(values)
    if not symbols:
        return [ca.DM(values).full()]
    function = ca.Function("drawn", [column(symbols)], [ca.densify(values)])
    own, read = {x.element_hash() for x in choices}, read_as_truths(function)
    turns = np.array([x.element_hash() in own for x in symbols])
    truths = np.array([k in read for k in range(len(symbols))]) & ~turns
    count = BRANCHES if turns.any() or truths.any() else PLACES
    random, side = np.random.default_rng(1), np.zeros(len(symbols), dtype=int)
    found: list[NDArray[np.floating]] = []
    for k in range(TRIES * count):
        side = 1 - side if k % 2 else random.integers(0, 2, len(symbols))  # and the other branches
        place = random.uniform(0.5, 2, len(symbols))
        if signed and k % 4 < 2:
            place *= random.choice([-1, 1], len(symbols))
        place = np.where(truths, side, np.where(turns, 2 * side - 1, place))
        value = function(ca.DM(place)).full()
        if np.isfinite(value).all():
            found.append(value)
        if len(found) == count:
            break
    return found


def read_as_truths(function: ca.Function) -> set[int]:
    """The items of a function's argument that are truths: something switches by them."""
    item: dict[int, int] = {}
    found: set[int] = set()
    operations = _operations(function)
    for k, operation in enumerate(operations if not _READS_TRUTHS.isdisjoint(operations) else ()):
        to, of = function.instruction_output(k), function.instruction_input(k)
        if operation in _READS_TRUTHS:
            read = of[:1] if operation == ca.OP_IF_ELSE_ZERO else of
            found.update(item[i] for i in read if i in item)
        if operation == ca.OP_INPUT:
            item[to[0]] = of[1]
        elif operation != ca.OP_OUTPUT:
            item.pop(to[0], None)
    return found


def _operations(function: ca.Function) -> list[int]:
    return [function.instruction_id(k) for k in range(function.n_instructions())]


def _open(values: ca.SX) -> tuple[ca.SX, list[ca.SX]]:
    """The values with every comparison left open, and the symbols, 1 or -1, that decide them.

    What is compared with infinity is not open.
    """
    inputs = ca.symvar(values)
    if not inputs:
        return values, []
    function = ca.Function("opened", [column(inputs)], [values])
    operations = _operations(function)
    if _CHOICES.isdisjoint(operations):
        return values, []
    compared: list[ca.SX] = []
    _walk(function, operations, inputs, values, compared)
    at = np.random.default_rng(2).uniform(0.5, 2, len(inputs))
    number = ca.Function("compared", [column(inputs)], [column(compared)])(at).full().ravel()
    kinds = [operation in _EQUALS for operation in operations if operation in _CHOICES]
    symbols: dict[object, ca.SX] = {}
    turns: list[ca.SX] = []
    for k, (x, equal) in enumerate(zip(number, kinds, strict=True)):
        if np.isinf(x):  # the other side is nowhere
            turns.append(ca.SX(-1 if equal else np.sign(x)))
            continue
        key = (equal, f"{abs(x):.{DIGITS}g}") if np.isfinite(x) else k
        turn = symbols.setdefault(key, ca.SX.sym("turn"))
        turns.append(-turn if x < 0 and not equal else turn)
    return _walk(function, operations, inputs, values, [], turns), list(symbols.values())


def _walk(
    function: ca.Function,
    operations: Sequence[int],
    inputs: Sequence[ca.SX],
    values: ca.SX,
    compared: list[ca.SX],
    turns: Sequence[ca.SX] = (),
) -> ca.SX:
    """The values again, by `turns` for what compares; `compared` becomes what decides them."""
    work = [ca.SX(0)] * function.sz_w()
    items = [ca.SX(0)] * values.nnz()
    for k, operation in enumerate(operations):
        to, of = function.instruction_output(k), function.instruction_input(k)
        if operation == ca.OP_OUTPUT:
            items[to[1]] = work[of[0]]
        elif operation == ca.OP_CONST:
            work[to[0]] = ca.SX(function.instruction_constant(k))
        elif operation == ca.OP_INPUT:
            work[to[0]] = inputs[of[1]]
        elif operation in _CHOICES and turns:
            turn = turns[len(compared)]
            compared.append(turn)
            work[to[0]] = _decided(operation, [work[i] for i in of], turn)
        else:
            operands = [work[i] for i in of]
            if operation in _CHOICES:
                compared.append(operands[0] if operation in _SIGNS else operands[0] - operands[1])
            make = ca.SX.unary if len(operands) == 1 else ca.SX.binary
            work[to[0]] = make(operation, *operands)
    return ca.SX(values.sparsity(), column(items))


def _decided(operation: int, of: Sequence[ca.SX], turn: ca.SX) -> ca.SX:
    """The value where what is compared has the sign `turn`; of equality, 1 where it holds."""
    above, below = (1 + turn) / 2, (1 - turn) / 2
    if operation == ca.OP_SIGN:
        return turn
    if operation == ca.OP_FABS:
        return turn * of[0]
    if operation == ca.OP_FMAX:
        return above * of[0] + below * of[1]
    if operation == ca.OP_FMIN:
        return below * of[0] + above * of[1]
    return above if operation == ca.OP_EQ else below
