"""The error follows the tolerance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from closed_forms import coulomb_oscillator, oscillator_at
from mechanical_scenes import BEAD_AND_SPRING, OSCILLATOR, Scenes

LONG = np.longdouble


def slope_of(tolerances: list[float], errors: list[float]) -> float:
    """Slope of log error against log tolerance, by least squares."""
    return float(np.polyfit(np.log(tolerances), np.log(errors), 1)[0])


def extrapolated(slope, y0: list[float], end: float, steps: int) -> np.ndarray:
    """Gragg-Bulirsch-Stoer with 10 columns in long double: an integrator of order 20."""
    y, h = np.array(y0, dtype=LONG), LONG(end) / steps
    for _ in range(steps):
        table: list[np.ndarray] = []
        for k in range(1, 11):
            n, row = 2 * k, []
            d = h / n
            before, now = y, y + d * slope(y)
            for _ in range(n - 1):
                before, now = now, before + 2 * d * slope(now)
            row.append((before + now + d * slope(now)) / 2)
            for j in range(1, k):
                ratio = (LONG(k) / LONG(k - j)) ** 2
                row.append(row[-1] + (row[-1] - table[j - 1]) / (ratio - 1))
            table = row
        y = table[-1]
    return y


def bead_on_line(end: float) -> np.ndarray:
    """Bead of BEAD_AND_SPRING while it slides up its line: abscissa and speed at the end."""
    g, mu, k, rest, off = LONG("9.81"), LONG("0.2"), LONG(15), LONG("0.8"), LONG("0.7")
    incline = LONG(20) * LONG(math.pi) / 180

    def rate(y: np.ndarray) -> np.ndarray:
        length = np.sqrt(y[0] ** 2 + off**2)
        tension = k * (length - rest)
        press = g * np.cos(incline) - tension * off / length
        along = -g * np.sin(incline) - tension * y[0] / length
        return np.array([y[1], along - mu * abs(press) * np.sign(y[1])], dtype=LONG)

    return extrapolated(rate, [-1.0, 6.0], end, 32)


def test_the_error_of_the_coulomb_oscillator_is_in_proportion_to_the_tolerance(
    scenes: Scenes,
) -> None:
    """Painlevé 1895, p. 61-62, through eight reversals and rest; both places and event times."""
    m, k, bound, s0 = 1.0, 9.0, 0.981, 2.0
    times, places = coulomb_oscillator(m, k, 0.0, bound, s0)
    grid = np.linspace(0, 12, 400)
    exact = np.array([oscillator_at(t, m, k, 0.0, times, places)[0] for t in grid])
    tolerances = [10.0**-n for n in range(4, 13)]
    errors, late = [], []
    for tolerance in tolerances:
        result = scenes.run(OSCILLATOR, tolerance=tolerance)
        errors.append(float(np.max(np.abs(result.at(grid)["b.position.x"] - exact))))
        late.append(max(abs(e.time - t) for e, t in zip(result.events, times[1:], strict=True)))
    assert 0.8 < slope_of(tolerances, errors) < 1.3
    assert 0.8 < slope_of(tolerances, late) < 1.3
    assert all(error < 20 * s0 * tol for error, tol in zip(errors, tolerances, strict=True))


def test_the_error_of_a_bead_drawn_by_a_spring_is_in_proportion_to_the_tolerance(
    scenes: Scenes,
) -> None:
    """The reaction, hence friction, follows the spring; reference in long double of order 20."""
    times = np.linspace(0.06, 0.3, 9)  # the error at one time may be small by chance
    references = [bead_on_line(t) for t in times]
    assert references[-1][1] > 1  # it still slides upwards, so that the reference holds
    tolerances = [10.0**-n for n in range(4, 13)]
    errors = []
    for tolerance in tolerances:
        result = scenes.run(BEAD_AND_SPRING, tolerance=tolerance, stop=0.3)
        assert result.events == ()
        places = result.at(times)["guide.abscissa"]
        errors.append(
            max(abs(float(LONG(x) - r[0])) for x, r in zip(places, references, strict=True))
        )
    assert 0.8 < slope_of(tolerances, errors) < 1.3
    assert errors[-1] < 1e-11


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8, 1e-10, 1e-12])
def test_dense_output_is_as_exact_as_the_steps(scenes: Scenes, tolerance: float) -> None:
    """Between steps and at their ends the error has the same size (oscillator, first swing)."""
    result = scenes.run(OSCILLATOR, tolerance=tolerance, stop=1.0)
    grid = np.linspace(0, 1, 1001)
    exact = [oscillator_at(t, 1, 9, 0, *coulomb_oscillator(1, 9, 0, 0.981, 2))[0] for t in grid]
    error = np.abs(result.at(grid)["b.position.x"] - np.array(exact))
    assert np.max(error) < max(20 * tolerance, 1e-14)
