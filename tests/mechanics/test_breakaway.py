"""Static friction above kinetic friction: break-away and stick-slip."""

from __future__ import annotations

import math

import numpy as np
import pytest
from closed_forms import stick_slip
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from mechanical_scenes import DRAGGED, PULLED, Scenes, near, row, times_of

DRAWN = settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@DRAWN
@given(
    slope=st.floats(-0.3, 0.3),
    mu=st.floats(0.05, 0.6),
    excess=st.floats(0, 1),
    rate=st.one_of(st.floats(0.5, 8), st.floats(-8, -0.5)),
    m=st.floats(0.05, 2),
)
def test_a_growing_pull_breaks_a_block_away_at_the_static_bound(
    scenes: Scenes, slope, mu, excess, rate, m
) -> None:
    """At rest while |c t - m g sin| <= mu_s m g cos; then m x'' = c t - m g sin -+ mu m g cos."""
    mu_s, g, stop = mu * (1 + excess), 9.81, 8.0
    assume(abs(math.tan(slope)) < 0.99 * mu_s)
    weight, press = -m * g * math.sin(slope), m * g * math.cos(slope)
    sense = math.copysign(1, rate)
    start = (sense * mu_s * press - weight) / rate
    assume(start < stop - 0.1)
    result = scenes.run(PULLED, slope=slope, mu=mu, mu_s=mu_s, rate=rate, m=m, stop=stop)
    assert [e.kind for e in result.events] == ["slip"]
    assert near(result.events[0].time, start, scale=stop)
    before = result.at(np.linspace(0, np.nextafter(start * (1 - 1e-10), 0), 30))
    assert np.all(before["support.slip"] == 0.0)
    assert np.all(before["b.position.x"] == 0.0)
    constant = weight - sense * mu * press
    d, end = stop - start, result.at(stop)
    jump = rate * start + constant  # what is left of the pull when it lets go
    speed = (jump * d + rate * d**2 / 2) / m
    place = (jump * d**2 / 2 + rate * d**3 / 6) / m
    assert near(float(end["support.slip"]), speed)
    assert near(float(end["support.abscissa"]), place)
    assert result.balance.relative < 1e-9


def check_stick_slip(result, first: float, slip: float, stick: float) -> None:
    slips, sticks = times_of(result, "slip"), times_of(result, "stick")
    assert [e.kind for e in result.events] == (["slip", "stick"] * len(slips))[: len(result.events)]
    assert len(slips) >= 3
    n, k = np.arange(len(slips)), np.arange(len(sticks))
    assert np.all(np.abs(slips - first - n * (slip + stick)) < 1e-10 * result.time[-1])
    assert np.all(np.abs(sticks - first - slip - k * (slip + stick)) < 1e-10 * result.time[-1])


def test_a_dragged_block_sticks_and_slips_with_the_period_of_the_belt(scenes: Scenes) -> None:
    """In the frame of the block's line: the far end of the spring moves."""
    p, e = row("belt-1")["parameters"], row("belt-1")["expected"]
    result = scenes.run(
        DRAGGED, m=p["m"], k=p["k"], g=p["N"] / p["m"], V=p["v_belt"], mu=p["mu_k"], mu_s=p["mu_s"]
    )
    first = e["x_break"] / p["v_belt"]
    check_stick_slip(result, first, e["t_slip"], e["t_stick"])
    grid = np.linspace(first, 7, 3000)
    stretch = p["v_belt"] * grid - result.at(grid)["b.position.x"]
    assert np.max(stretch) <= e["x_max"] + 1e-10
    assert np.min(stretch) >= e["x_min"] - 1e-10
    assert result.balance.relative < 1e-9


@DRAWN
@given(
    m=st.floats(0.1, 10),
    k=st.floats(20, 300),
    mu=st.floats(0.1, 0.5),
    excess=st.floats(0.1, 1),
    speed=st.floats(0.05, 0.5),
    sense=st.sampled_from((1, -1)),
)
def test_any_dragged_block_sticks_and_slips_with_its_closed_form(
    scenes: Scenes, m, k, mu, excess, speed, sense
) -> None:
    """The formula of S05 with other masses, springs, speeds and both senses."""
    static, kinetic = mu * (1 + excess) * m * 10, mu * m * 10
    first, slip, stick = stick_slip(m, k, speed, static, kinetic)
    assume(stick > 1e-2 * slip)
    result = scenes.run(
        DRAGGED,
        m=m,
        k=k,
        V=sense * speed,
        mu=mu,
        mu_s=mu * (1 + excess),
        stop=first + 3.5 * (slip + stick),
    )
    check_stick_slip(result, first, slip, stick)


@pytest.mark.parametrize("above", (0.0, 0.5))
def test_a_block_at_its_bound_to_the_bit_stays_and_just_past_it_leaves(
    scenes: Scenes, above: float
) -> None:
    """tan(slope) = mu_s: rest is preferred (Painlevé 1895, p. 41-43); past it, motion."""
    mu = 0.25
    mu_s = mu * (1 + above)
    held = scenes.run(PULLED, slope=-math.atan(mu_s), mu=mu, mu_s=mu_s, rate=0.0)
    assert held.events == ()
    assert np.all(held["support.slip"] == 0.0)
    left = scenes.run(PULLED, slope=-math.atan(mu_s * (1 + 1e-9)), mu=mu, mu_s=mu_s, rate=0.0)
    steep = math.atan(mu_s * (1 + 1e-9))
    rate = 9.81 * (math.sin(steep) - mu * math.cos(steep))
    assert abs(left["support.slip"][-1] - rate * 4.0) < 1e-12
    assert left["support.slip"][-1] > 0
