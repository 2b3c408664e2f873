"""Several contacts in one impact share it as springs of one stiffness."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest
from frot.runtime.impact_law import ENERGETIC, POISSON, Block, friction, normal
from frot.runtime.impact_law import solve_impact as solve
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Floats = NDArray[np.float64]


def row_of_balls(masses: Floats) -> Floats:
    """The matrix of the gaps between balls in a row."""
    inverse = 1 / masses
    return (
        np.diag(inverse[:-1] + inverse[1:]) - np.diag(inverse[1:-1], 1) - np.diag(inverse[1:-1], -1)
    )


def springs(w: Floats, u: Floats) -> Floats:
    """Speeds after, of elastic contacts: u' = W F, F' = -u while F or -u is positive."""

    def rates(_: float, y: Floats) -> Floats:
        n = len(u)
        force = np.maximum(-y[n:], 0)
        return np.concatenate([w @ force, y[:n]])

    y = solve_ivp(rates, (0, 60), [*u, *np.zeros(len(u))], rtol=1e-11, atol=1e-12, max_step=0.01)
    return y.y[: len(u), -1]


@pytest.mark.parametrize("count", [3, 4, 6])
def test_a_cradle_of_elastic_balls_conserves_energy(kernel: ct.CDLL, count: int) -> None:
    w = row_of_balls(np.ones(count))
    before = np.zeros(count - 1)
    before[0] = -1.0
    found = solve(kernel, w, before, [normal(k, 1.0) for k in range(count - 1)])
    assert found.status == 0
    assert found.u == pytest.approx(springs(w, before), abs=2e-6)
    speeds = np.zeros(count)
    speeds[0] = 1.0
    speeds[:-1] -= found.p
    speeds[1:] += found.p
    assert speeds.sum() == pytest.approx(1, abs=1e-13)
    assert (speeds**2).sum() == pytest.approx(1, abs=1e-11)
    assert sum(found.lost) == pytest.approx(0, abs=1e-11)


def test_symmetric_impacts_stay_symmetric(kernel: ct.CDLL) -> None:
    """Two balls meet one between them, and a bar falls flat on two supports."""
    w = row_of_balls(np.ones(3))
    for law in (ENERGETIC, POISSON):
        for e in (0.0, 0.4, 1.0):
            found = solve(kernel, w, [-1.0, -1.0], [normal(0, e, law), normal(1, e, law)])
            assert found.u == pytest.approx([e, e], abs=1e-11)
            assert found.p[0] == found.p[1]


def test_balls_far_apart_in_mass(kernel: ct.CDLL) -> None:
    """A light ball between heavy ones bounces to and fro within the impact."""
    w = row_of_balls(np.array([1.0, 1e-3, 1.0]))
    found = solve(kernel, w, [-1.0, 0.0], [normal(0, 1.0), normal(1, 1.0)])
    assert found.u == pytest.approx(springs(w, np.array([-1.0, 0.0])), abs=1e-4)
    assert sum(found.lost) == pytest.approx(0, abs=1e-10)


def feet(rng: np.random.Generator, count: int, components: int) -> Floats:
    """The rows of a body on its feet: of each the normal, then along the tangent plane."""
    axes = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])[: components + 1]
    places = np.c_[rng.normal(size=(count, 2)), -rng.uniform(0.1, 0.6, count)]
    rows = np.array([[*axis, *np.cross(place, axis)] for place in places for axis in axes])
    if components == 1:
        rows[:, [1, 3, 5]] = 0
    inverse = 1 / np.array([1, 1, 1, *rng.uniform(0.1, 0.5, 3)])
    return rows * np.sqrt(inverse)


@pytest.mark.parametrize("components", [1, 2])
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_no_impact_makes_energy(kernel: ct.CDLL, count: int, components: int) -> None:
    """Speeds part, impulses are within their cones, the blocks take the energy that is lost."""
    rng = np.random.default_rng(count + 10 * components)
    solved = 0
    for _ in range(60 if count < 3 else 25):
        half = feet(rng, count, components)
        w, step = half @ half.T, components + 1
        motion = rng.normal(size=6)
        before = half @ motion
        before[::step] = np.where(rng.random(count) < 0.3, 0, before[::step])
        half = half.copy()
        blocks: list[Block] = []
        mu = rng.uniform(0, 0.8, count)
        for k in range(count):
            law = int(rng.integers(2))
            blocks += [
                normal(step * k, float(rng.choice([0.0, 0.3, 0.9])), law),
                friction(step * k + 1, components, step * k, mu[k]),
            ]
        found = solve(kernel, w, before, blocks)
        if found.status != 0:
            continue
        solved += 1
        assert found.u[::step].min() >= -1e-11
        assert found.p[::step].min() >= 0
        for k in range(count):
            along = np.linalg.norm(found.p[step * k + 1 : step * (k + 1)])
            assert along <= mu[k] * found.p[step * k] + 1e-11
        # a slip of two components passes zero at a distance of 1e-10 of its size
        assert found.u == pytest.approx(before + w @ found.p, abs=1e-10 * 10 ** (components - 1))
        lost = -0.5 * found.p @ (before + found.u)
        assert lost >= -1e-11
        assert sum(found.lost) == pytest.approx(lost, abs=1e-9)
    assert solved >= 20
