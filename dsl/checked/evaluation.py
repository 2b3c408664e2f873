"""Values of expressions of parameters, by plain interpretation."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from frot.dsl import checked
from frot.dsl.catalogue import FUNCTIONS
from frot.dsl.checked.walk import Rules, SharedWalk, nodes

Value = float | bool | str | tuple[Any, ...]


class NotConstant(Exception):
    """The expression holds time, an input, an output or a variable of the motion."""

    def __init__(self, node: checked.Expression) -> None:
        super().__init__(f"{node.span.text!r} is not constant")
        self.node = node


def evaluate(expression: checked.Expression, values: Mapping[checked.Parameter, object]) -> Value:
    """The SI value of an expression of parameters; a vector is a tuple.

    Raises NotConstant where it depends on the motion, and ValueError with a sentence for a division
    by zero, an argument outside of a function's domain or a result out of range. KeyError is raised
    for a parameter that is not in `values`.
    """
    return _Evaluation(values).of(expression)


def constant(expression: checked.Expression) -> checked.Expression | None:
    """The first part that is not constant, or None where the whole depends on parameters only."""
    for node in nodes(expression):
        match node:
            case checked.Time() | checked.Quantity() | checked.Derivative():
                return node
            case checked.Reference(target=target) if not isinstance(target, checked.Parameter):
                return node
            case checked.Call(function=function) if FUNCTIONS[function].number is None:
                return node
    return None


@dataclass(slots=True)
class _Evaluation(SharedWalk[Value]):
    """The values of expressions, given those of the parameters."""

    values: Mapping[checked.Parameter, object]
    done: dict[int, tuple[checked.Expression, Value]] = field(default_factory=dict)

    def of(self, node: checked.Expression) -> Value:
        found = self.done.get(id(node))
        if found is not None:
            return found[1]
        try:
            result: Value = self.rules[type(node)](self, node)
        except ZeroDivisionError:
            raise ValueError(f"division by zero in {node.span.text!r}") from None
        except OverflowError:
            raise ValueError(f"{node.span.text!r} is out of range") from None
        if isinstance(result, float) and not math.isfinite(result):
            raise ValueError(f"{node.span.text!r} is out of range")
        self.done[id(node)] = (node, result)
        return result

    def _literal(self, node: checked.Literal) -> Value:
        value = node.value
        return float(value) if isinstance(value, int) and not isinstance(value, bool) else value

    def _reference(self, node: checked.Reference) -> Value:
        if not isinstance(node.target, checked.Parameter):
            raise NotConstant(node)
        return _plain(self.values[node.target])

    def _moving(self, node: checked.Expression) -> Value:
        raise NotConstant(node)

    def _element(self, node: checked.Element) -> Value:
        operand: Any = self.of(node.operand)
        result: Value = operand[node.index]
        return result

    def _vector(self, node: checked.Vector) -> Value:
        return tuple(self.of(item) for item in node.items)

    def _unary(self, node: checked.Unary) -> Value:
        operand: Any = self.of(node.operand)
        if node.op == "not":
            return not operand
        result: Value = _mapped(operator.neg, operand)
        return result

    def _binary(self, node: checked.Binary) -> Value:
        op = node.op
        left: Any = self.of(node.left)
        if op == "and":
            return bool(left and self.of(node.right))
        if op == "or":
            return bool(left or self.of(node.right))
        right: Any = self.of(node.right)
        if op == "^":
            return _power(node, left, right)
        function = _OPERATORS[op]
        if op in ("==", "<>"):
            return bool(function(left, right))
        result: Value = _mapped(function, left, right)
        return result

    def _call(self, node: checked.Call) -> Value:
        number = FUNCTIONS[node.function].number
        if number is None:
            raise NotConstant(node)
        operands: list[Any] = [self.of(a) for a in node.arguments]
        try:
            result: Value = number(*operands)
        except ValueError:
            shown = ", ".join(f"{o:g}" for o in operands if isinstance(o, float))
            raise ValueError(f"{node.function}({shown}) has no value") from None
        return result

    def _if(self, node: checked.If) -> Value:
        return self.of(node.yes if self.of(node.condition) else node.no)

    rules: ClassVar[Rules] = {
        checked.Literal: _literal,
        checked.Reference: _reference,
        checked.Time: _moving,
        checked.Quantity: _moving,
        checked.Derivative: _moving,
        checked.Element: _element,
        checked.Vector: _vector,
        checked.Unary: _unary,
        checked.Binary: _binary,
        checked.Call: _call,
        checked.If: _if,
    }


def _plain(value: Any) -> Value:
    """Numbers of any library as floats, sequences as tuples."""
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int | float):
        return float(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return tuple(_plain(v) for v in value)
    return float(value)


def _power(node: checked.Binary, base: float, power: float) -> float:
    result: float | complex
    try:
        result = base**power
    except ZeroDivisionError:
        raise ValueError(f"division by zero in {node.span.text!r}") from None
    if isinstance(result, complex):
        raise ValueError(f"{node.span.text!r} is a root of a negative number")
    return result


def _mapped(function: Callable[..., Any], *operands: Any) -> Any:
    """The function on scalars, or item by item on vectors, a scalar standing for all items."""
    sizes = [len(o) for o in operands if isinstance(o, tuple)]
    if not sizes:
        return function(*operands)
    columns = [o if isinstance(o, tuple) else (o,) * sizes[0] for o in operands]
    return tuple(_mapped(function, *row) for row in zip(*columns, strict=True))


_OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "<>": operator.ne,
}
