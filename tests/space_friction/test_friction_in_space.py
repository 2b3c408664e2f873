"""Dry friction in space against closed forms: sliding, rest, departure, lift-off, pins, balls."""

from __future__ import annotations

import math
import textwrap
from itertools import pairwise

import numpy as np
import pytest
from space_models import G, last, loaded

import frot

VELOCITY = ("b.velocity.x", "b.velocity.y", "b.velocity.z")


def model(text: str) -> frot.Model:
    return frot.compile(textwrap.dedent(text))


BALL = """
    model Ball
      parameter Mass m = 1 kg;
      parameter Length r = 0.1 m;
      parameter Real mu = 0.3;
      parameter Velocity u = 1 m/s;
      parameter Velocity w = 0.5 m/s;
      body b: sphere(mass = m, radius = r);
      liaison c: contact_ponctuel(b.surface, ground.plane) with coulomb(mu){more};
    initial
      b.position = (0 m, 0 m, r);
      b.velocity = (u, w, 0 m/s);
      b.angular_velocity = (0 rad/s, 0 rad/s, {spin} rad/s);
      experiment(stop = {stop} s, tolerance = 1e-11);
    end Ball;
    """


@pytest.mark.parametrize(
    ("mass", "radius", "mu", "u", "w"),
    [(1, 0.1, 0.3, 1, 0.5), (1e6, 2, 0.05, -3, 0.1), (1e-6, 0.01, 1.2, 0, -2)],
)
def test_a_sphere_slides_until_it_rolls(
    mass: float, radius: float, mu: float, u: float, w: float
) -> None:
    """Of slip v0 it rolls from t = 2 v0/(7 mu g) on, with 5/7 of its speed."""
    ball = model(BALL.format(more="", spin=0, stop=4))
    values = {"m": f"{mass} kg", "r": f"{radius} m", "mu": mu, "u": f"{u} m/s", "w": f"{w} m/s"}
    result = ball.simulate(parameters=values)
    (rolls,) = result.events
    assert rolls.time == pytest.approx(2 * math.hypot(u, w) / (7 * mu * G), rel=1e-10)
    assert last(result, *VELOCITY[:2]) == pytest.approx([5 * u / 7, 5 * w / 7], abs=1e-9)
    assert last(result, "c.slip.x", "c.slip.y", "c.slip.z") == [0, 0, 0]


def test_rolling_resistance_brings_a_sphere_to_rest() -> None:
    """v' = -mu g and r w' = 5/2 (mu - delta/r) g while it slides, then 7/5 v' = -delta g/r."""
    delta, radius, mu = 0.002, 0.1, 0.3
    result = model(BALL.format(more=f", rolling_resistance({delta} m)", spin=0, stop=12)).simulate()
    rolls, rests = result.events
    speed, part = math.hypot(1, 0.5), delta / radius
    time = speed / (G * (mu + 2.5 * (mu - part)))
    assert rolls.time == pytest.approx(time, rel=1e-10)
    rolling = speed - mu * G * time
    assert rests.time == pytest.approx(time + 7 * rolling / (5 * part * G), rel=1e-9)
    assert last(result, *VELOCITY) == [0, 0, 0]


def test_pivoting_resistance_ends_the_spin_alone() -> None:
    delta, spin = 0.002, 3.0
    result = model(
        BALL.format(more=f", pivoting_resistance({delta} m)", spin=spin, stop=1.5)
    ).simulate()
    stops = [event for event in result.events if "held" in event.text]
    assert [event.time for event in stops] == pytest.approx(
        [0.4 * 0.1**2 * spin / (delta * G)], rel=1e-10
    )
    assert last(result, "b.angular_velocity.z") == [0]
    assert last(result, *VELOCITY[:2]) == pytest.approx([5 / 7, 2.5 / 7], abs=1e-9)


PLANE = """
    model Plane
      parameter Angle i = 0.4 rad;
      parameter Angle about = 0 rad;
      parameter Real f = 0.6;
      body b: particle(mass = 1 kg);
      surface ramp on ground: plane(
        through = (0 m, 0 m, 0 m),
        normal = (sin(i)*cos(about), sin(i)*sin(about), cos(i)));
      liaison c: contact_ponctuel(b.G, ramp) with coulomb(f);
      parameter Velocity down = -0.5 m/s;
      parameter Velocity aside = 1 m/s;
    initial
      b.position = (0 m, 0 m, 0 m);
      b.velocity = (
        down*cos(i)*cos(about) - aside*sin(about),
        down*cos(i)*sin(about) + aside*cos(about),
        -down*sin(i));
      experiment(stop = 3 s);
    end Plane;
    """


def stop_time(incline: float, f: float, down: float, aside: float) -> float:
    """P. Painlevé 1895, p. 71: k = f cot i, u = tan(theta/2), |s| = C (u^(k-1) + u^(k+1))/2."""
    load, angle = G * math.sin(incline), math.atan2(abs(aside), down)
    k, u = f / math.tan(incline), math.tan(angle / 2)
    c = 2 * math.hypot(down, aside) / (u ** (k - 1) + u ** (k + 1))
    return c / (2 * load) * (u ** (k - 1) / (k - 1) + u ** (k + 1) / (k + 1))


def test_a_point_on_a_rough_plane_stops_and_the_error_follows_the_tolerance() -> None:
    plane, exact = model(PLANE), stop_time(0.4, 0.6, -0.5, 1)
    for tolerance in (1e-3, 1e-5, 1e-7, 1e-9, 1e-11):
        result = plane.simulate(tolerance=tolerance)
        (stop,) = result.events
        assert stop.time == pytest.approx(exact, rel=max(tolerance, 1e-12))
        assert last(result, *VELOCITY) == [0, 0, 0]


@pytest.mark.parametrize("about", [0.3, 1.9, -2.6])
@pytest.mark.parametrize(
    ("incline", "f", "down", "aside"), [(0.4, 0.6, 0.5, 1), (0.2, 1.1, -1, -0.3), (0.9, 1.4, 2, 2)]
)
def test_the_stop_is_the_same_in_turned_and_mirrored_planes(
    about: float, incline: float, f: float, down: float, aside: float
) -> None:
    result = model(PLANE).simulate(
        tolerance=1e-11,
        parameters={
            "i": f"{incline} rad",
            "about": f"{about} rad",
            "f": f,
            "down": f"{down} m/s",
            "aside": f"{aside} m/s",
        },
    )
    assert result.events[0].time == pytest.approx(stop_time(incline, f, down, aside), rel=1e-10)
    assert last(result, *VELOCITY) == [0, 0, 0]


PULL = """
    model Pull
      parameter Real mu = 0.3;
      parameter Real mu_s = 0.3;
      parameter Angle about = 0.9 rad;
      body b: particle(mass = 1 kg);
      liaison c: contact_ponctuel(b.G, ground.plane) with coulomb(mu, mu_s = mu_s);
      force f: on(b, value = (5 N/s*time*cos(about), 5 N/s*time*sin(about), 0 N));
    initial
      b.position = (0 m, 0 m, 0 m);
      b.velocity = (0 m/s, 0 m/s, 0 m/s);
      experiment(stop = 2 s);
    end Pull;
    """


@pytest.mark.parametrize("about", [0.0, 0.9, -2.4])
@pytest.mark.parametrize("mu_s", [0.3, 0.4])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-11])
def test_a_growing_pull_breaks_a_point_away(mu_s: float, about: float, tolerance: float) -> None:
    """It departs at 5 t = mu_s g, along the pull, with the coefficient of motion."""
    result = model(PULL).simulate(
        tolerance=tolerance, parameters={"mu_s": mu_s, "about": f"{about} rad"}
    )
    (departs,) = result.events
    start = mu_s * G / 5
    assert departs.time == pytest.approx(start, rel=1e-12)
    speed = 2.5 * (4 - start**2) - 0.3 * G * (2 - start)
    expected = [speed * math.cos(about), speed * math.sin(about)]
    assert last(result, *VELOCITY[:2]) == pytest.approx(expected, abs=max(tolerance, 1e-9))
    before = np.flatnonzero(result.time < start)
    assert not np.any(result["b.velocity.x"][before])


def test_a_sliding_point_is_lifted_off() -> None:
    """N = m g - 20 t ends at g/20 s; friction takes mu times its impulse."""
    result = model("""
        model Lift
          body b: particle(mass = 1 kg);
          liaison c: contact_ponctuel(b.G, ground.plane) with coulomb(0.3);
          force f: on(b, value = (0 N, 0 N, 20 N/s*time));
        initial
          b.position = (0 m, 0 m, 0 m);
          b.velocity = (2 m/s, 1 m/s, 0 m/s);
          experiment(stop = 1 s, tolerance = 1e-11);
        end Lift;
        """).simulate()
    (leaves,) = result.events
    assert leaves.kind == "separation"
    assert leaves.time == pytest.approx(G / 20, abs=1e-12)
    part = 1 - 0.3 * G**2 / 40 / math.sqrt(5)
    assert last(result, *VELOCITY[:2]) == pytest.approx([2 * part, part], abs=1e-10)
    assert last(result, "b.position.z") == pytest.approx([20 * (1 - G / 20) ** 3 / 6], abs=1e-10)


def test_the_reaction_of_a_bilateral_contact_changes_sides_while_it_slides() -> None:
    """Friction is mu |g - 20 t|, and stops the point at g/20 + sqrt((v0 - 0.3 g^2/40)/3)."""
    result = model("""
        model Held
          body b: particle(mass = 1 kg);
          liaison c: contact_ponctuel(b.G, ground.plane, unilateral = false) with coulomb(0.3);
          force f: on(b, value = (0 N, 0 N, 20 N/s*time));
        initial
          b.position = (0 m, 0 m, 0 m);
          b.velocity = (2 m/s, 1 m/s, 0 m/s);
          experiment(stop = 1.6 s, tolerance = 1e-11);
        end Held;
        """).simulate()
    turns, stops = result.events
    assert turns.time == pytest.approx(G / 20, abs=1e-10)
    left = math.sqrt(5) - 0.3 * G**2 / 40
    assert stops.time == pytest.approx(G / 20 + math.sqrt(left / 3), abs=1e-10)
    assert last(result, *VELOCITY) == [0, 0, 0]


def test_a_block_on_a_shaking_table_slips_and_sticks_in_time() -> None:
    """Table A sin(2 pi t) along any direction: it slips where the table's acceleration is mu g."""
    result = model("""
        model Shake
          body b: particle(mass = 1 kg);
          body t: box(mass = 1 kg, size = (1, 1, 0.1) m);
          surface top on t: plane(through = (0 m, 0 m, 0.05 m), normal = (0, 0, 1));
          liaison slide: prismatique(ground, t, axis = (0.6, 0.8, 0))
            driven(displacement = 0.1 m*sin(2*pi*time/1 s));
          liaison c: contact_ponctuel(b.G, top) with coulomb(0.3);
        initial
          b.position = (0 m, 0 m, 0.05 m);
          b.velocity = (0.6*0.2*pi*(1 m/s), 0.8*0.2*pi*(1 m/s), 0 m/s);
          experiment(stop = 1.2 s, tolerance = 1e-9);
        end Shake;
        """).simulate()
    slips, sticks, again, *_ = (event.time for event in result.events)
    assert slips == pytest.approx(
        math.asin(0.3 * G / (0.1 * (2 * math.pi) ** 2)) / math.tau, abs=1e-9
    )
    assert sticks == pytest.approx(0.4891949759, abs=1e-8)
    assert again == pytest.approx(slips + 0.5, abs=1e-9)


FEET = """
    model Feet
      parameter Force growth = 6 N;
      body b: box(mass = 2 kg, size = (0.4 m, 0.3 m, 0.1 m));
      liaison c: appui_faces(b.bottom, ground.plane) with coulomb(0.3);
      force f: on(b, value = (growth*time/1 s, 2 N/s*time, 0 N));
    initial
      b.position = (0 m, 0 m, 0.05 m);
      b.velocity = ({u} m/s, {w} m/s, 0 m/s);
      experiment(stop = 1.2 s, tolerance = 1e-9);
    end Feet;
    """


def test_a_box_on_four_corners_rests_until_the_limit_load() -> None:
    """However the corners share the load, all slide from 6.3246 t = mu m g on."""
    result = model(FEET.format(u=0, w=0)).simulate()
    pull = math.hypot(6, 2)
    start = 0.3 * 2 * G / pull
    assert [event.time for event in result.events] == pytest.approx([start] * 4, abs=1e-10)
    speed = (pull * (1.2**2 - start**2) / 2 - 0.3 * 2 * G * (1.2 - start)) / 2
    expected = [speed * 6 / pull, speed * 2 / pull, 0]
    assert last(result, *VELOCITY) == pytest.approx(expected, abs=1e-9)
    assert last(result, "b.angular_velocity.z") == pytest.approx([0], abs=1e-10)


def test_reactions_of_a_box_at_rest_do_not_jump() -> None:
    result = model(FEET.format(u=0, w=0)).simulate(stop=0.93)
    for corner in range(1, 5):
        normal = result[f"c[{corner}].normal_force"]
        steps = [abs(b - a) for a, b in pairwise(normal)]
        assert max(steps) < 0.5
        friction = np.hypot(
            result[f"c[{corner}].tangential_force.x"], result[f"c[{corner}].tangential_force.y"]
        )
        assert np.all(friction <= 0.3 * normal * (1 + 1e-9))


def test_a_sliding_box_that_turns_dissipates_its_energy_and_rests() -> None:
    result = model(FEET.format(u=1, w=0.2).replace("6 N;", "0 N;").replace("2 N/s", "0 N/s"))
    run = result.simulate()
    assert {event.after for event in run.events} == {"stick"}
    assert last(run, *VELOCITY) == [0, 0, 0]
    assert run.balance.relative < 1e-9


def test_a_tall_box_tips_about_its_edge() -> None:
    """It tips where the pull times its height is the weight times half the width."""
    result = model("""
        model Tip
          body b: box(mass = 2 kg, size = (0.2 m, 0.2 m, 0.6 m));
          liaison c: appui_faces(b.bottom, ground.plane) with coulomb(0.9);
          force f: on(b, value = (4 N/s*time, 0 N, 0 N));
        initial
          b.position = (0 m, 0 m, 0.3 m);
          b.velocity = (0 m/s, 0 m/s, 0 m/s);
          experiment(stop = 1.8 s, tolerance = 1e-9);
        end Tip;
        """).simulate()
    assert {event.after for event in result.events} == {"open"}
    tips = [event.time for event in result.events]
    assert tips == pytest.approx([2 * G * 0.1 / 0.3 / 4] * 2, abs=1e-9)
    assert result["b.angular_velocity.y"][-1] > 0
    assert last(result, "b.angular_velocity.x", "b.angular_velocity.z") == pytest.approx(
        [0, 0], abs=1e-9
    )


PENDULUM = """
    {model} Pendulum
      body b: solid(mass = 1.3 kg, inertia = {inertia}, com = {com});
      liaison h: rotoide(ground, b{axis}) with coulomb(0.2, radius = 30 mm);
    initial
      h.angle = {angle} rad;
      h.speed = 0 rad/s;
      experiment(stop = 6 s, tolerance = 1e-10);
    end Pendulum;
    """


def test_a_dry_hinge_in_space_moves_as_its_planar_twin() -> None:
    space = model(
        PENDULUM.format(
            model="model", inertia="(0.02, 0.03, 0.04) kg.m^2", com="(0.5 m, 0 m, 0 m)",
            axis=", axis = y", angle=-1,
        )
    ).simulate()  # fmt: skip
    planar = model(
        PENDULUM.format(
            model="planar model", inertia="0.03 kg.m^2", com="(0.5 m, 0 m)", axis="", angle=1
        )
    ).simulate()
    assert len(planar.events) == 5
    assert [e.time for e in space.events] == pytest.approx(
        [e.time for e in planar.events], abs=1e-10
    )
    assert last(space, "h.angle") == pytest.approx([-x for x in last(planar, "h.angle")], abs=1e-9)
    assert last(space, "h.torque.y") == pytest.approx(
        [-x for x in last(planar, "h.torque")], abs=1e-8
    )


def test_a_dry_ball_joint_ends_a_spin_about_the_vertical() -> None:
    """The couple is mu r m g, so that the spin ends at I w/(mu r m g)."""
    result = model("""
        model Spin
          body b: solid(
            mass = 1.3 kg, inertia = (0.02, 0.03, 0.04) kg.m^2, com = (0 m, 0 m, -0.5 m));
          liaison h: spherique(ground, b.origin) with coulomb(0.2, radius = 30 mm);
        initial
          b.angular_velocity = (0 rad/s, 0 rad/s, 3 rad/s);
          experiment(stop = 4 s, tolerance = 1e-11);
        end Spin;
        """).simulate()
    (stops,) = result.events
    assert stops.time == pytest.approx(0.04 * 3 / (0.2 * 0.03 * 1.3 * G), rel=1e-11)
    assert last(result, "b.angular_velocity.x", "b.angular_velocity.z") == [0, 0]


def test_a_dry_ball_joint_brings_a_pendulum_to_rest_off_the_vertical() -> None:
    result = model("""
        model Swing
          body b: solid(
            mass = 1.3 kg, inertia = (0.02, 0.03, 0.04) kg.m^2, com = (0.1 m, 0 m, -0.5 m));
          liaison h: spherique(ground, b.origin) with coulomb(0.2, radius = 30 mm);
        initial
          b.angular_velocity = (1 rad/s, 2 rad/s, 3 rad/s);
          experiment(stop = 60 s, tolerance = 1e-10);
        end Swing;
        """).simulate()
    assert result.events[-1].after == "stick"
    names = [f"b.angular_velocity.{axis}" for axis in "xyz"]
    assert last(result, *names) == [0, 0, 0]
    couple = math.hypot(*last(result, *(f"h.torque.{axis}" for axis in "xyz")))
    assert couple <= 0.2 * 0.03 * 1.3 * G
    assert result.balance.relative < 1e-9


@pytest.mark.parametrize("kind", ["encastrement", "libre", "fil"])
def test_other_joints_in_space_refuse_friction_by_name(kind: str) -> None:
    option = ", length = 1 m" if kind == "fil" else ""
    with pytest.raises(frot.FrotError, match="in space is not supported yet"):
        model(f"""
            model Dry
              body b: sphere(mass = 1 kg, radius = 0.1 m);
              liaison h: {kind}(ground, b{option}) with coulomb(0.2);
            end Dry;
            """).simulate()


def test_a_dae_with_friction_in_space_is_refused_by_name() -> None:
    with pytest.raises(frot.FrotError, match="a DAE with friction on contacts in space"):
        model(BALL.format(more="", spin=0, stop=1)).dae()


def test_a_dae_with_two_dry_axes_of_one_joint_is_refused() -> None:
    """A universal joint has one mode for both of its axes there."""
    with pytest.raises(frot.FrotError, match="on several motions of a joint"):
        loaded("dry_gimbal").dae()
