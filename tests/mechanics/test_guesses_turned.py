"""A start by guesses is the same wherever the scene stands and however it is turned."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

HEAD = """
planar model Turned
  parameter Angle th = 0;
  parameter Length x = 0 m;
  parameter Length y = 0 m;
  parameter Length span = 1.3 m;
  parameter Real g[6] = (0, 0, 0, 0, 0, 0);
  world(gravity = 0 m/s^2);
  frame base on ground at (x, y) rotated(angle = th);
"""
ROD = """
  body r: rod(mass = 1 kg, length = span);
  curve e on base: ellipse(a = 1.5 m, b = 0.7 m);
  liaison P: point_courbe(r.tip, e);
  SECOND
"""
LOOP = """
  body crank: rod(mass = 1 kg, length = 0.3 m);
  body coupler: rod(mass = 2 kg, length = 1 m);
  body rocker: rod(mass = 1.5 kg, length = 0.7 m);
  frame far on base at (0.9 m, 0 m);
  liaison A: rotoide(base, crank.start);
  liaison B: rotoide(crank.tip, coupler.start);
  liaison C: rotoide(coupler.tip, rocker.tip);
  liaison D: rotoide(far, rocker.start);
"""
BOTH = ROD.replace("SECOND", "liaison Q: point_courbe(r.start, e);")


def place(first: int, unit: float = 1.0, along: float = 0.0) -> str:
    """Two of the guesses as a place in the axes of the base."""
    return (
        f"base.position + ({along} + {unit}*g[{first}])*(1 m)*base.ex"
        f" + {unit}*g[{first + 1}]*(1 m)*base.ey"
    )


def text(body: str, guesses: list[str]) -> str:
    """The whole text with these lines in its section `initial`."""
    return f"{HEAD}{body}initial\n{''.join(guesses)}experiment(stop = 1e-9 s);\nend Turned;\n"


def rods(rng: np.random.Generator) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """A rod with both ends on the ellipse: its length, and where its ends are."""
    u = rng.uniform(-np.pi, np.pi)
    w = u + rng.uniform(1.0, 2.0)
    tip, start = ((1.5 * math.cos(s), 0.7 * math.sin(s)) for s in (u, w))
    return {"span": math.dist(tip, start)}, {"tip": tip, "start": start}


def loops(rng: np.random.Generator) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """The four-bar: where its crank and its coupler end."""
    crank, side = rng.uniform(-np.pi, np.pi), rng.choice([-1, 1])
    tip = 0.3 * np.exp(1j * crank)
    way = 0.9 - tip
    half = math.acos((abs(way) ** 2 + 1 - 0.49) / (2 * abs(way)))
    end = tip + way / abs(way) * np.exp(1j * side * half)
    return {}, {"crank": (tip.real, tip.imag), "coupler": (end.real, end.imag)}


SCENES = {
    "place and angle": (BOTH, [f"guess(r.position = {place(1)}, r.angle = th + g[3]);\n"], rods),
    "one end": (
        ROD.replace("SECOND", ""),
        [f"guess(r.tip.position = {place(1)}, r.start.position = {place(3)});\n"],
        rods,
    ),
    "loop": (
        LOOP,
        [f"guess(coupler.tip.position = {place(3)}, crank.tip.position = {place(1)});\n"],
        loops,
    ),
}
FRAMES = [(0.0, 0.0, 0.0), (0.7, 0.0, 0.0), (-2.0, 3.0, -1.0), (3.0, -40.0, 25.0)]


@pytest.mark.parametrize("name", SCENES)
def test_a_start_by_guesses_does_not_depend_on_the_frame(name: str) -> None:
    """Guesses a twentieth of a metre off a place that holds: near it, and always the same."""
    body, guesses, make = SCENES[name]
    moved = ("r.tip", "r.start") if body is not LOOP else ("crank.tip", "coupler.tip")
    outputs = "".join(
        f"  output Length p{k} = dot({point}.position - base.position, base.e{axis});\n"
        for k, (point, axis) in enumerate((p, a) for p in moved for a in "xy")
    )
    model, rng = frot.compile(text(body + outputs, guesses)), np.random.default_rng(8)
    for _ in range(10):
        lengths, places = make(rng)
        ends = np.array(list(places.values()))
        off = rng.uniform(-0.05, 0.05, 4)
        if name == "place and angle":
            middle, way = ends.mean(axis=0), ends[0] - ends[1]
            given = np.array([*middle, math.atan2(way[1], way[0])]) + off[:3]
        else:
            given = ends.ravel() + off
        parameters = lengths | {f"g[{k + 1}]": float(z) for k, z in enumerate(given)}
        found = []
        for th, x, y in FRAMES:
            start = model.simulate(parameters=parameters | {"th": th, "x": x, "y": y}).at(0)
            found.append([float(start[f"p{k}"]) for k in range(4)])
        assert np.ptp(found, axis=0).max() < 1e-8  # 47 m away
        assert abs(np.array(found[0]) - ends.ravel()).max() < 0.4
