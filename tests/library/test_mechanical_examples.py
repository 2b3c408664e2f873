"""The worked examples of mechanisms without friction, against equations of their own."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import frot
from tests.space.newton_euler import axes, orientation, vector

MODELS = Path(__file__).parents[2] / "models"


def solved(rate, start, stop):  # type: ignore[no-untyped-def]
    """The state at the end, to about 1e-12."""
    found = solve_ivp(rate, (0, stop), start, method="DOP853", rtol=1e-13, atol=1e-14)
    return found.y[:, -1]


def ring_rate(t: float, y: np.ndarray) -> np.ndarray:
    """Axis e and angular velocity w of a rolling ring: the couple is that of the force on the rim.

    The centre is above the rim by r = m/|m|, m = k - (k.e) e, and has the speed w x r.
    """
    up, axis, turn = np.array([0, 0, 1.0]), y[:3], y[3:]

    def above(e: np.ndarray) -> np.ndarray:
        m = up - (up @ e) * e
        return m / np.sqrt(m @ m)

    arm, moves = above(axis), np.cross(turn, axis)
    bends = above(axis + 1e-30j * moves).imag / 1e-30
    inertia = np.eye(3) / 2 + np.outer(axis, axis) / 2
    # about the place of contact: J a + w x J w = -r x (a_c + g k), a_c = a x r + w x r'
    square = np.cross(np.eye(3), arm) @ np.cross(np.eye(3), arm)
    push = np.cross(arm, np.cross(turn, bends) + 9.81 * up)
    gyration = np.cross(turn, inertia @ turn)
    return np.concatenate([moves, np.linalg.solve(inertia - square, -push - gyration)])


def test_a_ring_rolls_as_newton_and_euler_say() -> None:
    model = frot.load(MODELS / "rolling_ring.frot")
    result = model.simulate()
    start = [0, -np.sin(1.2), np.cos(1.2), 0.1, -6 * np.sin(1.2), 0.5 + 6 * np.cos(1.2)]
    for t in (0.7, 2.0):
        want = solved(ring_rate, start, t)
        at = result.at(t)
        axis = axes(orientation(at, "ring"))[:, 2]
        assert axis == pytest.approx(want[:3], abs=1e-9)
        assert vector(at, "ring.angular_velocity") == pytest.approx(want[3:], abs=1e-9)
    assert result.balance.relative < 1e-12
    # the rim never leaves the plane nor slips
    assert max(np.abs(result[f"ground_contact.slip.{k}"]).max() for k in "xyz") < 1e-12
    assert np.abs(result["ground_contact.gap"]).max() < 1e-13


def test_a_sphere_rolls_on_a_parabola() -> None:
    result = frot.load(MODELS / "rolling_sphere.frot").simulate()
    pull, t = 9.81 * np.sin(0.2), result.time
    assert result["down"] == pytest.approx(5 / 14 * pull * t**2, abs=1e-11)
    assert result["ball.position.y"] == pytest.approx(-0.3 * 2 * t, abs=1e-11)
    assert result["press"] == pytest.approx(9.81 * np.cos(0.2), rel=1e-12)
    assert result["holds"] == pytest.approx(2 / 7 * pull, rel=1e-12)
    spin = result["ball.angular_velocity.x"] * np.sin(0.2)
    spin += result["ball.angular_velocity.z"] * np.cos(0.2)
    assert spin == pytest.approx(5, rel=1e-12)


def test_a_point_on_a_plane_that_turns() -> None:
    result = frot.load(MODELS / "turning_plane.frot").simulate()
    t, w = result.time, 2
    away, rate = np.cosh(w * t) / 2 + np.sinh(w * t) / w, np.sinh(w * t) + np.cosh(w * t)
    assert result["x"] == pytest.approx(away, rel=1e-10)
    assert result["bead.position.z"] == pytest.approx(2 * t - 9.81 * t**2 / 2, abs=1e-10)
    assert np.abs(result["press"]) == pytest.approx(2 * w * rate, rel=1e-9)


def test_the_ball_in_the_channel_of_the_wheel() -> None:
    result = frot.load(MODELS / "wheel_channel.frot").simulate()

    def rate(t: float, y: np.ndarray) -> list[float]:
        s, c, a = np.sin(y[0]), np.cos(y[0]), np.cos(0.5)
        return [y[1], -9.81 * a * s + 4 * a**2 * s * c]

    assert result.at(2)["q"] == pytest.approx(solved(rate, [0.3, 0], 2)[0], abs=1e-10)


def test_two_points_on_threads() -> None:
    result = frot.load(MODELS / "double_pendulum.frot").simulate()

    def rate(t: float, y: np.ndarray) -> list[float]:
        d = y[0] - y[1]
        mass = [[1.5, 0.5 * 0.7 * np.cos(d)], [0.5 * np.cos(d), 0.5 * 0.7]]
        force = [
            -0.5 * 0.7 * y[3] ** 2 * np.sin(d) - 1.5 * 9.81 * np.sin(y[0]),
            0.5 * y[2] ** 2 * np.sin(d) - 0.5 * 9.81 * np.sin(y[1]),
        ]
        return [y[2], y[3], *np.linalg.solve(mass, force)]

    want = solved(rate, [0.5, -0.3, 0, 0], 5)
    at = result.at(5)
    assert [at["theta"], at["phi"]] == pytest.approx(want[:2], abs=1e-9)


def test_the_period_of_a_solid_on_a_pin() -> None:
    result = frot.load(MODELS / "physical_pendulum.frot").simulate(tolerance=1e-12)
    half = 2 * ellipk(np.sin(1.25) ** 2) / np.sqrt(9.81 * 0.5 * 3)
    at = result.at(half)
    assert [at["pin.angle"], at["pin.speed"]] == pytest.approx([-2.5, 0], abs=1e-10)


def angle_of_a_cone(half: float, slope: float, height: float, times: np.ndarray) -> np.ndarray:
    """L. Landau, E. Lifshitz, Mechanics, sect. 32, problem 7: the kinetic energy.

    T = 3 m h^2 (1 + 5 cos^2 a) f'^2/40, V = -3/4 m g h cos a sin b cos f.
    """
    pull = 5 * 9.81 * np.cos(half) * np.sin(slope) / (height * (1 + 5 * np.cos(half) ** 2))
    exact = solve_ivp(
        lambda t, y: [y[1], -pull * np.sin(y[0])],
        (0, 2),
        [1, 0],
        t_eval=times,
        rtol=1e-12,
        atol=1e-13,
    )
    return np.asarray(exact.y[0])


def test_a_cone_on_an_incline_is_a_pendulum() -> None:
    result = frot.load(MODELS / "rolling_cone.frot").simulate()
    wanted = angle_of_a_cone(0.3, 0.2, 0.4, result.time)
    assert np.abs(result["angle"] - wanted).max() < 1e-9
    assert np.ptp(result["energy.kinetic"] + result["energy.potential"]) < 1e-9


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize(
    ("half", "slope", "height"),
    [(0.3, 0.208, 0.227), (0.235, 0.315, 0.4), (0.3, 0.23, 0.303), (0.362, 0.372, 0.243)],
)
def test_where_a_cone_rolls_one_relation_too_many_is_no_singular_posture(
    half: float, slope: float, height: float, tolerance: float
) -> None:
    """Its path turns: now the one slip of the point that rolls says all, now the other."""
    result = frot.load(MODELS / "rolling_cone.frot").simulate(
        tolerance=tolerance, parameters={"half": half, "slope": slope, "h": height}
    )
    wanted = angle_of_a_cone(half, slope, height, result.time)
    assert np.abs(result["angle"] - wanted).max() < 30 * tolerance
    assert result.figures.crossings == 0
    assert result.figures.steps < 200


def test_beads_on_a_line_that_is_turned_and_in_a_tube_that_turns() -> None:
    """The tube, s = sin(b): r'' = r s^2 theta'^2 - g cos(b), (A + m r^2 s^2) theta' = C."""
    result = frot.load(MODELS / "turning_tube.frot").simulate()
    k = 2 * np.sin(np.radians(60))
    at, b = result.at(2), np.radians(70)
    want = np.cosh(2 * k) + 0.1 / k * np.sinh(2 * k)
    assert at["slides.displacement"] == pytest.approx(want, rel=1e-10)
    kept = (2 + (0.6 * np.sin(b)) ** 2) * 6
    assert np.ptp(result["spin"]) < 1e-9

    def rate(t: float, y: np.ndarray) -> list[float]:
        turns = kept / (2 + (y[0] * np.sin(b)) ** 2)
        return [y[1], y[0] * (np.sin(b) * turns) ** 2 - 9.81 * np.cos(b), turns]

    r, speed, angle = solved(rate, [0.6, 1.5, 0], 2)
    found = [at["runs.displacement"], at["runs.speed"], at["axle.angle"]]
    assert found == pytest.approx([r, speed, angle], abs=1e-9)
    turns = kept / (2 + (r * np.sin(b)) ** 2)
    spin_up = -2 * r * speed * np.sin(b) ** 2 * turns / (2 + (r * np.sin(b)) ** 2)
    across = np.sin(b) * (2 * speed * turns + r * spin_up)
    upright = np.sin(b) * (9.81 + r * np.cos(b) * turns**2)
    assert at["presses"] == pytest.approx(np.hypot(across, upright), rel=1e-9)


def test_a_point_on_a_sphere_runs_a_great_circle() -> None:
    result = frot.load(MODELS / "great_circle.frot").simulate()
    t, lean = result.time, 0.4
    for name, want in (
        ("x", np.cos(2 * t)),
        ("y", np.sin(2 * t) * np.cos(lean)),
        ("z", np.sin(2 * t) * np.sin(lean)),
    ):
        assert np.abs(result[f"point.position.{name}"] - want).max() < 1e-9
    assert np.abs(result["held"] - 4).max() < 1e-9


def test_a_point_on_a_frame_that_turns_freely() -> None:
    result = frot.load(MODELS / "free_frame.frot").simulate()
    kept = (2 + 0.5**2) * 3

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (kept / (2 + y[0] ** 2)) ** 2 * y[0], kept / (2 + y[0] ** 2)]

    at, (x, speed, angle) = result.at(2), solved(rate, [0.5, 0.4, 0], 2)
    assert [at["x"], at["axle.angle"]] == pytest.approx([x, angle], abs=1e-9)
    assert at["point.position.z"] == pytest.approx(2 * 2 - 9.81 * 2, abs=1e-10)
    assert at["press"] == pytest.approx(2 * 2 * kept * speed / (2 + x**2) ** 2, rel=1e-9)
    assert np.abs(result["C"] - kept).max() < 1e-9


def test_a_geodesic_of_a_cone_unrolls_to_a_straight_line() -> None:
    result = frot.load(MODELS / "geodesic_of_a_cone.frot").simulate()
    a, s0, way = 0.5, 0.8, 1.5 * result.time
    s, angle = np.hypot(s0, way), np.arctan2(way, s0) / np.sin(a)
    for name, want in (
        ("x", s * np.sin(a) * np.cos(angle)),
        ("y", s * np.sin(a) * np.sin(angle)),
        ("z", s * np.cos(a)),
    ):
        assert np.abs(result[f"point.position.{name}"] - want).max() < 1e-9
    assert np.abs(result["swept"] - s0 * np.sin(a) * 1.5).max() < 1e-10
    # across the generators it bends by v^2 cos(a)/r, at the part (s0/s)^2 of the speed's square
    bend = 1.5**2 * (s0 / s) ** 2 * np.cos(a) / (s * np.sin(a))
    assert result["held"] == pytest.approx(bend, rel=1e-8)


def test_the_middle_of_a_rod_on_a_cycloid_keeps_time() -> None:
    model = frot.load(MODELS / "centre_on_a_curve.frot")
    for s0 in (1.5, 0.3):
        result = model.simulate(parameters={"s0": s0})
        swing = s0 * np.cos(np.sqrt(9.81 / (4 * 0.5)) * result.time)
        assert np.abs(result["s"] - swing).max() < 1e-8
        assert np.abs(result["bar.angle"] - 3 * result.time).max() < 1e-10


def test_a_solid_on_four_points_glides_whatever_their_reactions_are() -> None:
    """One reaction of the four is free; the weight and the motion are not."""
    model = frot.load(MODELS / "five_points.frot")
    report = model.report()
    assert (report.mobility.hyperstatic, report.mobility.degrees_of_freedom) == (1, 3)
    assert [loop.cure for loop in report.analysis.loops] == [(("foot[1]", ""),)]
    # about x and y it is h/5 times the momentum along y and x: nothing new
    assert "about (" not in str(report)
    result, w = model.simulate(), 2
    t = result.time
    assert result["weight"] == pytest.approx(5 * 9.81, rel=1e-11)
    assert np.abs(result["centre"] - t).max() < 1e-10
    assert np.abs(result["M[1].position.x"] - (t - np.sin(w * t))).max() < 1e-9
    assert np.abs(result["M[1].position.y"] - np.cos(w * t)).max() < 1e-9
    assert max(np.abs(result[f"{k}.position.z"]).max() for k in ("M[1]", "M[3]")) < 1e-13


def test_a_slider_crank_with_a_flexible_rod() -> None:
    """The digits of the test set, whose initial values have nine: theirs is what is left."""
    path = MODELS.parent / "tests" / "reference" / "flexible_slider_crank.json"
    known = json.loads(path.read_text(encoding="utf-8"))["values"]
    result = frot.load(MODELS / "flexible_slider_crank.frot").simulate(tolerance=1e-8)
    end = result.at(0.1)
    for name, value in known.items():
        assert abs(float(end[name]) - value) < max(1e-9, 1e-9 * abs(value)), name
    assert end["a"] == pytest.approx(known["a"], rel=1e-7)
    assert end["end_"] == pytest.approx(known["end_"], rel=1e-7)
    turned = 150 * result.time
    ends = 0.15 * np.sin(turned) + (0.3 + result["end_"]) * np.sin(result["phi"])
    assert np.abs(ends).max() < 1e-13


def test_a_wheelset_hunts_as_in_the_test_set() -> None:
    """Their digits are those of DASSL at 1e-9, from initial values of five."""
    path = MODELS.parent / "tests" / "reference" / "wheelset.json"
    known = json.loads(path.read_text(encoding="utf-8"))
    result = frot.load(MODELS / "wheelset.frot").simulate(stop=10)
    start, end = result.at(0.0), result.at(10.0)
    for name, value in known["start"].items():
        assert float(start[name]) == pytest.approx(value, rel=3e-5), name
    for name, value in known["values"].items():
        assert float(end[name]) == pytest.approx(value, rel=2e-5), name
    for side in ("left", "right"):
        assert np.abs(result[f"{side}.gap"]).max() < 1e-12
