"""Landings without slip: a box flat on its four corners, in closed form, and a ball."""

from __future__ import annotations

import functools
import math
from pathlib import Path

import pytest

import frot

G = 9.81
HALF = 0.05


@functools.cache
def model(size: str = "(0.3, 0.43, 0.1)") -> frot.Model:
    return frot.compile(f"""
model Flat
  parameter Real mu = 0.5;
  parameter Real e = 0;
  parameter Velocity vx = 0 m/s;
  parameter AngularVelocity w = 0 rad/s;
  parameter Acceleration gx = 0 m/s^2;
  parameter Acceleration gz = {G} m/s^2;
  parameter Mass m = 1 kg;
  parameter Angle turn = 0 rad;
  parameter Length h = 0.2 m;
  world(gravity = 0 m/s^2);
  body b: box(mass = m, size = {size}*(1 m));
  liaison c: appui_faces(b.bottom, ground.plane) with coulomb(mu), restitution(e);
  force weight: on(b, value = m*(gx, 0 m/s^2, -gz));
initial
  b.position = (0, 0, 1)*h;
  b.orientation = (cos(turn/2), 0, 0, sin(turn/2));
  b.velocity = (1, 0, 0)*vx;
  b.angular_velocity = (0, 0, 1)*w;
  experiment(stop = 1.5 s, tolerance = 1e-8);
end Flat;
""")


def fall(h: float = 0.2, half: float = HALF) -> tuple[float, float]:
    """Time of the impact and speed of approach."""
    t = math.sqrt(2 * (h - half) / G)
    return t, G * t


@pytest.mark.parametrize("turn", [0.0, 0.2, 1.1, 2.9])
@pytest.mark.parametrize("w", [0.0, 3.0, -1.0])
@pytest.mark.parametrize("m", [1.0, 1e6, 1e-6])
def test_a_box_that_drops_flat_lies_where_it_fell(turn: float, w: float, m: float) -> None:
    for size, half in (("(0.3, 0.43, 0.1)", 0.05), ("(0.1, 0.13, 0.2)", 0.1)):
        values = {"turn": turn, "w": w, "m": m}
        result = model(size).simulate(parameters=values)
        t, v = fall(half=half)
        hits = [e for e in result.events if e.kind == "impact"]
        assert len(hits) == 4
        assert all(e.time == pytest.approx(t, rel=1e-12) for e in hits)
        assert sum(e.impulse for e in hits) == pytest.approx(m * v, rel=1e-9)
        assert {e.after for e in result.events[4:]} == {"stick"}
        at = result.at(1.5)
        for k in "xyz":
            assert at[f"b.velocity.{k}"] == 0
            assert at[f"b.angular_velocity.{k}"] == 0
        assert at["b.position.z"] == pytest.approx(half, rel=1e-12)
        assert abs(at["b.position.x"]) < 1e-12


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("m", [1.0, 1e6])
def test_a_box_thrown_flat_loses_mu_of_the_impulse_and_slides_to_rest(way: float, m: float) -> None:
    vx = 2.0 * way
    result = model().simulate(parameters={"vx": vx, "m": m})
    t, v = fall()
    after = abs(vx) - 0.5 * v
    at = result.at(1.5)
    stops = [e.time for e in result.events if e.after == "stick"]
    assert stops == pytest.approx([t + after / (0.5 * G)] * 4, rel=1e-10)
    assert at["b.position.x"] == pytest.approx(way * (2 * t + after**2 / G), rel=1e-9)
    assert at["b.velocity.x"] == 0 and at["b.angular_velocity.z"] == 0


def test_a_box_that_lands_flat_on_a_slope_goes_on_sliding() -> None:
    result = model().simulate(parameters={"gx": 6.0})
    t, v = fall()
    speed = 6 * t - 0.5 * v + (6 - 0.5 * G) * (1.5 - t)
    assert result.at(1.5)["b.velocity.x"] == pytest.approx(speed, rel=1e-10)


@pytest.mark.parametrize("e", [0.3, 0.5])
@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_a_box_that_bounces_flat_rests_at_its_limit(e: float, turn: float) -> None:
    result = model().simulate(parameters={"e": e, "turn": turn})
    t, v = fall()
    at = result.at(1.5)
    assert result.events[-1].time == pytest.approx(t + 2 * v / G * e / (1 - e), rel=1e-8)
    assert at["b.velocity.z"] == 0 and at["b.angular_velocity.x"] == 0


@pytest.mark.parametrize("vx", [-1.3, -1.35, -1.4])
def test_a_box_that_tips_back_onto_a_slope_stays_there(vx: float) -> None:
    """Two corners hold while two others land: friction is enough for all (mu = 1.2, tan 0.2)."""
    result = frot.compile("""
model Tip
  parameter Velocity vx = -1.33 m/s;
  parameter Angle a = -0.029;
  body b: box(mass = 1 kg, size = (0.589, 0.3, 0.151) m);
  surface slope on ground: plane(through = (0, 0, 0) m, normal = (-sin(0.2), 0, cos(0.2)));
  liaison floor: appui_faces(b.bottom, slope) with coulomb(1.2), restitution(0);
initial
  b.position = (0, 0, 1) m;
  b.orientation = (cos(a/2), sin(a/2)*0.6, sin(a/2)*0.8, 0);
  b.velocity = (vx, 0.2 m/s, 0 m/s);
  b.angular_velocity = (-1.509, -0.7545, 1.509) rad/s;
  experiment(stop = 0.8 s, tolerance = 1e-6);
end Tip;
""").simulate(parameters={"vx": vx})
    at = result.at(0.8)
    for k in "xyz":
        assert at[f"b.velocity.{k}"] == 0 and at[f"b.angular_velocity.{k}"] == 0


def test_a_ball_that_lands_on_an_apex_rests() -> None:
    """Its slip after the impact is rounding of the speed before it, and zero."""
    result = frot.load(Path(__file__).parent / "ball_lands_on_an_apex.frot").simulate()
    assert result.time[-1] == 0.5
