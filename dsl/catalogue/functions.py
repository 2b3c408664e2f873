"""The functions of the language: of each, on one row, its type, its value and its form.

The **rule** says what the function takes and of what type it is; the **number** is its value for
floats, vectors being tuples; the **form** is made with a module that has CasADi's names, so that
this table needs none. What has a `place` instead (arrays, events, rates) is unfolded or has a
meaning in equations only; the modules of `expressions/` of that name check it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from frot.dsl.quantities.dimensions import REAL, Type


@dataclass(frozen=True, slots=True)
class Rule:
    """Takes numbers, or `vectors` of one size, and gives the type that `gives` makes of theirs.

    `alike`: the operands have the dimension of the first one; `plain`: they have none. `sizes` are
    those a vector may have, where not all are meant.
    """

    gives: Callable[[tuple[Type, ...]], Type]
    vectors: bool = False
    alike: bool = False
    plain: bool = False
    sizes: tuple[int, ...] = ()


def _root(operands: tuple[Type, ...]) -> Type:
    return Type("real", operands[0].dimension ** Fraction(1, 2))


def _product(operands: tuple[Type, ...]) -> Type:
    return Type("real", operands[0].dimension * operands[1].dimension)


def _cross_product(operands: tuple[Type, ...]) -> Type:
    shape = operands[0].shape
    return _product(operands).of_shape(() if shape == (2,) else shape)


def _first(operands: tuple[Type, ...]) -> Type:
    return Type("real", operands[0].dimension)


NUMBER = Rule(lambda operands: REAL, plain=True)
SIGN = Rule(lambda operands: REAL)
SAME = Rule(_first)
ROOT = Rule(_root)
ALIKE = Rule(_first, alike=True)
RATIO = Rule(lambda operands: REAL, alike=True)
DOT = Rule(_product, vectors=True)
CROSS = Rule(_cross_product, vectors=True, sizes=(2, 3))
NORM = Rule(_first, vectors=True)


@dataclass(frozen=True, slots=True)
class Function:
    """A function: how many operands it takes (`most` None: any number), and what they come to.

    `whole` says when it gives a whole number: `always`, or where the operands are (`kept`).
    `switch` says how it continues where its operands cross: smoothly (empty), by the `sign` of one,
    the `order` of several, or in a `step`. `place` is `array`, `event` or `rate`.
    """

    name: str
    rule: Rule | None = None
    number: Callable[..., Any] | None = None
    form: Callable[..., Any] | None = None
    least: int = 1
    most: int | None = 1
    whole: str = ""
    switch: str = ""
    place: str = ""
    doc: str = ""

    @property
    def count(self) -> str:
        """The number of operands in words: `1`, `at least 2`, `2 or 3`."""
        if self.most is None:
            return f"at least {self.least}"
        if self.most <= self.least + 1:
            return " or ".join(dict.fromkeys((str(self.least), str(self.most))))
        return f"{self.least} to {self.most}"

    def takes(self, count: int) -> bool:
        """Whether it takes this number of operands."""
        return count >= self.least and (self.most is None or count <= self.most)


def _called(name: str) -> Callable[..., Any]:
    """The form of what CasADi has itself."""
    return lambda ca, *operands: getattr(ca, name)(*operands)


def _modulo(a: float, b: float) -> float:
    return a - math.floor(a / b) * b


def _cross(a: tuple[float, ...], b: tuple[float, ...]) -> float | tuple[float, ...]:
    if len(a) == 2:
        return a[0] * b[1] - a[1] * b[0]
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _cross_form(ca: Any, x: Any, y: Any) -> Any:
    return x[0] * y[1] - x[1] * y[0] if x.numel() == 2 else ca.cross(x, y)


_TRIGONOMETRIC = ("sin", "cos", "tan", "asin", "acos", "atan")
_HYPERBOLIC = ("sinh", "cosh", "tanh", "asinh", "acosh", "atanh")
_SMOOTH = (*_TRIGONOMETRIC, *_HYPERBOLIC, "exp", "log", "log10")


def _floor(x: float) -> float:
    return float(math.floor(x))


def _ceiling(x: float) -> float:
    return float(math.ceil(x))


def _sign(x: float) -> float:
    return float((x > 0) - (x < 0))


def _scalar_product(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    return math.fsum(x * y for x, y in zip(a, b, strict=True))


def _length(a: tuple[float, ...]) -> float:
    return math.hypot(*a)


def _modulo_form(ca: Any, x: Any, y: Any) -> Any:
    return x - y * ca.floor(x / y)


def _hypot_form(ca: Any, x: Any, y: Any) -> Any:
    return _length_form(ca, ca.vertcat(x, y))


def _length_form(ca: Any, x: Any) -> Any:
    """The slope is zero where there is none, at zero: no derivative is without a number there."""
    square = ca.sumsqr(x)
    return ca.if_else(square > 0, ca.sqrt(ca.if_else(square > 0, square, 1)), 0)


def _usual(
    name: str, rule: Rule, number: Callable[..., Any], form: Callable[..., Any] | str, **said: Any
) -> Function:
    return Function(name, rule, number, _called(form) if isinstance(form, str) else form, **said)


# How many operands each takes, at least and at most, and its meaning.
_OF_ARRAYS = {
    "sum": (1, 1, "sum of all items"),
    "size": (1, 2, "the sizes of an array, or the one of a dimension"),
    "zeros": (1, 8, "an array of zeros of these sizes"),
    "ones": (1, 8, "an array of ones of these sizes"),
    "fill": (2, 9, "an array of a value, of the sizes after it"),
    "transpose": (1, 1, "a matrix with rows and columns exchanged"),
}
_OF_EVENTS = {
    "pre": (1, 1, "value before the event"),
    "edge": (1, 1, "whether a condition becomes true at this event"),
    "change": (1, 1, "whether a discrete variable changes at this event"),
    "sample": (2, 2, "true at a first instant, then at each interval"),
    "initial": (0, 0, "true at the start"),
    "friction": (2, 3, "force of dry friction: slip, bound in motion, bound at rest"),
    "noEvent": (1, 1, "an expression whose comparisons bring about no event"),
    "smooth": (2, 2, "an expression that is smooth to this order across its comparisons"),
}
_TWO: dict[str, Any] = {"least": 2, "most": 2}
_STEP: dict[str, Any] = {**_TWO, "whole": "kept", "switch": "step"}
_ANY: dict[str, Any] = {"least": 2, "most": None, "whole": "kept", "switch": "order"}

_ROWS = (
    *(_usual(name, NUMBER, getattr(math, name), name) for name in _SMOOTH),
    _usual("floor", NUMBER, _floor, "floor", whole="always", switch="step"),
    _usual("ceil", NUMBER, _ceiling, "ceil", whole="always", switch="step"),
    _usual("abs", SAME, abs, "fabs", whole="kept", switch="sign", doc="absolute value"),
    _usual("sign", SIGN, _sign, "sign", whole="always", switch="sign", doc="-1, 0 or 1"),
    _usual("sqrt", ROOT, math.sqrt, "sqrt", doc="square root"),
    _usual("min", ALIKE, min, "fmin", **_ANY, doc="the smallest"),
    _usual("max", ALIKE, max, "fmax", **_ANY, doc="the largest"),
    _usual("mod", ALIKE, _modulo, _modulo_form, **_STEP, doc="with the sign of the divisor"),
    _usual("hypot", ALIKE, math.hypot, _hypot_form, **_TWO, doc="sqrt(a^2 + b^2)"),
    _usual("atan2", RATIO, math.atan2, "atan2", **_TWO, doc="angle of (x, y), as atan2(y, x)"),
    _usual("dot", DOT, _scalar_product, "dot", **_TWO, doc="scalar product"),
    _usual("cross", CROSS, _cross, _cross_form, **_TWO, doc="in the plane its z component"),
    _usual("norm", NORM, _length, _length_form, doc="length of a vector"),
    Function("der", place="rate", doc="derivative with respect to time"),
    *(Function(n, least=a, most=b, place="array", doc=d) for n, (a, b, d) in _OF_ARRAYS.items()),
    *(Function(n, least=a, most=b, place="event", doc=d) for n, (a, b, d) in _OF_EVENTS.items()),
)

FUNCTIONS: Mapping[str, Function] = {row.name: row for row in _ROWS}

# Functions of the language that have no meaning in `checked.Model` yet.
LATER = frozenset(("delay",))
