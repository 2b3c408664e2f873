"""Cylinders and rods side by side: where they are parallel, rims and ends carry them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import frot

G = 9.81
# Bodies of radius 0.1 m, the lower one fixed. The upper one starts at an angle about the axis of
# the lower one, both turned with gravity.
TEXT = """
model Logs
  parameter Mass m = 2 kg;
  parameter Angle tilt = 0;
  parameter Angle angle = 0.2;
  parameter Angle yaw = 0;
  parameter Angle pitch = 0;
  parameter Length apart = 0.2 m;
  parameter Velocity v = 0 m/s;
  parameter AngularVelocity spin = 0 1/s;
  world(gravity = 9.81 m/s^2, down = (-sin(tilt), 0, -cos(tilt)));
  frame f on ground at (1, 2, 3) m rotated(axis = y, angle = tilt);
  frame fa on f at (0, 0, 0) m rotated(axis = x, angle = 90 deg);
  frame fy on f at (apart*sin(angle), 0 m, apart*cos(angle)) rotated(axis = z, angle = yaw);
  frame fp on fy at (0, 0, 0) m rotated(axis = x, angle = pitch);
  frame fb on fp at (0, 0, 0) m rotated(axis = x, angle = 90 deg);
  body a: {lower};
  body b: {upper};
  liaison w: encastrement(fa, a);
  liaison c: contact_ponctuel({places}) {law};
initial
  b.position = fb.position;
  b.orientation = fb.orientation;
  b.velocity = v*f.ey;
  b.angular_velocity = spin*f.ez;
  experiment(stop = 0.6 s, tolerance = 1e-10);
end Logs;
"""
LOWER = "cylinder(mass = 1 kg, radius = 0.1 m, length = 1 m)"
UPPER = "cylinder(mass = m, radius = 0.1 m, length = 0.6 m)"
ROD = "rod(mass = m, length = 0.6 m)"


def model(lower: str = LOWER, upper: str = UPPER, places: str = "", law: str = "") -> frot.Model:
    places = places or "a.side, b.side"
    return frot.compile(TEXT.format(lower=lower, upper=upper, places=places, law=law))


@pytest.fixture(scope="module")
def smooth() -> frot.Model:
    return model()


@pytest.fixture(scope="module")
def rough() -> frot.Model:
    return model(law="with coulomb(0.3)")


def slides_off(angle: float, radius: float) -> float:
    """The time from rest until a smooth thing leaves a circle: where cos a = 2/3 cos a0."""
    last = math.acos(2 / 3 * math.cos(angle))

    def pace(s: float) -> float:  # a = a0 + s^2 takes the root of the start away
        a = angle + s * s
        drop = 2 * math.sin((a + angle) / 2) * math.sin(s * s / 2)
        return 2 * s * math.sqrt(radius / (2 * G * drop)) if s else 0.0

    way, _ = quad(pace, 1e-9, math.sqrt(last - angle), epsabs=1e-13)
    return way + 2e-9 * math.sqrt(radius / (2 * G * math.sin(angle)))


@pytest.mark.parametrize(
    ("angle", "tilt", "mass"), [(0.2, 0, 2), (-0.4, 0.9, 2e6), (0.6, -2.5, 2e-6)]
)
def test_a_log_slides_off_a_log(smooth: frot.Model, angle: float, tilt: float, mass: float) -> None:
    """It leaves where its weight no longer presses; both rims at once."""
    given = {"angle": angle, "tilt": tilt, "m": f"{mass} kg"}
    result = smooth.simulate(parameters=given)
    assert [(e.liaison, e.after) for e in result.events] == [("c[4]", "open"), ("c[5]", "open")]
    expected = slides_off(abs(angle), 0.2)
    assert [e.time for e in result.events] == pytest.approx([expected] * 2, abs=1e-8)
    assert result["c.normal_force"][0] == pytest.approx(mass * G * math.cos(angle), rel=1e-9)


@pytest.mark.parametrize(
    ("lower", "upper", "places", "apart"),
    [
        (LOWER, ROD, "b.axis, a.side", 0.1),
        ("rod(mass = 1 kg, length = 1 m)", UPPER, "b.side, a.axis", 0.1),
        (LOWER, UPPER, "b.side, s", 0.3),
    ],
)
def test_parallel_rods_and_cylinders_slide_off_each_other(
    lower: str, upper: str, places: str, apart: float
) -> None:
    """As a log off a log, at the distance of their axes; also off a cylinder of the text."""
    text = TEXT.replace("liaison w", "surface s on fa: cylinder(0.2 m, axis = z);\n  liaison w")
    for name, shape in (("fa on f", lower), ("fb on fp", upper)):
        if "rod" in shape:  # it lies along x
            lying = f"{name} at (0, 0, 0) m rotated(axis = "
            text = text.replace(lying + "x", lying + "z")
    text = text.format(lower=lower, upper=upper, places=places, law="")
    result = frot.compile(text).simulate(parameters={"apart": f"{apart} m", "angle": 0.3})
    expected = slides_off(0.3, apart)
    assert [e.time for e in result.events] == pytest.approx([expected] * 2, abs=1e-8)


@pytest.mark.parametrize(("angle", "tilt"), [(0.15, 0.0), (-0.15, 0.7)])
def test_a_log_rolls_round_a_log_until_it_slips(
    rough: frot.Model, angle: float, tilt: float
) -> None:
    """It slips where (g sin a)/3 = mu (g cos a - v^2/R), v^2 = 4/3 g R (cos a0 - cos a)."""
    given = {"angle": angle, "tilt": tilt, "v": 0, "m": "7 kg"}
    result = rough.simulate(parameters=given)
    first, size = abs(angle), 0.2

    def square(a: float) -> float:
        return 4 / 3 * G * size * 2 * math.sin((a + first) / 2) * math.sin((a - first) / 2)

    def missing(a: float) -> float:
        return G * math.sin(a) / 3 - 0.3 * (G * math.cos(a) - square(a) / size)

    last = brentq(missing, first, 1.2, xtol=1e-15)
    way, _ = quad(lambda s: 2 * s * size / math.sqrt(square(first + s * s)), 1e-9,
                  math.sqrt(last - first), epsabs=1e-13)  # fmt: skip
    way += 2e-9 * size / math.sqrt(4 / 3 * G * size * math.sin(first))
    slips = [e.time for e in result.events if (e.before, e.after) == ("stick", "slip")]
    assert slips == pytest.approx([way] * 2, abs=1e-8)


def test_a_log_rolls_to_and_fro_in_a_pipe() -> None:
    """Smooth: a pendulum as long as the difference of the radii."""
    text = TEXT.replace("liaison w", "surface s on f: cylinder(0.5 m, axis = y);\n  liaison w")
    text = text.format(lower=LOWER, upper=UPPER, places="b.side, s", law="")
    given = {"angle": math.pi - 0.3, "apart": "0.4 m"}
    result = frot.compile(text).simulate(parameters=given)
    x, z = result["b.position.x"] - 1, result["b.position.z"] - 3
    assert np.hypot(x, z) == pytest.approx(0.4, abs=1e-9)
    energy = result["b.kinetic_energy"] + 2 * G * z
    assert np.ptp(energy) < 1e-8
    assert x.min() < -0.11


@pytest.mark.parametrize("mass", [1, 1e6])
def test_a_log_lands_on_a_log_and_rests(rough: frot.Model, mass: float) -> None:
    """It loses all of its speed, and presses with its weight."""
    given = {"angle": 0, "apart": "0.35 m", "m": f"{mass} kg", "tilt": 0.4}
    result = rough.simulate(parameters=given)
    fall = math.sqrt(2 * 0.15 / G)
    assert {e.time for e in result.events} == {result.events[0].time}
    assert result.events[0].time == pytest.approx(fall, abs=1e-11)
    assert sum(e.energy_lost for e in result.events) == pytest.approx(mass * G * 0.15, rel=1e-9)
    assert result["c.normal_force"][-1] == pytest.approx(mass * G, rel=1e-9)
    assert result["c.gap"].min() > -1e-12


def test_a_log_bounces_on_a_log_without_loss() -> None:
    given = {"angle": 0, "apart": "0.3 m"}
    result = model(law="with restitution(1)").simulate(parameters=given)
    energy = result["b.kinetic_energy"] + 2 * G * result["b.position.z"]
    assert np.ptp(energy) < 1e-9
    fall = math.sqrt(0.2 / G)
    times = sorted({round(e.time, 9) for e in result.events})
    assert times == pytest.approx([fall, 3 * fall], abs=1e-9)


def test_a_log_slides_along_a_log_and_tips_over_its_end(smooth: frot.Model) -> None:
    """Its first rim passes the end of the lower log, which carries it there; then it tips."""
    result = smooth.simulate(parameters={"angle": 0, "v": "1 m/s"})
    assert [e.liaison for e in result.events] == ["c[2]", "c[4]", "c[5]"]
    times = [e.time for e in result.events]
    assert times == pytest.approx([0.2, 0.2, 0.5], abs=1e-9)


@pytest.mark.parametrize("spin", [0.3, -2, 10])
def test_a_log_that_turns_on_a_log_crosses_it(smooth: frot.Model, spin: float) -> None:
    """Two rims carry it, then the place where the sides cross: it keeps turning, level."""
    result = smooth.simulate(parameters={"angle": 0, "spin": f"{spin} 1/s"})
    assert result["b.angular_velocity.z"][-1] == pytest.approx(spin, rel=1e-7)
    assert result["b.position.z"] == pytest.approx(3.2, abs=1e-9)
    assert result["c.normal_force"][-1] == pytest.approx(2 * G, rel=1e-6)


@pytest.mark.parametrize("pitch", [0.4, -0.2])
def test_a_log_falls_with_a_rim_first_onto_a_log(smooth: frot.Model, pitch: float) -> None:
    """The lowest point of the rim is l/2 sin p + r cos p below the middle."""
    given = {"angle": 0, "apart": "0.4 m", "pitch": pitch}
    result = smooth.simulate(parameters=given)
    below = 0.3 * math.sin(abs(pitch)) + 0.1 * math.cos(pitch)
    assert result.events[0].time == pytest.approx(math.sqrt(2 * (0.3 - below) / G), abs=1e-10)
    assert result.events[0].liaison == ("c[5]" if pitch > 0 else "c[4]")
    assert result["c.gap"].min() > -1e-9


FACES = """
model Lands
  body t: {lower};
  frame f on ground at (0, 0, 0) m rotated(axis = x, angle = 90 deg);
  surface s on ground: {endless};
  body b: {upper};
  {curve}
  liaison w: encastrement({base}, t);
  liaison c: contact_ponctuel({place}, {on}) with coulomb(0.2);
initial
  b.position = (0.02, 0.1, 0.45) m;
  b.orientation = (cos(0.3), 0, 0, sin(0.3));
  b.velocity = (0, {speed}, 0) m/s;
  experiment(stop = 0.8 s, tolerance = 1e-10);
end Lands;
"""
EGG = "ellipsoid(mass = 1 kg, semi_axes = (0.1, 0.2, 0.15) m)"
BOWL = "curve k on b: parametric((u, 0.2*u, u^2/2 m), u = (-0.3 m, 0.3 m));"


@pytest.mark.parametrize(
    ("lower", "endless", "base", "side", "place", "curve"),
    [
        ("cylinder(mass = 1 kg, radius = 0.2 m, length = 1 m)",
         "cylinder(radius = 0.2 m, axis = (0, 1, 0))", "f", "t.side", "b.surface", ""),
        ("box(mass = 1 kg, size = (1, 1, 0.2) m)",
         "plane(through = (0, 0, 0.1) m, normal = (0, 0, 1))", "ground", "t.top", "k", BOWL),
    ],
)  # fmt: skip
def test_what_lands_within_the_ends_moves_as_without_ends(
    lower: str, endless: str, base: str, side: str, place: str, curve: str
) -> None:
    """An ellipsoid on a side, a curve on a face."""
    given = {"lower": lower, "endless": endless, "base": base, "place": place, "curve": curve}
    ends, without = (
        frot.compile(FACES.format(**given, upper=EGG, on=on, speed=0.2)).simulate()
        for on in (side, "s")
    )
    assert len(ends.events) >= 2
    one, other = ([e.time for e in x.events] for x in (ends, without))
    assert one == pytest.approx(other, abs=1e-8)
    for name in ("x", "y", "z"):
        one, other = (x[f"b.position.{name}"] for x in (ends, without))
        assert one == pytest.approx(other, abs=1e-7)


def test_an_ellipsoid_that_falls_beside_a_side_falls_on() -> None:
    text = FACES.format(
        lower="cylinder(mass = 1 kg, radius = 0.2 m, length = 1 m)", base="f", curve="",
        endless="plane(through = (0, 0, 0) m, normal = (0, 0, 1))", upper=EGG, place="b.surface",
        on="t.side", speed=4,
    )  # fmt: skip
    result = frot.compile(text).simulate()
    assert not result.events
    assert result["b.position.z"][-1] == pytest.approx(0.45 - G * 0.32, abs=1e-9)
