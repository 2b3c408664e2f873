"""The search for the first fall of a guard, against polynomials with known roots."""

from __future__ import annotations

import ctypes as ct
from math import comb

import numpy as np
import pytest
from numpy.polynomial import Polynomial

NO_ROOT = 2.0


def bernstein(p: Polynomial) -> np.ndarray:
    """Coefficients of degree 6 on [0, 1]: sum over j <= k of C(k, j) / C(6, j) a_j."""
    a = np.append(p.coef, np.zeros(7 - len(p.coef)))
    return np.array([sum(comb(k, j) / comb(6, j) * a[j] for j in range(k + 1)) for k in range(7)])


def first_fall(kernel: ct.CDLL, p: Polynomial, floor: float = 1e-12) -> float:
    return kernel.frot_first_fall((ct.c_double * 7)(*bernstein(p)), ct.c_double(floor))


def test_the_value_is_that_of_the_polynomial(kernel: ct.CDLL) -> None:
    p = Polynomial([0.3, -1, 2, 0.5, -0.7, 0.1, 1.1])
    g = (ct.c_double * 7)(*bernstein(p))
    for theta in np.linspace(0, 1, 11):
        assert kernel.frot_bernstein(g, ct.c_double(theta)) == pytest.approx(p(theta), abs=1e-14)


@pytest.mark.parametrize("seed", range(200))
def test_the_first_fall_is_the_first_root_with_a_falling_sign(kernel: ct.CDLL, seed: int) -> None:
    rng = np.random.default_rng(seed)
    roots = np.sort(rng.uniform(-0.5, 1.5, rng.integers(1, 7)))
    p = Polynomial.fromroots(roots)
    p = p if p(0) > 0 else -p
    inside = [r for r in roots if 0 < r < 1]
    found = first_fall(kernel, p)
    if inside:
        # close pairs of roots are known to the precision their distance allows
        spread = min(np.diff(roots), default=1.0)
        assert found == pytest.approx(inside[0], abs=1e-13 / spread**2 + 1e-12)
    else:
        assert found == NO_ROOT


def test_a_dip_between_close_roots_is_seen(kernel: ct.CDLL) -> None:
    for width in (1e-2, 1e-3, 1e-4):
        p = Polynomial.fromroots([0.5, 0.5 + width])
        assert first_fall(kernel, p) == pytest.approx(0.5, abs=1e-9)


def test_a_touch_from_above_is_no_fall(kernel: ct.CDLL) -> None:
    assert first_fall(kernel, Polynomial([0.25, -1, 1])) == NO_ROOT


def test_a_guard_that_starts_at_zero_and_grows_does_not_fall(kernel: ct.CDLL) -> None:
    assert first_fall(kernel, Polynomial([0, 0, 1.0])) == NO_ROOT
    assert first_fall(kernel, Polynomial([-1e-17, 1.0])) == NO_ROOT


def test_a_guard_that_starts_at_zero_grows_and_falls_is_caught_at_its_fall(kernel: ct.CDLL) -> None:
    assert first_fall(kernel, Polynomial([0, 1, -2.0])) == pytest.approx(0.5, abs=1e-14)


def test_a_guard_below_zero_from_the_start_falls_at_once(kernel: ct.CDLL) -> None:
    assert first_fall(kernel, Polynomial([-1e-3, 1.0])) == 0
    assert first_fall(kernel, Polynomial([0, -1.0])) == 0
