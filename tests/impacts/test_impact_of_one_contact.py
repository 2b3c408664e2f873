"""One contact with friction, in the plane and in space, beside integrations in the impulse."""

from __future__ import annotations

import ctypes as ct

import numpy as np
import pytest
from frot.runtime.impact_law import ENERGETIC, NEWTON, POISSON, friction, normal
from frot.runtime.impact_law import solve_impact as solve
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Floats = NDArray[np.float64]


def body(rng: np.random.Generator, rows: int) -> Floats:
    """The matrix of the rows of a place on a body: normal, then along the tangent plane."""
    mass, inertia = rng.uniform(0.5, 3), np.diag(rng.uniform(0.05, 0.5, 3))
    arm = rng.normal(size=3) * 0.4
    axes = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])[:rows]
    turns = np.cross(arm, axes)
    if rows == 2:
        turns *= np.array([0, 1, 0])
    return axes @ axes.T / mass + turns @ np.linalg.inv(inertia) @ turns.T


def phase_by_phase(w: Floats, u: Floats, mu: float, e: float, law: int) -> tuple[Floats, float]:
    """Speeds after, and the impulse, in the plane: the rates are constant between events."""
    u, p, compressing = u.copy(), 0.0, True
    approach, work, peak, compressed = -u[0], 0.0, 0.0, 0.0
    sense = np.sign(u[1])
    for _ in range(20):
        if sense == 0 and abs(w[0, 1]) <= mu * w[1, 1]:
            rate = w @ [1, -w[0, 1] / w[1, 1]]
        elif sense == 0:
            sense = next(s for s in (1, -1) if s * (w[0, 1] - s * mu * w[1, 1]) > 0)
            rate = w @ [1, -mu * sense]
        else:
            rate = w @ [1, -mu * sense]
        ends = {}
        if u[1] * rate[1] < 0:
            ends["slip"] = -u[1] / rate[1]
        if compressing and rate[0] > 0:
            ends["compression"] = -u[0] / rate[0]
        if not compressing and law == ENERGETIC:
            left = e * e * peak - work
            ends["end"] = (np.sqrt(u[0] ** 2 + 2 * rate[0] * left) - u[0]) / rate[0]
        if not compressing and law == POISSON:
            ends["end"] = (1 + e) * compressed - p
        if not compressing and law == NEWTON:
            ends["end"] = (e * approach - u[0]) / rate[0]
        event = min(ends, key=lambda name: ends[name])
        before = u[0]
        u, p = u + ends[event] * rate, p + ends[event]
        work += abs(before + u[0]) / 2 * ends[event]
        if event == "slip":
            u[1], sense = 0.0, 0
        if event == "compression":
            compressing, peak, work, compressed = False, work, 0.0, p
        if event == "end":
            break
    return u, p


@pytest.mark.parametrize("law", [ENERGETIC, POISSON, NEWTON])
def test_a_body_in_the_plane_goes_through_slip_stick_and_reversal(
    kernel: ct.CDLL, law: int
) -> None:
    rng = np.random.default_rng(law)
    reversals = 0
    for _ in range(300):
        w, mu, e = body(rng, 2), rng.uniform(0, 1), rng.uniform(0, 1)
        if w[0, 0] - mu * abs(w[0, 1]) < 0.01 * w[0, 0]:
            continue
        before = np.array([-rng.uniform(0.1, 3), rng.normal()])
        found = solve(kernel, w, before, [normal(0, e, law), friction(1, 1, 0, mu)])
        after, impulse = phase_by_phase(w, before, mu, e, law)
        assert found.status == 0
        assert found.u == pytest.approx(after, abs=2e-13)
        assert found.p[0] == pytest.approx(impulse, abs=1e-12)
        reversals += before[1] * after[1] < 0
    assert reversals > 20


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_the_direction_of_slip_turns_in_space(kernel: ct.CDLL, scale: float) -> None:
    """G. Darboux and J. Keller: du/dp = W (1, -mu s/|s|), to the end of compression and on."""
    rng = np.random.default_rng(5)
    seen = 0
    for _ in range(40):
        w, mu, e = body(rng, 3), rng.uniform(0.05, 0.4), rng.uniform(0, 1)
        before = np.array([-rng.uniform(0.5, 2), *(2 * rng.normal(size=2))])

        def rates(_: float, y: Floats, w: Floats = w, mu: float = mu) -> Floats:
            d = y[1:3] / np.hypot(*y[1:3])
            rate = w @ [1, -mu * d[0], -mu * d[1]]
            return np.array([*rate, -y[0]])

        def slow(_: float, y: Floats) -> float:
            return np.hypot(*y[1:3]) - 1e-3

        def compressed(_: float, y: Floats) -> float:
            return y[0]

        slow.terminal = compressed.terminal = True  # type: ignore[attr-defined]
        options = {"rtol": 1e-12, "atol": 1e-13, "method": "DOP853"}
        first = solve_ivp(rates, (0, 1e3), [*before, 0], events=(compressed, slow), **options)
        if len(first.t_events[0]) == 0:
            continue
        stored = first.y[3, -1]

        def given_back(_: float, y: Floats, e: float = e, stored: float = stored) -> float:
            return y[3] - (1 - e * e) * stored

        given_back.terminal = True  # type: ignore[attr-defined]
        start = [0.0, *first.y[1:, -1]]
        second = solve_ivp(rates, (0, 1e3), start, events=(given_back, slow), **options)
        if len(second.t_events[0]) == 0:
            continue
        seen += 1
        found = solve(kernel, w / scale, before, [normal(0, e), friction(1, 2, 0, mu)])
        assert found.status == 0
        assert found.u == pytest.approx(second.y[:3, -1], abs=1e-10)
        impulse = first.t[-1] + second.t[-1]
        assert found.p[0] == pytest.approx(scale * impulse, rel=1e-10)
    assert seen > 15


def test_a_sphere_dropped_with_spin(kernel: ct.CDLL) -> None:
    """A billiard ball: its slip s changes by mu (1/m + r^2/I) p, or ends at zero."""
    mass, e, mu = 0.17, 0.9, 0.2
    w = np.diag([1 / mass, 3.5 / mass, 3.5 / mass])
    for slip in ((3.0, 1.0), (0.1, -0.2)):
        found = solve(kernel, w, [-2.0, *slip], [normal(0, e), friction(1, 2, 0, mu)])
        size, impulse = np.hypot(*slip), (1 + e) * mass * 2.0
        left = max(1 - mu * impulse * 3.5 / mass / size, 0)
        assert found.u == pytest.approx([2 * e, left * slip[0], left * slip[1]], abs=1e-15)
        assert found.p[0] == pytest.approx(impulse, rel=1e-15)


def test_the_static_coefficient_holds_within_an_impact(kernel: ct.CDLL) -> None:
    """Once the slip has ended it stays zero up to mu_s, or begins again with mu."""
    w = np.array([[1.0, 0.5], [0.5, 1.0]])
    for mu_s, after in ((0.6, 0.0), (0.45, None)):
        blocks = [normal(0), friction(1, 1, 0, 0.3, mu_s)]
        found = solve(kernel, w, [-1.0, -0.1], blocks)
        if after is not None:
            assert found.u == pytest.approx([0, after], abs=1e-15)
            continue
        p = 0.1 / (0.5 + 0.3)  # the slip ends, and begins again forwards with -mu
        u = -1.0 + p * (1 + 0.3 * 0.5)
        rest = -u / (1 - 0.3 * 0.5)
        assert found.u == pytest.approx([0, rest * (0.5 - 0.3)], abs=1e-15)
