"""Forces with conditions, absolute values and extrema: each kink and jump is located."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mechanical_scenes import PUSHED, Scenes, near
from scipy.optimize import brentq

STEP = PUSHED.format(value="if time < t1 then P else Q")
WINDOW = PUSHED.format(value="if time >= 0.5*t1 and time < t1 then P else Q")
KINK = PUSHED.format(value="-k*abs(b.position.x) + P")
SIGN = PUSHED.format(value="-P*sign(b.position.x)")
LEAST = PUSHED.format(value="min(P, k*b.position.x)")
MOST = PUSHED.format(value="-max(0 N, k*b.position.x)")
PLACE = PUSHED.format(value="if b.position.x > 1 m then Q else P")


@pytest.mark.parametrize("t1", [1.2345, 1.0, 1 / 3, 3.999999])
@pytest.mark.parametrize("m", [1.0, 7.0])
def test_a_force_that_jumps_at_a_time_gives_the_exact_speed_and_place(
    scenes: Scenes, t1: float, m: float
) -> None:
    p, q, stop = 3.0, -2.0, 4.0
    result = scenes.run(STEP, t1=t1, m=m, P=p, Q=q)
    (event,) = result.events
    assert event.kind == "condition"
    assert near(event.time, t1, rel=4e-16)
    rest = stop - t1
    assert near(float(result["b.velocity.x"][-1]), (p * t1 + q * rest) / m, rel=1e-13)
    place = (p * t1**2 / 2 + p * t1 * rest + q * rest**2 / 2) / m
    assert near(float(result["b.position.x"][-1]), place, rel=1e-13)
    assert result.balance.relative < 1e-13
    kinked = result.at(np.array([t1 / 2, (t1 + stop) / 2]))["b.acceleration.x"]
    assert kinked == pytest.approx([p / m, q / m], rel=1e-14)


def test_a_force_in_a_window_of_time_acts_there_and_not_else(scenes: Scenes) -> None:
    result = scenes.run(WINDOW, t1=1.0, P=5.0, Q=0.0)
    assert [e.time for e in result.events] == pytest.approx([0.5, 1.0], rel=1e-15)
    assert near(float(result["b.velocity.x"][-1]), 2.5, rel=1e-14)
    assert near(float(result["b.position.x"][-1]), 0.625 + 2.5 * 3, rel=1e-14)


def test_a_window_too_short_for_the_steps_is_not_stepped_over(scenes: Scenes) -> None:
    """An impulse of 5 N over 1e-4 s in a run of 4 s."""
    text = PUSHED.format(value="if time >= t1 and time < t1 + 1e-4 s then P else Q")
    result = scenes.run(text, t1=2.0, P=5.0, Q=0.0)
    assert len(result.events) == 2
    assert near(float(result["b.velocity.x"][-1]), 5e-4, rel=1e-11)


def oscillation(k: float, centre: float, s: float, v: float):
    """Motion of a unit mass under -k (s - centre); k < 0: away from it."""
    omega = math.sqrt(abs(k))
    if k > 0:
        return lambda t: (
            centre + (s - centre) * math.cos(omega * t) + v / omega * math.sin(omega * t),
            -(s - centre) * omega * math.sin(omega * t) + v * math.cos(omega * t),
        )
    return lambda t: (
        centre + (s - centre) * math.cosh(omega * t) + v / omega * math.sinh(omega * t),
        (s - centre) * omega * math.sinh(omega * t) + v * math.cosh(omega * t),
    )


def test_the_kink_of_an_absolute_value_keeps_the_order(scenes: Scenes) -> None:
    """x'' = P - k |x| from x < 0: hyperbolic motion, then a cosine; slope of the error ~ 1."""
    k, p, v0, s0, stop = 4.0, 3.0, 0.0, -0.5, 2.0
    first = oscillation(-k, -p / k, s0, v0)  # x'' = P + k x
    cross = brentq(lambda t: first(t)[0], 0, stop, xtol=1e-16)
    second = oscillation(k, p / k, 0.0, first(cross)[1])
    exact = second(stop - cross)
    tolerances, errors = [10.0**-n for n in range(4, 13)], []
    for tolerance in tolerances:
        result = scenes.run(KINK, k=k, P=p, s0=s0, stop=stop, tolerance=tolerance)
        assert [e.kind for e in result.events] == ["condition"]
        errors.append(abs(float(result["b.position.x"][-1]) - exact[0]))
    errors = np.maximum(errors, 1e-15)
    assert 0.8 < np.polyfit(np.log(tolerances), np.log(errors), 1)[0] < 1.3
    assert errors[-1] < 1e-12


def test_a_force_with_a_sign_gives_parabolas_of_the_period_4_sqrt_2s_m_over_p(
    scenes: Scenes,
) -> None:
    """x'' = -P sign x: quarter periods sqrt(2 s0 m/P)."""
    result = scenes.run(SIGN, P=3.0, s0=0.7, stop=10.0)
    quarter = math.sqrt(2 * 0.7 / 3)
    expected = np.arange(1, 10 / quarter, 2) * quarter
    found = np.array([e.time for e in result.events])
    assert len(found) == len(expected)
    assert np.max(np.abs(found - expected)) < 1e-12
    assert result.balance.relative < 1e-12


def test_the_least_of_two_forces_changes_where_they_are_equal(scenes: Scenes) -> None:
    """x'' = min(P, k x): hyperbolic to x = P/k, then parabolic."""
    k, p, s0, stop = 4.0, 3.0, 0.1, 3.0
    first = oscillation(-k, 0.0, s0, 0.0)
    cross = math.acosh(p / k / s0) / 2
    speed, d = first(cross)[1], stop - cross
    result = scenes.run(LEAST, k=k, P=p, s0=s0, stop=stop)
    assert [e.kind for e in result.events] == ["condition"]
    assert near(result.events[0].time, cross, rel=1e-11)
    assert near(float(result["b.position.x"][-1]), p / k + speed * d + p * d * d / 2)
    assert near(float(result["b.velocity.x"][-1]), speed + p * d)


def test_a_spring_that_only_pushes_throws_the_bead_back_at_its_speed(scenes: Scenes) -> None:
    """-max(0, k x): half a swing, then free."""
    result = scenes.run(MOST, k=4.0, s0=-1.0, v0=2.0, stop=4.0)
    meet, leave = 0.5, 0.5 + math.pi / 2
    assert [e.time for e in result.events] == pytest.approx([meet, leave], rel=1e-11)
    assert near(float(result["b.velocity.x"][-1]), -2.0)
    assert near(float(result["b.position.x"][-1]), -2.0 * (4.0 - leave))


def test_a_force_that_changes_at_a_place_is_located_there(scenes: Scenes) -> None:
    """Pushed by P to x = 1, then back by Q until it returns there, and so on for ever."""
    result = scenes.run(PLACE, P=3.0, Q=-2.0, stop=4.0)
    speed = math.sqrt(2 * 3.0)
    first = speed / 3.0
    expected = [first]
    while True:  # over the place for 2 v/2, then below it for 2 v/3
        expected.append(expected[-1] + 2 * speed / (2.0 if len(expected) % 2 else 3.0))
        if expected[-1] > 4.0:
            break
    assert [e.time for e in result.events] == pytest.approx(expected[:-1], rel=1e-11)
