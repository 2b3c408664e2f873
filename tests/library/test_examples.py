"""The worked examples of the library against closed forms and independent integrations."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import frot

MODELS = Path(__file__).parents[2] / "models"

State = NDArray[np.float64]
Rate = Callable[[float, State], list[float]]


def integrate(rate: Rate, start: State, begin: float, end: float, times: State) -> State:
    """The states at those of `times` that lie in [begin, end), and at its end, as columns."""
    inside = times[(times >= begin) & (times < end)]
    solved = solve_ivp(
        rate, (begin, end), start, "DOP853", np.append(inside, end), rtol=1e-13, atol=1e-14
    )
    assert solved.success
    return np.asarray(solved.y)


def test_the_discs_meet_heat_the_linings_and_part_again() -> None:
    result = frot.load(MODELS / "clutch_engagement.frot").simulate(tolerance=1e-11)
    couple = 0.25 * 0.12 * 400
    meet = 0.25 + 60 / (couple * (1 / 0.8 + 1 / 0.5))
    # held while 0.8/1.3 of the load is below the couple of rest
    part = 4 + 0.32 * 0.12 * 400 * 1.3 / 0.8 / 20
    told = [(e.time, e.before, e.after) for e in result.events if e.liaison == "clutch"]
    assert [(b, a) for _, b, a in told] == [("slip", "stick"), ("stick", "slip")]
    assert [t for t, _, _ in told] == pytest.approx([meet, part], abs=1e-10)
    together = (result.time > meet) & (result.time < part)
    assert np.abs(result["clutch.slip"][together]).max() < 1e-13
    reduced = 0.8 * 0.5 / 1.3
    assert result["heat"][together] == pytest.approx(reduced * 60**2 / 2, abs=1e-8)
    after = result.time[result.time > part]
    speed = 60 * 0.8 / 1.3 - 10 * (part - 4) ** 2 / 1.3 - couple / 0.8 * (after - part)
    assert np.abs(result["driving.speed"][result.time > part] - speed).max() < 1e-9


def drive_rate(reference: Callable[[float], float], load: float, turning: bool) -> Rate:
    """Rates of current, speed and integral of the controller, away from its limits."""

    def rate(t: float, state: State) -> list[float]:
        i, w, integral = state
        u = reference(t) - w
        voltage = 0.25 * (u + integral)
        assert abs(voltage) < 24
        couple = (0.12 * i - 0.05 - load) / 2e-3 if turning else 0.0
        return [(voltage - 0.8 * i - 0.12 * w) / 1.5e-3, couple, u / 0.06]

    return rate


def test_the_drive_follows_an_independent_integration() -> None:
    result = frot.load(MODELS / "speed_drive.frot").simulate(tolerance=1e-11)

    def ramp(t: float) -> float:
        return 250 * (t - 0.1)

    def full(t: float) -> float:
        return 100.0

    held = drive_rate(ramp, 0.0, turning=False)

    def starting(t: float) -> float:
        state = integrate(held, np.zeros(3), 0.1, t, np.empty(0))[:, -1]
        return 0.12 * float(state[0]) - 0.08

    starts = brentq(starting, 0.105, 0.12, xtol=1e-14)
    pieces = [(0.1, held), (starts, drive_rate(ramp, 0.0, True))]
    pieces += [(0.5, drive_rate(full, 0.0, True)), (1.5, drive_rate(full, 0.15, True))]
    state, ends = np.zeros(3), [starts, 0.5, 1.5, 2.5]
    for (begin, rate), end in zip(pieces, ends, strict=True):
        inside = (result.time >= begin) & (result.time < end)
        found = integrate(rate, state, begin, end, result.time)
        state = found[:, -1]
        assert np.abs(result["current"][inside] - found[0, :-1]).max() < 1e-7
        assert np.abs(result["speed"][inside] - found[1, :-1]).max() < 1e-7
    told = next(e for e in result.events if e.liaison == "bearing")
    assert told.time == pytest.approx(starts, abs=1e-9)
    assert result["speed"][-1] == pytest.approx(100, abs=1e-4)


def test_the_integral_of_a_drive_at_its_limit_stays_bounded() -> None:
    """At 10 V the machine cannot reach its speed: the voltage stays there, and nothing winds up."""
    model = frot.load(MODELS / "speed_drive.frot")
    result = model.simulate(parameters={"controller.y_max": 10.0}, stop=5.0)
    speed = (10 - 0.8 * 0.2 / 0.12) / 0.12
    assert result["voltage"].max() == 10
    assert result["speed"][-1] == pytest.approx(speed, abs=1e-9)
    assert result["controller.free"][-1] == pytest.approx(10 + 0.25 * (100 - speed), abs=1e-9)


def test_the_rectifier_follows_an_independent_integration() -> None:
    result = frot.load(MODELS / "half_wave_rectifier.frot").simulate(tolerance=1e-11)
    r, c, on, off, forward = 120.0, 470e-6, 0.5, 1e6, 0.7

    def drop(t: float, v: float) -> float:
        return 325 / 19 * math.sin(100 * math.pi * t) - v

    def conducting(t: float, state: State) -> list[float]:
        i = (drop(t, state[0]) - forward) / on + forward / off
        return [(i - state[0] / r) / c]

    def blocking(t: float, state: State) -> list[float]:
        return [(drop(t, state[0]) / off - state[0] / r) / c]

    times = [e.time for e in result.events]
    assert len(times) == 10
    bounds = [0.0, *times, 0.1]
    state, rate = np.zeros(1), blocking
    for begin, end in pairwise(bounds):
        inside = (result.time >= begin) & (result.time < end)
        found = integrate(rate, state, begin, end, result.time)
        state = found[:, -1]
        assert np.abs(result["behind"][inside] - found[0, :-1]).max() < 1e-8
        if end < 0.1:
            # the instant told is the one at which the drop is that of the bend
            assert drop(end, float(state[0])) == pytest.approx(forward, abs=1e-7)
        rate = conducting if rate is blocking else blocking


# ------------------------------------------------------------------ the geared motor

U, R, L, K, ROTOR, RATIO, MASS, LENGTH, PIN = 6.0, 2.0, 2e-3, 0.03, 2e-5, 40.0, 1.2, 0.3, 8e-3
WEIGHT = MASS * 9.81
INERTIA = MASS * LENGTH**2 / 3 + RATIO**2 * ROTOR


def angular_acceleration(mu: float, i: float, angle: float, speed: float) -> float:
    """From the couples about the pin, whose friction follows the reaction and so the result."""
    couple = RATIO * K * i - WEIGHT * LENGTH / 2 * math.cos(angle)
    along = -MASS * LENGTH / 2 * speed**2 + WEIGHT * math.sin(angle)
    acceleration = couple / INERTIA
    for _ in range(60):
        across = MASS * LENGTH / 2 * acceleration + WEIGHT * math.cos(angle)
        new = (couple - mu * PIN * math.hypot(along, across)) / INERTIA
        if new == acceleration:
            break
        acceleration = new
    return acceleration


@pytest.mark.parametrize("mu", [0.0, 0.1, 0.35])
def test_the_geared_motor_follows_an_independent_integration(mu: float) -> None:
    text = (MODELS / "geared_motor.frot").read_text(encoding="utf-8")
    assert "coulomb(0.1, radius = 8 mm)" in text
    result = frot.compile(text.replace("coulomb(0.1,", f"coulomb({mu},")).simulate(tolerance=1e-11)

    def moving(t: float, state: State) -> list[float]:
        i, angle, speed = state
        acceleration = angular_acceleration(mu, i, angle, speed)
        return [(U - R * i - RATIO * K * speed) / L, speed, acceleration]

    # At rest below the pin, until the couple of the current exceeds the friction of the weight.
    current = mu * PIN * WEIGHT / (RATIO * K)
    begins = -L / R * math.log1p(-current * R / U)
    start = np.array([current, -math.pi / 2, 0.0])
    found = integrate(moving, start, begins, 2.0, result.time)
    inside = (result.time >= begins) & (result.time < 2.0)
    assert found[2].min() >= 0  # forward only
    assert np.abs(result["i"][inside] - found[0, :-1]).max() < 1e-7
    assert np.abs(result["phi"][inside] - found[1, :-1]).max() < 1e-7
    assert np.abs(result["hinge.speed"][inside] - found[2, :-1]).max() < 1e-7
