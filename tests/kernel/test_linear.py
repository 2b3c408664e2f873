"""The kernel's dense linear algebra against NumPy."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest

DOUBLES = ct.POINTER(ct.c_double)


def address(array: np.ndarray) -> object:
    return array.ctypes.data_as(DOUBLES)


def least_norm(kernel: ct.CDLL, a: np.ndarray, b: np.ndarray) -> tuple[int, np.ndarray]:
    m, n = a.shape
    matrix, right, x = a.flatten(order="F"), b.copy(), np.empty(n)
    work, pivot = np.empty(m + 4 * n + n * n), np.empty(n, dtype=np.intc)
    rank = kernel.frot_least_norm(
        address(matrix),
        address(right),
        m,
        n,
        ct.c_double(1e-11),
        address(x),
        address(work),
        pivot.ctypes.data_as(ct.POINTER(ct.c_int)),
    )
    return rank, x


@pytest.mark.parametrize("seed", range(40))
def test_least_norm_is_the_pseudo_inverse_at_every_rank(kernel: ct.CDLL, seed: int) -> None:
    rng = np.random.default_rng(seed)
    m, n = rng.integers(1, 8, 2)
    rank = int(rng.integers(0, min(m, n) + 1))
    a = rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))
    b = rng.normal(size=m)
    found, x = least_norm(kernel, a, b)
    expected = np.linalg.pinv(a, rcond=1e-12) @ b
    assert found == rank
    assert np.allclose(x, expected, rtol=1e-9, atol=1e-11 * (1 + np.abs(expected).max()))


@pytest.mark.parametrize("n", [1, 2, 3, 6, 12])
def test_cholesky_and_its_solves_invert_a_mass_matrix(kernel: ct.CDLL, n: int) -> None:
    rng = np.random.default_rng(n)
    root = rng.normal(size=(n, n))
    mass = root @ root.T + np.eye(n)
    factor, x = mass.flatten(order="F"), rng.normal(size=n)
    b = x.copy()
    assert kernel.frot_cholesky(address(factor), n) == 0
    kernel.frot_forward(address(factor), n, n, address(x))
    kernel.frot_backward(address(factor), n, n, address(x))
    assert np.allclose(mass @ x, b, rtol=0, atol=1e-12 * np.linalg.cond(mass))


def test_cholesky_refuses_a_motion_without_mass(kernel: ct.CDLL) -> None:
    mass = np.array([[1.0, 1.0], [1.0, 1.0]]).flatten()
    assert kernel.frot_cholesky(address(mass), 2) == 1


@pytest.mark.parametrize("n", [1, 2, 5, 9])
def test_lu_solves_what_is_not_symmetric(kernel: ct.CDLL, n: int) -> None:
    rng = np.random.default_rng(100 + n)
    a, b = rng.normal(size=(n, n)), rng.normal(size=n)
    matrix, x, again = a.flatten(order="F"), b.copy(), 2 * b
    sign, pivot = ct.c_int(), (ct.c_int * n)()
    assert kernel.frot_lu_solve(address(matrix), address(x), n, pivot, ct.byref(sign)) == 0
    assert sign.value == np.sign(np.linalg.det(a))
    assert np.allclose(a @ x, b, rtol=0, atol=1e-12 * np.linalg.cond(a))
    kernel.frot_lu_again(address(matrix), address(again), n, pivot)
    assert np.allclose(again, 2 * x, rtol=0, atol=1e-12 * np.linalg.cond(a))


@pytest.mark.parametrize("n", [1, 2, 5, 10])
def test_four_vectors_abreast_are_treated_as_each_by_itself(kernel: ct.CDLL, n: int) -> None:
    rng = np.random.default_rng(n)
    factor = np.tril(rng.normal(size=(n, n))) + 3 * np.eye(n)
    one, four, other = rng.normal(size=n), rng.normal(size=(n, 4)), rng.normal(size=(n, 4))
    products, each, solved = np.empty(4), np.empty((4, 4)), four.copy()
    kernel.frot_dot_four(address(one), address(four), n, address(products))
    kernel.frot_dot_fours(address(four), address(other), n, address(each))
    kernel.frot_forward_four(address(factor.flatten(order="F")), n, address(solved))
    assert np.allclose(products, one @ four, rtol=1e-13, atol=1e-13)
    assert np.allclose(each, four.T @ other, rtol=1e-13, atol=1e-13)
    assert np.allclose(factor @ solved, four, rtol=1e-12, atol=1e-12)


def test_lu_refuses_dependent_rows(kernel: ct.CDLL) -> None:
    matrix, b = np.array([1.0, 2.0, 2.0, 4.0]), np.array([1.0, 2.0])
    assert (
        kernel.frot_lu_solve(address(matrix), address(b), 2, (ct.c_int * 2)(), ct.byref(ct.c_int()))
        == 1
    )
