"""Bounds on coordinates of liaisons, `stops(min, max, e)`, against closed forms."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import frot

G = 9.81

SLIDE = """planar model Slide
  parameter Real e = 0.5;
  parameter Mass m = 1 kg;
  parameter Angle turn = 0 rad;
  parameter Velocity v = 2 m/s;
  body b: particle(mass = m);
  frame rail on ground at (0.3, -0.2) m rotated(angle = turn);
  liaison way: prismatique(rail, b) with stops(min = -1 m, max = 0.5 m, e = e);
  world(gravity = 0 m/s^2);
initial
  way.displacement = 0 m;
  way.speed = v;
  experiment(stop = 3 s, tolerance = 1e-10);
end Slide;
"""


@pytest.fixture(scope="module")
def slide() -> frot.Model:
    return frot.compile(SLIDE)


@pytest.mark.parametrize("m", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("turn", [0.0, 0.7, -2.1])
@pytest.mark.parametrize("v", [2.0, -3.0])
def test_a_slide_goes_to_and_fro_between_its_stops(
    slide: frot.Model, m: float, turn: float, v: float
) -> None:
    result = slide.simulate(parameters={"m": m, "turn": turn, "v": v})
    place, speed, now = 0.0, v, 0.0
    for event in result.events:
        bound = 0.5 if speed > 0 else -1.0
        now += (bound - place) / speed
        place = bound
        assert event.kind == "impact"
        assert event.liaison == f"way.stops.{'max' if speed > 0 else 'min'}"
        assert event.time == pytest.approx(now, abs=1e-12)
        assert event.impulse == pytest.approx(1.5 * m * abs(speed), rel=1e-12)
        assert event.energy_lost == pytest.approx(0.375 * m * speed**2, rel=1e-12)
        speed *= -0.5
    assert len(result.events) == 2
    assert result["way.displacement"][-1] == pytest.approx(place + speed * (3 - now), abs=1e-12)


PENDULUM = """{head}
  parameter Real e = 0.6;
  parameter Mass m = 1 kg;
  body b: rod(length = 0.8 m, mass = m);
  liaison hinge: rotoide(ground, b.start{axis}) with stops(min = -1.2 rad, max = 0.4 rad, e = e);
initial
  hinge.angle = 0;
  experiment(stop = 20 s, tolerance = 1e-11);
end Pendulum;
"""
PLANE = PENDULUM.format(head="planar model Pendulum", axis="")
SPACE = PENDULUM.format(
    head="model Pendulum",
    axis=", axis = (0, -1, 0)",
)


@pytest.mark.parametrize("text", [PLANE, SPACE], ids=["plane", "space"])
@pytest.mark.parametrize("m", [1e-6, 1.0, 1e6])
def test_a_pendulum_bounces_on_its_stop_and_rests_there(text: str, m: float) -> None:
    """At each impact omega' = -e omega; the reaction at rest is m g (l/2) cos(angle)."""
    model = frot.compile(text)
    result = model.simulate(parameters={"m": m})
    length, low, e = 0.8, -1.2, 0.6
    inertia = m * length**2 / 3
    impacts = [x for x in result.events if x.kind == "impact"]
    # released in the horizontal it comes to the stop with this speed
    speed = math.sqrt(2 * m * G * (length / 2) * -math.sin(low) / inertia)
    first = impacts[0]
    assert first.liaison == "hinge.stops.min"
    assert first.impulse == pytest.approx(inertia * (1 + e) * speed, rel=1e-9)
    assert first.energy_lost == pytest.approx(inertia * (1 - e * e) * speed**2 / 2, rel=1e-9)
    for one, other in itertools.pairwise(impacts[:8]):
        assert other.impulse == pytest.approx(e * one.impulse, rel=1e-8)
    assert result.events[-1].kind == "contact"
    assert result["hinge.angle"][-1] == pytest.approx(low, abs=1e-12)
    torque = result["hinge.torque.y" if text is SPACE else "hinge.torque"][-1]
    size = abs(m * G * (length / 2) * math.cos(low))
    assert abs(torque) == pytest.approx(size, rel=1e-9)


def test_a_stop_that_moves_gives_a_slide_twice_its_speed() -> None:
    """An elastic stop of speed w turns v to 2 w - v."""
    text = SLIDE.replace("max = 0.5 m", "max = 0.5 m + 0.25 m/s*time").replace(
        "stop = 3", "stop = 1"
    )
    result = frot.compile(text).simulate(parameters={"e": 1.0})
    (event,) = result.events
    assert event.time == pytest.approx(0.5 / 1.75, abs=1e-12)
    assert result["way.speed"][-1] == pytest.approx(0.5 - 2.0, abs=1e-12)


FOUR_BAR = """planar model FourBar
  body r1: rod(length = 1 m, mass = 1 kg);
  body r2: rod(length = 2 m, mass = 1 kg);
  body r3: rod(length = 1.5 m, mass = 1 kg);
  frame foot on ground at (2, 0) m;
  liaison h1: rotoide(ground, r1.start) {first};
  liaison h2: rotoide(r1.tip, r2.start);
  liaison h3: rotoide(r2.tip, r3.tip) {third};
  liaison h4: rotoide(foot, r3.start) {fourth};
  output Angle turned = r1.angle;
initial
  r1.angle = 90 deg;
  guess(r2.angle = 10 deg, r3.angle = 60 deg);
  experiment(stop = 1.5 s, tolerance = 1e-11);
end FourBar;
"""


def test_a_stop_of_a_hinge_that_closes_a_loop_is_that_of_one_that_carries() -> None:
    """Dry hinges carry first: without radius to speak of, friction moves the place of the loop."""
    stops = "with stops(min = 30 deg, max = 130 deg, e = 0.5)"
    dry = "with coulomb(0, radius = 1 mm)"
    texts = (
        FOUR_BAR.format(first="", third="", fourth=stops),
        FOUR_BAR.format(first="", third=dry, fourth=stops + ", coulomb(0, radius = 1 mm)"),
    )
    one, other = (frot.compile(text).simulate() for text in texts)
    impacts = [[x for x in r.events if "impact" in x.kind] for r in (one, other)]
    assert len(impacts[0]) == len(impacts[1]) > 0
    for a, b in zip(*impacts, strict=True):
        assert a.liaison == b.liaison
        assert a.time == pytest.approx(b.time, abs=1e-9)
        assert a.impulse == pytest.approx(b.impulse, rel=1e-7)
    assert np.allclose(one["turned"], other["turned"], atol=1e-8)


CARDAN = """model Joint
  body d: box(mass = 3 kg, size = (0.2, 0.1, 0.3) m);
  liaison car: cardan(ground, d.G, axis_a = x, axis_b = y)
    with stops(-0.2 rad, 0.5 rad, e = 1, coordinate = angle_a),
         stops(-0.3 rad, 0.4 rad, coordinate = angle_b, e = 1);
  world(gravity = 0 m/s^2);
initial
  d.angular_velocity = (1, 0.7, 0) rad/s;
  experiment(stop = 20 s, tolerance = 1e-11);
end Joint;
"""


def test_both_angles_of_a_cardan_have_stops_and_elastic_ones_keep_energy() -> None:
    result = frot.compile(CARDAN).simulate()
    names = {x.liaison for x in result.events}
    assert names == {
        f"car.stops_{angle}.{end}" for angle in ("angle_a", "angle_b") for end in ("min", "max")
    }
    energy = result["energy.kinetic"]
    assert energy[-1] == pytest.approx(energy[0], rel=1e-9)
    assert result["car.angle_a"].max() <= 0.5 + 1e-12
    assert result["car.angle_a"].min() >= -0.2 - 1e-12
    assert result["car.angle_b"].max() <= 0.4 + 1e-12
    assert result["car.angle_b"].min() >= -0.3 - 1e-12


def test_stops_are_those_of_the_coordinates_that_have_their_unit() -> None:
    text = """model Free
      body p: box(mass = 1 kg, size = (1, 1, 1) m);
      liaison a: verrou(ground, p.G, axis = z)
        with stops(-1 m, 1 m, e = 1), stops(-1 rad, 2 rad, e = 1);
      world(gravity = 0 m/s^2);
    initial
      a.displacement = 0 m;
      a.speed = 1 m/s;
      a.speed_angle = -1 rad/s;
      experiment(stop = 2.5 s);
    end Free;"""
    result = frot.compile(text).simulate()
    found = [(x.liaison, round(x.time, 10)) for x in result.events]
    assert ("a.stops_displacement.max", 1.0) in found
    assert ("a.stops_angle.min", 1.0) in found
    assert result["a.displacement"][-1] == pytest.approx(1 - 1.5, abs=1e-9)
    assert result["a.angle"][-1] == pytest.approx(-1 + 1.5, abs=1e-9)


BEAD = """planar model Bead
  body bead: particle(mass = 2 kg);
  curve ring on ground: circle(radius = 0.5 m);
  liaison on: point_courbe(bead, ring) with stops(-1 rad, 0.5 rad, e = 0.5);
  world(gravity = 0 m/s^2);
initial
  on.u = 0;
  bead.velocity = (0, 1) m/s;
  experiment(stop = 2 s, tolerance = 1e-10);
end Bead;
"""


def test_a_bead_on_a_ring_has_stops_of_its_angle() -> None:
    result = frot.compile(BEAD).simulate()
    first, second = result.events
    assert first.time == pytest.approx(0.25, abs=1e-11)
    assert first.impulse == pytest.approx(1.5 * 2 * 0.25 * 2, rel=1e-10)  # (1 + e) m r^2 omega
    assert second.time == pytest.approx(0.25 + 1.5, abs=1e-10)


CORD = """{head}model Cord
  body p: particle(mass = 1 kg);
  body q: particle(mass = 1 kg);
  liaison cord: fil(p, q, length = 1 m) with stops(0.25 m, 2 m, e = 1), restitution(1);
  world(gravity = 0 m/s^2);
initial
  p.position = ({zero}) m;
  q.position = ({place}) m;
  p.velocity = ({zero}) m/s;
  q.velocity = ({speed}) m/s;
  experiment(stop = 1.5 s, tolerance = 1e-10);
end Cord;
"""


@pytest.mark.parametrize(
    "text",
    [
        CORD.format(head="planar ", zero="0, 0", place="0.3, 0.4", speed="0.6, 0.8"),
        CORD.format(head="", zero="0, 0, 0", place="0.1, 0.1, 0.47", speed="0.2, 0.2, 0.94"),
    ],
    ids=["plane", "space"],
)
def test_the_length_of_a_cord_has_a_lower_stop(text: str) -> None:
    result = frot.compile(text).simulate()
    speed = 1.0 if "planar" in text else math.sqrt(0.2**2 * 2 + 0.94**2)
    far = 0.5 if "planar" in text else math.sqrt(0.1**2 * 2 + 0.47**2)
    times = [(1 - far) / speed, (1 - far + 0.75) / speed]
    assert [x.liaison for x in result.events] == ["cord", "cord.stops.min"]
    assert [x.time for x in result.events] == pytest.approx(times, abs=1e-11)


@pytest.mark.parametrize(
    ("law", "code", "cause"),
    [
        ("stops(0.5 m, -1 m)", "E0402", "max"),
        ("stops(-1 m, 1 m, e = 2)", "E0402", "e"),
        ("stops(-1 rad, 1 rad)", "E0301", "expected a length"),
        ("stops(-1 m, 1 m), stops(-2 m, 3 m)", "E0511", "'displacement' is bounded twice"),
        ("stops(-1 m, 1 m, coordinate = angle)", "E0511", "no coordinate 'angle'"),
        ("stops(-1 m, way.speed*1 s)", "E0701", "depends on the motion"),
        ("stops(0.2 m, 1 m)", "E0601", "way.stops.min"),
    ],
)
def test_stops_that_mean_nothing_are_refused(law: str, code: str, cause: str) -> None:
    text = SLIDE.replace("stops(min = -1 m, max = 0.5 m, e = e)", law)
    with pytest.raises(frot.FrotError) as raised:
        frot.compile(text).simulate()
    assert code in str(raised.value)
    assert cause in str(raised.value)


def test_stops_of_a_driven_coordinate_are_refused() -> None:
    text = SLIDE.replace("(rail, b)", "(rail, b) driven(displacement = 1 m*sin(time*1 rad/s))")
    text = text.replace("  way.displacement = 0 m;\n  way.speed = v;\n", "")
    with pytest.raises(frot.FrotError, match="is driven"):
        frot.compile(text).simulate()
