"""One body on one line: block, Coulomb oscillator and hoop against their closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from closed_forms import block_on_slope, coulomb_oscillator, hoop_on_line, oscillator_at
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from mechanical_scenes import (
    BLOCK,
    HOOP,
    OSCILLATOR,
    Scenes,
    falling,
    near,
    rests_from,
    row,
    rows,
    weighed,
)

DOWN = {"-y": -math.pi / 2, "+y": math.pi / 2, "+x": 0.0, "-x": math.pi}
DRAWN = settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def images(slope: float, turn: float, v0: float, w0: float = 0.0) -> dict[str, tuple]:
    """The scene and its images: parameters, then the signs of displacement and angle."""
    base = {"slope": slope, "turn": turn, "v0": v0, "w0": w0, "up": 1.0}
    return {
        "as printed": (base, 1, 1),
        "line reversed": ({**base, "slope": slope + math.pi, "v0": -v0, "up": -1.0}, -1, 1),
        "mirrored": (
            {**base, "slope": math.pi - slope, "turn": math.pi - turn, "w0": -w0, "up": -1.0},
            1,
            -1,
        ),
        "mirrored, line reversed": (
            {**base, "slope": -slope, "turn": math.pi - turn, "v0": -v0, "w0": -w0},
            -1,
            -1,
        ),
        "far away": ({**base, "x0": 100.0, "y0": -70.0}, 1, 1),
        "turned by 1 rad": ({**base, "slope": slope + 1, "turn": turn + 1}, 1, 1),
        "turned by -2.5 rad, far away": (
            {**base, "slope": slope - 2.5, "turn": turn - 2.5, "x0": -100.0, "y0": 100.0},
            1,
            1,
        ),
    }


IMAGES = tuple(images(0.0, 0.0, 0.0))


def as_block(parameters: dict) -> dict:
    return {k: v for k, v in parameters.items() if k not in ("up", "w0")}


def along(result, parameters: dict, body: str, t: float) -> tuple[float, float]:
    """Displacement along the line from the start, and speed along it."""
    e = np.array([math.cos(parameters["slope"]), math.sin(parameters["slope"])])
    start, now = result.at(result.time[0]), result.at(t)
    moved = [float(now[f"{body}.position.{c}"] - start[f"{body}.position.{c}"]) for c in "xy"]
    speed = [float(now[f"{body}.velocity.{c}"]) for c in "xy"]
    return float(e @ moved), float(e @ speed)


@pytest.mark.parametrize("image", IMAGES)
@pytest.mark.parametrize("name", [r["id"] for r in rows("inclined_line")])
def test_a_block_on_a_rough_slope_moves_as_painleve_p_58_says(
    scenes: Scenes, name: str, image: str
) -> None:
    given_, expected = row(name)["parameters"], row(name)["expected"]
    parameters, sign, _ = images(-given_["incline"], -math.pi / 2, given_["v0"])[image]
    result = scenes.run(
        weighed(BLOCK, "b"),
        **as_block(parameters),
        g=given_["g"],
        mu=given_["f"],
        stop=max(given_["t"], expected.get("t_stop", 0) + 0.5),
    )
    assert near(sign * along(result, parameters, "b", given_["t"])[0], expected["s_t"])
    if "t_stop" in expected:
        assert [e.kind for e in result.events] == ["stick"]
        assert near(result.events[0].time, expected["t_stop"])
        assert near(
            sign * along(result, parameters, "b", result.events[0].time)[0], expected["s_stop"]
        )
        assert rests_from(result, result.events[0].time, "b")
        assert result.at(given_["t"])["support.mode"] == 2
    else:
        assert [e.kind for e in result.events] == ["reversal"]
        assert near(result.events[0].time, expected["t_reversal"])
        assert near(
            sign * along(result, parameters, "b", result.events[0].time)[0], expected["s_reversal"]
        )


@pytest.mark.parametrize("down", DOWN)
@pytest.mark.parametrize("side", (1, -1))
def test_a_block_stops_on_a_gentle_slope_whatever_axis_gravity_follows(
    scenes: Scenes, down: str, side: int
) -> None:
    """`side` mirrors the slope."""
    p, e = row("block_on_incline-1")["parameters"], row("block_on_incline-1")["expected"]
    slope = DOWN[down] + side * (math.pi / 2 - math.radians(p["slope_deg"]))
    result = scenes.run(
        falling(BLOCK, down),
        slope=slope,
        mu=p["mu"],
        v0=p["v0_downslope"],
        g=p["g"],
        x0=-100.0,
        y0=50.0,
        stop=p["t_end"],
    )
    assert [e.kind for e in result.events] == ["stick"]
    assert near(result.events[0].time, e["t_stop"])
    assert near(along(result, {"slope": slope}, "b", p["t_end"])[0], e["x_stop"])
    assert rests_from(result, result.events[0].time, "b")


@DRAWN
@given(
    slope=st.floats(-3.1, 3.1),
    turn=st.floats(-3.1, 3.1),
    mu=st.floats(0, 1.5),
    v0=st.floats(-10, 10),
    m=st.floats(1e-3, 1e3),
    g=st.floats(0.5, 30),
    place=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
def test_any_block_on_any_slope_follows_the_closed_form(
    scenes: Scenes, slope, turn, mu, v0, m, g, place
) -> None:
    """Painlevé 1895, p. 58."""
    stop = 3.0
    pull, press = g * math.cos(turn - slope), g * abs(math.sin(turn - slope))
    motion = block_on_slope(v0, pull, mu * press, stop)
    assume(motion.margin > 1e-3 and (v0 == 0 or abs(v0) > 1e-3))
    result = scenes.run(
        weighed(BLOCK, "b"),
        slope=slope,
        turn=turn,
        mu=mu,
        v0=v0,
        m=m,
        g=g,
        x0=place[0],
        y0=place[1],
        stop=stop,
    )
    # where nothing holds (mu = 0) nothing switches when the block turns back
    switches = motion.phases[1:] if mu > 0 else []
    for event, phase in zip(result.events, switches, strict=True):
        assert event.kind == ("reversal" if phase.slip else "stick")
        assert near(event.time, phase.t)
    s, v, _, _ = motion.at(stop)
    reach = max(abs(motion.at(t)[0]) for t in np.linspace(0, stop, 50))
    found = along(result, {"slope": slope}, "b", stop)
    assert abs(found[0] - s) <= 1e-10 * reach + 1e-13
    assert near(found[1], v, scale=abs(v0) + g * stop)
    if motion.phases[-1].slip == 0 and v0 != 0:
        assert rests_from(result, result.events[-1].time, "b")
    assert result.balance.relative < 1e-9


def check_oscillator(result, parameters: dict, m, k, pull, bound, s0) -> None:
    times, places = coulomb_oscillator(m, k, pull, bound, s0)
    kinds = ["reversal"] * (len(times) - 2) + ["stick"] * (len(times) > 1)
    assert [e.kind for e in result.events] == kinds
    for event, time, place in zip(result.events, times[1:], places[1:], strict=True):
        assert near(event.time, time)
        moved, _ = along(result, parameters, "b", event.time)
        assert near(s0 + moved, place, scale=abs(s0) + abs(pull) / k)
    for t in np.linspace(result.time[0], result.time[-1], 37):
        s, v = oscillator_at(t, m, k, pull, times, places)
        moved, speed = along(result, parameters, "b", t)
        size = abs(s0) + abs(pull) / k
        assert near(s0 + moved, s, scale=size)
        assert near(speed, v, scale=size * math.sqrt(k / m))
    last = times[-1] if len(times) == 1 else result.events[-1].time
    assert rests_from(result, last, "b")


@pytest.mark.parametrize("image", IMAGES)
@pytest.mark.parametrize("name", ["coulomb_oscillator-1", "coulomb_oscillator-2"])
def test_half_swings_in_a_rough_tube_are_isochronous_and_end_in_rest(
    scenes: Scenes, name: str, image: str
) -> None:
    """Painlevé 1895, p. 61-62."""
    p, e = row(name)["parameters"], row(name)["expected"]
    if "F_coulomb" in p:
        m, k, bound, s0 = p["m"], p["k"], p["F_coulomb"], p["x0"]
        g, mu = 9.81, bound / (m * 9.81)
        rest, place, count = e["t_stop"], e["x_final"], e["half_cycles"]
    else:
        m, k, s0, g, mu = 1.0, p["k"] ** 2, p["x0"], p["g"], p["f"]
        bound, rest, place, count = mu * m * g, e["t_rest"], e["x_rest"], e["half_swings"]
    parameters, sign, _ = images(0.0, -math.pi / 2, 0.0)[image]
    parameters = {n: v for n, v in as_block(parameters).items() if n != "v0"}
    result = scenes.run(
        OSCILLATOR, **parameters, m=m, k=k, g=g, mu=mu, s0=sign * s0, stop=rest + 2.0
    )
    assert len(result.events) == count
    assert near(result.events[-1].time, rest)
    end = sign * (sign * s0 + along(result, parameters, "b", rest + 2.0)[0])
    assert near(end, place, scale=abs(s0))
    check_oscillator(result, parameters, m, k, 0.0, bound, sign * s0)


@DRAWN
@given(
    slope=st.floats(-3.1, 3.1),
    lean=st.floats(-1.2, 1.2),
    mu=st.floats(0.05, 0.8),
    m=st.floats(1e-2, 1e2),
    stiffness=st.floats(2.0, 400.0),
    s0=st.floats(-3, 3),
    place=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
def test_any_coulomb_oscillator_on_any_slope_follows_the_closed_form(
    scenes: Scenes, slope, lean, mu, m, stiffness, s0, place
) -> None:
    """Painlevé 1895, p. 61-62, with the centre of the swings moved by gravity along the line."""
    g, k = 9.81, stiffness * m
    pull, bound = m * g * math.sin(lean), mu * m * g * math.cos(lean)
    times, places = coulomb_oscillator(m, k, pull, bound, s0)
    assume(len(times) < 40)
    assume(all(abs(abs(pull - k * s) - bound) > 1e-3 * bound for s in places))
    parameters = {
        "slope": slope,
        "turn": slope - math.pi / 2 + lean,
        "x0": place[0],
        "y0": place[1],
    }
    result = scenes.run(OSCILLATOR, **parameters, m=m, k=k, mu=mu, s0=s0, stop=times[-1] + 1.0)
    check_oscillator(result, parameters, m, k, pull, bound, s0)
    assert result.balance.relative < 1e-9


def check_hoop(result, motion, parameters: dict, signs: tuple[int, int], stop: float) -> None:
    """Events one by one, then the end state; `signs` of displacement and angle in this image."""
    expected = []
    for before, after in zip(motion.phases, motion.phases[1:], strict=False):
        if before.slip != after.slip:
            kind = "reversal" if before.slip * after.slip else ("slip" if after.slip else "stick")
            expected.append((after.t, kind))
        if before.roll != after.roll and parameters.get("delta", 0) > 0:
            kind = (
                "roll_reversal"
                if before.roll * after.roll
                else ("roll_start" if after.roll else "roll_stop")
            )
            expected.append((after.t, kind))
    assert [e.kind for e in result.events] == [kind for _, kind in expected]
    for event, (t, _) in zip(result.events, expected, strict=True):
        assert near(event.time, t)
    s, v, angle, w = motion.at(stop)
    grid = [motion.at(t) for t in np.linspace(0, stop, 60)]
    found, speed = along(result, parameters, "hoop", stop)
    reach, pace, turn, spin = (max(abs(x[i]) for x in grid) for i in range(4))
    assert abs(signs[0] * found - s) <= 1e-10 * reach + 1e-13
    assert near(signs[0] * speed, v, scale=pace)
    end = result.at(stop)
    assert near(signs[1] * float(end["hoop.angle"]), angle, scale=turn)
    assert near(signs[1] * float(end["hoop.angular_velocity"]), w, scale=spin)
    last = motion.phases[-1]
    if last.slip == last.roll == 0 and last.v == last.w == 0 and len(motion.phases) > 1:
        assert rests_from(result, result.events[-1].time, "hoop")


@pytest.mark.parametrize("image", IMAGES)
@pytest.mark.parametrize("name", [r["id"] for r in rows("hoop")])
def test_a_hoop_slides_rolls_and_rests_as_painleve_p_78_and_106_says(
    scenes: Scenes, name: str, image: str
) -> None:
    """x down the slope, theta clockwise in the text: slip = x' - r theta'."""
    p, expected = row(name)["parameters"], row(name)["expected"]
    r, incline, mu, delta = p["r"], p["incline"], p["f"], p.get("f_roll", 0.0) * p["r"]
    parameters, sign, spin = images(-incline, -math.pi / 2, p["vx0"], -p["w0"])[image]
    result = scenes.run(
        weighed(HOOP, "hoop"), **parameters, g=p["g"], r=r, mu=mu, delta=delta, stop=p["t"]
    )
    kinds = {"roll": "stick", "rest": "roll_stop"}
    phases = [e for e in result.events if e.kind != "reversal"]  # a slide both ways is one there
    assert [e.kind for e in phases] == [kinds[k] for _, k in expected["events"][1:]]
    for event, (t, _) in zip(phases, expected["events"][1:], strict=True):
        assert near(event.time, t)
    found, speed = along(result, parameters, "hoop", p["t"])
    end = result.at(p["t"])
    assert near(sign * found, expected["x"])
    assert near(-spin * float(end["hoop.angle"]), expected["theta"])
    assert near(sign * speed, expected["vx"])
    assert near(-spin * float(end["hoop.angular_velocity"]), expected["w"])
    motion = hoop_on_line(
        1.0,
        r,
        r * r,
        p["g"] * math.sin(incline),
        p["g"] * math.cos(incline),
        mu,
        delta,
        p["vx0"],
        -p["w0"],
        p["t"],
    )
    check_hoop(result, motion, {**parameters, "delta": delta}, (sign, spin), p["t"])


@pytest.mark.parametrize("down", DOWN)
@pytest.mark.parametrize("side", (1, -1))
def test_a_hoop_thrown_with_backspin_comes_back_whatever_axis_gravity_follows(
    scenes: Scenes, down: str, side: int
) -> None:
    """hoop-1 on a level line, run through in both senses."""
    p, expected = row("hoop-1")["parameters"], row("hoop-1")["expected"]
    slope = DOWN[down] + side * math.pi / 2
    result = scenes.run(
        falling(HOOP, down),
        slope=slope,
        up=side,
        v0=p["vx0"],
        w0=-side * p["w0"],
        r=p["r"],
        mu=p["f"],
        g=p["g"],
        x0=30.0,
        y0=-20.0,
        stop=p["t"],
    )
    assert [e.kind for e in result.events] == ["stick"]
    assert near(result.events[0].time, expected["events"][1][0])
    found, speed = along(result, {"slope": slope}, "hoop", p["t"])
    assert near(found, expected["x"])
    assert near(speed, expected["vx"])


@DRAWN
@given(
    slope=st.floats(-3.1, 3.1),
    lean=st.floats(-1.2, 1.2),
    up=st.sampled_from((1.0, -1.0)),
    mu=st.floats(0.02, 1.0),
    rolling=st.one_of(st.just(0.0), st.floats(1e-3, 0.3)),
    m=st.floats(1e-2, 1e2),
    r=st.floats(1e-2, 10),
    shape=st.floats(0.2, 2),
    v0=st.floats(-8, 8),
    rim_speed=st.floats(-8, 8),
    place=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
def test_any_round_body_on_any_slope_follows_the_closed_form(
    scenes: Scenes, slope, lean, up, mu, rolling, m, r, shape, v0, rim_speed, place
) -> None:
    """Painlevé 1895, p. 78-81 and 106-108; inertia shape*m*r^2, rolling resistance rolling*r."""
    g, stop, w0 = 9.81, 3.0, rim_speed / r
    assume(min(abs(v0), abs(rim_speed), abs(v0 + rim_speed)) > 1e-2)
    motion = hoop_on_line(
        m,
        r,
        shape * m * r * r,
        m * g * math.sin(lean),
        m * g * math.cos(lean),
        mu,
        rolling * r,
        v0,
        w0,
        stop,
    )
    assume(motion.margin > 1e-3)
    turn = slope - up * (math.pi / 2 - lean)
    parameters = {"slope": slope, "turn": turn, "x0": place[0], "y0": place[1]}
    result = scenes.run(
        weighed(HOOP, "hoop"),
        **parameters,
        up=up,
        v0=v0,
        w0=up * w0,
        m=m,
        r=r,
        J=shape * m * r * r,
        mu=mu,
        delta=rolling * r,
        g=g,
        stop=stop,
    )
    check_hoop(result, motion, {**parameters, "delta": rolling}, (1, int(up)), stop)
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize("r", [1e-3, 1e-6, 1e-7, 1e-9, 1e3, 1e7])
def test_a_hoop_rolls_whatever_its_size(scenes: Scenes, r: float) -> None:
    """Rolling begins at v = v0/2 when w0 = 0, and goes on (Painlevé 1895, p. 79)."""
    result = scenes.run(weighed(HOOP, "hoop"), r=r, v0=3.0, w0=0.0, stop=3.0)
    end = result.at(3.0)
    assert [e.kind for e in result.events] == ["stick"]
    assert near(result.events[0].time, 1.5 / (0.3 * 9.81))
    assert near(float(end["hoop.velocity.x"]), 1.5)
    assert near(float(end["hoop.angular_velocity"]), -1.5 / r)
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize("slope", [1e-4, 1e-6, 5e-8, -1e-9, math.pi / 2 - 1e-7])
def test_a_hoop_slides_down_an_almost_level_or_upright_line_without_leaving_it(
    scenes: Scenes, slope: float
) -> None:
    """Gravity across the line does no work: v = r w = 1 m/s, both spent at t = v/(mu g)."""
    result = scenes.run(
        weighed(HOOP, "hoop"), slope=slope, turn=slope - math.pi / 2, r=1.0, v0=1.0, w0=1.0, mu=1.0
    )
    assert [e.kind for e in result.events] == ["stick"]
    assert near(result.events[0].time, 1 / 9.81)
    values = result.at(np.linspace(0, 3, 500))
    # one step spans the rest: the normal acceleration is zero to the rounding of its two terms g
    rounding = 4 * np.finfo(float).eps * 9.81 * 3**2
    assert np.max(np.abs(values["floor.gap"])) < rounding
    assert np.max(np.abs(values["energy.work"])) < 9.81 * rounding
    assert near(along(result, {"slope": slope}, "hoop", 3.0)[0], 0.5 / 9.81)
    assert abs(float(result["hoop.angular_velocity"][-1])) < 1e-14


@pytest.mark.parametrize("sense", (1, -1))
def test_a_speed_along_a_line_turned_by_pi_is_along_it_but_for_rounding(
    scenes: Scenes, sense: int
) -> None:
    """The normal speed 1e-16 m/s of a start written along x neither lifts nor pushes the hoop."""
    text = weighed(HOOP, "hoop").replace("(v0*cos(slope), v0*sin(slope))", "(v0, 0 m/s)")
    text = text.replace("(x0 - up*r*sin(slope), y0 + up*r*cos(slope))", "(0 m, r)")
    result = scenes.run(text, slope=math.pi, v0=3.0 * sense, w0=0.0, stop=2.0)
    assert [e.kind for e in result.events] == ["stick"]
    assert near(result.events[0].time, 1.5 / (0.3 * 9.81))
