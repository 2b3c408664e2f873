"""Operations called at once give the expressions that CasADi's own way gives."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
import pytest
from frot.compiler.lowering import symbols  # puts them in place  # noqa: F401

X, Y, V = ca.SX.sym("x"), ca.SX.sym("y"), ca.SX.sym("v", 3)
NOTHING, HALF_EMPTY = ca.SX(3, 1), ca.SX(ca.DM([0, 2, 0])) * X
OPERANDS = (Y, V, NOTHING, HALF_EMPTY, 2, 2.5, 0, True, ca.DM([1, 0, 3]), np.float64(3), np.ones(3))
OWN = {
    operator.add: ca.plus,
    operator.sub: ca.minus,
    operator.mul: ca.times,
    operator.truediv: ca.rdivide,
}


@pytest.mark.parametrize("operation", OWN, ids=[f.__name__ for f in OWN])
@pytest.mark.parametrize("left", [X, V, NOTHING, HALF_EMPTY], ids=str)
def test_operators_give_what_casadi_gives(
    operation: Callable[[Any, Any], ca.SX], left: ca.SX
) -> None:
    for right in OPERANDS:
        for a, b in ((left, right), (right, left)):
            if not isinstance(a, np.ndarray | np.floating):  # numpy would take it item by item
                assert str(operation(a, b)) == str(OWN[operation](a, b)), (a, b)


def test_sides_of_unlike_shapes_are_refused() -> None:
    with pytest.raises(RuntimeError, match="Dimension mismatch"):
        V + ca.SX.sym("w", 2)


@pytest.mark.parametrize("name", ["fabs", "sin", "cos", "sqrt"])
def test_functions_give_what_casadi_gives(name: str) -> None:
    function = getattr(ca, name)
    for value in (X, V, NOTHING, HALF_EMPTY):
        assert str(function(value)) == str(getattr(value, name)())
    assert float(function(ca.DM(0.25))) == function(0.25) == getattr(np, name)(0.25)
