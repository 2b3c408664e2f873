"""Systems of linear equations in symbols."""

from __future__ import annotations

import casadi as ca


def solve_in_units(matrix: ca.SX, right: ca.SX) -> ca.SX:
    """The solution (n x k) of matrix (n x n) x = right (n x k), whatever the units of the rows are.

    CasADi makes the columns orthonormal, in which small rows beside large ones lose their digits.
    """
    if matrix.numel() == 1:
        return right / matrix
    sizes = [ca.sqrt(ca.sumsqr(matrix[k, :])) for k in range(matrix.size1())]
    scale = ca.diag(1 / ca.vertcat(*sizes))
    return ca.solve(scale @ matrix, scale @ right)
