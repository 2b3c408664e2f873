"""Sums that are zero wherever some of given expressions are, in exact arithmetic.

In numbers such a sum is what rounding leaves of its terms. `a - b`, `2*b - (a + b)` and `(a - c) -
(b - c)` are zero with the slip `b - a`. They are found at random places, at which all the given
expressions are zero but one at a time: a rational expression that is zero there is zero everywhere
(J. Schwartz, J. ACM 27, 1980). What is not rational, as `abs` or `sin`, has at random places the
value of some function without any property but that equal operands give equal values.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import cast

import casadi as ca
import numpy as np
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.slopes import CANCELS
from numpy.typing import NDArray

PLACES = 3
MOST = 4  # expressions that one sum is made of
# A sum moves with an expression where that changes it by more than this part of its terms.
_MOVES = 1e-6
_SUMS = {ca.OP_ADD, ca.OP_SUB}

Numbers = NDArray[np.floating]


@dataclass(frozen=True, slots=True, eq=False)
class _Number:
    """Values in all cases and at all places, with the sizes of the terms they are sums of."""

    value: Numbers
    size: Numbers


class Zeros:
    """Random places where all of some expressions are zero, all but one, and one alone."""

    def __init__(self, zeros: Sequence[ca.SX], along: ca.SX) -> None:
        """`zeros` are scalars, linear in the symbols `along` by factors that hold none of them."""
        self._count, self._along = len(zeros), along
        self._drawn: dict[int, Numbers] = {}
        self._names: list[ca.SX] = []  # keeps the symbols, and so their hashes, alive
        whole, slope = column(zeros), ca.densify(ca.jacobian(column(zeros), along))
        found = evaluate([*ca.vertsplit(whole), *ca.vertsplit(ca.vec(slope))], self._draw)
        values = np.array([x.value for x in found])
        self._slopes = values[self._count :].reshape(along.numel(), self._count, PLACES).T
        moved = [np.zeros((self._count + 1, PLACES)) for _ in range(along.numel())]
        alone = [np.zeros((self._count, PLACES)) for _ in range(along.numel())]
        for k in range(PLACES):
            slopes = self._slopes[k]
            lengths, now = np.linalg.norm(slopes, axis=1), values[: self._count, k]
            wanted = np.vstack([np.zeros(self._count), np.diag(lengths)])
            steps = (wanted - now) @ np.linalg.pinv(slopes).T
            own = -(now / lengths**2)[:, None] * slopes
            for j in range(along.numel()):
                moved[j][:, k], alone[j][:, k] = steps[:, j], own[:, j]
        symbols = ca.vertsplit(along)
        self._still = np.zeros((self._count + 1, PLACES))
        self._moved = dict(zip((x.element_hash() for x in symbols), moved, strict=True))
        self._alone = dict(zip((x.element_hash() for x in symbols), alone, strict=True))

    def _draw(self, symbol: ca.SX) -> Numbers:
        """The values of a symbol, one a place."""
        key = symbol.element_hash()
        if key not in self._drawn:
            random = np.random.default_rng(len(self._drawn))
            signs = random.choice([-1, 1], PLACES)
            self._drawn[key] = random.uniform(0.5, 2, PLACES) * signs
            self._names.append(symbol)
        return self._drawn[key]

    def _draw_moved(self, symbol: ca.SX) -> Numbers:
        """The same where all expressions are zero, and where all are but one."""
        return self._draw(symbol) + self._moved.get(symbol.element_hash(), self._still)

    def _draw_alone(self, symbol: ca.SX) -> Numbers:
        """The same where one of the expressions is zero."""
        return self._draw(symbol) + self._alone.get(symbol.element_hash(), self._still[1:])

    def together(self, value: ca.SX) -> tuple[int, ...]:
        """The expressions that a scalar, linear in them, is a sum of; none if it is no such sum.

        One where that is enough, at most MOST of them, none of which follows from the others.
        """
        if not ca.symvar(value) or self.is_zero(value):
            return ()
        (number,) = evaluate([value], self._draw_alone)
        found = np.flatnonzero(np.all(_is_nothing(number), axis=1))
        if found.size:
            return (int(found[0]),)
        (number,) = evaluate([value], self._draw_moved)
        which = sorted(_vanishes_with(number))
        if not 0 < len(which) <= MOST:
            return ()
        slopes = self._slopes[:, which, :]
        if min(np.linalg.matrix_rank(x) for x in slopes) < len(which):
            return ()
        return tuple(which)

    def is_zero(self, value: ca.SX) -> bool:
        """Whether a scalar is zero everywhere."""
        (number,) = evaluate([value], self._draw)
        return bool(np.all(_is_nothing(number)))

    def replace(
        self, values: ca.SX, by: Callable[[ca.SX, frozenset[int]], ca.SX]
    ) -> tuple[ca.SX, list[frozenset[int]]]:
        """The values with `by(sum, which)` for every sum that is zero with the expressions `which`.

        Also the expressions of the sums inside each entry of `values`.
        """
        items = cast("list[ca.SX]", values.nonzeros())
        inputs = ca.symvar(values)
        if not inputs:
            return values, [frozenset()] * len(items)
        function = ca.Function("f", [column(inputs)], [column(items)])
        numbers = _Numbers(self._draw_moved)
        work = [ca.SX(0)] * function.sz_w()
        inside = [frozenset[int]()] * function.sz_w()
        made, found = list(items), [frozenset[int]()] * len(items)
        for k in range(function.n_instructions()):
            operation, to = function.instruction_id(k), function.instruction_output(k)
            of = function.instruction_input(k)
            if operation == ca.OP_OUTPUT:
                found[to[1]] = inside[of[0]]
                made[to[1]] = work[of[0]] if inside[of[0]] else items[to[1]]
                continue
            number = numbers.follow(function, k, inputs)
            if operation == ca.OP_CONST:
                work[to[0]], inside[to[0]] = ca.SX(function.instruction_constant(k)), frozenset()
                continue
            if operation == ca.OP_INPUT:
                work[to[0]], inside[to[0]] = inputs[of[1]], frozenset()
                continue
            held = frozenset[int]().union(*(inside[i] for i in of))
            make = ca.SX.unary if len(of) == 1 else ca.SX.binary
            value = make(operation, *(work[i] for i in of))
            which = _vanishes_with(number) if operation in _SUMS else frozenset[int]()
            work[to[0]] = by(value, which) if which else value
            inside[to[0]] = held | which
        return ca.SX(values.sparsity(), column(made)), found


def _is_nothing(number: _Number) -> NDArray[np.bool_]:
    """Where a value is what rounding leaves of its terms."""
    return np.abs(number.value) <= CANCELS * number.size


def _vanishes_with(number: _Number) -> frozenset[int]:
    """The expressions all of which must be zero for a sum to be; none if it is not zero then."""
    if not np.all(_is_nothing(number)[0]):
        return frozenset()
    moves = np.any(np.abs(number.value) > _MOVES * number.size, axis=1)
    return frozenset(int(k) - 1 for k in np.flatnonzero(moves) if k > 0)


def evaluate(values: Sequence[ca.SX], draw: Callable[[ca.SX], Numbers]) -> list[_Number]:
    """The values where symbols are what `draw` gives."""
    inputs = ca.symvar(column(values))
    function = ca.Function("f", [column(inputs)], [ca.densify(column(values))])
    numbers = _Numbers(draw)
    nothing = np.zeros(PLACES)
    found = [_Number(nothing, nothing)] * len(values)
    for k in range(function.n_instructions()):
        number = numbers.follow(function, k, inputs)
        if function.instruction_id(k) == ca.OP_OUTPUT:
            found[function.instruction_output(k)[1]] = number
    return found


class _Numbers:
    """The numbers in the work of a function, instruction by instruction."""

    def __init__(self, draw: Callable[[ca.SX], Numbers]) -> None:
        self._draw = draw
        self._work: dict[int, _Number] = {}

    def follow(self, function: ca.Function, k: int, inputs: Sequence[ca.SX]) -> _Number:
        """What instruction `k` gives."""
        operation, of = function.instruction_id(k), function.instruction_input(k)
        if operation == ca.OP_OUTPUT:
            return self._work[of[0]]
        if operation == ca.OP_CONST:
            value = np.full(PLACES, float(function.instruction_constant(k)))
            number = _Number(value, np.abs(value))
        elif operation == ca.OP_INPUT:
            value = self._draw(inputs[of[1]])
            number = _Number(value, np.abs(value))
        else:
            with np.errstate(all="ignore"):
                number = _operate(operation, [self._work[i] for i in of])
        self._work[function.instruction_output(k)[0]] = number
        return number


def _operate(operation: int, of: Sequence[_Number]) -> _Number:
    a, b = of[0], of[-1]
    match operation:
        case ca.OP_ADD:
            return _Number(a.value + b.value, a.size + b.size)
        case ca.OP_SUB:
            return _Number(a.value - b.value, a.size + b.size)
        case ca.OP_NEG:
            return _Number(-a.value, a.size)
        case ca.OP_TWICE:
            return _Number(2 * a.value, 2 * a.size)
        case ca.OP_MUL | ca.OP_IF_ELSE_ZERO | ca.OP_AND:
            return _Number(a.value * b.value, a.size * b.size)
        case ca.OP_SQ:
            return _Number(a.value**2, a.size**2)
        case ca.OP_DIV:
            return _Number(a.value / b.value, a.size * b.size / b.value**2)
        case ca.OP_INV:
            return _Number(1 / a.value, a.size / a.value**2)
        case ca.OP_NOT:
            return _Number(1 - a.value, 1 + a.size)
        case ca.OP_OR:
            return _Number(a.value + b.value - a.value * b.value, a.size + b.size + a.size * b.size)
    random = np.random.default_rng(operation)
    angle: Numbers = np.full(PLACES, random.uniform(0, 3))
    size: Numbers = np.full(PLACES, 2.5)
    for x in of:
        weight = random.uniform(0.5, 2)
        angle, size = angle + weight * x.value, size + weight * x.size
    return _Number(np.sin(angle) + 1.5, size)
