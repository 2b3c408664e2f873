"""A trammel with friction and chains of many links, against integrations of their own equations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]
G = 9.81
MODELS = Path(__file__).parents[3] / "models"


def trammel_rates(y: np.ndarray, mu: float, tilt: float, sense: int) -> tuple[list[float], float]:
    """Rates of the angle and of its rate, and the acceleration along the tilted line.

    The middle of the rod lies at -cos(angle)/cos(tilt) along the tilted line. The other line
    pushes the tip by p, the tilted one by n = G cos(tilt) + p sin(tilt), whose sign is tried.
    """
    angle, rate = y
    inertia, c, s = 1 / 3, np.cos(tilt), np.sin(tilt)
    for side in (1, -1):
        held = mu * side * sense
        push = np.cos(angle) * rate**2 / c + G * s + held * G * c
        p = push / (c - held * s + np.sin(angle) ** 2 / (inertia * c))
        if (G * c + p * s) * side >= 0:
            break
    turned = -p * np.sin(angle) / inertia
    return [rate, turned], (np.sin(angle) * turned + np.cos(angle) * rate**2) / c


def trammel_reference(
    y: list[float], stop: float, mu: float, tilt: float
) -> tuple[list[float], np.ndarray]:
    """The times at which the slip turns, and the end, by order 8 from turn to turn."""
    time, turns = 0.0, []
    state, sense = np.array(y), int(np.sign(np.sin(y[0]) * y[1]))
    while True:

        def slip(_: float, z: np.ndarray) -> float:
            return float(np.sin(z[0]) * z[1])

        slip.terminal, slip.direction = True, -sense  # type: ignore[attr-defined]
        part = solve_ivp(
            lambda _, z, sense=sense: trammel_rates(z, mu, tilt, sense)[0],
            (time, stop), state, method="DOP853", rtol=1e-12, atol=1e-14, events=slip,
        )  # fmt: skip
        time, state = part.t[-1], part.y[:, -1]
        if part.status == 0:
            return turns, state
        turns.append(time)
        (sense,) = (q for q in (1, -1) if q * trammel_rates(state, mu, tilt, q)[1] > 0)


@pytest.mark.parametrize(
    ("mu", "tilt", "angle", "rate"),
    [
        (0.20106, -0.57045, -0.58132, -1.77927),
        (0.20106, 0.57045, 0.58132 - np.pi, 1.77927),
        (0.05, 0.3, 1.0, 4.0),
        (0.0, -0.57045, -0.58132, -1.77927),
    ],
)
def test_a_rod_on_two_lines_passes_where_sticking_is_singular(
    finding: Finding, mu: float, tilt: float, angle: float, rate: float
) -> None:
    changes = {"-0.58132": str(angle), "-1.77927": str(rate)}
    model = finding("trammel", changes)
    stop = 3.0
    turns, end = trammel_reference([angle, rate], stop, mu, tilt)
    assert len(turns) > 1
    for tolerance in (1e-6, 1e-9, 1e-12):
        result = model.simulate(stop=stop, tolerance=tolerance, parameters={"mu": mu, "tilt": tilt})
        at = result.at(stop)
        allowed = 100 * tolerance + 1e-10
        assert at["b.angle"] == pytest.approx(end[0], abs=allowed)
        assert at["b.angular_velocity"] == pytest.approx(end[1], abs=allowed * 10)
        if mu:
            # the kinds besides are reactions that pass zero
            found = [e.time for e in result.events if e.kind == "reversal"]
            assert found == pytest.approx(turns, abs=allowed)
            assert {e.kind for e in result.events} <= {"reversal", "reaction"}


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_friction_of_a_rod_on_two_lines_brakes_and_the_energy_is_told(
    finding: Finding, tolerance: float
) -> None:
    result = finding("trammel").simulate(tolerance=tolerance)
    assert result.time[-1] == 10
    assert result.balance.relative < 100 * tolerance
    normal, friction = result["A.normal_force"], result["A.tangential_force"]
    largest = np.abs(normal).max()
    assert np.abs(friction).max() > 0
    assert np.all(np.abs(friction) <= 0.20106 * np.abs(normal) + 1e-10 * largest)
    assert np.all(friction * np.sign(result["A.slip"]) <= 1e-10 * largest)


def chain_masses(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Of n uniform rods in absolute angles: the metric where all are aligned, and the weights."""
    links = np.arange(n)
    after = n - 1 - np.maximum.outer(links, links)
    return np.where(np.eye(n, dtype=bool), 1 / 3, 1 / 2) + after, 0.5 + n - 1 - links


def chain_reference(n: int, first: float, apart: float) -> np.ndarray:
    """The angles of n uniform rods after 1 s: Lagrange's equations in absolute angles."""
    masses, weights = chain_masses(n)

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        angle, rate = y[:n], y[n:]
        apart = np.subtract.outer(angle, angle)
        pull = masses * np.sin(apart) @ rate**2 + G * weights * np.cos(angle)
        return np.concatenate([rate, -np.linalg.solve(masses * np.cos(apart), pull)])

    start = np.concatenate([first + apart * np.arange(n), np.zeros(n)])
    return solve_ivp(rates, (0, 1), start, method="DOP853", rtol=2.3e-14, atol=1e-14).y[:n, -1]


def chain_angles(result: frot.Result, n: int) -> np.ndarray:
    """The absolute angles after 1 s."""
    at = result.at(1.0)
    return np.cumsum([float(at[f"{j}.angle"]) for j in ["o", *(f"j[{k}]" for k in range(1, n))]])


@pytest.mark.parametrize("n", [2, 5, 20, 40])
def test_the_tolerance_has_its_effect_on_a_long_chain(finding: Finding, n: int) -> None:
    """Also from the horizontal, where accelerations of the outer joints begin as rounding."""
    model = finding("chain", {"n = 20;": f"n = {n};"})
    for first, apart in ((-np.pi / 2 + 0.5, 0.2), (0.0, 0.0)):
        exact, start = chain_reference(n, first, apart), {"first": first, "apart": apart}
        for tolerance in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
            result = model.simulate(tolerance=tolerance, parameters=start)
            assert np.abs(chain_angles(result, n) - exact).max() < 10 * tolerance + 1e-12
            assert result.figures.steps < 400


@pytest.mark.parametrize("n", [2, 5, 20, 40])
def test_a_chain_upright_moves_as_rounding_makes_it(finding: Finding, n: int) -> None:
    """A difference of rounding grows as exp(rate t) at most, and no step is spent on it."""
    model = finding("chain", {"n = 20;": f"n = {n};"})
    masses, weights = chain_masses(n)
    rate = np.sqrt(np.linalg.eigvals(np.linalg.solve(masses, np.diag(G * weights))).real.max())
    for tolerance in (1e-4, 1e-8, 1e-12):
        start = {"first": np.pi / 2, "apart": 0}
        result = model.simulate(tolerance=tolerance, parameters=start)
        moved = np.abs(chain_angles(result, n) - np.pi / 2).max()
        assert moved < 10 * np.finfo(float).eps * np.exp(rate)
        assert result.figures.steps < 100


def test_a_small_swing_is_followed_to_its_own_size() -> None:
    """Rounding is no excuse where there is none: 1e-10 rad cos(w t), w^2 = m g l / J."""
    model = frot.load(MODELS / "physical_pendulum.frot")
    for tolerance in (1e-4, 1e-8, 1e-12):
        result = model.simulate(tolerance=tolerance, parameters={"start": 1e-10})
        exact = 1e-10 * np.cos(np.sqrt(1.5 * G) * result.time)
        assert np.abs(result["pin.angle"] - exact).max() < 1e-10 * (10 * tolerance + 1e-13)
