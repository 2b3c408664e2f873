"""The direction of gravity as a vector: of any length, of numbers or of parameters."""

import math

import numpy as np
import pytest

import frot

G = 9.81
SLIDE = """
planar model Slide "A block on a level line under a gravity that leans: the slope of a table"
  parameter Angle slope = 30 deg;
  parameter Real mu = 0.2;
  world(down = {down});
  body b: particle(mass = 2 kg);
  liaison c: contact_ponctuel(ground.line, b) with coulomb(mu);
initial
  b.position = (0, 0) m;
  b.velocity.x = {start} m/s;
  experiment(stop = 1 s, tolerance = 1e-10);
end Slide;
"""
LEANING = "(sin(slope), -cos(slope))"


@pytest.mark.parametrize("slope", [-70.0, -12.0, 0.0, 11.0, 30.0, 80.0])
@pytest.mark.parametrize("start", [-3.0, 0.0, 2.0])
def test_a_slope_is_a_gravity_that_leans(slope: float, start: float) -> None:
    """With slip v the acceleration along the line is g (sin - sign(v) mu cos)."""
    result = frot.compile(SLIDE.format(down=LEANING, start=start)).simulate(
        parameters={"slope": f"{slope} deg"}
    )
    s, c = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    v, t = start, 0.0
    if v != 0:
        rate = G * (s - math.copysign(0.2, v) * c)
        stops = -v / rate if rate * v < 0 else math.inf
        t = min(stops, 1.0)
        v = v + rate * t if stops > 1 else 0.0
    if t < 1 and abs(s) > 0.2 * c:
        v += G * (s - math.copysign(0.2, s) * c) * (1 - t)
    assert result["b.velocity.x"][-1] == pytest.approx(v, abs=1e-8)
    assert np.allclose(result["c.normal_force"], 2 * G * c, rtol=1e-12)


@pytest.mark.parametrize("length", [1e-6, 1.0, 5.0, 1e6])
def test_only_the_direction_counts(length: float) -> None:
    down = f"({0.6 * length!r}, {-0.8 * length!r})"
    result = frot.compile(SLIDE.format(down=down, start=1)).simulate()
    assert result["b.velocity.x"][-1] == pytest.approx(1 + G * (0.6 - 0.2 * 0.8), rel=1e-9)


def test_a_vector_along_an_axis_is_that_axis_to_the_last_bit() -> None:
    named, vector = (frot.compile(SLIDE.format(down=d, start=3)) for d in ("-y", "(0, -2)"))
    one, other = named.simulate(), vector.simulate()
    assert all(np.array_equal(one[name], other[name]) for name in one)


def test_a_body_falls_along_it_in_space() -> None:
    result = frot.compile("""
model Fall
  constant Real way[3] = (2, -3, 6);
  world(gravity = 7 m/s^2, down = way);
  body b: sphere(mass = 3 kg, radius = 1 m);
  experiment(stop = 2 s);
end Fall;
""").simulate()
    for axis, part in zip("xyz", (2, -3, 6), strict=True):
        assert result[f"b.position.{axis}"][-1] == pytest.approx(part * 2.0, rel=1e-12)
    assert result.balance.relative < 1e-12


def test_a_tilted_world_is_a_turned_one() -> None:
    """A pendulum of any plane through the leaning vertical has the period of one at rest."""
    text = """
model Pendulum
  world(down = {down});
  body rod: rod(mass = 1 kg, length = 1 m);
  liaison pin: rotoide(ground, rod.start, axis = {axis});
initial
  pin.angle = {angle};
  pin.speed = 0.3 rad/s;
  experiment(stop = 5 s, tolerance = 1e-11);
end Pendulum;
"""
    upright = text.format(down="-z", axis="y", angle="90 deg - 0.2 rad")
    leaning = text.format(down="(0.6, 0, -0.8)", axis="y", angle="90 deg - 0.2 rad - asin(0.6)")
    one, other = (frot.compile(x).simulate() for x in (upright, leaning))
    assert np.allclose(one["pin.speed"], other["pin.speed"], atol=1e-8)


def test_parts_of_one_world_may_say_it_in_two_ways() -> None:
    part = "planar model Part\n world(down = {down});\n body p: particle(mass = 1 kg);\nend Part;\n"
    whole = "planar model Whole\n  world(down = -y);\n  Part part;\nend Whole;\n"
    frot.compile(part.format(down="(0, -3)") + whole, model="Whole").simulate()
    with pytest.raises(frot.FrotError, match="E0521"):
        frot.compile(part.format(down="(0, 3)") + whole, model="Whole")


@pytest.mark.parametrize(
    ("down", "code"),
    [
        ("(0, 0)", "E0401"),
        ("(time/(1 s), -1)", "E0305"),
        ("(0, -1) m", "E0301"),
        ("(0, 0, -1)", "E0301"),
        ("-z", "E0404"),
        ("south", "E0201"),
    ],
)
def test_what_is_no_direction_is_refused(down: str, code: str) -> None:
    with pytest.raises(frot.FrotError, match=code):
        frot.compile(SLIDE.format(down=down, start=0)).simulate()
