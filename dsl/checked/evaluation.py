"""Values of expressions of parameters, by plain interpretation."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from frot.dsl import checked

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
    return _value(expression, values, {})


Known = dict[int, Value]


def _value(
    expression: checked.Expression, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    """As `evaluate`; `known` keeps what stands at several places of the tree."""
    if isinstance(expression, checked.Literal):
        return _literal(expression)
    if id(expression) in known:
        return known[id(expression)]
    try:
        result = _EVALUATORS[type(expression)](expression, values, known)
    except ZeroDivisionError:
        raise ValueError(f"division by zero in {expression.span.text!r}") from None
    except OverflowError:
        raise ValueError(f"{expression.span.text!r} is out of range") from None
    if isinstance(result, float) and not math.isfinite(result):
        raise ValueError(f"{expression.span.text!r} is out of range")
    known[id(expression)] = result
    return result


def nodes(root: checked.Expression) -> Iterator[checked.Expression]:
    """The expression and everything in it, each object once, from left to right."""
    seen: set[int] = set()
    pending = [root]
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        yield node
        pending.extend(reversed(parts(node)))


def parts(node: checked.Expression) -> tuple[checked.Expression, ...]:
    """The expressions directly inside an expression."""
    match node:
        case (
            checked.Element(operand=operand)
            | checked.Unary(operand=operand)
            | checked.Derivative(operand=operand)
        ):
            return (operand,)
        case checked.Vector(items=items) | checked.Call(arguments=items):
            return items
        case checked.Binary(left=left, right=right):
            return (left, right)
        case checked.If(condition=condition, yes=yes, no=no):
            return (condition, yes, no)
    return ()


def constant(expression: checked.Expression) -> checked.Expression | None:
    """The first part that is not constant, or None where the whole depends on parameters only."""
    for node in nodes(expression):
        match node:
            case checked.Time() | checked.Quantity() | checked.Derivative():
                return node
            case checked.Reference(target=target) if not isinstance(target, checked.Parameter):
                return node
            case checked.Call(function=function) if function not in _FUNCTIONS:
                return node
    return None


def _literal(node: checked.Literal) -> Value:
    value = node.value
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _reference(
    node: checked.Reference, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    if not isinstance(node.target, checked.Parameter):
        raise NotConstant(node)
    value: Any = values[node.target]
    return _plain(value)


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


def _moving(
    node: checked.Expression, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    raise NotConstant(node)


def _element(
    node: checked.Element, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    operand: Any = _value(node.operand, values, known)
    result: Value = operand[node.index]
    return result


def _vector(
    node: checked.Vector, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    return tuple(_value(i, values, known) for i in node.items)


def _unary(node: checked.Unary, values: Mapping[checked.Parameter, object], known: Known) -> Value:
    operand: Any = _value(node.operand, values, known)
    if node.op == "not":
        return not operand
    result: Value = _mapped(operator.neg, operand)
    return result


def _binary(
    node: checked.Binary, values: Mapping[checked.Parameter, object], known: Known
) -> Value:
    op = node.op
    left: Any = _value(node.left, values, known)
    if op == "and":
        return bool(left and _value(node.right, values, known))
    if op == "or":
        return bool(left or _value(node.right, values, known))
    right: Any = _value(node.right, values, known)
    if op == "^":
        return _power(node, left, right)
    function = _OPERATORS[op]
    if op in ("==", "<>"):
        return bool(function(left, right))
    result: Value = _mapped(function, left, right)
    return result


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


def _call(node: checked.Call, values: Mapping[checked.Parameter, object], known: Known) -> Value:
    operands: list[Any] = [_value(a, values, known) for a in node.arguments]
    try:
        result: Value = _FUNCTIONS[node.function](*operands)
    except ValueError:
        shown = ", ".join(f"{o:g}" for o in operands if isinstance(o, float))
        raise ValueError(f"{node.function}({shown}) has no value") from None
    return result


def _if(node: checked.If, values: Mapping[checked.Parameter, object], known: Known) -> Value:
    chosen = node.yes if _value(node.condition, values, known) else node.no
    return _value(chosen, values, known)


def _cross(a: tuple[float, ...], b: tuple[float, ...]) -> Value:
    if len(a) == 2:
        return a[0] * b[1] - a[1] * b[0]
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _modulo(a: float, b: float) -> float:
    return a - math.floor(a / b) * b


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

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "asinh": math.asinh,
    "acosh": math.acosh,
    "atanh": math.atanh,
    "exp": math.exp,
    "log": math.log,
    "log10": math.log10,
    "sqrt": math.sqrt,
    "atan2": math.atan2,
    "hypot": math.hypot,
    "abs": abs,
    "min": min,
    "max": max,
    "mod": _modulo,
    "floor": lambda x: float(math.floor(x)),
    "ceil": lambda x: float(math.ceil(x)),
    "sign": lambda x: float((x > 0) - (x < 0)),
    "dot": lambda a, b: math.fsum(x * y for x, y in zip(a, b, strict=True)),
    "cross": _cross,
    "norm": lambda a: math.hypot(*a),
}

_EVALUATORS: dict[type, Callable[[Any, Mapping[checked.Parameter, object], Known], Value]] = {
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
