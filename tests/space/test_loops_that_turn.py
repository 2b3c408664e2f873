"""Loops whose axes turn with what carries them, and rolling where the normal turns.

Which directions their rows are written along means nothing: neither to the motion nor to its cost.
"""

import numpy as np
import pytest

import frot
from tests.liaisons.table import turned, unit

FLAT = """
model Carried "A four-bar on a body that turns freely"
  world(gravity = 0 m/s^2);
  body base: cylinder(mass = 50 kg, radius = 1 m, length = 0.2 m);
  liaison Z: {held};
  body left: rod(mass = 1 kg, length = 1 m, inertia = (0.01, 0.1, 0.1) kg.m^2);
  body top: rod(mass = 2 kg, length = 1.3 m, inertia = (0.02, 0.2, 0.2) kg.m^2);
  body right: rod(mass = 1 kg, length = 0.9 m, inertia = (0.01, 0.1, 0.1) kg.m^2);
  frame far on base at (1.1, 0, 0) m;
  liaison A: rotoide(base, left.start, axis = y);
  liaison B: {first}(left.tip, top.start, axis = y);
  liaison C: {second};
  liaison D: rotoide(far, right.start, axis = y);
initial
  {starts}
  A.angle = -1.2;
  guess(B.angle = 1.37, D.angle = -0.92);
  A.speed = 2 rad/s;
  experiment(stop = 2 s, tolerance = 1e-10);
end Carried;
"""
PINS = {"first": "rotoide", "second": "rotoide(top.tip, right.tip, axis = y)"}
ISOSTATIC = {"first": "verrou", "second": "spherique(top.tip, right.tip)"}
HELD = {
    "fixed": ("encastrement(ground, base)", ""),
    "leans": ("rotoide(ground, base, axis = (1, 1, 1))", "Z.speed = 3 rad/s;"),
    "tumbles": (
        "spherique(ground, base)",
        "base.orientation = (1, 0, 0, 0); base.angular_velocity = (1, 2, 3) rad/s;",
    ),
}


@pytest.fixture(scope="module")
def carried() -> dict[tuple[str, str], frot.Result]:
    kinds = {"pins": PINS, "isostatic": ISOSTATIC}
    return {
        (way, kind): frot.compile(FLAT.format(held=held, starts=starts, **joints)).simulate()
        for way, (held, starts) in HELD.items()
        for kind, joints in kinds.items()
        if kind == "pins" or way == "tumbles"
    }


def test_a_flat_loop_costs_alike_however_it_turns(carried: dict) -> None:
    """Along axes of the ground its rows would depend on each other in turns."""
    fixed = carried["fixed", "pins"].figures
    for (way, kind), result in carried.items():
        assert result.figures.steps < 3 * fixed.steps, (way, kind)
        assert result.figures.rejected < result.figures.steps, (way, kind)
        assert result.figures.crossings == 0


def test_pins_too_many_move_as_those_that_suffice(carried: dict) -> None:
    one, other = carried["tumbles", "pins"], carried["tumbles", "isostatic"]
    for name in ("A.angle", "D.angle", "base.angular_velocity.x", "top.position.z"):
        assert np.abs(one[name] - other[name]).max() < 1e-8, name
    assert np.ptp(one["D.angle"]) > 0.5
    energy = one["energy.kinetic"] + one["energy.potential"]
    assert np.ptp(energy) < 1e-8 * energy[0]


BOWL = """
model Bowl "A ball rolls without slip inside of a sphere, all of it turned about the vertical"
  parameter Angle turn = 0;
  parameter Length z = -0.3 m;
  parameter Length r = 0.5 m;
  body ball: sphere(mass = 1 kg, radius = r);
  surface bowl on ground: sphere(radius = 1 m);
  liaison rolls: roulement(bowl, ball.surface);
initial
  ball.position = (sqrt(0.25 m^2 - z^2)*cos(turn), sqrt(0.25 m^2 - z^2)*sin(turn), z);
  ball.velocity.z = 0 m/s;
  guess(ball.velocity = (-0.5*sin(turn), 0.5*cos(turn), 0) m/s);
  experiment(stop = 3 s, tolerance = 1e-10);
end Bowl;
"""


def test_where_the_normal_turns_rolling_is_the_same_to_every_side() -> None:
    model = frot.compile(BOWL)
    plain = model.simulate(parameters={"turn": 0})
    way = np.array([plain[f"ball.position.{c}"] for c in "xyz"])
    energy = plain["energy.kinetic"] + plain["energy.potential"]
    assert np.ptp(energy) < 1e-9 * np.ptp(plain["energy.kinetic"])
    for angle in (0.7, 2.4, 4.0):
        result = model.simulate(parameters={"turn": angle})
        assert result.figures.steps < 1.2 * plain.figures.steps
        there = np.array([result[f"ball.position.{c}"] for c in "xyz"])
        assert np.abs(there - turned(unit(0, 0, 1), angle) @ way).max() < 1e-8


def test_a_ball_whose_start_is_not_told_is_put_against_its_bowl() -> None:
    """From the centre every way is as near; of a sphere of its size it is outside."""
    text = BOWL.split("initial")[0] + "experiment(stop = 1 s);\nend Bowl;\n"
    model = frot.compile(text)
    at = model.simulate().at(0.0)
    assert np.linalg.norm([at[f"ball.position.{c}"] for c in "xyz"]) == pytest.approx(0.5, rel=1e-9)
    at = model.simulate(parameters={"r": 1.0}).at(0.0)
    assert np.linalg.norm([at[f"ball.position.{c}"] for c in "xyz"]) == pytest.approx(2, rel=1e-9)
