"""The usual functions, and the rule by which each gives a type.

Rules: `number` takes and gives numbers; `same` keeps the dimension of its one operand; `root` takes
its square root; `alike` takes any number of operands of one dimension and keeps it; `ratio` takes
two of one dimension and gives a number; `dot`, `cross`, `norm` act on vectors; `sign` gives a
number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Function:
    """A built-in function: how many operands (`most` None: any number) and its typing rule."""

    name: str
    rule: str
    least: int = 1
    most: int | None = 1
    doc: str = ""


_TRIGONOMETRIC = ("sin", "cos", "tan", "asin", "acos", "atan")
_HYPERBOLIC = ("sinh", "cosh", "tanh", "asinh", "acosh", "atanh")
_NUMBER = (*_TRIGONOMETRIC, *_HYPERBOLIC, "exp", "log", "log10", "floor", "ceil")

FUNCTIONS: Mapping[str, Function] = {
    **{name: Function(name, "number") for name in _NUMBER},
    "abs": Function("abs", "same", doc="absolute value"),
    "sign": Function("sign", "sign", doc="-1, 0 or 1"),
    "sqrt": Function("sqrt", "root", doc="square root"),
    "min": Function("min", "alike", 2, None, "the smallest"),
    "max": Function("max", "alike", 2, None, "the largest"),
    "mod": Function("mod", "alike", 2, 2, "remainder with the sign of the divisor"),
    "hypot": Function("hypot", "alike", 2, 2, "sqrt(a^2 + b^2)"),
    "atan2": Function("atan2", "ratio", 2, 2, "angle of the point (x, y), as atan2(y, x)"),
    "dot": Function("dot", "dot", 2, 2, "scalar product"),
    "cross": Function("cross", "cross", 2, 2, "vector product; in the plane its z component"),
    "norm": Function("norm", "norm", doc="length of a vector"),
}

# Functions of the language that have no meaning in `checked.Model` yet.
LATER = frozenset(("smooth", "noEvent", "delay"))
