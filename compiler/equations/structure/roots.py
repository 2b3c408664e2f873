"""Roots of differences, next to where a condition switches them off at zero.

Two levels that a pipe evens out, `q = sign(d)*sqrt(abs(d))` of their difference d, are even after
a finite time: d is (T - t)^2 c/4, then zero. Of a difference of numbers the last digits are
rounding, of which a root makes a flow a hundred million times as large, that no step can follow. So
below FEW roundings of its terms the root is zero, and from there to MANY it rises in proportion,
that a flow which something else keeps up has a level of its own. Beyond zero, where a stage of a
step may lie before the event is located, it is odd: it drives back what it has drawn to zero.

That a condition switches a root is found by numbers. Where parameters decide it, it is known for
those of the signs of the defaults alone: for others the root is what the text says.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.structure.parameter_defaults import Given
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.derivative_chains import Resolver, replace_known
from numpy.typing import NDArray

FEW, MANY = (k * float(np.finfo(float).eps) for k in (4, 16))
POINTS = 64  # random places at which a root of a negative operand must act on nothing
SETTLING = 3  # times that conditions that read each other are decided


@dataclass(frozen=True, slots=True, eq=False)
class Root:
    """A power below one: its operand, a sum of several terms, and their size."""

    operand: ca.SX
    size: ca.SX
    exponent: float

    def settled(self, where: ca.SX) -> ca.SX:
        """The root as it is next to zero where that holds, else as it is written.

        No branch has a slope without a number.
        """
        near_zero = self._near_zero()
        if where.is_one():
            return near_zero
        return ca.if_else(where, near_zero, self._of(ca.if_else(where, 1, self.operand)))

    def _near_zero(self) -> ca.SX:
        x = ca.fabs(self.operand)
        above = x > MANY * self.size
        rises = (x > FEW * self.size) * (1 - above)
        size = ca.if_else(rises, self.size, 1)
        part = (x - FEW * size) / ((MANY - FEW) * size)
        near = ca.if_else(rises, part * self._of(MANY * size), 0)
        far = self._of(ca.if_else(above, x, 1))
        return ca.sign(self.operand) * ca.if_else(above, far, near)

    def _of(self, x: ca.SX) -> ca.SX:
        return x**self.exponent


@dataclass(frozen=True, slots=True, eq=False)
class Roots:
    """The conditions of a text, which tell which of its roots they switch.

    Of `flags` those are 1 whose `values` are positive. Parameters are `given`; what `resolver`
    knows has been put in everywhere.
    """

    flags: Sequence[ca.SX]
    values: Sequence[ca.SX]
    given: Given
    resolver: Resolver

    def may_switch(self, value: ca.SX) -> bool:
        """Whether a value reads a condition."""
        own = {flag.element_hash() for flag in self.flags}
        return bool(own) and any(x.element_hash() in own for x in ca.symvar(value))

    def settle(self, value: ca.SX, known: Mapping[int, ca.SX]) -> ca.SX:
        """A formula with its roots as they are next to zero.

        `known` are the values of the unknowns before it, by the hashes of their symbols.
        """
        own = self._read_by([value], known)
        if not own:
            return value
        roots: list[Root] = []
        marks: list[ca.SX] = []

        def mark(root: Root, _: ca.SX) -> ca.SX:
            roots.append(root)
            marks.append(ca.SX.sym("root"))
            return marks[-1]

        marked = self._with_roots(value, mark)
        if not roots:
            return value
        switched = iter(self._are_switched(roots, marks, marked, own))
        where = self._as_signed(self._deciding(roots, own))
        return self._with_roots(
            value, lambda root, it: root.settled(where) if next(switched) else it
        )

    def _deciding(self, roots: Sequence[Root], own: Mapping[int, ca.SX]) -> list[ca.SX]:
        """The parameters that roots and the conditions that switch them read."""
        read = ca.symvar(column([*(root.operand for root in roots), *own.values()]))
        return [x for x in read if x in self.given]

    def _as_signed(self, parameters: Sequence[ca.SX]) -> ca.SX:
        """Whether these have the signs of their defaults: 1 where there are none."""
        whole = ca.SX(1)
        for x in parameters:
            sign = np.sign(self.given.numbers([x])[0])
            same = ca.eq(x, 0) if sign == 0 else sign * x > 0
            whole = same if whole.is_one() else ca.logic_and(whole, same)
        return whole

    def _read_by(self, values: list[ca.SX], known: Mapping[int, ca.SX]) -> dict[int, ca.SX]:
        """The conditions that these values read, and those that they read: place and value."""
        places = {flag.element_hash(): j for j, flag in enumerate(self.flags)}
        found: dict[int, ca.SX] = {}
        waiting = list(values)
        while waiting:
            for x in ca.symvar(waiting.pop()):
                j = places.get(x.element_hash(), -1)
                if j >= 0 and j not in found:
                    found[j] = replace_known(self.resolver.resolve(self.values[j]), known)
                    waiting.append(found[j])
        return found

    def _are_switched(
        self, roots: list[Root], marks: list[ca.SX], marked: ca.SX, own: dict[int, ca.SX]
    ) -> list[bool]:
        """Whether each root acts on nothing wherever its operand is negative, and that may be.

        `marked` is the formula with the `marks` for its roots.
        """
        flags, tests = column(self.flags[j] for j in own), column(own.values())
        operands, places = column(root.operand for root in roots), column(marks)
        taken = {x.element_hash() for x in (*marks, *ca.vertsplit(flags))}
        inside = ca.symvar(ca.vertcat(operands, tests, marked))
        free = [x for x in inside if x.element_hash() not in taken]
        look = ca.Function("look", [column(free), places, flags], [operands, tests, marked])
        random = np.random.default_rng(1)
        at = random.normal(size=(len(free), POINTS))
        deciding = {x.element_hash() for x in self._deciding(roots, own)}
        for k, x in enumerate(free):
            if x.element_hash() in deciding:
                at[k] = np.abs(at[k]) * np.sign(self.given.numbers([x])[0])
        ones = np.ones((len(roots), POINTS))
        holds: NDArray[np.floating] = np.ones((len(own), POINTS))
        for _ in range(SETTLING):
            holds = 1.0 * (np.array(look(at, ones, holds)[1]) > 0)
        operand, _, value = (np.array(x) for x in look(at, ones, holds))
        other = np.array(look(at, ones, 1 - holds)[0])
        found: list[bool] = []
        for k in range(len(roots)):
            ones[k] = 2
            acts = np.array(look(at, ones, holds)[2])[0] != value[0]
            ones[k] = 1
            missed = (operand[k] < 0) & acts
            may_be = (operand[k] < 0) | (other[k] < 0)
            found.append(bool(np.isfinite(operand[k]).all() and may_be.any() and not missed.any()))
        return found

    def _with_roots(self, value: ca.SX, of: Callable[[Root, ca.SX], ca.SX]) -> ca.SX:
        """The value with what `of` gives for each of its roots, in their order, and the root."""
        inputs = ca.symvar(value)
        flags = {flag.element_hash() for flag in self.flags}
        function = ca.Function("f", [column(inputs)], [value])
        terms = [_Term(ca.SX(0))] * function.sz_w()
        whole = value
        for k in range(function.n_instructions()):
            operation, to = function.instruction_id(k), function.instruction_output(k)
            places = function.instruction_input(k)
            if operation == ca.OP_OUTPUT:
                whole = terms[places[0]].value
            elif operation == ca.OP_CONST:
                terms[to[0]] = _Term(ca.SX(function.instruction_constant(k)), exact=True)
            elif operation == ca.OP_INPUT:
                x = inputs[places[1]]
                exact = x in self.given or x.element_hash() in flags
                terms[to[0]] = _Term(x, exact=exact)
            else:
                made = _make(operation, [terms[i] for i in places])
                exponent = _exponent(operation, [terms[i] for i in places])
                size = terms[places[0]].size if exponent is not None else None
                if exponent is not None and size is not None:
                    root = Root(terms[places[0]].value, size, exponent)
                    made = _Term(of(root, made.value))
                terms[to[0]] = made
        return whole


@dataclass(frozen=True, slots=True, eq=False)
class _Term:
    """A value, the size of the terms if it is a sum of several; `exact`: nothing in it moves."""

    value: ca.SX
    size: ca.SX | None = None
    exact: bool = False

    @property
    def whole_size(self) -> ca.SX:
        return ca.fabs(self.value) if self.size is None else self.size


def _exponent(operation: int, of: list[_Term]) -> float | None:
    """The exponent of a root, of whatever is no root None."""
    if operation == ca.OP_SQRT:
        return 0.5
    if operation not in (ca.OP_POW, ca.OP_CONSTPOW) or not of[1].value.is_constant():
        return None
    exponent = float(of[1].value)
    return exponent if 0 < exponent < 1 else None


def _make(operation: int, of: list[_Term]) -> _Term:
    """The value of an operation on these operands."""
    values = [x.value for x in of]
    made = ca.SX.unary(operation, *values) if len(of) == 1 else ca.SX.binary(operation, *values)
    if all(x.exact for x in of):
        return _Term(made, exact=True)
    if operation in (ca.OP_ADD, ca.OP_SUB):
        return _Term(made, of[0].whole_size + of[1].whole_size)
    if all(x.size is None for x in of):
        return _Term(made)
    if operation == ca.OP_NEG:
        return _Term(made, of[0].size)
    if operation == ca.OP_TWICE:
        return _Term(made, 2 * of[0].whole_size)
    if operation == ca.OP_MUL:
        return _Term(made, of[0].whole_size * of[1].whole_size)
    if operation == ca.OP_DIV:
        return _Term(made, of[0].whole_size / ca.fabs(of[1].value))
    if operation == ca.OP_IF_ELSE_ZERO:
        return _Term(made, of[1].size)
    return _Term(made)
