"""Many contacts that come to their bounds at one instant, where one motion is looked for."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest
from scipy.optimize import brentq

import frot

pytestmark = pytest.mark.finding

G = 9.81
TOLERANCES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13]


@functools.cache
def table(legs: int) -> frot.Model:
    """A table with legs in a row, loaded and pulled at its edge ever more."""
    feet = "\n".join(
        f"  frame leg{i} on top at ({-0.9 + 1.8 * i / (legs - 1)}, -0.7) m;\n"
        f"  liaison f{i}: contact_ponctuel(leg{i}, ground.line) with coulomb(mu);"
        for i in range(legs)
    )
    return frot.compile(f"""
planar model Table
  parameter Real mu = 0.35;
  parameter Real way = 1;
  body top: rod(mass = 20 kg, length = 2 m);
{feet}
  frame edge on top at (1.1 m*way, 0 m);
  force pull: on(edge, value = (way*8 N/s*time, -15 N/s*time));
initial
  top.position = (0, 0.7) m;
  experiment(stop = 22 s);
end Table;""")


@pytest.mark.parametrize("legs", [3, 8, 9, 12])
@pytest.mark.parametrize("way", [1, -1])
def test_a_table_of_many_legs_tips_about_the_last(legs: int, way: int) -> None:
    """Moments about the last leg: 20 kg g 0.9 m = (15*0.2 + 8*0.7) N.m/s t. It sticks there."""
    tips = 20 * G * 0.9 / (15 * 0.2 + 8 * 0.7)
    for tolerance in TOLERANCES[:: 1 if legs < 9 else 5]:
        for mu in (0.35, 0.8):
            result = table(legs).simulate(parameters={"mu": mu, "way": way}, tolerance=tolerance)
            opened = [e for e in result.events if e.after == "open"]
            last = f"f{legs - 1}" if way > 0 else "f0"
            assert result.time[-1] == 22
            assert {e.liaison for e in opened} == {f"f{i}" for i in range(legs)} - {last}
            assert [e.time for e in opened] == pytest.approx([tips] * (legs - 1), rel=1e-9)


@functools.cache
def pile(count: int) -> frot.Model:
    """Boxes on each other, each shaken by a force in proportion to its mass."""
    lines = [
        "planar model Pile",
        "  parameter Acceleration p = 3 m/s^2;",
        "  parameter Real mu = 0.3;",
    ]
    lines += ["  Acceleration shake = p*sin(5*time/(1 s));"]
    below = "ground.line"
    for i in range(count):
        lines += [
            f"  body b{i}: box(mass = {1 + i} kg, size = (0.4, 0.2) m);",
            f"  liaison c{i}: appui_faces(b{i}.bottom, {below}) with coulomb(mu);",
            f"  force f{i}: on(b{i}, value = ({1 + i} kg*shake, 0 N));",
        ]
        below = f"b{i}.top"
    lines += ["initial"]
    lines += [f"  b{i}.position = (0, {0.1 + 0.2 * i}) m;" for i in range(count)]
    return frot.compile("\n".join([*lines, "  experiment(stop = 0.6 s);", "end Pile;"]))


def slides(p: float, mu: float) -> tuple[float, float, float]:
    """When a block that p sin(w t) shakes begins to slide from rest and stops, and how far away."""
    w, a = 5.0, mu * G
    begins = math.asin(a / p) / w

    def speed(t: float) -> float:
        return p / w * (math.cos(w * begins) - math.cos(w * t)) - a * (t - begins)

    stops = brentq(speed, 1.001 * (math.pi / w - begins), 2 * math.pi / w, xtol=1e-15)
    way = p / w * math.cos(w * begins) * (stops - begins)
    way -= p / w**2 * (math.sin(w * stops) - math.sin(w * begins))
    return begins, stops, way - a * (stops - begins) ** 2 / 2


@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize(("p", "mu"), [(3.0, 0.3), (-3.0, 0.3), (3.5, 0.3)])
def test_a_shaken_pile_slides_as_one(count: int, p: float, mu: float) -> None:
    """Friction is the same part of each load everywhere: all interfaces are at their bounds at one
    instant, and whether the upper ones slip or not no box moves on another."""
    begins, stops, way = slides(abs(p), mu)
    for tolerance in TOLERANCES[:: 1 if count < 5 else 5]:
        result = pile(count).simulate(parameters={"p": p, "mu": mu}, tolerance=tolerance)
        assert result.time[-1] == 0.6
        near = max(tolerance, 1e-10)
        times = {round(e.time, 6): e.time for e in result.events}
        assert list(times.values()) == pytest.approx([begins, stops], rel=near)
        at = result.at(0.6)
        for i in range(count):
            assert at[f"b{i}.position.x"] == pytest.approx(np.sign(p) * way, rel=10 * near)
            assert at[f"b{i}.velocity.x"] == 0


@pytest.mark.parametrize("away", [0.0, 1e-3])
def test_boxes_corner_over_corner_hold_until_their_friction_is_passed(away: float) -> None:
    """The lowest of three boxes is pulled: it slides at 0.3 of the weight of all, 6 kg; the upper
    two stay on it until they would need more than 0.4 g."""
    model = frot.compile("""
planar model Corners
  parameter Length away = 0 m;
  body a: box(mass = 3 kg, size = (0.4, 0.2) m);
  body b: box(mass = 2 kg, size = (0.3, 0.2) m);
  body c: box(mass = 1 kg, size = (0.2, 0.2) m);
  liaison fa: appui_faces(a.bottom, ground.line) with coulomb(0.3);
  liaison fb: appui_faces(b.bottom, a.top) with coulomb(0.4);
  liaison fc: appui_faces(c.bottom, b.top) with coulomb(0.4);
  force pull: on(a, value = (10 N/s*time, 0 N));
initial
  a.position = (0, 0.1) m; b.position = (0.05, 0.3) m; c.position = (away, 0.5 m);
  experiment(stop = 4.12 s);
end Corners;""")
    for tolerance in TOLERANCES:
        result = model.simulate(parameters={"away": away}, tolerance=tolerance, stop=4.121)
        begins = {e.liaison[:2]: e.time for e in reversed(result.events) if e.kind == "slip"}
        assert begins["fa"] == pytest.approx(0.3 * 6 * G / 10, rel=1e-9)
        assert begins["fb"] == pytest.approx(0.7 * 6 * G / 10, rel=1e-9)
        at = result.at(4.1205)
        assert at["a.velocity.x"] > at["b.velocity.x"] > 0
        assert at["c.velocity.x"] == pytest.approx(at["b.velocity.x"], rel=1e-9)
