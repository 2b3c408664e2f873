"""The sparse factorisation against NumPy: orders, fill-in, solves, lost pivots."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest
from frot.compiler.symbolic.sparsity import Factors, factor_pattern

INTS, DOUBLES = ct.POINTER(ct.c_int), ct.POINTER(ct.c_double)


class Pattern(ct.Structure):
    """frot_pattern."""

    _fields_ = (
        ("n", ct.c_int),
        ("entries", ct.c_int),
        *((name, INTS) for name in ("order", "start", "column", "diagonal")),
        *((name, INTS) for name in ("entry_row", "entry_column", "place")),
    )


class Matrix:
    """shift I - J with the tables of its factors, as the kernel takes them."""

    def __init__(self, kernel: ct.CDLL, jacobian: np.ndarray) -> None:
        self.kernel, self.n = kernel, len(jacobian)
        rows, columns = np.nonzero(jacobian)
        self.values = np.ascontiguousarray(jacobian[rows, columns])
        self.factors: Factors = factor_pattern(rows, columns, self.n)
        f = self.factors
        tables = (f.order, f.starts, f.columns, f.diagonal, rows, columns, f.places)
        self.tables = [np.array(x, dtype=np.intc) for x in tables]
        self.pattern = Pattern(self.n, len(rows), *(x.ctypes.data_as(INTS) for x in self.tables))
        self.lu = np.empty(len(f.columns))
        self.scratch = np.empty((2, self.n))
        self.growth = ct.c_int(0)
        kernel.frot_sparse_error.restype = ct.c_double

    def factor(self, shift: float) -> int:
        return int(
            self.kernel.frot_sparse_factor(
                ct.byref(self.pattern),
                self.values.ctypes.data_as(DOUBLES),
                ct.c_double(shift),
                self.lu.ctypes.data_as(DOUBLES),
                self.scratch.ctypes.data_as(DOUBLES),
                ct.byref(self.growth),
            )
        )

    def solve(self, b: np.ndarray) -> np.ndarray:
        x = np.empty(self.n)
        self.kernel.frot_sparse_solve(
            ct.byref(self.pattern),
            self.lu.ctypes.data_as(DOUBLES),
            b.ctypes.data_as(DOUBLES),
            self.scratch.ctypes.data_as(DOUBLES),
            x.ctypes.data_as(DOUBLES),
        )
        return x

    def error(self, shift: float, b: np.ndarray, x: np.ndarray) -> float:
        return float(
            self.kernel.frot_sparse_error(
                ct.byref(self.pattern),
                self.values.ctypes.data_as(DOUBLES),
                ct.c_double(shift),
                b.ctypes.data_as(DOUBLES),
                x.ctypes.data_as(DOUBLES),
                self.scratch[0].ctypes.data_as(DOUBLES),
                self.scratch[1].ctypes.data_as(DOUBLES),
            )
        )


def ladder(n: int) -> np.ndarray:
    return np.diag([-2.0] * n) + np.diag([1.0] * (n - 1), 1) + np.diag([1.0] * (n - 1), -1)


@pytest.mark.parametrize("seed", range(30))
def test_a_dominant_matrix_of_any_pattern_is_inverted(kernel: ct.CDLL, seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 40))
    jacobian = rng.normal(size=(n, n)) * (rng.random((n, n)) < rng.uniform(0, 0.3))
    shift = float(np.abs(jacobian).sum(1).max() + 1)
    matrix, b = Matrix(kernel, jacobian), rng.normal(size=n)
    assert matrix.factor(shift) == 0
    x = matrix.solve(b)
    assert np.allclose((shift * np.eye(n) - jacobian) @ x, b, rtol=0, atol=1e-13 * shift)
    assert matrix.error(shift, b, x) < 1e-14


@pytest.mark.parametrize("n", [10, 100, 1000])
def test_a_ladder_has_no_fill_in(kernel: ct.CDLL, n: int) -> None:
    matrix = Matrix(kernel, ladder(n))
    assert len(matrix.factors.columns) == 3 * n - 2


def test_a_star_is_taken_from_its_tips(kernel: ct.CDLL) -> None:
    n = 200
    star = -np.eye(n)
    star[0, :] = star[:, 0] = 1
    assert len(Matrix(kernel, star).factors.columns) == 3 * n - 2


def test_a_plate_fills_in_like_its_side_and_not_like_its_area(kernel: ct.CDLL) -> None:
    side = 24
    plate = np.kron(ladder(side), np.eye(side)) + np.kron(np.eye(side), ladder(side))
    matrix, b = Matrix(kernel, plate), np.arange(side**2, dtype=float)
    assert len(matrix.factors.columns) < side**2 * side
    assert matrix.factor(0.5) == 0
    assert np.allclose((0.5 * np.eye(side**2) - plate) @ matrix.solve(b), b, rtol=0, atol=1e-10)


def test_a_pivot_lost_by_cancellation_is_told(kernel: ct.CDLL) -> None:
    singular = -np.array([[1.0, 2.0], [2.0, 4.0]])
    assert Matrix(kernel, singular).factor(0.0) == 1
    assert Matrix(kernel, np.zeros((1, 1))).factor(0.0) == 1
    assert Matrix(kernel, np.array([[np.nan]])).factor(1.0) == 1


def test_a_solution_spoilt_by_growth_is_seen(kernel: ct.CDLL) -> None:
    """With pivots of 1e-17 beside ones the factors hold nothing of the second row."""
    matrix = Matrix(kernel, -np.array([[1e-17, 1.0], [1.0, 1e-17]]))
    b = np.array([1.0, 2.0])
    assert matrix.factor(0.0) == 0
    assert matrix.growth.value == 1
    assert matrix.error(0.0, b, matrix.solve(b)) > 1e-3
    # pivots as large as their rows need no such look
    dominant = Matrix(kernel, ladder(9))
    assert dominant.factor(1.0) == 0
    assert dominant.growth.value == 0
