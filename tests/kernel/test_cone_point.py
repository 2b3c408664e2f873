"""The admissible reactions of least norm, against their optimality conditions."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest


class Ball(ct.Structure):
    _fields_ = (
        ("at", ct.c_int),
        ("n", ct.c_int),
        ("bounding", ct.c_int),
        ("ratio", ct.c_double),
    )


class Cone(ct.Structure):
    _fields_ = (("at", ct.c_int),)


class Problem(ct.Structure):
    _fields_ = (
        *((name, ct.c_int) for name in ("n", "rows", "n_cones", "n_balls")),
        *((name, ct.c_void_p) for name in ("a", "b", "cones", "balls")),
        ("tolerance", ct.c_double),
    )


@dataclass(frozen=True)
class Feet:
    """Feet of one body on level ground, each with three reactions, and the load that they bear."""

    a: np.ndarray
    mu: np.ndarray

    def solve(self, kernel: ct.CDLL, load: np.ndarray) -> tuple[bool, np.ndarray, np.ndarray]:
        feet, (rows, n) = len(self.mu), self.a.shape
        cones = (Cone * feet)(*(Cone(3 * k) for k in range(feet)))
        balls = (Ball * feet)(*(Ball(3 * k + 1, 2, k, mu) for k, mu in enumerate(self.mu)))
        a, b = np.ascontiguousarray(self.a), np.ascontiguousarray(load)
        x, y = np.zeros(n), np.zeros(rows)
        scratch = np.empty(kernel.frot_cone_scratch(n, rows))
        problem = Problem(
            *(n, rows, feet, feet),
            *(a.ctypes.data, b.ctypes.data, ct.addressof(cones), ct.addressof(balls)),
            1e-12,
        )
        given = [array.ctypes.data_as(ct.c_void_p) for array in (x, y, scratch)]
        return kernel.frot_cone_point(ct.byref(problem), *given) == 0, x, y

    def inside(self, x: np.ndarray) -> bool:
        normal, along = x[::3], np.hypot(x[1::3], x[2::3])
        return bool(np.all(normal >= 0) and np.all(along <= self.mu * normal + 1e-12))


def project(x: np.ndarray, mu: float) -> np.ndarray:
    """The nearest point of the cone |f| <= mu N, by its three regions."""
    normal, along = x[0], np.hypot(x[1], x[2])
    if along <= mu * normal:
        return x
    if mu * along <= -normal:
        return np.zeros(3)
    bearing = (normal + mu * along) / (1 + mu**2)
    return np.array([bearing, *(x[1:] * mu * bearing / along)])


def random_feet(rng: np.random.Generator) -> Feet:
    count = int(rng.integers(1, 6))
    places = np.c_[rng.normal(size=(count, 2)), -rng.uniform(0.2, 1, count)]
    axes = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    columns = [[*axis, *np.cross(place, axis)] for place in places for axis in axes]
    return Feet(np.array(columns, float).T, rng.uniform(0.1, 0.8, count))


def admissible(rng: np.random.Generator, feet: Feet, most: float) -> np.ndarray:
    normal, angle = rng.uniform(0, 2, len(feet.mu)), rng.uniform(0, 2 * np.pi, len(feet.mu))
    along = rng.uniform(0.5, most, len(feet.mu)) * feet.mu * normal
    return np.ravel(np.c_[normal, along * np.cos(angle), along * np.sin(angle)])


@pytest.mark.parametrize("seed", range(10))
def test_the_point_is_admissible_and_the_projection_of_its_multipliers(
    kernel: ct.CDLL, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(50):
        feet = random_feet(rng)
        known = admissible(rng, feet, 0.98)
        load = feet.a @ known
        found, x, y = feet.solve(kernel, load)
        assert found
        assert np.abs(feet.a @ x - load).max() <= 1e-11 * (1 + np.abs(load).max())
        assert feet.inside(x)
        assert np.linalg.norm(x) <= np.linalg.norm(known) * (1 + 1e-10)
        of_y = (feet.a.T @ y).reshape(-1, 3)
        least = np.ravel([project(one, mu) for one, mu in zip(of_y, feet.mu, strict=True)])
        assert x == pytest.approx(least, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("seed", range(10))
def test_a_load_that_no_reactions_bear_is_refused(kernel: ct.CDLL, seed: int) -> None:
    """A motion that all reactions resist, and that the load drives, proves that there are none."""
    rng = np.random.default_rng(seed)
    tried = 0
    for _ in range(400):
        feet = random_feet(rng)
        motion = rng.normal(size=6)
        of_feet = (feet.a.T @ motion).reshape(-1, 3)
        resisted = all(
            of_foot[0] + mu * np.hypot(*of_foot[1:]) <= 0
            for of_foot, mu in zip(of_feet, feet.mu, strict=True)
        )
        if not resisted:
            continue
        load = rng.normal(size=6)
        load += motion * (1e-3 - load @ motion) / (motion @ motion)
        tried += 1
        assert not feet.solve(kernel, load)[0]
    assert tried > 5


def test_the_point_changes_continuously_where_a_foot_comes_to_its_bound(kernel: ct.CDLL) -> None:
    """A bar on four feet is pulled ever harder: no reaction jumps up to the limit load."""
    places = [(-0.3, 0.0, -0.2), (-0.1, 0.0, -0.2), (0.1, 0.0, -0.2), (0.3, 0.0, -0.2)]
    axes = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    columns = [[*axis, *np.cross(place, axis)] for place in places for axis in axes]
    feet = Feet(np.array(columns, float).T, np.array([0.3, 0.35, 0.4, 0.45]))
    before: np.ndarray | None = None
    weight = 2 * 9.81
    steps, last = 2000, 0.0
    for pull in np.linspace(0, 8, steps):
        found, x, _ = feet.solve(kernel, np.array([-pull, 0, weight, 0, 0, 0], float))
        if not found:
            break
        if before is not None:
            assert np.abs(x - before).max() < 40 * 8 / steps
        before, last = x, pull
    # the feet slip together at the sum of mu N, which the moments leave undetermined: a linear
    # program gives its largest value
    assert last == pytest.approx(limit_pull(weight, places), abs=2 * 8 / steps)


def limit_pull(weight: float, places: list[tuple[float, float, float]]) -> float:
    """The largest pull at the height of the mass centre: sum mu N, sum N = weight, moments zero."""
    from scipy.optimize import linprog

    mu = np.array([0.3, 0.35, 0.4, 0.45])
    x = np.array([place[0] for place in places])
    height = -places[0][2]
    # about y through the mass centre: -x N (of each) and, of friction along -x, height * pull
    found = linprog(
        [0, 0, 0, 0, -1],
        A_ub=[[*(-mu), 1]],
        b_ub=[0],
        A_eq=[[1, 1, 1, 1, 0], [*x, -height]],
        b_eq=[weight, 0],
        bounds=[(0, None)] * 5,
    )
    return float(found.x[4])


def test_several_bounds_of_one_normal_reaction(kernel: ct.CDLL) -> None:
    """Sliding, rolling and pivoting share N; the projection is the zero of a monotone function."""
    rng = np.random.default_rng(3)
    project_all: Callable[..., None] = kernel.frot_project_cones
    for _ in range(300):
        ratios = rng.uniform(0.05, 1.5, 3)
        x = 2 * rng.normal(size=6)
        cones = (Cone * 1)(Cone(0))
        balls = (Ball * 3)(
            Ball(1, 2, 0, ratios[0]), Ball(3, 2, 0, ratios[1]), Ball(5, 1, 0, ratios[2])
        )
        problem = Problem(6, 0, 1, 3, 0, 0, ct.addressof(cones), ct.addressof(balls), 0)
        found = x.copy()
        project_all(ct.byref(problem), found.ctypes.data_as(ct.c_void_p))
        sizes = np.array([np.hypot(x[1], x[2]), np.hypot(x[3], x[4]), abs(x[5])])
        lo, hi = 0.0, 10.0
        for _ in range(100):
            mid = 0.5 * (lo + hi)
            slope = mid - x[0] - np.sum(ratios * np.maximum(0, sizes - ratios * mid))
            lo, hi = (mid, hi) if slope < 0 else (lo, mid)
        normal = lo if lo > 1e-12 else 0.0
        parts = np.minimum(1, ratios * normal / sizes)
        expected = [normal, *(x[1:3] * parts[0]), *(x[3:5] * parts[1]), x[5] * parts[2]]
        assert found == pytest.approx(np.array(expected), abs=1e-10)
