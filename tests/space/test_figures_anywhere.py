"""Convex figures touch and roll alike turned, moved and in a gliding frame.

All stand on a base that parameters turn, move and push; weights are forces that turn with it.
"""

from __future__ import annotations

import numpy as np
import pytest

import frot
from tests.liaisons.table import turned, unit
from tests.space.newton_euler import vector

BASE = {
    "plane": ("surface", "plane(through = (0, 0, 0) m, normal = (0.1, 0.2, 1))", (0.1, 0.2, 0.5)),
    "ball": ("surface", "sphere(radius = 1 m)", (0.3, 0.2, 1.25)),
    "bowl": ("surface", "sphere(radius = 1 m)", (0.1, 0.2, -0.6)),
    "tube": ("surface", "cylinder(radius = 1 m, axis = (1, 0.2, 0.1))", (0.1, 0.2, -0.6)),
    "drum": ("surface", "cylinder(radius = 1 m, axis = (1, 0.2, 0.1))", (0.1, 0.2, 1.3)),
    "level": ("surface", "implicit(x^2 + 2*y^2 + z^4/(1 m^2) - 1 m^2)", (0.2, 0.1, 1.25)),
    "rail": ("curve", "line(through = (0, 0, 0) m, direction = (1, 0.2, 0.1))", (0.1, 0.1, 0.4)),
    "oval": ("curve", "ellipse(a = 1 m, b = 0.7 m, normal = (0.1, 0.3, 1))", (0.95, 0.1, 0.35)),
}
BODY = {
    "sphere": ("sphere(mass = 2 kg, radius = 0.3 m)", "surface"),
    "egg": ("ellipsoid(mass = 2 kg, semi_axes = (0.3, 0.4, 0.2) m)", "surface"),
    "plate": ("ellipse(mass = 2 kg, a = 0.4 m, b = 0.3 m)", "rim"),
    "hoop": ("ring(mass = 2 kg, radius = 0.3 m)", "rim"),
    "can": ("cylinder(mass = 2 kg, radius = 0.2 m, length = 1 m)", "rims[1]"),
}
TOUCH, ROLL = "contact_ponctuel(F_@, b_@.{}, unilateral = false)", "roulement(F_@, b_@.{})"
PAIRS = [
    ("plane", "sphere", TOUCH),
    ("plane", "can", ROLL),
    ("ball", "sphere", ROLL),
    ("ball", "plate", ROLL),
    ("bowl", "egg", TOUCH),
    ("bowl", "hoop", ROLL),
    ("tube", "plate", TOUCH),
    ("tube", "egg", ROLL),
    ("drum", "can", TOUCH),
    ("drum", "hoop", ROLL),
    ("level", "sphere", TOUCH),
    ("rail", "plate", TOUCH),
    ("oval", "sphere", ROLL),
]
TURN = (0.7, 0.1, 0.5, 0.5)
PLACED = ({"tilt": 0.7}, {"x": 0.3, "y": -0.2, "z": 0.5}, {"u": 2.0, "v": -1.0, "w": 3.0})


def text() -> str:
    declared, begins = "", ""
    for k, (figure, body, liaison) in enumerate(PAIRS):
        kind, given, (x, y, z) = BASE[figure]
        shape, part = BODY[body]
        declared += f"""
  {kind} F_@ on base: {given};
  body b_@: {shape};
  liaison L_@: {liaison.format(part)};
  force w_@: on(b_@, value = -19.62 N*base.ez);
  output Force f_@ = L_@.force;""".replace("@", str(k))
        begins += f"""
  guess(b_@.position = base.position + {x} m*base.ex + {y} m*base.ey + ({z} m)*base.ez);
  guess(b_@.orientation = (q1, q2, q3, q4));
  guess(b_@.velocity = base.velocity + 0.3 m/s*base.ex + 0.2 m/s*base.ey);
  guess(b_@.angular_velocity = 1 rad/s*base.ex - 2 rad/s*base.ey + 1.5 rad/s*base.ez);""".replace(
            "@", str(k)
        )
    return f"""
model Figures "Bodies on figures of a base, anywhere"
  parameter Angle tilt = 0 rad;
  parameter Length x = 0 m, y = 0 m, z = 0 m;
  parameter Velocity u = 0 m/s, v = 0 m/s, w = 0 m/s;
  parameter Real q1 = {TURN[0]}, q2 = {TURN[1]}, q3 = {TURN[2]}, q4 = {TURN[3]};
  world(gravity = 0 m/s^2);
  frame base on ground at (x + u*time, y + v*time, z + w*time)
    rotated(axis = (1, 2, 3), angle = tilt);{declared}
initial{begins}
  experiment(stop = 0.3 s, tolerance = 1e-12);
end Figures;
"""


@pytest.fixture(scope="module")
def still() -> tuple[frot.Model, frot.Result]:
    model = frot.compile(text())
    return model, model.simulate()


def together(first: np.ndarray, then: np.ndarray) -> np.ndarray:
    """One turn after another, as quaternions w, x, y, z."""
    (a, *p), (b, *q) = then, first
    p, q = np.array(p), np.array(q)
    return np.array([a * b - p @ q, *(a * q + b * p + np.cross(p, q))])


@pytest.mark.parametrize("given", PLACED)
def test_they_move_alike_and_push_alike(
    still: tuple[frot.Model, frot.Result], given: dict[str, float]
) -> None:
    model, plain = still
    tilt = given.get("tilt", 0.0)
    own = together(np.array(TURN), np.array([np.cos(tilt / 2), *np.sin(tilt / 2) * unit(1, 2, 3)]))
    begin = {f"q{k + 1}": float(x) for k, x in enumerate(own)}
    result = model.simulate(parameters={**given, **begin})
    turn = turned(unit(1, 2, 3), tilt)
    for t in (0.0, 0.1, 0.3):
        here, there = plain.at(t), result.at(t)
        way = np.array([given.get(c, 0.0) for c in "xyz"])
        way = way + t * np.array([given.get(c, 0.0) for c in "uvw"])
        for k, pair in enumerate(PAIRS):
            place = way + turn @ vector(here, f"b_{k}.position")
            assert vector(there, f"b_{k}.position") == pytest.approx(place, abs=1e-10), pair
            push = turn @ vector(here, f"f_{k}")
            assert vector(there, f"f_{k}") == pytest.approx(push, abs=1e-8), pair
    moved = [np.ptp(plain[f"b_{k}.position.{c}"]) for k in range(len(PAIRS)) for c in "x"]
    assert min(moved) > 1e-3
