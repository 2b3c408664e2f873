"""Free bodies in space: the top without torque, orientations, slender rods."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import frot
from tests.space.newton_euler import axes, orientation, vector

TOP = """
model Top "Asymmetric top without torque"
  world(gravity = 0 m/s^2);
  parameter Inertia a = 1 kg.m^2;
  parameter Inertia b = 2 kg.m^2;
  parameter Inertia c = 2.5 kg.m^2;
  body t: solid(mass = 3 kg, inertia = (a, b, c));
initial
  t.angular_velocity = (0.01, 2, 0.03) rad/s;
  t.velocity = (0.1, 0, -0.2) m/s;
  experiment(stop = {stop} s, tolerance = {tolerance});
end Top;
"""
MOMENTS = np.array([1, 2, 2.5])


def momentum(at: object) -> np.ndarray:
    turn = axes(orientation(at, "t"))
    return turn @ (MOMENTS * (turn.T @ vector(at, "t.angular_velocity")))


def euler(t: float, w: np.ndarray) -> np.ndarray:
    """Euler's equations in the body's axes."""
    return -np.cross(w, MOMENTS * w) / MOMENTS


def flips(stop: float) -> np.ndarray:
    """Instants at which the middle component of the angular velocity passes zero."""

    def middle(t: float, w: np.ndarray) -> float:
        return float(w[1])

    start = np.array([0.01, 2, 0.03])
    found = solve_ivp(
        euler, (0, stop), start, method="DOP853", rtol=3e-14, atol=1e-16, events=middle
    )
    return found.t_events[0]


def test_energy_and_momentum_over_a_thousand_seconds() -> None:
    result = frot.compile(TOP.format(stop=1000, tolerance=1e-12)).simulate(interval=50)
    energy = result["energy.kinetic"]
    assert np.ptp(energy) < 1e-10 * energy[0]
    first = momentum(result.at(0))
    for t in (137.0, 500.0, 1000.0):
        assert momentum(result.at(t)) == pytest.approx(first, abs=1e-10 * np.abs(first).max())
        assert np.linalg.norm(orientation(result.at(t), "t")) == pytest.approx(1, abs=1e-15)


def test_the_middle_axis_flips_when_euler_says() -> None:
    result = frot.compile(TOP.format(stop=60, tolerance=1e-12)).simulate()
    instants = flips(60)
    assert len(instants) >= 3
    for t in instants:
        near = result.at(t)
        own = axes(orientation(near, "t")).T @ vector(near, "t.angular_velocity")
        slope = euler(t, own)[1]
        assert abs(own[1] / slope) < 1e-9  # the instant at which it is zero


def test_the_error_follows_the_tolerance() -> None:
    """About the axis of the least moment, where errors do not grow by themselves."""
    start = "(2, 0.3, 0.4)"
    exact = solve_ivp(euler, (0, 20), [2, 0.3, 0.4], method="DOP853", rtol=3e-14, atol=1e-16).y[
        :, -1
    ]
    errors = []
    for tolerance in ("1e-4", "1e-6", "1e-8", "1e-10", "1e-12"):
        model = TOP.format(stop=20, tolerance=tolerance).replace("(0.01, 2, 0.03)", start)
        at = frot.compile(model).simulate().at(20)
        own = axes(orientation(at, "t")).T @ vector(at, "t.angular_velocity")
        errors.append(np.abs(own - exact).max())
        assert errors[-1] < 30 * float(tolerance)
    assert errors[-1] < 1e-6 * errors[0]


@pytest.mark.parametrize(
    "stated", [(1, 0, 0, 0), (0.6, 0, 0.8, 0), (0, 1, 0, 0), (-0.6, 0, 0, 0.8)]
)
def test_a_stated_orientation_is_the_one_at_the_start(stated: tuple[float, ...]) -> None:
    model = TOP.format(stop=1, tolerance=1e-9).replace(
        "initial", f"initial\n  t.orientation = {stated};"
    )
    at = frot.compile(model).simulate().at(0)
    assert orientation(at, "t") == pytest.approx(np.array(stated), abs=1e-14)
    assert vector(at, "t.angular_velocity") == pytest.approx([0.01, 2, 0.03], abs=1e-15)


def test_an_orientation_that_is_no_unit_is_refused_by_its_statement() -> None:
    model = TOP.format(stop=1, tolerance=1e-9).replace(
        "initial", "initial\n  t.orientation = (1, 1, 0, 0);"
    )
    with pytest.raises(frot.SimulationError, match="orientation"):
        frot.compile(model).simulate()


def test_a_thrown_slender_rod_turns_uniformly() -> None:
    """It does not spin about its own axis, and its direction goes round a great circle."""
    result = frot.compile(
        """
model Thrown "A slender rod"
  body r: rod(mass = 1 kg, length = 1 m);
initial
  r.velocity = (1, 0, 4.905) m/s;
  r.angular_velocity = (0, 0, 3) rad/s;
  experiment(stop = 1 s, tolerance = 1e-11);
end Thrown;
"""
    ).simulate()
    at = result.at(1)
    assert vector(at, "r.position") == pytest.approx([1, 0, 0], abs=1e-11)
    along = axes(orientation(at, "r"))[:, 0]
    assert along == pytest.approx([np.cos(3), np.sin(3), 0], abs=1e-10)


def test_principal_moments_that_no_body_has_are_refused() -> None:
    with pytest.raises(frot.SimulationError, match="moment"):
        frot.compile(TOP.format(stop=1, tolerance=1e-9)).simulate(parameters={"c": 4})


def test_a_rod_on_a_ball_joint_goes_round_steadily() -> None:
    """Vieille 1849: (2/3) L w^2 cos(slope) = g; the reaction carries the weight alone."""
    model = frot.load(Path(__file__).parents[2] / "models" / "conical_rod.frot")
    result = model.simulate()
    slope = np.pi / 6
    turn = np.sqrt(1.5 * 9.81 / np.cos(slope))
    for t in (0.0, 1.7, 5.0):
        at = result.at(t)
        tip = 2 * vector(at, "rod.position")
        round_it = np.sin(slope) * np.array([np.cos(turn * t), np.sin(turn * t)])
        assert tip == pytest.approx([*round_it, -np.cos(slope)], abs=1e-9)
        assert at["up"] == pytest.approx(9.81, rel=1e-9)


def test_what_symmetry_keeps_at_zero_is_no_reason_for_short_steps() -> None:
    """A bead at the centre of a box that tumbles as it falls: both go straight down."""
    model = frot.compile(
        """
model Bead
  body b: box(mass = 1 kg, size = (1, 2, 3) dm);
  body d: particle(mass = 0.1 kg);
  liaison p: prismatique(b, d);
initial
  b.position = (0, 0, 0) m;
  b.angular_velocity = (1, 2, 3) rad/s;
  experiment(stop = 1 s);
end Bead;
"""
    )
    for tolerance in (1e-3, 1e-8, 1e-13):
        result = model.simulate(tolerance=tolerance)
        assert result.figures.steps < 200
        assert np.abs(result["p.displacement"]).max() < 1e-13
        assert np.abs(result["b.position.z"] + 9.81 / 2 * result.time**2).max() < 10 * tolerance


def test_places_on_a_solid_are_given_from_its_origin() -> None:
    """A solid swings about a frame; as the same solid does with its G at the origin."""
    text = """
model Swings
  body s: solid(mass = 2 kg, inertia = (1, 2, 3) kg.m^2, com = {com} m);
  frame f on s at {f} m rotated(axis = x, angle = 0.3 rad);
  frame g on f at (0, 0, 0.1) m;
  curve c on s: circle(radius = 1 m, centre = {f} m);
  liaison pin: rotoide(ground, g, axis = y);
  output Length far = norm(g.position - s.origin.position);
initial
  pin.angle = 0.4 rad;
  experiment(stop = 1 s, tolerance = 1e-11);
end Swings;
"""
    given = frot.compile(text.format(com="(0.1, -0.2, 0.3)", f="(0.5, 0.6, 0.7)")).simulate()
    moved = frot.compile(text.format(com="(0, 0, 0)", f="(0.4, 0.8, 0.4)")).simulate()
    assert given["pin.angle"] == pytest.approx(moved["pin.angle"], abs=1e-10)
    corner = np.array([0.5, 0.6 - 0.1 * np.sin(0.3), 0.7 + 0.1 * np.cos(0.3)])
    assert given["far"] == pytest.approx(np.linalg.norm(corner), abs=1e-12)
