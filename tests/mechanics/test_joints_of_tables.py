"""What slides over the joint of two tables that are flush: nothing meets, and nothing is lost."""

from __future__ import annotations

import math

import pytest

import frot

G = 9.81
TWO = """
  body one: box(mass = 1 kg, size = (2, 0.5) m);
  body two: box(mass = 1 kg, size = (2, 0.5) m);
  frame there on ground at (2, 0) m;
  liaison fix: encastrement(ground, one);
  liaison fix2: encastrement(there, two);"""
TABLES = """planar model Joint
  parameter Velocity v = 1 m/s;
  parameter Real mu = 0;
  parameter Length x = -0.5 m;
  parameter Mass m = 2 kg;
  body b: box(mass = m, size = (0.4, {high}) m);
  {two}
  liaison C: appui_faces({first}) with coulomb(mu);
  liaison D: appui_faces({second}) with coulomb(mu);
initial
  b.position = (x, 0.25 m + {high} m/2);
  b.velocity.x = v;
  experiment(stop = 3 s, tolerance = 1e-8);
end Joint;"""
ORDERS = {
    "body first": ("b.bottom, one.top", "b.bottom, two.top"),
    "table first": ("one.top, b.bottom", "two.top, b.bottom"),
    "mixed": ("one.top, b.bottom", "b.bottom, two.top"),
}


def slid(speed: float, mu: float, time: float) -> float:
    """How far a block has slid by then, from a speed."""
    time = min(time, abs(speed) / (mu * G)) if mu > 0 else time
    return math.copysign(abs(speed) * time - mu * G * time**2 / 2, speed)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("high", [0.2, 0.05])
def test_a_block_slides_over_the_joint_of_two_tables(order: str, high: float) -> None:
    """To and fro, smooth and rough, light and heavy: on a straight way, with all its energy."""
    first, second = ORDERS[order]
    model = frot.compile(TABLES.format(two=TWO, high=high, first=first, second=second))
    for speed, mu, mass in ((1.0, 0.0, 2.0), (4.0, 0.3, 2e-6), (-3.0, 0.2, 2e6), (-0.8, 0.0, 2.0)):
        start = -0.5 if speed > 0 else 2.4
        for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
            result = model.simulate(
                tolerance=tolerance, parameters={"v": speed, "mu": mu, "x": start, "m": mass}
            )
            for t in (0.4, 1.5, 3.0):
                now = result.at(t)
                assert now["b.position.x"] == pytest.approx(start + slid(speed, mu, t), abs=1e-11)
                assert now["b.position.y"] == pytest.approx(0.25 + high / 2, abs=1e-12)
                assert now["b.angle"] == pytest.approx(0, abs=1e-12)
                assert now["C.normal_force"] + now["D.normal_force"] == pytest.approx(mass * G)
            assert result.balance.relative < 1e-11


def test_a_block_that_stops_over_the_joint_rests_there() -> None:
    """Whatever of it stands on which: it comes to rest with its middle 1 cm beside the joint."""
    model = frot.compile(
        TABLES.format(two=TWO, high=0.2, first=ORDERS["mixed"][0], second=ORDERS["mixed"][1])
    )
    for stands in (0.99, 1.0, 1.01, 1.15, 1.25):
        speed = math.sqrt(2 * 0.3 * G * (stands + 0.5))
        for tolerance in (1e-4, 1e-8, 1e-12):
            result = model.simulate(tolerance=tolerance, parameters={"v": speed, "mu": 0.3})
            now = result.at(3.0)
            assert now["b.position.x"] == pytest.approx(stands, abs=1e-11)
            assert now["b.velocity.x"] == 0
            assert now["C.normal_force"] + now["D.normal_force"] == pytest.approx(2 * G)


BRICKS = """planar model Bricks
  parameter Real mu = 0.4;
  parameter Force F = 4 N;
  body one: box(mass = 3 kg, size = (1, 0.3) m);
  body two: box(mass = 3 kg, size = (1, 0.3) m);
  body b: box(mass = 1 kg, size = (0.4, 0.2) m);
  liaison A: appui_faces(one.bottom, ground.line) with coulomb(0.6);
  liaison B: appui_faces(two.bottom, ground.line) with coulomb(0.6);
  liaison N: {touch};
  liaison C: appui_faces(b.bottom, one.top) with coulomb(mu);
  liaison D: appui_faces(b.bottom, two.top) with coulomb(mu);
  force pull: on(b, value = (F, 0 N));
initial
  one.position = (0, 0.15) m; two.position = (1, 0.15) m;
  b.position = (-0.2, 0.4) m;
  experiment(stop = 1.5 s, tolerance = 1e-8);
end Bricks;"""


@pytest.mark.parametrize(
    "touch",
    ["appui_faces(one.right, two.left) with coulomb(0.2)", "appui_faces(two.left, one.right)"],
)
def test_a_brick_is_pulled_from_one_brick_onto_the_next(touch: str) -> None:
    """These stand on rough ground and touch: what they carry is shared in ever other ways."""
    model = frot.compile(BRICKS.format(touch=touch))
    for force, mu in ((6.0, 0.4), (4.5, 0.4), (3.0, 0.1)):
        pull = force - mu * G
        t = 0.9 * min(1.5, math.sqrt(2.4 / pull))
        for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
            result = model.simulate(tolerance=tolerance, parameters={"F": force, "mu": mu})
            now = result.at(t)
            assert now["b.position.x"] == pytest.approx(pull * t**2 / 2 - 0.2, abs=1e-12)
            assert now["b.angle"] == pytest.approx(0, abs=1e-12)
            assert now["one.velocity.x"] == now["two.velocity.x"] == 0
            assert result.balance.relative < 1e-10


WHEEL = """planar model Wheel
  parameter Velocity v = 1 m/s;
  parameter AngularVelocity w = 0 rad/s;
  parameter Length x = 0.3 m;
  parameter Real mu = 0.3;
  body d: {shape}(mass = 3 kg, radius = 0.2 m);
  {two}
  liaison C: contact_ponctuel({first}) with coulomb(mu);
  liaison D: contact_ponctuel({second}) with coulomb(mu);
initial
  d.position = (x, 0.45 m);
  d.velocity.x = v;
  d.angular_velocity = w;
  experiment(stop = 1 s, tolerance = 1e-8);
end Wheel;"""


def rolled(share: float, speed: float, spin: float, mu: float) -> float:
    """The way of a wheel in 1 s: it slides until it rolls; `share` is its inertia over m r^2."""
    slip, brake = speed + 0.2 * spin, mu * G
    lasts = min(1.0, abs(slip) / (brake * (1 + 1 / share))) if brake > 0 else 1.0
    pull = -math.copysign(brake, slip)
    return speed + pull * lasts * (1 - lasts / 2)


@pytest.mark.parametrize(("shape", "share"), [("disc", 0.5), ("ring", 1.0)])
@pytest.mark.parametrize(
    "order", [("d.rim, one.top", "two.top, d.rim"), ("one.top, d.rim", "d.rim, two.top")]
)
def test_a_wheel_goes_over_the_joint_of_two_tables(
    shape: str, share: float, order: tuple[str, str]
) -> None:
    """The edge of the table ahead comes to its rim along it: it touches, and meets nothing."""
    model = frot.compile(WHEEL.format(two=TWO, shape=shape, first=order[0], second=order[1]))
    for speed, spin, mu, x in (
        (1.0, -5.0, 0.3, 0.3),
        (1.0, 2.0, 0.0, 0.3),
        (2.0, 0.0, 0.3, 0.3),
        (-1.5, 0.0, 0.2, 1.9),
        (-1.0, 5.0, 0.4, 1.5),
        (0.9, 40.0, 0.5, 0.6),
    ):
        for tolerance in (1e-3, 1e-5, 1e-7, 1e-9, 1e-12):
            result = model.simulate(
                tolerance=tolerance, parameters={"v": speed, "w": spin, "mu": mu, "x": x}
            )
            now = result.at(1.0)
            assert now["d.position.x"] == pytest.approx(
                x + rolled(share, speed, spin, mu), abs=1e-11
            )
            assert now["d.position.y"] == pytest.approx(0.45, abs=1e-12)
            assert now["C.normal_force"] + now["D.normal_force"] == pytest.approx(3 * G)
            assert result.balance.relative < 1e-11
