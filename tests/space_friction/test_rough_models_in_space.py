"""The models of `models/` with friction in space, against closed forms and equations by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from space_models import G, last, loaded, run

import frot

MASSES = ("1e-6 kg", "1e6 kg")


def times(result: frot.Result) -> list[float]:
    return [event.time for event in result.events]


def stop_on_a_slope(
    along: float, across: float, speed: float, launch: float
) -> tuple[float, float, float]:
    """Time and place of the stop: weight `along` the slope, friction `across`, per mass.

    a v - b v_y decreases by a^2 - b^2; the place is integrated over the direction of the velocity.
    """
    a, b = across, along
    stop = speed * (a - b * math.sin(launch)) / (a * a - b * b)

    def rates(angle: float, y: np.ndarray) -> list[float]:
        v = y[0]
        return [v * (a + b * math.sin(angle)) / (b * math.cos(angle)),
                -(v**2) / b, -(v**2) * math.tan(angle) / b]  # fmt: skip

    end = -math.pi / 2 + 1e-7  # v vanishes there as a power of the angle
    run = solve_ivp(rates, (launch, end), [speed, 0, 0], rtol=1e-12, atol=1e-15, method="DOP853")
    return stop, float(run.y[1, -1]), float(run.y[2, -1])


@pytest.mark.parametrize("m", ["1 kg", *MASSES])
@pytest.mark.parametrize(
    ("slope", "mu", "speed", "launch"),
    [(15, 0.5, 3, 60), (15, 0.5, 3, 120), (5, 0.3, 1, -40), (0.6, 0.9, 10, 20)],
)
def test_a_point_launched_on_a_slope_stops(
    m: str, slope: float, mu: float, speed: float, launch: float
) -> None:
    i, a0 = math.radians(slope), math.radians(launch)
    mirrored = math.cos(a0) < 0
    stop, x, y = stop_on_a_slope(
        G * math.sin(i), mu * G * math.cos(i), speed, math.pi - a0 if mirrored else a0
    )
    result = loaded("inclined_plane").simulate(
        parameters={"slope": f"{slope} deg", "mu": mu, "v0": speed, "launch": f"{launch} deg",
                    "m": m},
        stop=stop + 0.1,
    )  # fmt: skip
    assert times(result) == pytest.approx([stop], rel=1e-10)
    assert last(result, "across", "up") == pytest.approx([-x if mirrored else x, y], abs=1e-9)
    assert last(result, "support.slip.x", "support.slip.y", "support.slip.z") == [0, 0, 0]


def test_the_stop_on_a_slope_as_published() -> None:
    result = run("inclined_plane")
    assert times(result) == pytest.approx([0.4760420859136214], abs=1e-10)
    expected = [0.39290643419627985, 0.5291389183987916]
    assert last(result, "across", "up") == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("m", ["1 kg", *MASSES])
@pytest.mark.parametrize(("mu", "speed", "lean"), [(0.3, 2, 0.4), (1.5, 3, -1.3), (0.05, 1, 2.5)])
def test_a_point_on_a_rough_sphere_runs_a_great_circle(
    m: str, mu: float, speed: float, lean: float
) -> None:
    """v = v0/(1 + mu v0 t/R), and the angle is log(1 + mu v0 t/R)/mu."""
    result = run("rough_sphere", m=m, mu=mu, v0=speed, lean=lean)
    grown = 1 + mu * speed * 5
    angle = math.log(grown) / mu
    place = [math.cos(angle), math.sin(angle) * math.cos(lean), math.sin(angle) * math.sin(lean)]
    assert last(result, "speed") == pytest.approx([speed / grown], abs=1e-9)
    found = last(result, "point.position.x", "point.position.y", "point.position.z")
    assert found == pytest.approx(place, abs=1e-9)


@pytest.mark.parametrize("w", [2, -2])
@pytest.mark.parametrize("m", ["1 kg", *MASSES])
def test_a_point_on_a_rough_plane_that_turns(m: str, w: float) -> None:
    result = run("rough_turning_plane", m=m, w=w)
    expected = [1.9834138564369534, -1.388556095712326, -4.858373768590557]
    found = last(result, "x", "bead.position.z", "bead.velocity.z")
    assert found == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("m", ["1 kg", *MASSES])
@pytest.mark.parametrize("spin", [0, 20, -300])
def test_a_sphere_slides_and_rolls_on_the_horizontal_plane(m: str, spin: float) -> None:
    """Its spin about the normal lasts and changes nothing."""
    result = run("sphere_on_plane", m=m, spin=spin)
    assert times(result) == pytest.approx([0.2649841088094011], abs=1e-10)
    found = last(result, "across", "up", "across_rate", "up_rate", "turn_x", "turn_y")
    expected = [2.7194231230203663, 1.3063541916360315, 1.3142857142857143, 0.6285714285714286,
                -6.285714285714286, 13.142857142857142]  # fmt: skip
    assert found == pytest.approx(expected, abs=1e-9)
    assert last(result, "ball.angular_velocity.z") == pytest.approx([spin], rel=1e-12)


def test_a_sphere_slides_up_and_down_a_slope() -> None:
    result = loaded("sphere_on_plane").simulate(
        parameters={"slope": "25 deg", "mu": 0.1, "vx": 1.5, "vy": 1, "p": 5, "q": -8}, stop=0.5
    )
    found = last(result, "across", "up", "across_rate", "up_rate", "turn_x", "turn_y")
    expected = [0.6467520346965709, -0.046874838452334054, 1.0857151872932371,
                -1.097502081317477, 4.386012313016344, 2.3571203176690556]  # fmt: skip
    assert found == pytest.approx(expected, abs=1e-9)


SPHERE_AT_REST = {"vx": 0, "vy": 0, "p": 0, "q": 0, "r": "0.05 m"}


def test_a_sphere_with_backward_slip_rolls_in_the_end() -> None:
    """It rolls from 2 v0/(7 mu g) on, with 5/7 of its speed."""
    result = run("sphere_on_plane", **{**SPHERE_AT_REST, "mu": 0.2, "vx": 3, "r": "0.1 m"})
    assert times(result) == pytest.approx([0.436871996505024028], abs=1e-10)
    rolled = 1.12338513387006179 + 15 / 7 * (2 - 0.436871996505024028)
    assert last(result, "across", "across_rate") == pytest.approx([rolled, 15 / 7], abs=1e-9)


@pytest.mark.parametrize(
    ("slope", "mu", "x", "v", "w"),
    [
        (15, 0.5, 0.906791011591331671, 1.81358202318266334, 36.2716404636532668),
        (60, 0.3, 3.51210460556267156, 7.02420921112534312, 73.575),
    ],
)
def test_a_sphere_released_on_a_slope_rolls_or_slips(
    slope: float, mu: float, x: float, v: float, w: float
) -> None:
    """It rolls where tan(slope) <= 7 mu/2."""
    values = {**SPHERE_AT_REST, "slope": f"{slope} deg", "mu": mu}
    result = loaded("sphere_on_plane").simulate(parameters=values, stop=1)
    assert last(result, "up", "up_rate", "turn_x") == pytest.approx([-x, -v, w], abs=1e-9)


def puck(w: float, mu: float, start: list[float]) -> tuple[float, np.ndarray]:
    """When the puck rests on the table, and where: time is divided by the slip."""

    def rates(s: float, y: np.ndarray) -> np.ndarray:
        slip = np.array([y[2] + w * y[1], y[3] - w * y[0]])
        size = np.hypot(*slip)
        return np.array([*(size * y[2:4]), *(-mu * G * slip), size])

    def small(s: float, y: np.ndarray) -> float:
        return float(np.hypot(y[2] + w * y[1], y[3] - w * y[0])) - 1e-9

    small.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rates, (0, 100), [*start, 0], rtol=1e-12, atol=1e-14, events=small,
                      method="DOP853")  # fmt: skip
    end = found.y[:, -1]
    acceleration = w * w * np.hypot(*end[:2])
    assert acceleration < mu * G
    slip = np.array([end[2] + w * end[1], end[3] - w * end[0]])
    return float(end[4] + np.hypot(*slip) / (mu * G)), end[:2]


@pytest.mark.parametrize("m", ["0.5 kg", *MASSES])
@pytest.mark.parametrize(
    ("w", "mu", "x0", "vx", "vy"),
    [(2, 0.2, 0.3, 0, 0), (-2, 0.2, 0.3, 0, 0), (2, 0.5, 0.2, 0.4, -0.3), (1, 0.1, 0, 0.2, 0.4)],
)
def test_a_puck_comes_to_rest_on_a_turntable(
    m: str, w: float, mu: float, x0: float, vx: float, vy: float
) -> None:
    rest, place = puck(w, mu, [x0, 0, vx, vy])
    result = run("puck_on_turntable", m=m, w=w, mu=mu, x0=x0, vx=vx, vy=vy)
    assert times(result) == pytest.approx([rest], abs=1e-9)
    turned = w * (1 - rest)
    c, s = math.cos(turned), math.sin(turned)
    expected = [c * place[0] - s * place[1], s * place[0] + c * place[1]]
    assert last(result, "puck.position.x", "puck.position.y") == pytest.approx(expected, abs=1e-8)


FEET = np.array([(0.3, 0.0), (-0.2, 0.25), (-0.15, -0.3)])


def stool(speed: tuple[float, float, float], h: float, until: float) -> np.ndarray:
    """x, y, angle and their rates: loads of the feet from the three equations of balance."""
    mu = 0.3

    def rates(t: float, y: np.ndarray) -> list[float]:
        c, s = math.cos(y[2]), math.sin(y[2])
        r = FEET @ np.array([[c, s], [-s, c]])
        slip = y[3:5] + y[5] * np.stack([-r[:, 1], r[:, 0]], axis=1)
        d = slip / np.linalg.norm(slip, axis=1)[:, None]
        rows = np.array([np.ones(3), r[:, 1] - h * mu * d[:, 1], h * mu * d[:, 0] - r[:, 0]])
        load = np.linalg.solve(rows, [G, 0, 0])
        f = -mu * load[:, None] * d
        couple = float((r[:, 0] * f[:, 1] - r[:, 1] * f[:, 0]).sum())
        return [*y[3:], *f.sum(axis=0), couple / 0.05]

    start = [0, 0, 0, *speed]
    return solve_ivp(rates, (0, until), start, rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1]


@pytest.mark.parametrize("m", ["3 kg", *MASSES])
@pytest.mark.parametrize(
    ("speed", "h", "until"),
    [((1, 0.2, 4), 0.2, 0.4), ((0.3, -0.1, 8), 0.2, 0.45), ((-1, 1, -3), 0.05, 0.4)],
)
def test_a_stool_on_three_feet_slides_and_turns(
    m: str, speed: tuple[float, float, float], h: float, until: float
) -> None:
    vx, vy, spin = speed
    values = {"m": m, "h": f"{h} m", "vx": vx, "vy": vy, "spin": spin}
    result = loaded("sliding_tripod").simulate(parameters=values, stop=until)
    names = ("stool.position.x", "stool.position.y", "stool.velocity.x", "stool.velocity.y",
             "stool.angular_velocity.z")  # fmt: skip
    expected = stool(speed, h, until)[[0, 1, 3, 4, 5]]
    assert last(result, *names) == pytest.approx(list(expected), abs=1e-9)


@pytest.mark.parametrize("m", ["2 kg", *MASSES])
def test_a_block_on_a_shaking_table_slips_and_rests(m: str) -> None:
    """The second slip starts half a period after the first: the table is periodic."""
    result = run("shaken_block", m=m)
    slips, rests = 0.133887601620939314, 0.489194975907132119
    expected = [slips, rests, slips + 0.5, rests + 0.5, slips + 1]
    assert times(result) == pytest.approx(expected, abs=1e-10)
    one, other = (float(result.at(t)["block.position.x"]) for t in (slips, rests))
    table = [0.1 * math.sin(2 * math.pi * t) for t in (slips, rests)]
    slid = (other - table[1]) - (one - table[0])
    assert slid == pytest.approx(0.0307984096445522532, abs=1e-10)


@pytest.mark.parametrize("turn", ["0 deg", "50 deg", "-163 deg"])
def test_a_block_on_a_belt_sticks_and_slips(turn: str) -> None:
    """Slip lasts (2/w)(pi - atan(dF w/(k v))), rest 2 dF/(k v)."""
    result = run("belt_oscillator", turn=turn)
    period = 0.64961830895930177
    expected = [0.2, 0.05 + period, 0.2 + period, 0.05 + 2 * period, 0.2 + 2 * period,
                0.05 + 3 * period]  # fmt: skip
    assert times(result) == pytest.approx(expected, abs=1e-10)
    along = 0.2 * (2 - (0.05 + 3 * period)) + 0.01
    assert last(result, "along") == pytest.approx([along], abs=1e-9)


@pytest.mark.parametrize("m", ["1 kg", *MASSES])
@pytest.mark.parametrize(("half", "mu"), [(45, 0.3), (20, 0.3), (80, 0.9)])
def test_a_groove_brakes_more_than_a_plane(m: str, half: float, mu: float) -> None:
    """Each plane bears m g/(2 sin half)."""
    result = run("v_groove", m=m, half=f"{half} deg", mu=mu)
    braking = mu * G / math.sin(math.radians(half))
    assert times(result) == pytest.approx([2 / braking] * 2, rel=1e-10)
    assert last(result, "slider.position.x", "slider.velocity.x") == pytest.approx(
        [2 / braking, 0], abs=1e-9
    )


def test_a_groove_of_45_degrees() -> None:
    assert 0.3 * G / math.sin(math.radians(45)) == pytest.approx(4.162031, abs=1e-6)
    assert 2 / run("v_groove").events[0].time == pytest.approx(4.162031, abs=1e-6)


@pytest.mark.parametrize("m", ["1 kg", "1e-6 kg", "1e5 kg"])
@pytest.mark.parametrize(("vx", "vy"), [(1, 0), (-0.6, 0.8)])
def test_a_rolling_sphere_stops_by_its_resistance(m: str, vx: float, vy: float) -> None:
    """Its deceleration is (5/7)(delta/r) g."""
    result = run("rolling_resistance", m=m, vx=vx, vy=vy)
    stop = 1 / (5 / 7 * 0.02 * G)
    assert times(result) == pytest.approx([stop], abs=1e-10)
    expected = [vx * stop / 2, vy * stop / 2]
    assert last(result, "across", "up") == pytest.approx(expected, abs=1e-9)


def test_a_sphere_that_rolls_obliquely_on_a_slope_stops() -> None:
    """It moves as a point with friction delta/r under 5/7 of gravity."""
    i = math.radians(0.5)
    stop, x, y = stop_on_a_slope(
        5 / 7 * G * math.sin(i), 5 / 7 * 0.02 * G * math.cos(i), 0.5, math.radians(30)
    )
    values = {"slope": "0.5 deg", "vx": 0.5 * math.cos(math.pi / 6), "vy": 0.25}
    result = run("rolling_resistance", **values)
    assert times(result) == pytest.approx([stop], abs=1e-9)
    assert last(result, "across", "up") == pytest.approx([x, y], abs=1e-9)


def test_a_sphere_rests_below_the_slope_of_its_resistance() -> None:
    """It rests where tan(slope) <= delta/r = 0.02, that is up to 1.1457 degrees."""
    at_rest = run("rolling_resistance", slope="1.145 deg")
    assert at_rest.events == ()
    assert all(at_rest["ball.velocity.y"] == 0)
    i = math.radians(1.2)
    down = 5 / 7 * G * (math.sin(i) - 0.02 * math.cos(i))
    rolling = run("rolling_resistance", slope="1.2 deg")
    assert last(rolling, "up") == pytest.approx([-down * 50], abs=1e-9)
