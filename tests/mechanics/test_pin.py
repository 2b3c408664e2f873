"""Rotoïdes in the plane: pendulums, chains, pin reactions, Coulomb friction of the pin."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from mechanical_scenes import Scenes, near, row
from pin_scenes import (
    CART,
    FREE_PAIR,
    SLIDER_CRANK,
    TWO_POINTS,
    cart_by_hand,
    chain,
    chain_by_hand,
    crank_rate,
    pendulum,
)
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import frot

MODELS = Path(__file__).parents[2] / "models"
G, MASS, ARM, INERTIA = 9.81, 1.0, 0.5, 1 / 3  # of the rod of 1 m; ARM from the axis to G
HANG = -math.pi / 2
DRY = " with coulomb(0.25, mu_s = 0.3, radius = 40 mm)"


# ------------------------------------------------------------------ motion without friction


@pytest.mark.parametrize("amplitude", [0.3, 1.0, 2.5, 3.0])
def test_a_pendulum_returns_after_the_period_of_the_elliptic_integral(
    scenes: Scenes, amplitude: float
) -> None:
    """T = 4 sqrt(I / m g l) K(sin(th0 / 2))."""
    period = 4 * math.sqrt(INERTIA / (MASS * G * ARM)) * ellipk(math.sin(amplitude / 2) ** 2)
    if amplitude == 2.5:
        assert near(period, row("physical_pendulum-1")["expected"]["period"], rel=1e-12)
    result = scenes.run(pendulum(), th0=amplitude, stop=5 * period, tolerance=1e-12)
    now = result.at(5 * period)
    assert near(now["hinge.angle"] - HANG, amplitude, rel=1e-10)
    assert abs(now["hinge.speed"]) < 1e-9
    assert result.balance.relative < 1e-11


def test_a_pendulum_is_where_the_worked_example_says(scenes: Scenes) -> None:
    given = row("physical_pendulum-1")
    now = scenes.run(pendulum(), th0=given["parameters"]["th0"], stop=3.0, tolerance=1e-12).at(3.0)
    assert near(now["hinge.angle"] - HANG, given["expected"]["theta"])
    assert near(now["hinge.speed"], given["expected"]["theta_dot"])
    assert now["hinge.angle"] == now["arm.angle"]


@pytest.mark.parametrize("turn", [0.0, 1.1, math.pi / 2])
@pytest.mark.parametrize("friction", [False, True])
def test_the_motion_does_not_depend_on_the_direction_of_gravity(
    scenes: Scenes, turn: float, friction: bool
) -> None:
    text = pendulum(friction=friction)
    straight = scenes.run(text, th0=1.2, stop=2.0).at(2.0)
    tilted = scenes.run(text, th0=1.2, turn=turn, stop=2.0).at(2.0)
    assert near(tilted["hinge.angle"] - turn, straight["hinge.angle"] - HANG, 1.0)
    assert near(tilted["hinge.speed"], straight["hinge.speed"], 3.0)


@pytest.mark.parametrize("friction", [False, True])
def test_a_mirrored_pendulum_moves_in_the_mirror(scenes: Scenes, friction: bool) -> None:
    text = pendulum(friction=friction, reaction=True)
    one = scenes.run(text, th0=1.2, stop=2.0).at(2.0)
    other = scenes.run(text, th0=-1.2, stop=2.0).at(2.0)
    assert near(other["hinge.angle"] - HANG, -(one["hinge.angle"] - HANG), 1.0, 1e-12)
    assert near(other["hinge.force.x"], -one["hinge.force.x"], G, 1e-11)
    assert near(other["hinge.force.y"], one["hinge.force.y"], G, 1e-11)


@pytest.mark.parametrize("friction", [False, True])
def test_exchanging_the_places_changes_the_signs_of_the_liaison_only(
    scenes: Scenes, friction: bool
) -> None:
    names = [f"hinge.{n}" for n in ("angle", "speed", "force.x", "force.y", "torque")]
    one = scenes.run(pendulum(friction=friction, reaction=True), th0=1.2, stop=1.5).at(1.5)
    text = pendulum(a_carried=True, friction=friction, reaction=True)
    other = scenes.run(text, th0=1.2, stop=1.5).at(1.5)
    for name in names:
        assert near(other[name], -one[name], G, 1e-11), name
    for name in ("arm.angle", "arm.position.x", "hinge.normal_force", "hinge.power"):
        assert near(other[name], one[name], G, 1e-11), name


def test_two_heavy_points_move_as_in_the_worked_example(scenes: Scenes) -> None:
    given = row("double_pendulum-1")["expected"]
    now = scenes.run(TWO_POINTS).at(5.0)
    assert near(now["upper.angle"], given["theta"], 1.0)
    assert near(now["lower.angle"], given["phi"], 1.0)
    assert near(now["upper.angular_velocity"], given["theta_dot"], 1.0, 1e-9)
    assert near(now["lower.angular_velocity"], given["phi_dot"], rel=1e-9)


@pytest.mark.parametrize("count", [2, 5])
@pytest.mark.parametrize("reverse", [False, True])
def test_a_chain_of_rods_follows_lagranges_equations(
    scenes: Scenes, count: int, reverse: bool
) -> None:
    """Whatever the order of the liaisons and of their places."""
    result = scenes.run(chain(count, reverse=reverse))
    now, (angles, rates) = result.at(2.0), chain_by_hand(count, 2.0)
    for k in range(count):
        assert near(now[f"r{k}.angle"], angles[k], 10.0, 1e-9)
        assert near(now[f"r{k}.angular_velocity"], rates[k], 10.0, 1e-9)
    assert result.balance.relative < 1e-11


def test_the_points_of_a_pin_coincide_and_its_frames_give_the_angle(scenes: Scenes) -> None:
    result = scenes.run(FREE_PAIR.format(laws=""))
    now = result.at(np.linspace(0.0, 3.0, 50))
    c, s = np.cos(now["q.angle"]), np.sin(now["q.angle"])
    for axis, end, eye in (
        ("x", np.cos(now["p.angle"]) / 2, 0.1 * c - 0.05 * s),
        ("y", np.sin(now["p.angle"]) / 2, 0.1 * s + 0.05 * c),
    ):
        apart = now[f"p.position.{axis}"] + end - now[f"q.position.{axis}"] - eye
        assert np.max(np.abs(apart)) < 1e-14
    angle = now["q.angle"] + math.radians(25) - now["p.angle"]
    assert np.allclose(now["hinge.angle"], angle, rtol=0, atol=1e-13)
    rate = now["q.angular_velocity"] - now["p.angular_velocity"]
    assert np.allclose(now["hinge.speed"], rate, rtol=0, atol=1e-13)


@pytest.mark.parametrize("laws", ["", " with coulomb(0.3, radius = 50 mm)"])
def test_what_two_bodies_do_to_each_other_changes_neither_momentum(
    scenes: Scenes, laws: str
) -> None:
    """Action and reaction of the pin, of its friction and of a couple in it."""
    result = scenes.run(FREE_PAIR.format(laws=laws))
    now = result.at(np.linspace(0.0, 3.0, 50))
    linear = {
        axis: now[f"p.velocity.{axis}"] + 2 * now[f"q.velocity.{axis}"] for axis in ("x", "y")
    }
    angular = now["p.angular_velocity"] / 12 + 2 * 0.36 / 12 * now["q.angular_velocity"]
    for body, mass in (("p", 1.0), ("q", 2.0)):
        angular += mass * (
            now[f"{body}.position.x"] * now[f"{body}.velocity.y"]
            - now[f"{body}.position.y"] * now[f"{body}.velocity.x"]
        )
    for value in (*linear.values(), angular):
        assert np.max(np.abs(value - value[0])) < 1e-10
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize("slope", [0.0, math.radians(20), -1.0])
def test_a_pendulum_on_a_sliding_point_follows_lagranges_equations(
    scenes: Scenes, slope: float
) -> None:
    """The liaisons are written from the bob inwards; a line carries them all."""
    now = scenes.run(CART, slope=slope).at(2.0)
    s, th, u, w = cart_by_hand(slope, 2.0)
    for name, value in (
        ("guide.abscissa", s),
        ("arm.angle", th),
        ("guide.slip", u),
        ("arm.angular_velocity", w),
    ):
        assert near(now[name], value, 10.0, 1e-10), name
    assert near(now["hinge.angle"], -now["arm.angle"], 1.0, 1e-13)  # a is the arm's end


def test_a_slider_crank_closed_by_a_point_on_a_line_keeps_its_energy_and_its_loop(
    scenes: Scenes,
) -> None:
    result = scenes.run(SLIDER_CRANK)
    now = result.at(np.linspace(0.05, 0.6, 40))
    start = math.radians(30)
    for angle, speed in zip(now["O.angle"], now["O.speed"], strict=True):
        assert near(speed, crank_rate(angle, angle - start), rel=1e-8)
    assert now["O.angle"][-1] > 2 * math.pi  # whole turns, through both dead points
    assert np.max(np.abs(now["piston.position.y"])) < 1e-11
    assert np.max(np.abs(now["piston.velocity.y"])) < 1e-10


# ------------------------------------------------------------------ reactions


@pytest.mark.parametrize("amplitude", [0.7, 2.5])
def test_the_reaction_of_the_pin_is_that_of_the_closed_form(
    scenes: Scenes, amplitude: float
) -> None:
    """m g cos th + m l th'^2 towards the axis, m g sin th (1 - m l^2 / I) across the rod."""
    result = scenes.run(pendulum(reaction=True), th0=amplitude, stop=3.0)
    now = result.at(np.linspace(0.0, 3.0, 60))
    th = now["hinge.angle"] - HANG
    square = 2 * MASS * G * ARM * (np.cos(th) - math.cos(amplitude)) / INERTIA
    inwards = MASS * G * np.cos(th) + MASS * ARM * square
    across = MASS * G * np.sin(th) * (1 - MASS * ARM**2 / INERTIA)
    x = -inwards * np.sin(th) + across * np.cos(th)
    y = inwards * np.cos(th) + across * np.sin(th)
    size = MASS * G * 5
    assert np.max(np.abs(now["hinge.force.x"] - x)) < 1e-9 * size
    assert np.max(np.abs(now["hinge.force.y"] - y)) < 1e-9 * size
    assert np.max(np.abs(now["reaction"] - np.hypot(x, y))) < 1e-9 * size
    assert np.all(now["hinge.torque"] == 0.0)


@pytest.mark.parametrize("laws", ["", DRY])
def test_the_reactions_of_a_chain_balance_weights_and_accelerations(
    scenes: Scenes, laws: str
) -> None:
    text = chain(3, laws=laws).replace(
        "initial", "output Force f = h0.force.x + h1.force.x + h2.force.x;\ninitial"
    )
    now = scenes.run(text).at(np.linspace(0.0, 2.0, 30))
    for axis, weight in (("x", 0.0), ("y", -G)):
        for k in range(3):
            mass = 1 + 0.2 * k
            below = now[f"h{k + 1}.force.{axis}"] if k < 2 else 0.0
            balance = now[f"h{k}.force.{axis}"] - below + mass * weight
            assert np.max(np.abs(balance - mass * now[f"r{k}.acceleration.{axis}"])) < 1e-10 * 100


def test_a_reaction_that_nobody_reads_is_not_computed(scenes: Scenes) -> None:
    assert "hinge.force.x" not in scenes.run(pendulum(), stop=0.1).at(0.1)
    read = scenes.run(pendulum(reaction=True), stop=0.1).at(0.1)
    assert "hinge.force.x" in read
    assert "hinge.slip" not in read  # a pin without radius


# ------------------------------------------------------------------ friction of the pin


def test_a_pendulum_in_a_dry_bearing_stops_first_where_the_worked_example_says(
    scenes: Scenes,
) -> None:
    """The couple f r norm(R) follows the reaction, which it changes itself."""
    given = row("pendulum_bearing-1")
    result = scenes.run(pendulum(friction=True), th0=1.0, mu=0.25, radius=0.04, tolerance=1e-12)
    first = result.events[0]
    assert near(first.time, given["expected"]["t_first_stop"])
    assert near(result.at(first.time)["hinge.angle"] - HANG, given["expected"]["theta_first_stop"])


def test_the_couple_of_a_dry_bearing_is_bounded_by_the_size_of_the_reaction(
    scenes: Scenes,
) -> None:
    result = scenes.run(pendulum(friction=True), th0=1.0, stop=30.0)
    now = result.at(np.linspace(0.0, 30.0, 3000))
    couple, size = now["hinge.torque"], np.hypot(now["hinge.force.x"], now["hinge.force.y"])
    slips, held = now["hinge.mode"] == 2, now["hinge.mode"] == 1
    assert np.any(slips) and np.any(held)
    assert np.allclose(now["hinge.normal_force"], size, rtol=1e-14)
    assert np.allclose(now["hinge.tangential_force"], couple / 0.04, rtol=1e-14)
    assert np.allclose(now["hinge.slip"], 0.04 * now["hinge.speed"], rtol=1e-14)
    opposed = -0.01 * size * np.sign(now["hinge.speed"])
    moving = slips & (np.abs(now["hinge.speed"]) > 1e-9)
    assert np.allclose(couple[moving], opposed[moving], rtol=1e-10)
    assert np.all(np.abs(couple[held]) <= 0.01 * size[held] * (1 + 1e-12))
    assert np.all(now["hinge.power"] <= 0.0)
    assert result.balance.relative < 1e-9


def test_a_pendulum_in_a_dry_bearing_comes_to_rest_off_the_vertical_and_stays(
    scenes: Scenes,
) -> None:
    """At rest the reaction is the weight: it holds where m g l sin th <= f r m g."""
    result = scenes.run(pendulum(friction=True), th0=1.0, stop=60.0)
    last = result.events[-1]
    assert last.after == "stick"
    now = result.at(np.linspace(np.nextafter(last.time, np.inf), 60.0, 50))
    assert np.all(now["hinge.speed"] == 0.0)
    assert np.all(now["hinge.angle"] == now["hinge.angle"][0])
    offset = math.sin(float(now["hinge.angle"][0]) - HANG)
    assert 0 < abs(offset) <= 0.01 / ARM
    assert np.allclose(now["hinge.torque"], MASS * G * ARM * offset, rtol=1e-9)


@pytest.mark.parametrize("part", [0.999999, 1.000001])
def test_a_pendulum_starts_where_the_weight_overcomes_the_bearing(
    scenes: Scenes, part: float
) -> None:
    limit = math.asin(0.01 / ARM)
    result = scenes.run(pendulum(friction=True), th0=part * limit, stop=1.0)
    moved = result.at(1.0)["hinge.angle"] != result.at(0.0)["hinge.angle"]
    assert bool(moved) is (part > 1)


def test_friction_of_several_pins_agrees_with_the_dae(scenes: Scenes) -> None:
    """Every phase of a chain of two dry pins, integrated by CasADi from the events before it."""
    text = chain(2, laws=DRY)
    result = scenes.run(text, stop=1.5)
    dae = scenes.model(text).dae()
    times = [0.0, *sorted({e.time for e in result.events}), 1.5]
    assert len(times) > 3
    t, y, m = ca.SX.sym("t"), ca.SX.sym("x", 4), ca.SX.sym("m", len(dae.names.mode))
    ode = dae.ode(t, y, dae.solve(t, y, [], [], m), [], [], m)
    for begin, end in itertools.pairwise(times):
        middle = result.at((begin + end) / 2)
        mode = _mode_of(dae.names.mode, middle)
        names = ("h0.angle", "h1.angle", "h0.speed", "h1.speed")
        x = np.array([result.at(begin)[n] for n in names])
        options = {"abstol": 1e-12, "reltol": 1e-12}
        step = ca.integrator(
            "step", "erk", {"t": t, "x": y, "p": m, "ode": ode}, begin, end, options
        )
        reached = np.array(step(x0=x, p=mode)["xf"]).ravel()
        assert np.max(np.abs(reached - [result.at(end)[n] for n in names])) < 1e-8
        x = np.array([middle[n] for n in names])
        z = dae.solve((begin + end) / 2, x, [], [], mode)
        residual = np.array(dae.alg((begin + end) / 2, x, z, [], [], mode)).ravel()
        assert np.max(np.abs(residual)) < 1e-11
        for name, value in zip(dae.names.z, np.array(z).ravel(), strict=True):
            if not name.startswith("der"):
                assert near(value, middle[name], 30.0), name
        guards = np.array(dae.guards((begin + end) / 2, x, z, [], [], mode)).ravel()
        assert np.min(guards) > 0


def _mode_of(names: tuple[str, ...], now: dict) -> np.ndarray:
    """The DAE's mode of a chain of pins."""
    mode = []
    for name in names:
        liaison, part = name.rsplit(".", 1)
        slip = 2 if now[f"{liaison}.speed"] > 0 else 3
        kind = {1: 1, 2: slip}[int(now[f"{liaison}.mode"])]
        mode.append({"friction": kind, "rolling": 0}.get(part, 1))
    return np.array(mode, dtype=float)


def test_a_dry_slider_crank_obeys_every_law_at_every_instant(scenes: Scenes) -> None:
    """The example of the language: three dry pins and a dry guide that closes the loop.

    The crank is so fast that reactions change by 1e6 N/s where the guide changes sides.
    """
    text = (MODELS / "slider_crank.frot").read_text(encoding="utf-8")
    exact, loose = (scenes.run(text, tolerance=tolerance) for tolerance in (1e-12, 1e-9))
    assert near(loose.at(3.0)["O.angle"], exact.at(3.0)["O.angle"], rel=1e-8)
    assert exact.balance.relative < 1e-11
    now = exact.at(np.linspace(0.01, 3.0, 4000))
    for pin in "OAB":
        size = np.hypot(now[f"{pin}.force.x"], now[f"{pin}.force.y"])
        couple = -0.12 * 0.012 * size * np.sign(now[f"{pin}.speed"])
        moving = np.abs(now[f"{pin}.speed"]) > 1e-6
        assert np.allclose(now[f"{pin}.torque"][moving], couple[moving], rtol=1e-8)
    friction = -0.08 * np.abs(now["C.normal_force"]) * np.sign(now["C.slip"])
    moving = np.abs(now["C.slip"]) > 1e-6
    largest = np.max(np.abs(friction))
    assert np.max(np.abs(now["C.tangential_force"] - friction)[moving]) < 1e-9 * largest
    # the piston: force of the rod, reaction of the guide, weight
    x = now["B.force.x"] - now["C.force.x"] - 0.9 * now["piston.acceleration.x"]
    y = now["B.force.y"] - now["C.force.y"] - 0.9 * 9.81
    assert np.max(np.abs(x)) < 1e-8 * np.max(np.abs(now["B.force.x"]))
    assert np.max(np.abs(y)) < 1e-8 * np.max(np.abs(now["B.force.x"]))


def test_energy_is_kept_in_a_chain_of_dry_pins(scenes: Scenes) -> None:
    result = scenes.run(chain(4, laws=DRY), stop=4.0)
    assert result.balance.relative < 1e-9
    assert result.at(4.0)["energy.dissipated"] > 1.0


def test_a_force_in_the_pin_of_a_weightless_rod_drives_no_couple(scenes: Scenes) -> None:
    """Without any reaction dry friction vanishes: the rod turns on and on at its speed."""
    text = pendulum(friction=True).replace(
        "hinge: rotoide(ground, arm.start)", "hinge: rotoide(ground, arm)"
    )
    result = scenes.run(text, g=0.0, w0=2.0, stop=5.0)
    assert near(result.at(5.0)["hinge.speed"], 2.0, rel=1e-12)
    assert near(result.at(5.0)["hinge.angle"] - HANG, 2.5 + 10.0, rel=1e-12)


# ------------------------------------------------------------------ report and refusals


def test_the_report_counts_two_relations_a_pin_and_says_how_they_are_kept() -> None:
    report = frot.compile(chain(3, laws=DRY)).report()
    assert report.mobility.degrees_of_freedom == 3
    for line in report.liaisons:
        assert (line.relations, line.unilateral) == (2, False)
        assert line.kept == "built into the coordinates"
    assert "2 relations, bilateral, geometric; built into the coordinates" in str(report)


HINGE = "liaison hinge: rotoide(ground, arm.start)"
REFUSED = {
    "a pin that parts": (
        "liaison hinge: rotoide(ground, arm.start, unilateral = true);",
        "E0204",
        "a rotoïde holds from all sides and cannot part",
    ),
    "friction without a radius": (
        f"{HINGE} with coulomb(0.1);",
        "E0204",
        "'coulomb' of the rotoïde 'hinge' needs radius",
    ),
    "the length of a guide": (
        f"{HINGE} with coulomb(0.1, radius = 1 mm, half_length = 1 m);",
        "E0701",
        "'half_length' of the law 'coulomb'",
    ),
    "rolling resistance": (
        f"{HINGE} with rolling_resistance(1 mm);",
        "E0701",
        "the law 'rolling_resistance' of a rotoïde",
    ),
    "a particle on the ground": (
        "body p: particle(mass = 1 kg); liaison hinge: rotoide(ground, p) with "
        "coulomb(0.1, radius = 1 mm);",
        "E0511",
        "a pin of two bodies that do not turn",
    ),
    "slip without a radius": (
        f"{HINGE}; output Velocity v = hinge.slip;",
        "E0203",
        "no 'slip' on 'hinge': its pin has no radius",
    ),
    "a coefficient that depends on speed": (
        f"{HINGE} with coulomb(0.1 + abs(hinge.speed)*(1 s), radius = 1 mm);",
        "E0701",
        "a coefficient that depends on 'speed'",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_pin_cannot_do_is_refused_by_name(name: str) -> None:
    declared, code, cause = REFUSED[name]
    text = (
        f"planar model Refused\n  body arm: rod(mass = 1 kg, length = 1 m);\n  {declared}\n"
        "end Refused;\n"
    )
    with pytest.raises(frot.FrotError) as fault:
        frot.compile(text).report()
    (message,) = fault.value.diagnostics
    assert message.code == code
    assert cause in message.message


def test_a_body_with_two_pins_rests_and_its_redundant_reactions_carry_it() -> None:
    result = frot.compile(
        """
planar model Twice
  body arm: rod(mass = 2 kg, length = 1 m);
  frame far on ground at (0.5 m, 0 m);
  liaison one: rotoide(ground, arm.start);
  liaison two: rotoide(far, arm);
  output Real up = (one.force.y + two.force.y)/(1 N);
  experiment(stop = 1 s);
end Twice;
"""
    ).simulate()
    assert result["up"][-1] == pytest.approx(2 * 9.81, rel=1e-13)
    assert result["arm.angle"][-1] == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("tolerance", ["1e-4", "1e-7", "1e-10"])
def test_a_four_bar_of_pins_moves_as_its_one_crank(tolerance: str) -> None:
    """Two cranks of 1 m with a coupler that stays level, below their pins."""
    result = frot.compile(
        f"""
planar model FourBar
  parameter Length L = 1 m;
  body left:  rod(mass = 1 kg, length = L);
  body top:   rod(mass = 1 kg, length = 2*L);
  body right: rod(mass = 1 kg, length = L);
  frame far on ground at (2*L, 0 m);
  liaison A: rotoide(ground, left.start);
  liaison B: rotoide(left.tip, top.start);
  liaison C: rotoide(top.tip, right.tip);
  liaison D: rotoide(far, right.start);
initial
  left.angle = -130 deg;
  guess(top.angle = 0 deg);
  guess(right.angle = -130 deg);
  experiment(stop = 3 s, tolerance = {tolerance});
end FourBar;
"""
    ).simulate()

    def rate(t: float, x: np.ndarray) -> list[float]:
        return [x[1], -2 * 9.81 * np.cos(x[0]) / (5 / 3)]

    start = [-130 * np.pi / 180, 0]
    exact = solve_ivp(rate, (0, 3), start, method="DOP853", rtol=1e-13, atol=1e-14).y[0, -1]
    assert abs(result.at(3)["left.angle"] - exact) < 30 * float(tolerance)
    assert abs(result.at(3)["right.angle"] - exact) < 30 * float(tolerance)
