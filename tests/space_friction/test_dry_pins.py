"""Dry pins in space that turn, slide, screw, or turn about two axes: closed forms and a judge."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from space_models import G, last, model

import frot
from tests.space.newton_euler import Body, Link, Place, axes, orientation, residual, vector

SHAFT = """
    model Shaft
      parameter Mass m = 2 kg;
      parameter Real mu = 0.3;
      parameter Real mu_s = 0.3;
      parameter Length r = 5 cm;
      parameter Inertia I = 0.01 kg.m^2;
      parameter Velocity u = 1 m/s;
      parameter AngularVelocity w = 10 rad/s;
      body b: solid(mass = m, inertia = (I, I, I));
      frame bush on ground rotated(axis = z, angle = 0.6 rad);
      liaison g: verrou(bush, b, axis = {axis}){driven} with coulomb(mu, mu_s = mu_s, radius = r);
      {more}
    initial
      {start}
      experiment(stop = 3 s, tolerance = 1e-11);
    end Shaft;
    """
TURNS = "g.speed = u; g.speed_angle = w;"


def shaft(**more: str) -> frot.Model:
    return model(SHAFT.format(**{"axis": "x", "driven": "", "more": "", "start": TURNS, **more}))


@pytest.mark.parametrize("axis", ["x", "(1, 2, 0)"])
@pytest.mark.parametrize(
    ("mass", "radius", "u", "w"), [(2, 0.05, 1, 10), (2e6, 0.05, -1, 10), (2e-6, 0.3, 0.3, -2)]
)
def test_a_shaft_of_one_inertia_both_ways_stops_both_at_once(
    axis: str, mass: float, radius: float, u: float, w: float
) -> None:
    """With I = m r^2 the slip (v, r w) keeps its direction and ends after |s|/(mu g)."""
    result = shaft(axis=axis).simulate(
        parameters={"m": f"{mass} kg", "r": f"{radius} m", "I": f"{mass * radius**2} kg.m^2",
                    "u": f"{u} m/s", "w": f"{w} rad/s"}
    )  # fmt: skip
    (stop,) = result.events
    assert stop.time == pytest.approx(math.hypot(u, radius * w) / (0.3 * G), rel=1e-10)
    assert last(result, "g.speed", "g.speed_angle", "g.slip.x", "g.slip.y") == [0, 0, 0, 0]
    assert last(result, "g.displacement", "g.angle") == pytest.approx(
        [u * stop.time / 2, w * stop.time / 2], rel=1e-9
    )


def test_a_shaft_of_another_inertia_turns_its_slip() -> None:
    """M v' = -F v/|s|, I w' = -F r^2 w/|s|, by another integrator."""
    mass, inertia, radius, friction = 2.0, 0.01, 0.05, 0.3 * 2 * G

    def rates(t: float, x: np.ndarray) -> list[float]:
        size = math.hypot(x[0], radius * x[1])
        return [-friction * x[0] / size / mass, -friction * radius**2 * x[1] / size / inertia]

    result = shaft().simulate()
    exact = solve_ivp(rates, (0, 0.3), [1, 10], rtol=1e-12, atol=1e-14, method="DOP853").y[:, -1]
    at = result.at(0.3)
    assert [at["g.speed"], at["g.speed_angle"]] == pytest.approx(list(exact), rel=1e-9)
    assert last(result, "g.speed", "g.speed_angle") == [0, 0]


def test_a_shaft_that_is_turned_yields_to_a_small_pull() -> None:
    """A pull P < mu N moves it at v = r w P/sqrt((mu N)^2 - P^2)."""
    scene = shaft(
        driven=" driven(angle = 20 rad/s*time)",
        more="force pull: on(b, value = (cos(0.6)*2 N, sin(0.6)*2 N, 0 N));",
        start="g.speed = 0 m/s;",
    )
    friction = 0.3 * 2 * G
    (speed,) = last(scene.simulate(stop=20), "g.speed")
    assert speed == pytest.approx(0.05 * 20 * 2 / math.sqrt(friction**2 - 4), rel=1e-9)


@pytest.mark.parametrize("factor", [1 - 1e-8, 1 + 1e-8])
def test_a_shaft_holds_a_pull_and_a_couple_together(factor: float) -> None:
    """It departs when hypot(P, C/r) reaches mu_s N."""
    size = 0.4 * 2 * G * factor
    scene = shaft(
        more=f"force pull: on(b, value = (cos(0.6)*{0.6 * size} N, sin(0.6)*{0.6 * size} N, 0 N));"
        f" force twist: couple(g, value = {0.8 * size * 0.05} N.m);",
        start="g.speed = 0 m/s; g.speed_angle = 0 rad/s;",
    )
    result = scene.simulate(parameters={"mu_s": 0.4})
    if factor < 1:
        assert last(result, "g.speed", "g.speed_angle") == [0, 0]
    else:
        assert last(result, "g.mode") == [2]
        # straight on: both accelerations are those of one inertia only where I = m r^2
        assert min(last(result, "g.speed", "g.speed_angle")) > 0


SCREW = """
    model Screw
      parameter Real mu = 0.1;
      parameter Length p = 10 cm;
      parameter Length r = 5 cm;
      parameter Mass m = 2 kg;
      parameter AngularVelocity w = 10 rad/s;
      body b: cylinder(mass = m, radius = 0.1 m, length = 0.4 m);
      liaison g: helicoidale(ground, b, pitch = p) with coulomb(mu, radius = r);
    initial
      g.speed = w;
      experiment(stop = 0.5 s, tolerance = 1e-11);
    end Screw;
    """


@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
@pytest.mark.parametrize("pitch", [0.1, -0.1])
def test_a_screw_rises_and_runs_back(mass: float, pitch: float) -> None:
    """(I + m h^2) w' = -m g h -+ mu r m (g + h w') with the lead h = p/2 pi, R being axial."""
    result = model(SCREW).simulate(
        parameters={"m": f"{mass} kg", "p": f"{pitch} m", "w": f"{math.copysign(10, pitch)} rad/s"}
    )
    lead, arm, inertia = abs(pitch) / (2 * math.pi), 0.1 * 0.05, 0.1**2 / 2
    up = -G * (lead + arm) / (inertia + lead**2 + lead * arm)
    down = -G * (lead - arm) / (inertia + lead**2 - lead * arm)
    (turns,) = result.events
    assert turns.time == pytest.approx(-10 / up, rel=1e-10)
    speed = math.copysign(1, pitch) * down * (0.5 - turns.time)
    assert last(result, "g.speed") == pytest.approx([speed], rel=1e-9)
    assert last(result, "g.force.z") == pytest.approx([mass * (G + lead * down)], rel=1e-9)


@pytest.mark.parametrize("factor", [1 - 1e-9, 1 + 1e-9])
def test_a_screw_holds_its_load_from_mu_equal_to_its_slope_on(factor: float) -> None:
    mu = 0.1 / (2 * math.pi * 0.05) * factor
    result = model(SCREW).simulate(parameters={"mu": mu, "w": "0 rad/s"})
    assert (last(result, "g.speed") == [0]) == (factor > 1)


def test_both_axes_of_a_universal_joint_brake_by_themselves() -> None:
    """On a sphere each angle's rate falls by mu r m g/I, the axes being at right angles."""
    result = model("""
        model Gimbal
          body b: sphere(mass = 3 kg, radius = 0.2 m);
          frame f on ground rotated(axis = y, angle = 0.4 rad);
          liaison g: cardan(f, b) with coulomb(0.1, radius = 0.05 m);
        initial
          g.angle_a = 0.2 rad;
          der(g.angle_a) = 3 rad/s;
          der(g.angle_b) = -2 rad/s;
          experiment(stop = 2 s, tolerance = 1e-11);
        end Gimbal;
        """).simulate()
    brake = 0.1 * 0.05 * G / (0.4 * 0.2**2)
    second, first = (event.time for event in result.events)
    assert [second, first] == pytest.approx([2 / brake, 3 / brake], rel=1e-10)
    assert last(result, "g.angle_a", "g.angle_b") == pytest.approx(
        [0.2 + 4.5 / brake, -2 / brake], rel=1e-9
    )
    assert last(result, *(f"b.angular_velocity.{c}" for c in "xyz")) == [0, 0, 0]


HANGING = """
    model Hanging
      body b: solid(mass = 1.3 kg, inertia = (0.02, 0.03, 0.04) kg.m^2);
      frame at on b at (0.05 m, -0.04 m, 0.2 m) rotated(axis = y, angle = 0.3 rad);
      frame f on ground rotated(axis = x, angle = 0.5 rad);
      liaison g: {kind};
      force pull: on(b.G, value = (1 N, 2 N*cos(3 1/s*time), -1 N));
    initial
      {start}
      experiment(stop = 1 s, tolerance = 1e-11);
    end Hanging;
    """
HANGS = {
    "rotoide": ("rotoide(f, at, axis = (1, 2, 3)) with coulomb(0.3, radius = 0.02 m)",
                "g.speed = 3 rad/s;"),
    "verrou": ("verrou(f, at, axis = (1, 2, 3)) with coulomb(0.3, radius = 0.02 m)",
               "g.speed_angle = 30 rad/s; g.speed = 3 m/s;"),
    "helicoidale": ("helicoidale(f, at, pitch = 0.3 m) with coulomb(0.3, radius = 0.02 m)",
                    "g.speed = 9 rad/s;"),
    "cardan": ("cardan(f, at, axis_a = x, axis_b = (0, 2, 1)) with coulomb(0.3, radius = 0.02 m)",
               "g.angle_a = 0.3 rad; g.angle_b = 0.2 rad; der(g.angle_a) = 9 rad/s;"
               " der(g.angle_b) = -9 rad/s;"),
    "prismatique": ("prismatique(f, at, axis = (1, 2, 3)) with coulomb(0.3)", "g.speed = 3 m/s;"),
    "guide": ("prismatique(f, at, axis = (1, 2, 3)) "
              "with coulomb(0.3, half_length = 0.1 m, radius = 0.05 m)", "g.speed = 9 m/s;"),
    "appui_plan": ("appui_plan(f, at, normal = (1, 2, 3)) "
                   "with coulomb(0.3), pivoting_resistance(0.01 m)",
                   "g.angle = 0 rad; der(g.angle) = 9 rad/s; der(g.x) = 3 m/s;"),
}  # fmt: skip
AXIS = np.array([1, 2, 3]) / math.sqrt(14)


@pytest.mark.parametrize("name", HANGS)
def test_a_body_off_its_joint_satisfies_newton_euler_and_the_law(name: str) -> None:
    kind, start = HANGS[name]
    result = model(HANGING.format(kind=kind, start=start)).simulate()
    body = Body("b", 1.3, (0.02, 0.03, 0.04))
    link = Link("g", Place(None, (0, 0, 0)), Place("b", (0.05, -0.04, 0.2)))
    times = [0.05, 0.1, 0.15]
    assert all(event.time > times[-1] for event in result.events)
    for t in times:
        pull = np.array([1, 2 * math.cos(3 * t), -1])
        gravity = pull / 1.3 + (0, 0, -G)
        assert residual(result, [body], [link], [t], gravity) < 1e-9
        _check_law(name, result, t)


def _check_law(name: str, result: frot.Result, t: float) -> None:
    """The friction of each slip: its size by the reaction, against its motion."""
    at = result.at(t)
    frame = np.array([[1, 0, 0], [0, math.cos(0.5), -math.sin(0.5)],
                      [0, math.sin(0.5), math.cos(0.5)]])  # fmt: skip
    force, couple = vector(at, "g.force"), vector(at, "g.torque")
    axis = frame @ (AXIS if name not in ("helicoidale", "cardan") else np.array([0, 0, 1.0]))
    across = force - force @ axis * axis
    match name:
        case "rotoide":
            size = 0.3 * 0.02 * np.linalg.norm(force)
            assert couple @ axis == pytest.approx(-size * np.sign(at["g.speed"]), rel=1e-9)
        case "helicoidale":
            lead = 0.3 / (2 * math.pi)
            size = 0.3 * 0.02 * np.linalg.norm(force)
            friction = couple @ axis + lead * (force @ axis)
            assert friction == pytest.approx(-size * np.sign(at["g.speed"]), rel=1e-9)
        case "verrou":
            slip = np.array([at["g.speed"], 0.02 * at["g.speed_angle"]])
            friction = np.array([force @ axis, couple @ axis / 0.02])
            size = 0.3 * np.linalg.norm(across)
            assert friction == pytest.approx(-size * slip / np.linalg.norm(slip), rel=1e-9)
        case "prismatique":
            size = 0.3 * np.linalg.norm(across)
            assert force @ axis == pytest.approx(-size * np.sign(at["g.speed"]), rel=1e-9)
        case "guide":
            couple_across = couple - couple @ axis * axis
            lever = np.cross(couple_across, axis) / 0.1
            ends = [np.linalg.norm(across + sign * lever) / 2 for sign in (1, -1)]
            size = 0.3 * (sum(ends) + abs(couple @ axis) / 0.05)
            assert force @ axis == pytest.approx(-size * np.sign(at["g.speed"]), rel=1e-9)
        case "appui_plan":
            normal = abs(force @ axis)
            slip = vector(at, "g.slip")
            assert across == pytest.approx(-0.3 * normal * slip / np.linalg.norm(slip), rel=1e-9)
            turning = vector(at, "b.angular_velocity") @ axis
            assert couple @ axis == pytest.approx(-0.01 * normal * np.sign(turning), rel=1e-9)
        case "cardan":
            turned = axes(orientation(at, "b"))
            own = np.array([[math.cos(0.3), 0, math.sin(0.3)], [0, 1, 0],
                            [-math.sin(0.3), 0, math.cos(0.3)]])  # fmt: skip
            second = turned @ own @ (np.array([0, 2, 1]) / math.sqrt(5))
            first, size = frame @ [1.0, 0, 0], 0.3 * 0.02 * np.linalg.norm(force)
            normal = np.cross(first, second)
            omega = vector(at, "b.angular_velocity")
            rates = np.linalg.lstsq(np.stack([first, second], 1), omega, rcond=None)[0]
            assert abs(omega @ normal) < 1e-9
            assert couple @ first == pytest.approx(-size * np.sign(rates[0]), rel=1e-8)
            assert couple @ second == pytest.approx(-size * np.sign(rates[1]), rel=1e-8)


@pytest.mark.parametrize("name", HANGS)
def test_the_implicit_method_follows_dry_joints(name: str) -> None:
    kind, start = HANGS[name]
    scene = model(HANGING.format(kind=kind, start=start))
    text = HANGING.replace("1e-11", "1e-9, method = implicit").format(kind=kind, start=start)
    explicit, implicit = scene.simulate(), model(text).simulate()
    places = [f"b.position.{c}" for c in "xyz"]
    assert last(implicit, *places) == pytest.approx(last(explicit, *places), abs=1e-8)
    kinds = [[event.kind for event in run.events] for run in (explicit, implicit)]
    assert kinds[0] == kinds[1]
