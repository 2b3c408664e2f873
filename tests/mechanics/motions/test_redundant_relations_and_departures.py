"""Relations kept twice, departures without acceleration, corners, sides at the start."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]
G = 9.81
TOLERANCES = [1e-4, 1e-8, 1e-12]


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(
    "place", [(0.2739233746429086, -0.4604265724722594, -2.75), (1e3, 0.1, 0.4), (0.1, 0.2, 1.57)]
)
def test_a_redundant_relation_changes_nothing(
    finding: Finding, place: tuple[float, float, float], tolerance: float
) -> None:
    given = dict(zip("xys", place, strict=True))
    line = "  liaison g: contact_ponctuel(q.start, c, unilateral = false) with coulomb(0.1);\n"
    twice = finding("kept_twice").simulate(tolerance=tolerance, parameters=given)
    once = finding("kept_twice", {line: ""}).simulate(tolerance=tolerance, parameters=given)
    assert not twice.events
    for name in ("o.angle", "j.angle", "o.speed", "j.speed"):
        size = np.abs(once[name]).max()
        assert twice.at(1.0)[name] == pytest.approx(
            once.at(1.0)[name], abs=(30 * tolerance + 1e-11) * size
        )
    assert np.abs(twice["g.tangential_force"]).max() == 0


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(("light", "heavy"), [(2e-5, 36.0), (1e6, 1e-6), (1.0, 1.0)])
def test_a_locked_pair_flies_as_one_body(
    finding: Finding, light: float, heavy: float, tolerance: float
) -> None:
    result = finding("locked_pair").simulate(
        tolerance=tolerance, parameters={"light": light, "heavy": heavy}
    )
    assert not result.events
    allowed = 10 * tolerance + 1e-12
    at = {t: result.at(t) for t in (0.0, 0.7)}
    for axis, fall in (("x", 0.0), ("y", -G * 0.7**2 / 2)):
        middle = [(at[t][f"a.position.{axis}"] + 6 * at[t][f"b.position.{axis}"]) / 7 for t in at]
        speed = (at[0.0][f"a.velocity.{axis}"] + 6 * at[0.0][f"b.velocity.{axis}"]) / 7
        assert middle[1] - middle[0] == pytest.approx(0.7 * speed + fall, abs=10 * allowed)
    for body in "ab":
        turned = result[f"{body}.angular_velocity"]
        assert np.abs(turned + 0.5).max() < 10 * allowed
    assert np.abs(result["block.velocity.x"]).max() == 0


def first_return(speed: Callable[[float], float], t: float, stop: float, span: float) -> float:
    """The first zero after t of a speed that is positive after t, looked for in parts of `span`."""
    parts = span / 500 * np.arange(1, 5000)
    while t < stop:
        values = np.array([speed(t + part) for part in parts])
        back = np.flatnonzero(values < 0)
        if len(back):
            end = t + parts[back[0]]
            return min(stop, brentq(speed, end - span / 500, end, xtol=1e-15))
        t += parts[-1]
    return stop


def drawn_reference(m: float, k: float, force: float, stop: float) -> tuple[float, int]:
    """Place at the end and number of departures, phase by phase in closed form.

    m x'' + k x = k a sin(w t) - s F mu while it slips in the direction s.
    """
    a, w, bound, own = 0.3, 2.0, 0.3 * force, np.sqrt(k / m)
    gain = a * k / (k - m * w**2)
    t, x, departures = 0.0, 0.0, 0
    while True:
        # rest, until the spring has the bound
        times = np.linspace(t, stop, 3000)
        excess = np.abs(k * (a * np.sin(w * times) - x)) - bound
        past = np.flatnonzero(excess > bound * 1e-9)
        if len(past) == 0:
            return x, departures
        if past[0] > 0:
            t = brentq(
                lambda t, x=x: abs(k * (a * np.sin(w * t) - x)) - bound,
                times[past[0] - 1],
                times[past[0]],
                xtol=1e-15,
            )
        s = np.sign(k * (a * np.sin(w * times[past[0]]) - x))
        departures += 1
        # slip from (x, 0) at t: a free oscillation about gain sin(w t) - s F mu/k
        free, rate = x - gain * np.sin(w * t) + s * bound / k, -gain * w * np.cos(w * t)

        def speed(u: float, t: float = t, free: float = free, rate: float = rate) -> float:
            turn = own * (u - t)
            back = rate * np.cos(turn) - own * free * np.sin(turn)
            return float(back + gain * w * np.cos(w * u))

        end = first_return(lambda u, s=s: s * speed(u), t, stop, np.pi / own)
        turn = own * (end - t)
        x = free * np.cos(turn) + rate / own * np.sin(turn)
        x += gain * np.sin(w * end) - s * bound / k
        t = end
        if t >= stop:
            return x, departures


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-6, 1e-8, 1e-11])
@pytest.mark.parametrize("force", [1.0, 3.0, 20.0])
def test_a_light_particle_departs_again_and_again(
    finding: Finding, force: float, tolerance: float
) -> None:
    """Each slip begins with no acceleration: it grows as the cube of the time."""
    end, departures = drawn_reference(2e-4, 27.0, force, 3.0)
    result = finding("drawn_particle").simulate(tolerance=tolerance, parameters={"F": force})
    assert result.at(3.0)["b.position.x"] == pytest.approx(end, abs=tolerance + 1e-12)
    assert result.figures.steps < 6000
    gone = [e for e in result.events if e.kind in ("slip", "reversal")]
    assert abs(len(gone) - departures) <= 1


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-8, 1e-11])
@pytest.mark.parametrize("unit", [1.0, 1e-3, 1e4])
def test_springs_at_their_rest_lengths_take_no_steps_for_rounding(
    finding: Finding, unit: float, tolerance: float
) -> None:
    """M x'' + K x = f t, mode by mode: c (t - sin(w t)/w)/w^2."""
    result = finding("slack_springs").simulate(tolerance=tolerance, parameters={"unit": unit})
    k1, k2, k3 = 74.0, 15.0, 33.0
    stiffness = np.array([[k1 + k2, -k2, 0], [-k2, k2 + k3, -k3], [0, -k3, k3]])
    squares, shapes = eigh(stiffness, np.diag([10.0, 0.15, 1.4]))
    w, t = np.sqrt(squares), 2.4
    modal = shapes.T @ np.array([0, 0, 0.5 / 4]) * (t - np.sin(w * t) / w) / squares
    exact = shapes @ modal
    begin = unit * np.array([0.748183348707549, 1.585583856914125, 1.979802408943282])
    at = result.at(t)
    for k in range(3):
        moved = at[f"b{k + 1}.position.x"] - begin[k]
        assert moved == pytest.approx(exact[k], abs=(10 * tolerance + 1e-12) * unit + 1e-11)
    assert result.figures.steps < 1000


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("part", [0.98, -0.98, 0.5])
@pytest.mark.parametrize("scale", [1.0, 1e9])
def test_a_point_at_rest_in_a_corner_meets_no_line(
    finding: Finding, scale: float, part: float, tolerance: float
) -> None:
    """The push is less than the weight: one line or the other holds, and nothing moves."""
    given = {"part": part, "g": 9.81e-9 * scale}
    result = finding("shaken_in_corner").simulate(tolerance=tolerance, parameters=given)
    assert result.time[-1] == 1848
    for axis in "xy":
        assert np.abs(result[f"b.position.{axis}"]).max() < 1e-9 * 9.81e-9 * scale
    push = -part * 0.35 * 9.81e-9 * scale * np.minimum(1, result.time / 700)
    push = push * np.sin(0.005 * result.time)
    held = result["A.force.x"] + result["B.force.x"]
    assert np.abs(held - push).max() < 1e-7 * 0.35 * 9.81e-9 * scale


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(("m", "s"), [(0.002, 0.055), (1e4, 0.055), (0.002, 0.3), (1.0, 0.0)])
def test_a_disc_guessed_under_a_line_falls_from_there(
    finding: Finding, m: float, s: float, tolerance: float
) -> None:
    result = finding("under_a_line").simulate(tolerance=tolerance, parameters={"m": m, "s": s})
    t = result.time
    start = 0.66 - 0.5 * np.cos(s)
    assert np.abs(result["b.position.y"] - (start - G * t**2 / 2)).max() < 10 * tolerance + 1e-12
    assert np.abs(result["under.normal_force"]).max() == 0
