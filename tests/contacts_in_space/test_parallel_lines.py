"""Thin figures that meet without a common normal end the run; no step passes over them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from frot.runtime.run import SimulationError

import frot

G = 9.81
# `b` flies freely towards `a`, which is fixed in the frame f; p and the turn of b are those in f.
TEXT = """
model Meets
  parameter Angle one = 0;
  parameter Angle other = 0;
  parameter Mass m = 1 kg;
  parameter Length x = 0 m;
  parameter Length y = 0 m;
  parameter Length z = 0.5 m;
  parameter Velocity vx = 0 m/s;
  parameter Velocity vy = 0 m/s;
  parameter Velocity vz = 0 m/s;
  parameter Angle yaw = 0;
  parameter Angle pitch = 0;
  parameter Angle roll = 0;
  parameter AngularVelocity spin = 0 1/s;
  parameter Acceleration g = 9.81 m/s^2;
  frame e on ground at (1, 2, 3) m rotated(axis = x, angle = one);
  frame f on e at (0, 0, 0) m rotated(axis = y, angle = other);
  world(gravity = g, down = (-sin(other), sin(one)*cos(other), -cos(one)*cos(other)));
  frame fa on f at (0, 0, 0) m rotated(axis = x, angle = {roll});
  frame fy on f at (x, y, z) rotated(axis = z, angle = yaw);
  frame fp on fy at (0, 0, 0) m rotated(axis = y, angle = pitch);
  frame fb on fp at (0, 0, 0) m rotated(axis = x, angle = roll);
  body a: {first};
  body b: {second};
  {curves}
  liaison w: encastrement(fa, a);
  liaison c: contact_ponctuel({places}) {law};
initial
  b.position = fb.position;
  b.orientation = fb.orientation;
  b.velocity = vx*f.ex + vy*f.ey + vz*f.ez;
  b.angular_velocity = spin*f.ez;
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Meets;
"""
LONG, SHORT = "rod(mass = 1 kg, length = 1 m)", "rod(mass = m, length = 0.6 m)"
RING, HOOP = "ring(mass = 1 kg, radius = 0.1 m)", "ring(mass = m, radius = 0.1 m)"
BOX = "box(mass = m, size = (0.6, 0.2, 0.2) m)"
PLATE = "box(mass = 1 kg, size = (1, 0.2, 0.2) m)"
UP, DOWN = (
    "parametric((u, 0 m, u^2/1 m), u = (-0.3 m, 0.3 m))",
    "line(through = (0, 0, 0) m, direction = (1, 0, 0))",
)


def model(
    first: str, second: str, places: str, *, roll: str = "0", curves: str = "", law: str = ""
) -> frot.Model:
    return frot.compile(TEXT.format(
        first=first, second=second, places=places, roll=roll, curves=curves, law=law))  # fmt: skip


@pytest.fixture(scope="module")
def rods() -> frot.Model:
    return model(LONG, SHORT, "a.axis, b.axis")


@pytest.fixture(scope="module")
def rim() -> frot.Model:
    return model(RING, SHORT, "a.rim, b.axis")


def end_of(own: frot.Model, **given: object) -> tuple[float, frot.Result]:
    """The time at which the figures of c meet without a normal."""
    with pytest.raises(SimulationError, match=r"E0911.*liaison 'c': its (lines|curves|line)") as e:
        own.simulate(parameters=given)
    result = e.value.result
    assert result is not None
    return float(str(e.value).split("t = ")[1].split()[0]), result


def fall(height: float) -> float:
    return math.sqrt(2 * height / G)


H = 0.1 * math.sqrt(2)  # from the axis of a box to its edges


@pytest.mark.parametrize(
    ("first", "second", "places", "options", "given", "time"),
    [
        (LONG, SHORT, "a.axis, b.axis", {}, {}, fall(0.5)),
        (LONG, SHORT, "b.axis, a.axis", {}, {"yaw": math.pi}, fall(0.5)),
        (PLATE, BOX, "a.edges[7], b.edges[1]", {"roll": "45 deg"}, {"roll": math.pi / 4},
         fall(0.5 - 2 * H)),
        (PLATE, SHORT, "a.edges[7], b.axis", {"roll": "45 deg"}, {}, fall(0.5 - H)),
        (RING, SHORT, "k, b.axis", {"curves": f"curve k on f: {DOWN};"}, {}, fall(0.5)),
        (RING, BOX, "k, q", {"curves": f"curve k on f: {DOWN}; curve q on b: {UP};"}, {},
         fall(0.5)),
        (RING, SHORT, "a.rim, b.axis", {}, {"x": "0.03 m", "y": "0.02 m"}, fall(0.5)),
        (RING, HOOP, "a.rim, b.rim", {},
         {"x": "0.5 m", "z": "0 m", "vx": "-2 m/s", "g": "0 m/s^2"}, 0.15),
        (RING, SHORT, "a.rim, b.axis", {},
         {"x": "0.8 m", "z": "0 m", "vx": "-2 m/s", "g": "0 m/s^2"}, 0.2),
    ],
)  # fmt: skip
@pytest.mark.parametrize(("one", "other", "mass"), [(0, 0, 1), (0.7, -2.1, 1e6)])
def test_figures_that_meet_without_a_normal_end_the_run(
    first: str, second: str, places: str, options: dict[str, str], given: dict[str, object],
    time: float, one: float, other: float, mass: float,
) -> None:  # fmt: skip
    """Parallel lines, edges and curves; a line and a rim, and rims, in one plane."""
    own = model(first, second, places, **options)
    turned = given | {"one": one, "other": other, "m": f"{mass} kg"}
    found, result = end_of(own, **turned)
    assert found == pytest.approx(time, abs=1e-7)
    assert not result.events


@pytest.mark.parametrize("angle", [1e-9, -1e-12, 1e-15])
@pytest.mark.parametrize("turn", ["yaw", "pitch"])
def test_lines_that_are_parallel_to_rounding_are_parallel(
    rods: frot.Model, turn: str, angle: float
) -> None:
    found, _ = end_of(rods, **{turn: angle, "y": "1e-10 m", "x": "0.1 m"})
    assert found == pytest.approx(fall(0.5), abs=1e-8)


@pytest.mark.parametrize(("y", "x"), [(1e-6, 0), (-1e-3, 0.1), (0, 0.9), (0, -0.81)])
def test_parallel_rods_pass_beside_each_other(rods: frot.Model, y: float, x: float) -> None:
    result = rods.simulate(parameters={"y": f"{y} m", "x": f"{x} m", "one": 0.4})
    assert not result.events
    assert result["b.kinetic_energy"][-1] == pytest.approx((G * 0.5) ** 2 / 2, rel=1e-9)


@pytest.mark.parametrize("size", [1e-2, 1e-4, 1e-6, 1e-8])
def test_nearly_parallel_rods_meet_where_they_cross(rods: frot.Model, size: float) -> None:
    """Seen from above b crosses a at x. Its height there is what it falls, however it is turned."""
    rng = np.random.default_rng(5)
    for _ in range(8):
        way, x = rng.uniform(0.1, 1.45), rng.uniform(-0.18, 0.38)
        yaw, pitch = size * math.cos(way), size * math.sin(way)
        given = {"yaw": yaw, "pitch": pitch, "x": "0.1 m", "y": f"{-(x - 0.1) * math.tan(yaw)!r} m"}
        result = rods.simulate(parameters=given, stop=0.33)
        height = 0.5 - math.tan(pitch) * (x - 0.1) / math.cos(yaw)
        assert result.events[0].kind == "impact"
        assert result.events[0].time == pytest.approx(fall(height), abs=1e-10 + 1e-17 / size)


def test_random_parallel_rods_do_not_pass_through_each_other(rods: frot.Model) -> None:
    """Aimed at each other, at any speed, from any side: all end where they meet."""
    rng = np.random.default_rng(11)
    for _ in range(40):
        time, along = rng.uniform(0.1, 0.45), rng.uniform(-0.75, 0.75)
        v = rng.uniform(-3, 3, 3)
        start = np.array([along, 0, 0]) - v * time + [0, 0, G * time**2 / 2]
        given = {k: f"{float(value)!r} m" for k, value in zip("xyz", start, strict=True)}
        given |= {f"v{k}": f"{float(value)!r} m/s" for k, value in zip("xyz", v, strict=True)}
        tilt, turn = rng.uniform(-3, 3, 2)
        found, _ = end_of(rods, **given, one=float(tilt), other=float(turn))
        assert found == pytest.approx(time, abs=1e-6)


def test_rods_that_become_parallel_on_each_other_end_the_run(rods: frot.Model) -> None:
    """One lies across the other, and turns."""
    for x in ("0 m", "0.05 m"):
        found, _ = end_of(rods, x=x, z="0 m", yaw=0.5, spin="-3 1/s")
        assert found == pytest.approx(0.5 / 3, abs=1e-8)


def test_rods_that_turn_above_each_other_do_not_end_it(rods: frot.Model) -> None:
    """They become parallel while they are apart, and meet across."""
    given = {"yaw": 0.5, "spin": "-3 1/s", "x": "0.05 m", "y": "0.01 m"}
    result = rods.simulate(parameters=given)
    assert result.events[0].time == pytest.approx(fall(0.5), abs=1e-9)


@pytest.mark.parametrize("pitch", [0.1, -0.01, 1e-3, 1e-5, 1e-7])
def test_a_rod_that_falls_onto_a_ring_does_not_pass_through_it(
    rim: frot.Model, pitch: float
) -> None:
    """It meets the near side of the ring, turns about that, and the run ends where it lies flat."""
    found, result = end_of(rim, x="0.05 m", y="0.03 m", pitch=pitch)
    chord = math.sqrt(0.1**2 - 0.03**2)
    near = fall(0.5 - abs(math.tan(pitch)) * (chord + math.copysign(0.05, -pitch)))
    assert near - 1e-8 < found < near + 0.05
    for event in result.events:
        assert event.time == pytest.approx(near, abs=1e-10)
    w, x, y, z = (float(result[f"b.orientation.{k}"][-1]) for k in "wxyz")
    assert abs(2 * (x * z - w * y)) < 1e-2 + abs(pitch) * 0.2


def test_a_rod_over_one_side_of_a_ring_slides_off(rim: frot.Model) -> None:
    """Its end is within the ring: it meets one side alone, at any angle."""
    for pitch in (1e-2, 1e-4, 1e-6):
        result = rim.simulate(parameters={"x": "0.25 m", "y": "0.03 m", "pitch": pitch})
        chord = math.sqrt(0.1**2 - 0.03**2)
        height = 0.5 - math.tan(pitch) * (chord - 0.25)
        assert result.events[0].time == pytest.approx(fall(height), abs=1e-10)
        assert [e.kind for e in result.events] == ["impact", "contact", "separation"]
