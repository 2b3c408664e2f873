"""What a mechanism does turned, moved, gliding, renumbered, cut elsewhere, and in the plane.

One text holds a mechanism with tree and loop, another all liaisons of the table; parameters turn,
move and push them, so that each is compiled once. Weight is a force of the text, which turns with
the mechanism.
"""

from __future__ import annotations

import numpy as np
import pytest

import frot
from tests.liaisons.table import JOINTS as TABLE
from tests.liaisons.table import turned, unit
from tests.liaisons.test_table import G, H, K, first, second, stands, value
from tests.space.newton_euler import vector

BODIES = {
    "left": "body left: rod(mass = 1 kg, length = 1 m, inertia = (0.01, 0.1, 0.1) kg.m^2);",
    "top": "body top: rod(mass = 2 kg, length = 1.3 m, inertia = (0.02, 0.2, 0.2) kg.m^2);",
    "right": "body right: rod(mass = 1 kg, length = 0.9 m, inertia = (0.01, 0.1, 0.1) kg.m^2);",
    "hung": "body hung: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);",
}
JOINTS = {
    "A": "liaison A: rotoide(foot, left.start, axis = y);",
    "B": "liaison B: rotoide(left.tip, top.start, axis = y);",
    "C": "liaison C: rotoide(top.tip, right.tip, axis = y);",
    "D": "liaison D: rotoide(far, right.start, axis = y);",
    "E": "liaison E: rotoide(top.G, hook, axis = y);",
}


def text(bodies: str, joints: str) -> str:
    """A four-bar that carries a pendulum, with its parts in these orders."""
    declared = "\n  ".join([BODIES[x] for x in bodies.split()] + [JOINTS[x] for x in joints])
    return f"""
model FourBar "A four-bar with a pendulum, anywhere"
  parameter Angle tilt = 0 rad;
  parameter Length x = 0 m, y = 0 m, z = 0 m;
  parameter Velocity u = 0 m/s, v = 0 m/s, w = 0 m/s;
  parameter Acceleration g = 9.81 m/s^2;
  world(gravity = 0 m/s^2);
  frame base on ground at (x + u*time, y + v*time, z + w*time)
    rotated(axis = (1, 2, 3), angle = tilt);
  frame foot on base;
  frame far on base at (1.1, 0, 0) m;
  {declared}
  frame hook on hung at (0, 0, 0.3) m;
  force w1: on(left, value = -1 kg*g*base.ez);
  force w2: on(top, value = -2 kg*g*base.ez);
  force w3: on(right, value = -1 kg*g*base.ez);
  force w4: on(hung, value = -1 kg*g*base.ez);
  output Force f = D.force;
  output Power power = dot(A.force, left.start.velocity) + dot(D.force, right.start.velocity)
    + dot(B.force, top.start.velocity - left.tip.velocity)
    + dot(C.force, right.tip.velocity - top.tip.velocity)
    + dot(E.force, hook.velocity - top.velocity)
    + dot(A.torque, left.angular_velocity) + dot(D.torque, right.angular_velocity)
    + dot(B.torque, top.angular_velocity - left.angular_velocity)
    + dot(C.torque, right.angular_velocity - top.angular_velocity)
    + dot(E.torque, hung.angular_velocity - top.angular_velocity);
initial
  A.angle = -1.2;
  guess(B.angle = 1.37, D.angle = -0.92, C.angle = -1.09);
  E.angle = 0.2;
  A.speed = 2 rad/s;
  E.speed = 1 rad/s;
  experiment(stop = 1 s, tolerance = 1e-12);
end FourBar;
"""


@pytest.fixture(scope="module")
def plain() -> tuple[frot.Model, frot.Result]:
    model = frot.compile(text("left top right hung", "ABCDE"))
    return model, model.simulate()


def places(result: frot.Result, body: str, name: str = "position") -> np.ndarray:
    return np.array([result[f"{body}.{name}.{c}"] for c in "xyz"])


PLACED = ({"tilt": 0.7}, {"x": 3.0, "y": -2.0, "z": 5.0}, {"u": 2.0, "v": -1.0, "w": 3.0})
PLACED += ({"tilt": -2.5, "x": -1.0, "z": 0.3, "u": -4.0, "w": 0.5},)


@pytest.mark.parametrize("given", PLACED)
def test_turned_moved_and_gliding_it_moves_alike(
    plain: tuple[frot.Model, frot.Result], given: dict[str, float]
) -> None:
    model, still = plain
    result = model.simulate(parameters=given)
    turn = turned(unit(1, 2, 3), given.get("tilt", 0.0))
    at = np.array([[given.get(c, 0.0)] for c in "xyz"])
    glides = np.array([[given.get(c, 0.0)] for c in "uvw"]) * result.time
    for body in BODIES:
        want = at + glides + turn @ places(still, body)
        assert np.abs(places(result, body) - want).max() < 1e-10
    for name in ("A.angle", "D.angle", "E.angle"):
        assert np.abs(result[name] - still[name]).max() < 1e-10
    forces = (np.array([x[f"f.{c}"] for c in "xyz"]) for x in (result, still))
    in_plane = turn.T @ next(forces) - next(forces)
    assert np.abs(in_plane[[0, 2]]).max() < 1e-8


def test_perfect_liaisons_have_no_power(plain: tuple[frot.Model, frot.Result]) -> None:
    _, still = plain
    assert np.abs(still["power"]).max() < 1e-10
    assert np.ptp(still["D.angle"]) > 0.5


@pytest.mark.parametrize(
    ("bodies", "joints"),
    [("hung right top left", "EDCBA"), ("top left hung right", "DBEAC")],
)
def test_renumbered_and_cut_elsewhere_it_moves_alike(
    plain: tuple[frot.Model, frot.Result], bodies: str, joints: str
) -> None:
    _, still = plain
    result = frot.compile(text(bodies, joints)).simulate()
    for body in BODIES:
        assert np.abs(places(result, body) - places(still, body)).max() < 1e-10


PLANAR = """
planar model FourBar "The same in the plane: x and z become x and y, and angles count the other way"
  body left: rod(mass = 1 kg, length = 1 m, inertia = 0.1 kg.m^2);
  body top: rod(mass = 2 kg, length = 1.3 m, inertia = 0.2 kg.m^2);
  body right: rod(mass = 1 kg, length = 0.9 m, inertia = 0.1 kg.m^2);
  body hung: box(mass = 1 kg, size = (0.4, 0.3) m);
  frame far on ground at (1.1, 0) m;
  frame hook on hung at (0, 0.3) m;
  liaison A: rotoide(ground, left.start);
  liaison B: rotoide(left.tip, top.start);
  liaison C: rotoide(top.tip, right.tip);
  liaison D: rotoide(far, right.start);
  liaison E: rotoide(top.G, hook);
  output Force f = D.force;
initial
  A.angle = 1.2;
  guess(B.angle = -1.37, D.angle = 0.92, C.angle = 1.09);
  E.angle = -0.2;
  A.speed = -2 rad/s;
  E.speed = -1 rad/s;
  experiment(stop = 1 s, tolerance = 1e-12);
end FourBar;
"""


def test_written_in_the_plane_it_moves_alike(plain: tuple[frot.Model, frot.Result]) -> None:
    _, still = plain
    flat = frot.compile(PLANAR).simulate()
    for body in BODIES:
        x, y, z = places(still, body)
        assert np.abs(y).max() < 1e-12
        assert np.abs(flat[f"{body}.position.x"] - x).max() < 1e-10
        assert np.abs(flat[f"{body}.position.y"] - z).max() < 1e-10
    assert np.abs(flat["D.angle"] + still["D.angle"]).max() < 1e-10
    assert np.abs(flat["f.x"] - still["f.x"]).max() < 1e-8
    assert np.abs(flat["f.y"] - still["f.z"]).max() < 1e-8


BASE = """
  parameter Angle tilt = 0 rad;
  parameter Length x = 0 m, y = 0 m, z = 0 m;
  parameter Velocity u = 0 m/s, v = 0 m/s, w = 0 m/s;
  parameter Acceleration g = 9.81 m/s^2;
  world(gravity = 0 m/s^2);
  frame base on ground at (x + u*time, y + v*time, z + w*time)
    rotated(axis = (1, 2, 3), angle = tilt);
  frame f0 on base at (0.1, 0.2, 0.3) m rotated(axis = (1, 2, 3), angle = 20 deg);"""
FREE = {"orientation": "(1, 0, 0, 0)"}


def two(kind: str) -> tuple[str, str]:
    """A box on the base in a liaison, and one on that box; where they begin."""
    row = TABLE[kind]
    weights = "".join(
        f"\n  force w{b}_{kind}: on({b}_{kind}, value = -{m} kg*g*base.ez);"
        for b, m in (("p", 2), ("q", 1))
    )
    liaisons = f"""
  liaison A_{kind}: {kind}(f0, g_{kind}{row.options});
  liaison B_{kind}: {kind}(h_{kind}, k_{kind}{row.options});
  output Force a_{kind} = norm(A_{kind}.force);
  output Force b_{kind} = norm(B_{kind}.force);"""
    begins = "".join(
        f"\n  {liaison}_{kind}.{name} = {FREE.get(name) or value(name, '0.2')};"
        for liaison in "AB"
        for name in row.coordinates
    )
    if kind != "encastrement":
        begins += (
            f"\n  guess(p_{kind}.velocity = base.velocity, q_{kind}.velocity = base.velocity);"
        )
    return first(kind) + second(kind) + weights + liaisons, begins


@pytest.fixture(scope="module")
def rows() -> tuple[frot.Model, frot.Result]:
    parts, begins = zip(*(two(kind) for kind in TABLE), strict=True)
    model = frot.compile(f"""
model Rows "Each liaison that coordinates keep, anywhere"{BASE}{"".join(parts)}
initial{"".join(begins)}
  experiment(stop = 0.6 s, tolerance = 1e-12);
end Rows;
""")
    return model, model.simulate()


@pytest.mark.parametrize("given", PLACED)
def test_each_liaison_moves_alike_turned_moved_and_gliding(
    rows: tuple[frot.Model, frot.Result], given: dict[str, float]
) -> None:
    model, still = rows
    result = model.simulate(parameters=given)
    turn = turned(unit(1, 2, 3), given.get("tilt", 0.0))
    at = np.array([[given.get(c, 0.0)] for c in "xyz"])
    at = at + np.array([[given.get(c, 0.0)] for c in "uvw"]) * result.time
    for kind in TABLE:
        for body in (f"p_{kind}", f"q_{kind}"):
            want = at + turn @ places(still, body)
            assert np.abs(places(result, body) - want).max() < 1e-10, body
        if kind != "libre":
            for name in (f"a_{kind}", f"b_{kind}"):
                assert np.abs(result[name] - still[name]).max() < 1e-8, name
        if kind != "encastrement":
            assert np.ptp(still[f"q_{kind}.position.z"]) > 1e-3


@pytest.mark.parametrize("kind", [x for x in TABLE if x != "libre"])
def test_the_reactions_of_each_liaison_have_no_power(
    rows: tuple[frot.Model, frot.Result], kind: str
) -> None:
    """At the places of a and b, which a slide or a plane keeps apart."""
    _, result = rows
    for t in (0.0, 0.2, 0.5):
        at = result.at(t)
        for liaison, a, b in (("A", None, ("p", G)), ("B", ("p", H), ("q", K))):
            force, couple = (vector(at, f"{liaison}_{kind}.{x}") for x in ("force", "torque"))
            power, size = 0.0, np.abs(force).max() + np.abs(couple).max()
            for sign, end in ((1, b), (-1, a)):
                if end is None:
                    continue
                body = f"{end[0]}_{kind}"
                turn = vector(at, f"{body}.angular_velocity")
                # the force acts at the place b on both
                there = stands(at, f"{b[0]}_{kind}", b[1])[0] - vector(at, f"{body}.position")
                moves = vector(at, f"{body}.velocity") + np.cross(turn, there)
                power += sign * (force @ moves + couple @ turn)
            assert abs(power) <= 1e-11 * max(size, 1.0), (liaison, t)
