"""CasADi's operations with expressions, called without its search for what the operands are.

CasADi's Python layer asks of every operand whether it is a number, an array or a sparse one before
it takes it as the expression that it is, which takes ten times as long as the operation itself.
Between an `SX` and another, or a number of Python, the operation is called at once; anything else
goes CasADi's way. What comes out is the same expression.
"""

from __future__ import annotations

from typing import Any

import casadi as ca

_OPERATORS = {"add": ca.OP_ADD, "sub": ca.OP_SUB, "mul": ca.OP_MUL, "truediv": ca.OP_DIV}
_FUNCTIONS = {"fabs": ca.OP_FABS, "sin": ca.OP_SIN, "cos": ca.OP_COS, "sqrt": ca.OP_SQRT}
_KNOWN = (ca.SX, float, int)


def take_operators() -> None:
    """Put them in the place of CasADi's own."""
    for name, code in _OPERATORS.items():
        _take(name, code)
        _take_turned(name, code)
    for name, code in _FUNCTIONS.items():
        _take_function(name, code)


def _take(name: str, code: int) -> None:
    binary, other = ca.SX.binary, getattr(ca.SX, f"__{name}__")

    def operator(a: ca.SX, b: Any) -> ca.SX:
        return binary(code, a, b) if type(b) in _KNOWN else other(a, b)

    setattr(ca.SX, f"__{name}__", operator)


def _take_turned(name: str, code: int) -> None:
    binary, other = ca.SX.binary, getattr(ca.SX, f"__r{name}__")

    def operator(b: ca.SX, a: Any) -> ca.SX:
        return binary(code, a, b) if type(a) in _KNOWN else other(b, a)

    setattr(ca.SX, f"__r{name}__", operator)


def _take_function(name: str, code: int) -> None:
    unary, other = ca.SX.unary, getattr(ca, name)

    def function(a: object) -> object:
        return unary(code, a) if type(a) is ca.SX else other(a)

    setattr(ca, name, function)
