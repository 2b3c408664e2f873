"""What can part from a curve with ends: it flies past them, falls off them, or goes round them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

import frot

G, R = 9.81, 0.1

TABLE = """planar model Table
  parameter Length x = 0 m;
  parameter Length y = 35 cm;
  parameter Velocity vx = 0 m/s;
  parameter Velocity vy = 0 m/s;
  parameter Angle lean = 0;
  world(gravity = 0 m/s^2);
  body table: {table};
  frame pin on ground at {middle} rotated(angle = lean);
  liaison fix: encastrement(pin, table);
  body p: {body};
  force weight: on(p, value = 9.81 N*(sin(lean), -cos(lean)));
  liaison C: contact_ponctuel({order}){law};
initial
  p.position = x*(cos(lean), sin(lean)) + y*(-sin(lean), cos(lean));
  p.velocity = vx*(cos(lean), sin(lean)) + vy*(-sin(lean), cos(lean));
  experiment(stop = 1 s);
end Table;"""
BOX = "box(mass = 1 kg, size = (1, 0.5) m)"
SHEET = (
    "polygon(mass = 1 kg, vertices = ((-0.5, -0.25), (0.5, -0.25), (0.5, 0.25), (-0.5, 0.25)) m)"
)
POINT, DISC = "particle(mass = 1 kg)", "disc(mass = 1 kg, radius = 10 cm)"


def table(order: str, body: str, law: str = "", of: str = BOX, middle: str = "(0, 0) m") -> str:
    return TABLE.format(table=of, order=order, body=body, law=law, middle=middle)


ROUGH = " with coulomb(0.25)"
POINTS = {
    "a box": table("table.top, p", POINT, ROUGH),
    "in the other order": table("p, table.top", POINT, ROUGH),
    "a polygon": table("table.sides[3], p", POINT, ROUGH, SHEET),
    "a rod": table(
        "table.axis, p", POINT, ROUGH, "rod(mass = 1 kg, length = 1 m)",
        "0.25 m*(-sin(lean), cos(lean))",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", POINTS)
def test_a_point_slides_over_the_end_and_falls(name: str) -> None:
    """It brakes with mu g along half a metre, then it falls freely; tilted axes are the same."""
    model = frot.compile(POINTS[name])
    for lean, tolerance in ((0.0, 1e-8), (2.4, 1e-12)):
        given = {"y": 0.25, "vx": 3.0, "lean": lean}
        result = model.simulate(tolerance=tolerance, parameters=given)
        (event,) = (e for e in result.events if e.kind == "separation")
        left = (3 - math.sqrt(9 - G / 4)) / (G / 4)
        assert event.time == pytest.approx(left, abs=1e-12)
        after = 1 - left
        along, up = 0.5 + (3 - left * G / 4) * after, 0.25 - G / 2 * after**2
        x, y = result["p.position.x"][-1], result["p.position.y"][-1]
        c, s = math.cos(lean), math.sin(lean)
        assert c * x + s * y == pytest.approx(along, abs=1e-11)
        assert c * y - s * x == pytest.approx(up, abs=1e-11)
        assert result["C.gap"][-1] == pytest.approx(math.hypot(along - 0.5, up - 0.25), abs=1e-11)


def test_what_falls_beside_does_not_land() -> None:
    """The distance to an end is one to a point; from below the line is met from below."""
    model = frot.compile(table("table.top, p", POINT))
    result = model.simulate(parameters={"x": 0.9, "y": 1.0})
    t = result.time
    away = np.hypot(0.4, 0.75 - G / 2 * t**2)
    assert np.abs(result["C.gap"] - away).max() < 1e-10
    # thrown around the end, and back beneath the line against it
    result = model.simulate(parameters={"x": 0.8, "y": -1.0, "vx": -2.0, "vy": 6.0})
    hit = (6 - math.sqrt(36 - 2 * G * 1.25)) / G
    assert result.events[0].kind == "impact"
    assert result.events[0].time == pytest.approx(hit, abs=1e-10)


def lifts() -> tuple[float, float]:
    """When a smooth disc, from 0.5 m/s, leaves the edge it goes round, and at which angle.

    R w^2 = v^2/R + 2 g (1 - cos a); the pressure g cos a - R w^2 vanishes.
    """
    v = 0.5
    lift = math.acos((v * v / (G * R) + 2) / 3)

    def slowness(a: float) -> float:
        return 1 / math.sqrt((v / R) ** 2 + 2 * G / R * (1 - math.cos(a)))

    return 0.5 / v + quad(slowness, 0, lift, epsabs=1e-14)[0], lift


@pytest.mark.parametrize("tolerance", [1e-5, 1e-8, 1e-12])
def test_a_disc_goes_round_an_edge(tolerance: float) -> None:
    model = frot.compile(table("table.top, p.rim", DISC))
    result = model.simulate(stop=1.5, tolerance=tolerance, parameters={"vx": 0.5})
    (event,) = (e for e in result.events if e.kind == "separation")
    when, angle = lifts()
    assert event.time == pytest.approx(when, abs=1e-12 + tolerance)
    there = result.at(event.time)
    assert there["p.position.x"] == pytest.approx(0.5 + R * math.sin(angle), abs=1e-12 + tolerance)
    early = result.at(1.0 + 1e-9)
    assert early["C.normal_force"] == pytest.approx(G - 0.25 / R, rel=1e-6)


CURVE = """planar model Bead
  parameter Velocity v = 5 m/s;
  parameter Length x = 0 m;
  parameter Length y = 0 m;
  curve arc on ground: parametric((1 m*u, 0.3 m*u^2), u = {ends});
  body p: particle(mass = 1 kg);
  liaison C: {kind};
initial
  p.position = (x, y);
  p.velocity = (v, 0.6*x/(1 m)*v);
  experiment(stop = 1 s, tolerance = 1e-10);
end Bead;"""


@pytest.mark.parametrize(
    "kind", ["contact_ponctuel(arc, p)", "point_courbe(p, arc, unilateral = true)"]
)
@pytest.mark.parametrize("ends", ["(-1, 1)", "(1, -1)"])
def test_a_bead_leaves_a_bowl_at_its_rim(kind: str, ends: str) -> None:
    """Energy gives its speed there, the slope of 0.6 its direction."""
    model = frot.compile(CURVE.format(kind=kind, ends=ends))
    result = model.simulate()
    (event,) = result.events
    assert event.kind == "separation"
    there = result.at(event.time)
    assert there["p.position.x"] == pytest.approx(1, abs=1e-10)
    speed = math.sqrt(25 - 2 * G * 0.3)
    assert there["p.velocity.x"] == pytest.approx(speed / math.hypot(1, 0.6), abs=1e-9)
    after = 1 - event.time
    x = 1 + there["p.velocity.x"] * after
    assert result["p.position.x"][-1] == pytest.approx(x, abs=1e-9)
    flies = model.simulate(parameters={"x": 0.9, "y": 0.9, "v": 4.0})
    assert not flies.events
    assert flies["p.position.x"][-1] == pytest.approx(4.9, abs=1e-9)


def test_what_cannot_part_ends_by_name() -> None:
    for kind in ("contact_ponctuel(arc, p, unilateral = false)", "point_courbe(p, arc)"):
        with pytest.raises(frot.SimulationError, match="'C' leaves 'arc', which ends") as told:
            frot.compile(CURVE.format(kind=kind, ends="(-1, 1)")).simulate()
        assert told.value.diagnostics[0].code == "E0906"
        assert told.value.result["p.position.x"][-1] == pytest.approx(1, abs=1e-9)
    with pytest.raises(frot.SimulationError, match=r"'C' leaves 'table.top', which ends"):
        frot.compile(table("table.top, p.rim, unilateral = false", DISC)).simulate(
            parameters={"vx": 2.0}
        )


BLOCKS = """planar model Blocks
  parameter Length x = 0 m;
  parameter Velocity v = 0 m/s;
  body base: box(mass = 1 kg, size = (1, 0.5) m);
  body b: box(mass = 2 kg, size = (WIDE, 0.2) m);
  liaison fix: encastrement(ground, base);
  liaison C: appui_faces(ORDER) with coulomb(0.1);
initial
  b.position = (x, 0.35 m);
  b.velocity.x = v;
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Blocks;"""


@pytest.mark.parametrize("order", ["b.bottom, base.top", "base.top, b.bottom"])
def test_a_block_rests_on_another_and_tips_over_its_edge(order: str) -> None:
    """The upper one may be as wide as the lower, wider, or reach beyond; sliding, it tips where
    its weight and the friction m g mu at its foot meet the edge: at x = 1/2 - mu h."""
    for wide in ("1", "3", "0.4"):
        model = frot.compile(BLOCKS.replace("ORDER", order).replace("WIDE", wide))
        for x in (0.0, 0.4 if wide != "0.4" else 0.1):
            result = model.simulate(parameters={"x": x})
            assert np.abs(result["b.position.x"] - x).max() == 0
            assert result["C.normal_force"][-1] == pytest.approx(2 * G, rel=1e-12)
    model = frot.compile(BLOCKS.replace("ORDER", order).replace("WIDE", "1"))
    result = model.simulate(parameters={"v": 2.0})
    way, brake = 0.5 - 0.1 * 0.1, 0.1 * G
    tips = (2 - math.sqrt(4 - 2 * brake * way)) / brake
    times = [e.time for e in result.events if e.kind == "separation"]
    assert min(abs(t - tips) for t in times) < 1e-9
    assert result["b.angle"][-1] < -0.05
    gone = model.simulate(parameters={"x": 1.2})
    assert gone["b.position.y"][-1] == pytest.approx(0.35 - G / 8, abs=1e-10)


def test_a_rocker_comes_to_stand_on_its_tip() -> None:
    """An arc of a circle of 1 m about the G of what it is on rolls until its end, then tips.

    Smooth, its G sinks as the end does: at the angle a the height is cos(a - 0.3), from 0.3 on.
    """
    text = """planar model Rocker
  body b: solid(mass = 1 kg, inertia = 0.5 kg.m^2);
  curve sole on b: parametric((1 m*sin(u), -1 m*cos(u)), u = (-0.3, 0.3));
  liaison C: contact_ponctuel(ground.line, sole);
initial
  b.position = (0, 1) m;
  b.angular_velocity = 1 rad/s;
  experiment(stop = 0.8 s, tolerance = 1e-10);
end Rocker;"""
    result = frot.compile(text).simulate()
    angle, y = result["b.angle"], result["b.position.y"]
    expected = np.where(angle < 0.3, 1.0, np.cos(angle - 0.3))
    assert angle[-1] > 0.7
    assert np.abs(y - expected).max() < 1e-9
    sink = -np.sin(angle - 0.3) * result["b.angular_velocity"]
    energy = 0.25 * result["b.angular_velocity"] ** 2 + np.where(angle < 0.3, 0, sink**2) / 2
    assert np.abs(energy + G * (y - 1) - 0.25).max() < 1e-8


@pytest.mark.parametrize("order", ["a.axis, b", "b, a.axis", "a.axis, b.bottom", "a.axis, hill"])
def test_a_gap_of_zero_may_be_met_at_an_end(order: str) -> None:
    """The guesses are far beyond the end, on both sides of which the place found is."""
    body = "box(mass = 1 kg, size = (0.6, 0.4) m)" if "bottom" in order else POINT
    if "bottom" in order:
        order = "a.start, b.bottom"
    text = f"""planar model Begins
  body a: rod(mass = 1 kg, length = 1 m);
  body b: {body};
  body c: solid(mass = 1 kg, inertia = 0.1 kg.m^2);
  curve hill on c: parametric((0.5 m*u, 0.2 m*u^2 - 0.2 m), u = (-1, 1));
  liaison C: contact_ponctuel({order});
initial
  guess(b.position = (0.03, 0.8) m);
  guess(c.position = (0.03, 0.8) m);
  C.gap = 0 m;
  experiment(stop = 0.1 s);
end Begins;"""
    result = frot.compile(text).simulate()
    assert np.abs(result["C.gap"]).max() < 1e-12


@pytest.mark.parametrize("of", ["egg on a box", "disc on a hump"])
def test_rolling_over_an_end_is_one_motion_at_every_tolerance(of: str) -> None:
    """The reaction jumps there, as the curvature does: from then on it is that of the end."""
    egg = of == "egg on a box"
    text = f"""planar model Over
  body s: box(mass = 1 kg, size = (1.2, 0.5) m);
  liaison f: encastrement(ground, s);
  curve hump on ground: parametric((0.6 m*u, -0.2 m*u^2), u = (-1, 1));
  body p: {"ellipse(mass = 1 kg, a = 20 cm, b = 12 cm)" if egg else DISC};
  liaison C: contact_ponctuel({"s.top" if egg else "hump"}, p.rim) with coulomb(0.8);
initial
  p.position.x = {0.00655 if egg else -0.402} m;
  p.velocity.x = {1.859 if egg else 0.964} m/s;
  C.gap = 0 m;
  guess(p.position.y = {0.68 if egg else 0.45} m);
  p.angle = 0.0551;
  experiment(stop = 1.1 s);
end Over;"""
    model = frot.compile(text)
    results = [model.simulate(tolerance=t) for t in (1e-8, 1e-10, 1e-12, 1e-13)]
    for result in results[:-1]:
        assert len(result.events) == len(results[-1].events) > 0
        for a, b in zip(result.events, results[-1].events, strict=True):
            assert (a.kind, a.after) == (b.kind, b.after)
            assert a.time == pytest.approx(b.time, abs=1e-9)
        assert np.min(result["C.normal_force"]) > -1e-9
