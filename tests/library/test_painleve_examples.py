"""The worked examples of dry friction of which Painlevé gives the equations, and a bell.

Values: `tests/reference/mechanics.json`, from the text's own equations, closed forms, Lagrange's
equations integrated here.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import frot

HERE = Path(__file__)
MODELS = HERE.parents[2] / "models"
ROWS = json.loads((HERE.parents[1] / "reference" / "mechanics.json").read_text(encoding="utf-8"))


def expected(name: str):  # type: ignore[no-untyped-def]
    (row,) = (r for r in ROWS if r["id"] == name)
    return row["expected"]


def test_two_points_on_parallel_lines() -> None:
    model, want = frot.load(MODELS / "points_on_two_lines.frot"), expected("parallel_lines-1")
    for sign, speed in (("x'>0", "1 m/s"), ("x'<0", "-1 m/s")):
        now = model.simulate(stop=1e-3, parameters={"v0": speed}).at(0.0)
        assert now["M.acceleration.x"] == pytest.approx(want[sign][0]["xdd"], rel=1e-11)
    past = {"mu": 3.0, "mu1": 0.1, "alpha": "1.2 rad"}
    for speed, told in (("1 m/s", "2 motions"), ("-1 m/s", "no admissible motion")):
        with pytest.raises(frot.FrotError, match=f"E0902.*{told}"):
            model.simulate(parameters={**past, "v0": speed})


def test_a_bar_on_two_lines() -> None:
    result = frot.load(MODELS / "bar_on_two_lines.frot").simulate(tolerance=1e-12)
    for name, angle in (("bar_two_lines-1", 1.4), ("bar_two_lines-2", 2.9)):

        def turned(t: float, angle: float = angle) -> float:
            return float(result.at(t)["bar.angle"]) - angle

        rate = result.at(brentq(turned, 0, 6, xtol=1e-15))["bar.angular_velocity"]
        assert rate == pytest.approx(expected(name)["theta_dot"], rel=1e-10)


def test_a_dumbbell_on_a_line() -> None:
    model, (want,) = frot.load(MODELS / "dumbbell.frot"), expected("dumbbell_acceleration-1")
    now = model.simulate(stop=1e-3).at(0.0)
    assert now["M.acceleration.x"] == pytest.approx(want["x_dd"], rel=1e-10)
    assert now["guide.normal_force"] == pytest.approx(want["R_y"], rel=1e-10)
    past = {"mu": 3.2, "start": "-0.9553 rad", "rate": "0 rad/s"}
    for speed, told in (("1 m/s", "2 motions"), ("-1 m/s", "no admissible motion")):
        with pytest.raises(frot.FrotError, match=f"E0902.*{told}"):
            model.simulate(parameters={**past, "v0": speed})


def test_a_rod_on_rough_ground() -> None:
    model = frot.load(MODELS / "rod_on_rough_ground.frot")
    now = model.simulate(stop=1e-3).at(0.0)
    want = expected("rod_acceleration-1")["R_n"]
    assert now["tip.normal_force"] == pytest.approx(want, rel=1e-11)
    past = {"mu": 1.6, "start": "2.04 rad"}
    for rate, told in (("0 rad/s", "no admissible motion"), ("5 rad/s", "2 motions")):
        with pytest.raises(frot.FrotError, match=f"E0902.*{told}"):
            model.simulate(parameters={**past, "rate": rate})
    parts = model.simulate(stop=1e-3, parameters={"rate": "5 rad/s"})
    assert parts.at(0.0)["tip.mode"] == 0  # rod_acceleration-4


def test_a_hoop_on_a_wedge() -> None:
    model, want = frot.load(MODELS / "wedge_and_hoop.frot"), expected("wedge_hoop-1")
    now = model.simulate().at(0.5)
    assert now["rubs.normal_force"] == pytest.approx(want["R_n"], rel=1e-11)
    assert now["wedge.acceleration.x"] == pytest.approx(want["wedge_xdd"], rel=1e-11)
    turning = -0.3 * now["hoop.angular_acceleration"]
    assert turning == pytest.approx(want["r_theta_dd"], rel=1e-11)
    for share, mode in ((0.99, 2), (1.01, 1)):
        rolling = model.simulate(stop=0.1, parameters={"mu": share * want["f_roll"]})
        assert set(rolling["rubs.mode"]) == {mode}


def test_two_hoops_on_one_another() -> None:
    want = expected("two_hoops-1")
    result = frot.load(MODELS / "two_hoops.frot").simulate()
    (stick,) = result.events
    assert stick.time == pytest.approx(want["t_roll"], rel=1e-11)
    end = result.at(2.0)
    apart = end["b.velocity.x"] - end["a.velocity.x"], end["b.velocity.y"] - end["a.velocity.y"]
    assert np.hypot(*apart) / 2 == pytest.approx(want["phi_dot_end"], rel=1e-11)
    assert end["a.angular_velocity"] == pytest.approx(want["theta_dot_end"], rel=1e-11)
    assert end["b.angular_velocity"] == pytest.approx(want["theta1_dot_end"], rel=1e-11)


def test_a_block_slides_down_on_both_ends_of_its_base() -> None:
    """Half the load is shifted by mu height/width to the lower end, which bears all from one on."""
    model, slope = frot.load(MODELS / "block_on_base.frot"), np.radians(30)
    result = model.simulate()
    now, load = result.at(0.7), 2 * 9.81 * np.cos(slope)
    for name, sign in (("front", 1), ("back", -1)):
        want = load / 2 * (1 + sign * 0.3 * 1 / 0.4)
        assert now[f"{name}.normal_force"] == pytest.approx(want, rel=1e-11)
    speed = 9.81 * (np.sin(slope) - 0.3 * np.cos(slope)) * 0.7
    assert now["block.velocity.x"] == pytest.approx(speed * np.cos(slope), rel=1e-11)
    assert np.abs(result["block.angular_velocity"]).max() < 1e-14
    for width, tips in (("0.301 m", False), ("0.299 m", True)):
        events = model.simulate(stop=0.1, parameters={"width": width})
        assert (events["back.gap"][-1] > 1e-6) == tips


def test_a_clapper_leans_on_its_bell_and_parts() -> None:
    """Lagrange's equations in the angles of both, with the couple of the contact while it lasts."""
    big, h, own, b, m, length, g = 20.0, 0.3, 4.0, 0.1, 1.0, 0.5, 9.81

    def rates(y: np.ndarray, leaning: bool) -> np.ndarray:
        x, f, u, w = y
        across, turn = m * b * length / 2, x - f
        a = np.zeros((3, 3))
        a[0, :2] = own + big * h**2 + m * b**2, across * np.cos(turn)
        a[1, :2] = across * np.cos(turn), m * length**2 / 3
        a[0, 2], a[1, 2] = 1, -1  # the couple on the clapper, in the sense of its angle
        a[2] = [1, -1, 0] if leaning else [0, 0, 1]
        right = [
            -(big * h + m * b) * g * np.sin(x) - across * w**2 * np.sin(turn),
            -m * g * length / 2 * np.sin(f) + across * u**2 * np.sin(turn),
            0,
        ]
        return np.linalg.solve(a, right)

    def parts(t: float, y: np.ndarray) -> float:
        return float(rates(y, True)[2])

    parts.terminal = True  # type: ignore[attr-defined]
    options = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
    start = np.radians([60, 45, 0, 0])
    first = solve_ivp(
        lambda t, y: [*y[2:], *rates(y, True)[:2]], (0, 0.8), start, events=parts, **options
    )
    apart = float(first.t[-1])
    then = solve_ivp(
        lambda t, y: [*y[2:], *rates(y, False)[:2]], (apart, 0.8), first.y[:, -1], **options
    )
    result = frot.load(MODELS / "bell_and_clapper.frot").simulate()
    (event,) = result.events
    assert event.kind == "separation"
    assert event.time == pytest.approx(apart, abs=1e-9)
    end = result.at(0.8)
    assert end["axle.angle"] == pytest.approx(then.y[0, -1], abs=1e-9)
    assert end["clapper.angle"] + np.pi / 2 == pytest.approx(then.y[1, -1], abs=1e-9)
    assert result.at(0.0)["leans.normal_force"] * length == pytest.approx(
        rates(start, True)[2], rel=1e-9
    )


def test_the_lower_of_two_threads_goes_slack() -> None:
    """Newton's law with the pulls of both threads, then of one while the lower point falls."""
    masses, g = np.array([1.0, 0.5]), 9.81

    def tensions(y: np.ndarray, tight: int) -> tuple[np.ndarray, np.ndarray]:
        x, v = y[:4].reshape(2, 2), y[4:].reshape(2, 2)
        threads = np.array([[x[0], [0, 0]], [x[0] - x[1], x[1] - x[0]]])[:tight].reshape(tight, 4)
        apart = [v[0] @ v[0], (v[1] - v[0]) @ (v[1] - v[0])][:tight]
        a = np.zeros((4 + tight, 4 + tight))
        a[:4, :4] = np.diag(np.repeat(masses, 2))
        a[:4, 4:], a[4:, :4] = threads.T, threads
        right = [0, -g * masses[0], 0, -g * masses[1], *(-s for s in apart)]
        solved = np.linalg.solve(a, right)
        return solved[:4], solved[4:] * [1.0, 0.7][:tight]

    def slack(t: float, y: np.ndarray) -> float:
        return float(tensions(y, 2)[1][1])

    slack.terminal = True  # type: ignore[attr-defined]
    options = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
    start = np.array([0, -1, 0, -1.7, 4, 0, 7, 0])
    first = solve_ivp(
        lambda t, y: [*y[4:], *tensions(y, 2)[0]], (0, 1.1), start, events=slack, **options
    )
    when = float(first.t[-1])
    then = solve_ivp(
        lambda t, y: [*y[4:], *tensions(y, 1)[0]], (when, 1.1), first.y[:, -1], **options
    )
    model = frot.load(MODELS / "slack_threads.frot")
    result = model.simulate()
    (event,) = result.events
    assert (event.kind, event.liaison) == ("separation", "second")
    assert event.time == pytest.approx(when, abs=1e-9)
    assert result.at(0.0)["tension2"] == pytest.approx(tensions(start, 2)[1][1], rel=1e-11)
    end, names = result.at(1.1), ("upper.position", "lower.position")
    found = [end[f"{name}.{axis}"] for name in names for axis in "xy"]
    assert found == pytest.approx(then.y[:4, -1], abs=1e-9)
    assert end["second.gap"] > 1e-3
    taut = next(e for e in model.simulate(stop=1.6).events if e.kind == "impact")
    assert taut.liaison == "second"
    assert taut.time == pytest.approx(1.23, abs=0.01)
