"""Dry guides, planes and lines, in the plane and in space, against closed forms and their twins."""

from __future__ import annotations

import math

import numpy as np
import pytest
from space_models import G, last, model

import frot

GUIDE = """
    model Guide
      parameter Mass m = 2 kg;
      parameter Real mu = 0.3;
      parameter Angle i = 0.4 rad;
      parameter Angle about = 0.7 rad;
      parameter Velocity u = -1 m/s;
      body b: box(mass = m, size = (0.2, 0.1, 0.1) m);
      liaison g: {kind}
        with coulomb(mu);
    initial
      b.velocity = (
        u*cos(i)*cos(about), u*cos(i)*sin(about), -u*sin(i));
      experiment(stop = 1 s, tolerance = 1e-11);
    end Guide;
    """
WAY = "axis = (cos(i)*cos(about), cos(i)*sin(about), -sin(i))"
KINDS = {
    "prismatique": f"prismatique(ground, b, {WAY})",
    "swapped": f"prismatique(b, ground, {WAY})",
    "lineaire_annulaire": f"lineaire_annulaire(ground, b, {WAY})",
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("mass", "mu", "incline", "about", "u"),
    [
        (2, 0.3, 0.4, 0.7, -1),
        (2e6, 0.3, 0.4, -2.6, 1),
        (2e-6, 0.6, 0.4, 1.9, -1),
        (1, 0.5, 0.9, 0.1, -3),
        (1, 2.0, -0.6, 0, 2),
    ],
)
def test_a_box_on_an_inclined_guide(
    kind: str, mass: float, mu: float, incline: float, about: float, u: float
) -> None:
    """V' = g sin i - mu g cos i sign v; it rests where tan i <= mu."""
    result = model(GUIDE.format(kind=KINDS[kind])).simulate(
        parameters={"m": f"{mass} kg", "mu": mu, "i": f"{incline} rad", "about": f"{about} rad",
                    "u": f"{u} m/s"}
    )  # fmt: skip
    load, friction = G * math.sin(incline), mu * G * math.cos(incline)
    stop, left = _until_rest(u, load, friction)
    way = np.array([math.cos(incline) * math.cos(about), math.cos(incline) * math.sin(about),
                    -math.sin(incline)])  # fmt: skip
    found = way @ [result[f"b.velocity.{c}"][-1] for c in "xyz"]
    assert found == pytest.approx(left, abs=1e-9)
    assert [event.time for event in result.events] == pytest.approx(stop, rel=1e-10)
    if left == 0:
        assert last(result, *(f"b.velocity.{c}" for c in "xyz")) == [0, 0, 0]
        assert result.events[-1].after == "stick"
    assert last(result, "g.normal_force")[0] == pytest.approx(mass * friction / mu, rel=1e-10)


def _until_rest(u: float, load: float, friction: float) -> tuple[list[float], float]:
    """Times below 1 s at which the speed is zero, and the speed then."""
    slope = load - math.copysign(friction, u)
    if u * slope >= 0 or -u / slope >= 1:
        return [], u + slope
    stop = -u / slope
    left = max(abs(load) - friction, 0)
    return [stop], math.copysign(left * (1 - stop), load)


def test_the_slip_of_a_guide_is_a_vector_along_it() -> None:
    result = model(GUIDE.format(kind=KINDS["prismatique"])).simulate()
    way = np.array([math.cos(0.4) * math.cos(0.7), math.cos(0.4) * math.sin(0.7), -math.sin(0.4)])
    speed, size = last(result, "g.speed", "g.normal_force")
    assert last(result, *(f"g.slip.{c}" for c in "xyz")) == pytest.approx(speed * way, rel=1e-12)
    friction = last(result, *(f"g.tangential_force.{c}" for c in "xyz"))
    assert friction == pytest.approx(-0.3 * size * way, rel=1e-11)
    assert last(result, "g.power")[0] == pytest.approx(-0.3 * size * speed, rel=1e-11)


DRAWER = """
    {planar}model Drawer
      parameter Real mu = 0.2;
      parameter Real mu_s = 0.2;
      parameter Length l = 0.2 m;
      parameter Length d = 0.15 m;
      parameter Mass m = 4 kg;
      parameter Force across = 0 N;
      parameter Force pull = 8 N;
      body b: box(mass = m, size = {size});
      frame h on b at {at};
      liaison g: prismatique(ground, b{axis}) with coulomb(mu, mu_s = mu_s, half_length = l);
      force f: on(h, value = {pull});
      force w: on(b, value = {across});
      world(gravity = 0 m/s^2);
    initial
      g.displacement = 0 m;
      g.speed = 0 m/s;
      experiment(stop = 3 s, tolerance = 1e-11);
    end Drawer;
    """


def drawer(space: bool, axis: str = "x") -> frot.Model:
    """The pull grows with time at d beside the guide; in space along x or along z."""
    if not space:
        return model(
            DRAWER.format(planar="planar ", size="(0.5, 0.4) m", at="(0.25 m, d)", axis="",
                          pull="(pull*time/(1 s), 0 N)", across="(0 N, across)")
        )  # fmt: skip
    at, pull, across = {
        "x": ("(0.25 m, d, 0 m)", "(pull*time/(1 s), 0 N, 0 N)", "(0 N, across, 0 N)"),
        "z": ("(0 m, 0.6*d, 0.8*d)", "(0 N, 0 N, pull*time/(1 s))", "(0 N, across, 0 N)"),
    }[axis]
    if axis == "z":
        at = "(0.8*d, 0.6*d, 0.25 m)"
        across = "(0.8*across, 0.6*across, 0 N)"
    return model(
        DRAWER.format(planar="", size="(0.5, 0.4, 0.1) m", at=at, axis=f", axis = {axis}",
                      pull=pull, across=across)
    )  # fmt: skip


SCENES = [(False, "x"), (True, "x"), (True, "z")]


@pytest.mark.parametrize(("space", "axis"), SCENES)
@pytest.mark.parametrize("factor", [1 - 1e-9, 1 + 1e-9])
def test_a_drawer_locks_from_mu_equal_to_half_length_over_offset(
    space: bool, axis: str, factor: float
) -> None:
    """The moment P d presses both ends by P d/(2 L): P against mu P d/L."""
    result = drawer(space, axis).simulate(parameters={"mu": 4 / 3 * factor, "mu_s": 4 / 3 * factor})
    speed = last(result, "g.speed")[0]
    if factor > 1:
        assert speed == 0
    else:
        assert speed == pytest.approx(8 * 9 / 2 / 4 * 1e-9, rel=1e-5)


@pytest.mark.parametrize(("space", "axis"), SCENES)
@pytest.mark.parametrize(("across", "mass"), [(10, 4), (-10, 4), (10, 4e6), (3, 4e-3)])
def test_one_end_of_a_drawer_changes_sides(
    space: bool, axis: str, across: float, mass: float
) -> None:
    """The ends press by max(|F|, |P| d/L): F until P d = F L, where the far one changes sides.

    It departs at P = mu max(F, P d/L), with P = 8 t.
    """
    scale = mass / 4
    result = drawer(space, axis).simulate(
        parameters={"m": f"{mass} kg", "across": f"{across * scale} N", "pull": f"{8 * scale} N"}
    )
    force, rate, mu, part = abs(across), 8.0, 0.2, 0.75
    begin, turn = mu * force / rate, force / (rate * part)
    speed = rate / 2 * (9 - begin**2)
    speed -= mu * (force * (turn - begin) + rate * part / 2 * (9 - turn**2))
    assert last(result, "g.speed")[0] == pytest.approx(speed / 4, rel=1e-9)
    assert result.events[0].time == pytest.approx(begin, rel=1e-9)


def test_a_guide_that_turns_presses_at_its_radius() -> None:
    """G is d beside the guide: what brakes presses its ends by a d/L, the weight about its axis.

    a = mu (sqrt(g^2 + (a d/L)^2) + g d/r).
    """
    scene = model("""
        model Rail
          body b: box(mass = 3 kg, size = (0.5, 0.4, 0.1) m);
          frame h on b at (0 m, -0.2 m, 0 m);
          liaison g: prismatique(ground, h) with coulomb(0.1, half_length = 0.3 m, radius = 0.04 m);
        initial
          g.speed = 1 m/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Rail;
        """)
    (stop,) = scene.simulate().events
    mu, twist, part = 0.1, G * 0.2 / 0.04, 0.2 / 0.3
    # (a/mu - twist)^2 = g^2 + (a part)^2
    a, b, c = 1 / mu**2 - part**2, -2 * twist / mu, twist**2 - G**2
    slows = (-b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
    assert stop.time == pytest.approx(1 / slows, rel=1e-11)


def test_the_kinetic_coefficient_takes_over_when_a_drawer_departs() -> None:
    result = drawer(True).simulate(parameters={"across": "10 N", "mu": 0.2, "mu_s": 0.3})
    (begin,) = (event.time for event in result.events)
    assert begin == pytest.approx(0.3 * 10 / 8, rel=1e-10)


PLATE = """
    model Plate
      parameter Mass m = 2 kg;
      parameter Real mu = 0.1;
      parameter Length delta = 1 cm;
      parameter Force lift = 0 N;
      body b: cylinder(mass = m, radius = 0.1 m, length = 0.4 m);
      liaison g: appui_plan({places}) with coulomb(mu), pivoting_resistance(delta);
      force f: on(b, value = (0 N, 0 N, lift*time/(1 s)));
    initial
      b.velocity = (1, 0.5, 0) m/s;
      b.angular_velocity = (0, 0, 10) rad/s;
      experiment(stop = 3 s, tolerance = 1e-11);
    end Plate;
    """


@pytest.mark.parametrize("mass", [2, 2e6, 2e-6])
def test_a_plate_slides_and_turns_to_rest(mass: float) -> None:
    """V' = -mu g and I w' = -delta m g, each by itself."""
    result = model(PLATE.format(places="ground, b")).simulate(parameters={"m": f"{mass} kg"})
    turns, slides = (event.time for event in result.events)
    assert turns == pytest.approx(0.5 * 0.01 * 10 / (0.01 * G), rel=1e-10)
    assert slides == pytest.approx(math.hypot(1, 0.5) / (0.1 * G), rel=1e-10)
    assert last(result, "b.velocity.x", "b.velocity.y", "b.angular_velocity.z") == [0, 0, 0]
    path = 1.25 / (2 * 0.1 * G)
    assert math.hypot(*last(result, "b.position.x", "b.position.y")) == pytest.approx(path)


def test_the_force_of_a_plane_may_change_its_side() -> None:
    """N = m g - k t passes zero: v loses mu int |N|/m dt."""
    lift, mu = 2 * G, 0.02
    result = model(PLATE.format(places="ground, b")).simulate(
        parameters={"lift": f"{lift} N", "mu": mu, "delta": "0 m"}
    )
    lost = mu * G * (0.5 + 2)
    speed = math.hypot(1, 0.5) - lost
    assert math.hypot(*last(result, "b.velocity.x", "b.velocity.y")) == pytest.approx(
        speed, abs=1e-9
    )
    assert last(result, "g.force.z")[0] == pytest.approx(-2 * 2 * G, rel=1e-11)


SLOPE = """
    model Slope
      parameter Angle i = 0.4 rad;
      parameter Angle about = 0.3 rad;
      body b: cylinder(mass = 1 kg, radius = 0.1 m, length = 0.4 m);
      frame ramp on ground rotated(axis = z, angle = about);
      frame tilted on ramp rotated(axis = y, angle = i);
      liaison g: appui_plan(tilted, b) with coulomb(0.6);
    initial
      der(g.x) = -0.5 m/s;
      der(g.y) = 1 m/s;
      g.angle = 0 rad;
      der(g.angle) = 2 rad/s;
      experiment(stop = 3 s, tolerance = 1e-11);
    end Slope;
    """


def test_a_plate_on_a_slope_stops_as_a_point_does() -> None:
    """P. Painlevé 1895, p. 71: friction acts at the origin of b, which here is G."""
    load, angle = G * math.sin(0.4), math.atan2(1, -0.5)
    k, u = 0.6 / math.tan(0.4), math.tan(angle / 2)
    c = 2 * math.hypot(0.5, 1) / (u ** (k - 1) + u ** (k + 1))
    exact = c / (2 * load) * (u ** (k - 1) / (k - 1) + u ** (k + 1) / (k + 1))
    result = model(SLOPE).simulate()
    (stop,) = result.events
    assert stop.time == pytest.approx(exact, rel=1e-10)
    assert last(result, "b.velocity.x", "b.velocity.y", "b.velocity.z") == [0, 0, 0]
    assert last(result, "b.angular_velocity.x")[0] == pytest.approx(
        2 * math.sin(0.4) * math.cos(0.3)
    )


SIDES = """
    model Sides
      parameter Mass m = 1 kg;
      parameter Real mu = 0.02;
      parameter Real mu_s = 0.02;
      parameter Angle i = 0.3 rad;
      parameter Velocity u = 1 m/s;
      body b: {body};
      surface wall on ground: plane(through = (0, 0, 0) m, normal = (-sin(i), 0, cos(i)));
      liaison g: {kind} with coulomb(mu, mu_s = mu_s);
      force f: on(b, value = (-sin(i)*m*{load}, m*{along}*1 m/s^2, cos(i)*m*{load}));
      world(gravity = 0 m/s^2);
    initial
      b.position = (-sin(i)*{high}, 0 m, cos(i)*{high});
      b.velocity = (cos(i)*0.6*u, 0.8*u, sin(i)*0.6*u);
      b.angular_velocity = (0, 0, 0) rad/s;
      experiment(stop = 2 s, tolerance = 1e-11);
    end Sides;
    """
POINT = SIDES.replace("      b.angular_velocity = (0, 0, 0) rad/s;\n", "")
BOTH_SIDES = {
    "point_surface": POINT.replace("{body}", "particle(mass = m)").replace("{high}", "0 m")
    .replace("{kind}", "point_surface(b, wall)"),
    "contact_ponctuel": POINT.replace("{body}", "particle(mass = m)").replace("{high}", "0 m")
    .replace("{kind}", "contact_ponctuel(b, wall, unilateral = false)"),
    "lineaire_annulaire": POINT.replace("{body}", "particle(mass = m)").replace("{high}", "0 m")
    .replace("{kind}", "lineaire_annulaire(ground, b, axis = (cos(i)*0.6, 0.8, sin(i)*0.6))"),
}  # fmt: skip


@pytest.mark.parametrize("name", BOTH_SIDES)
@pytest.mark.parametrize(("mass", "u"), [(1, 1), (1e6, -1), (1e-6, 2)])
def test_a_load_presses_one_side_and_then_the_other(name: str, mass: float, u: float) -> None:
    """N = m (10 t - 9): v loses mu int |N|/m dt = mu (9^2 + 11^2)/20."""
    text = BOTH_SIDES[name].format(load="(10*time/(1 s) - 9)*1 m/s^2", along=0)
    result = model(text).simulate(parameters={"m": f"{mass} kg", "u": f"{u} m/s"})
    speed = np.linalg.norm(last(result, *(f"b.velocity.{c}" for c in "xyz")))
    assert speed == pytest.approx(abs(u) - 0.02 * (81 + 121) / 20, rel=1e-9)


@pytest.mark.parametrize("name", ["point_surface", "contact_ponctuel"])
def test_what_is_pressed_from_the_other_side_rests_and_departs(name: str) -> None:
    """At rest under a pull that grows: it departs at mu_s N, with mu N then."""
    text = BOTH_SIDES[name].format(load="(-10 m/s^2)", along="(4*time/(1 s))")
    result = model(text).simulate(parameters={"mu": 0.3, "mu_s": 0.5, "u": "0 m/s"})
    assert [event.time for event in result.events] == pytest.approx([1.25], rel=1e-9)
    speed = 2 * (4 - 1.25**2) - 3 * 0.75
    assert last(result, "b.velocity.y") == pytest.approx([speed], rel=1e-9)
