"""Bodies that fall, bounce and come to rest, against closed forms."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest

import frot

G = 9.81

BALL = """planar model Ball
  parameter Real e = 0.8;
  parameter Real mu = 0.3;
  parameter Mass m = 1 kg;
  parameter Angle slope = 0 rad;
  parameter Velocity vx = 0 m/s;
  body b: particle(mass = m);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(slope), -sin(slope)));
  liaison c: contact_ponctuel(floor, b) with coulomb(mu), restitution(e);
initial
  b.position = (sin(slope)*1 m, cos(slope)*1 m);
  b.velocity = (vx, 0 m/s);
  experiment(stop = 8 s, tolerance = 1e-10);
end Ball;
"""


def limit(e: float, slope: float = 0.0, height: float = 1.0) -> float:
    """The instant at which the bounces of a ball dropped at rest have ended."""
    g = G * math.cos(slope)
    return math.sqrt(2 * height / g) * (1 + e) / (1 - e)


@pytest.fixture(scope="module")
def ball() -> frot.Model:
    return frot.compile(BALL)


@pytest.mark.parametrize("m", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("e", [0.3, 0.8])
def test_a_ball_rests_at_its_limit_time_and_stays_there(
    ball: frot.Model, e: float, m: float
) -> None:
    result = ball.simulate(parameters={"e": e, "m": m}, tolerance=1e-13)
    impacts = [x for x in result.events if x.kind.endswith("impact")]
    for k, one in enumerate(impacts[:-1]):
        speed = math.sqrt(2 * G) * e**k
        before = math.sqrt(2 / G) * (1 + 2 * sum(e**j for j in range(1, k + 1)))
        assert one.time == pytest.approx(before, abs=1e-10)
        assert one.impulse == pytest.approx(m * (1 + e) * speed, rel=1e-5)
        assert one.energy_lost == pytest.approx(m * (1 - e * e) * speed**2 / 2, rel=1e-5)
    assert impacts[-1].kind == "last_impact"
    assert impacts[-1].until == pytest.approx(limit(e), abs=1e-9)
    assert result.events[-1].kind == "contact"
    assert result.events[-1].time == pytest.approx(limit(e), abs=1e-9)
    assert result["b.velocity.y"][-1] == 0
    assert abs(result["b.position.y"][-1]) < 1e-8
    assert result["c.normal_force"][-1] == pytest.approx(m * G, rel=1e-12)
    assert result.balance.relative < 1e-8


@pytest.mark.parametrize("slope", [0.2, 0.5, -0.7])
def test_a_ball_on_a_slope_slides_on(ball: frot.Model, slope: float) -> None:
    """Friction of all impulses together is mu times the weight across, as in contact."""
    mu, e = 0.1, 0.6
    result = ball.simulate(parameters={"e": e, "mu": mu, "slope": slope}, tolerance=1e-13)
    g, across = G * math.sin(slope), G * math.cos(slope)
    assert result.events[-1].time == pytest.approx(limit(e, slope), abs=1e-9)
    way = math.copysign(1, slope)
    speed = g * 8 - way * mu * across * 8
    along = result["b.velocity.x"][-1] * math.cos(slope)
    along -= result["b.velocity.y"][-1] * math.sin(slope)
    assert along == pytest.approx(speed, rel=1e-10)


def test_the_error_of_impacts_follows_the_tolerance(ball: frot.Model) -> None:
    """Of the time of the fifth impact, on a slope, with a drag that makes flights no parabolas."""
    text = BALL.replace("initial", "  force air: drag(b, c = 0.3 kg/s, exponent = 1);\ninitial", 1)
    model = frot.compile(text)
    times = []
    tolerances = (1e-4, 1e-6, 1e-8, 1e-10, 1e-13)
    for tolerance in tolerances:
        events = model.simulate(tolerance=tolerance, stop=3.0).events
        times.append([e.time for e in events if e.kind == "impact"][4])
    for tolerance, time in zip(tolerances[:-1], times[:-1], strict=True):
        assert abs(time - times[-1]) <= 10 * tolerance


ROCKING = """planar model Rocking
  parameter Length wide = 0.2 m;
  parameter Length high = 0.6 m;
  parameter Mass m = 1 kg;
  body b: box(mass = m, size = (wide, high));
  liaison floor: appui_faces(b.bottom, ground.line) with coulomb(3);
initial
  guess(b.position = (0, 0.31) m);
  b.angle = 0.1;
  floor.gap = 0 m;
  b.velocity.x = 0 m/s;
  b.angular_velocity = 0 rad/s;
  experiment(stop = 6 s, tolerance = 1e-11);
end Rocking;
"""


@pytest.mark.parametrize("m", [1.0, 1e6])
def test_each_blow_of_a_rocking_block_takes_its_part(m: float) -> None:
    """G. Housner 1963: the angular momentum about the other corner is kept,
    r = w'/w = 1 - 3/2 sin^2 a, tan a = wide/high; then the block stands."""
    result = frot.compile(ROCKING).simulate(parameters={"m": m})
    ratio = 1 - 1.5 * 0.2**2 / (0.2**2 + 0.6**2)
    blows = [e for e in result.events if e.kind == "impact"]
    assert len(blows) > 20
    for first, second in itertools.pairwise(blows[:11]):
        assert {first.liaison, second.liaison} == {"floor[1]", "floor[2]"}
        # energy before the second blow is that after the first
        lost = second.energy_lost / first.energy_lost
        assert lost == pytest.approx(ratio**2, rel=1e-8)
    energy = m * G * (0.5 * math.hypot(0.2, 0.6) * math.cos(math.atan2(0.2, 0.6) - 0.1) - 0.3)
    assert blows[0].energy_lost == pytest.approx((1 - ratio**2) * energy, rel=1e-10)
    assert result["b.angular_velocity"][-1] == 0
    assert abs(result["b.angle"][-1]) < 1e-8
    assert [e.kind for e in result.events[-2:]][-1] == "contact"


def test_a_ball_on_a_plate_that_moves() -> None:
    """It meets the plate with the relative speed."""
    text = """planar model Plate
      body b: particle(mass = 2 kg);
      curve plate on ground: line(through = (0 m, 0.02 m*sin(20*time/(1 s))), direction = (1, 0));
      liaison c: contact_ponctuel(plate, b) with restitution(0.5);
    initial
      b.position = (0, 0.5) m;
      experiment(stop = 3 s, tolerance = 1e-11);
    end Plate;"""
    result = frot.compile(text).simulate()
    first = next(e for e in result.events if e.kind == "impact")
    t = first.time
    assert 0.5 - G / 2 * t * t == pytest.approx(0.02 * math.sin(20 * t), abs=1e-11)
    approach = G * t + 0.4 * math.cos(20 * t)
    assert first.impulse == pytest.approx(2 * 1.5 * approach, rel=1e-9)


SPACE = """model Billiard
  parameter Real mu = 0.2;
  parameter Real e = 0.9;
  body b: sphere(mass = 0.17 kg, radius = 0.028 m);
  liaison c: contact_ponctuel(ground.plane, b.surface) with coulomb(mu), restitution(e);
initial
  b.position = (0 m, 0 m, 0.028 m);
  b.velocity = (1.5, -0.5, -2) m/s;
  b.angular_velocity = (30, 10, 5) rad/s;
  experiment(stop = 0.3 s, tolerance = 1e-11);
end Billiard;
"""


@pytest.mark.parametrize("mu", [0.02, 0.2, 1.0])
def test_a_billiard_ball_is_thrown_against_the_table_with_spin(mu: float) -> None:
    """The slip s = v + w x (-r n) keeps its direction; it loses 7/2 mu (1 + e) of the speed of
    approach, or ends."""
    result = frot.compile(SPACE).simulate(parameters={"mu": mu})
    first = result.events[0]
    assert (first.kind, first.time) == ("impact", 0.0)
    r, m, e = 0.028, 0.17, 0.9
    slip = np.array([1.5 - 10 * r, -0.5 + 30 * r])
    size = np.hypot(*slip)
    impulse = min(mu * (1 + e) * 2 * m, size * m / 3.5)
    velocity = np.array([1.5, -0.5]) - impulse / m * slip / size
    at = result.at(1e-9)
    assert at["b.velocity.x"] == pytest.approx(velocity[0], abs=1e-12)
    assert at["b.velocity.y"] == pytest.approx(velocity[1], abs=1e-12)
    assert at["b.velocity.z"] == pytest.approx(2 * e, abs=1e-7)
    assert at["b.angular_velocity.z"] == pytest.approx(5, abs=1e-12)
    assert result.balance.relative < 1e-9


def test_a_chain_hits_a_wall() -> None:
    """Impulses reach through smooth joints: the wall alone changes the momentum about the hinge,
    and the tip leaves with e times its speed."""
    text = """planar model Chain
      world(gravity = 0 m/s^2);
      body r: rod(mass = 1 kg, length = 1 m);
      body s: rod(mass = 2 kg, length = 0.5 m);
      liaison h: rotoide(ground, r.start);
      liaison k: rotoide(r.tip, s.start);
      curve wall on ground: line(through = (1.2, 0) m, direction = (0, 1));
      liaison c: contact_ponctuel(wall, s.tip) with restitution(0.6);
    initial
      r.angle = -90 deg; s.angle = -60 deg;
      r.angular_velocity = 2 rad/s; s.angular_velocity = 2 rad/s;
      experiment(stop = 1.5 s, tolerance = 1e-11);
    end Chain;"""
    model = frot.compile(text)
    result = model.simulate()
    hit = next(e for e in result.events if e.kind == "impact")
    t = hit.time
    before, after = result.at(t - 1e-9), result.at(t + 1e-9)
    speeds = [
        x["s.velocity.x"] - 0.25 * math.sin(x["s.angle"]) * x["s.angular_velocity"]
        for x in (before, after)
    ]
    assert speeds[1] == pytest.approx(-0.6 * speeds[0], rel=1e-6)

    def momentum(x: dict[str, float]) -> float:
        """About the hinge."""
        sum_ = x["r.angular_velocity"] * 1 / 3 + 2 * 0.25 / 12 * x["s.angular_velocity"]
        return sum_ + 2 * (
            x["s.position.x"] * x["s.velocity.y"] - x["s.position.y"] * x["s.velocity.x"]
        )

    tip = before["s.position.y"] + 0.25 * math.sin(before["s.angle"])
    gained = momentum(after) - momentum(before)
    assert abs(gained) == pytest.approx(abs(hit.impulse * tip), rel=1e-6)
    assert result.balance.relative < 1e-9


def test_a_thread_comes_taut() -> None:
    """A ball on a slack thread: the speed along it is lost, that across is kept."""
    text = """planar model Taut
      body b: particle(mass = 1.5 kg);
      liaison t: fil(ground, b, length = 1 m) with restitution(0.25);
    initial
      b.position = (0.6, 0) m;
      experiment(stop = 0.6 s, tolerance = 1e-11);
    end Taut;"""
    result = frot.compile(text).simulate()
    hit = next(e for e in result.events if e.kind == "impact")
    assert hit.time == pytest.approx(math.sqrt(2 * 0.8 / G), rel=1e-11)
    speed = G * hit.time
    assert hit.impulse == pytest.approx(1.5 * 1.25 * 0.8 * speed, rel=1e-9)
    assert hit.energy_lost == pytest.approx(0.75 * (1 - 0.25**2) * (0.8 * speed) ** 2, rel=1e-9)


@pytest.mark.parametrize("e", ["1.2", "-0.1"])
def test_a_coefficient_beyond_its_bounds_is_refused(e: str) -> None:
    with pytest.raises(frot.FrotError, match=r"error.E040[12].: e must"):
        frot.compile(BALL.replace("restitution(e)", f"restitution({e})"))


@pytest.mark.parametrize("e", [1.2, -0.1])
def test_a_coefficient_set_beyond_its_bounds_is_refused(ball: frot.Model, e: float) -> None:
    with pytest.raises(frot.FrotError, match="e of liaison 'c'"):
        ball.simulate(parameters={"e": e})


def test_restitution_of_what_cannot_part_is_refused() -> None:
    with pytest.raises(frot.FrotError, match="cannot part"):
        frot.compile(BALL.replace("(floor, b)", "(floor, b, unilateral = false)")).simulate()


def test_json_has_the_numbers_of_an_impact(ball: frot.Model, tmp_path: Path) -> None:
    result = ball.simulate(stop=1.0)
    result.save(tmp_path / "ball.json")
    (event,) = json.loads((tmp_path / "ball.json").read_text(encoding="utf-8"))["events"]
    (found,) = result.events
    assert event["impulse"] == found.impulse > 0
    assert event["energy_lost"] == found.energy_lost > 0
    assert (event["contacts"], event["phases"], event["text"]) == (1, 2, found.text)
