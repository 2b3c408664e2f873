"""Reactions that others share, that vanish for an instant, or that act on nothing: one text."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def scenes() -> frot.Model:
    """A rod with two laws at one contact beside a smooth one; a bead on a rough rail, whose loads
    all vanish at some instants; a point where a rough rail and a smooth line meet, with a plate
    that is drawn off it; a bar that a dry pin and a rough rail lock, turned to and
    fro."""
    return frot.compile("""
planar model Shared
  world(gravity = 0 m/s^2);
  parameter Length size = 1 m;
  parameter Mass heavy = 1 kg;
  parameter Real mu = 0.5;
  parameter Real delta = 0.8;
  parameter Real bend = 0.9;
  parameter Angle turn = 0;
  parameter Angle ahead = 1.4;
  parameter Angle other = 0.05;
  parameter AngularVelocity w = 2 rad/s;
  parameter Acceleration g = 1 m/s^2;
  curve floor on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  parameter Angle slope = turn + other;
  curve wedge on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  body rod: rod(mass = heavy, length = 2*size);
  liaison smooth: contact_ponctuel(rod.tip, floor);
  liaison rough: contact_ponctuel(rod, floor) with coulomb(mu), rolling_resistance(delta*size);
  Real grows = time/(1 s);
  force pull: on(rod, value = heavy*g*grows*(cos(turn), sin(turn)));
  force press: on(rod, value = heavy*g*(sin(turn), -cos(turn)));
  force turned: couple(rod, value = -bend*heavy*g*size);
  body bead: particle(mass = heavy);
  liaison rail: point_courbe(bead, floor, unilateral = false) with coulomb(0.3);
  force shake: on(bead, value = heavy*g*sin(w*time + 0.4)*(cos(turn + ahead), sin(turn + ahead)));
  body point: particle(mass = heavy);
  body plate: particle(mass = 3*heavy);
  curve top on plate: line(through = (0, 0) m, direction = (cos(turn + 1), sin(turn + 1)));
  liaison corner: contact_ponctuel(point, floor, unilateral = false) with coulomb(0.4);
  liaison stop: contact_ponctuel(point, wedge);
  liaison touch: point_courbe(point, top, unilateral = true) with coulomb(0.1);
  force away: on(plate, value = 3*heavy*g*(sin(turn + 1), -cos(turn + 1)));
  force down: on(point, value = heavy*g*cos(w*time)*(-sin(turn), cos(turn)));
  frame pivot on ground at size*(5*cos(turn) + 2*cos(turn + 0.6), 5*sin(turn) + 2*sin(turn + 0.6));
  body bar: rod(mass = heavy, length = 2*size);
  liaison hinge: rotoide(pivot, bar.tip) with coulomb(0.3, radius = 0.05*size);
  liaison guide: point_courbe(bar.start, floor, unilateral = false) with coulomb(mu);
  force twist: couple(bar, value = heavy*g*size*sin(w*time + 0.4));
initial
  bar.angle = turn + 0.6;
  rod.position = (0, 0) m;
  rod.angle = turn;
  bead.position = 2*size*(cos(turn), sin(turn));
  point.position = (0, 0) m;
  plate.position = (0, 0) m;
  experiment(stop = 1 s, tolerance = 1e-9);
end Shared;
""")


@pytest.mark.parametrize("tolerance", [None, 1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("seed", range(24))
def test_rest_lasts_as_long_as_any_share_holds(seed: int, tolerance: float | None) -> None:
    """Of the couple the smooth tip takes s, rolling resistance the rest; n + s is the load, so that
    n - (1 - bend) <= delta n bounds n, and friction holds a pull up to mu n."""
    random = np.random.default_rng(seed)
    mu, delta = random.uniform(0.2, 0.8), random.uniform(0.3, 0.9)
    bend = random.uniform(1 - 0.9 * (1 - delta), 1)
    g, heavy, size = (
        10 ** random.uniform(-1, 1),
        10 ** random.uniform(-6, 6),
        10 ** random.uniform(-8, 8),
    )
    turn, ahead = random.uniform(-np.pi, np.pi), np.pi / 2 + random.uniform(-0.28, 0.28)
    values = {"turn": turn, "mu": mu, "delta": delta, "bend": bend, "g": g, "heavy": heavy}
    values |= {"size": size, "ahead": ahead, "w": random.uniform(5, 40)}
    values |= {"other": random.uniform(-0.1, 0.1)}
    tolerance = tolerance or 10 ** random.uniform(-11, -3)
    result = scenes().simulate(parameters=values, tolerance=tolerance)
    t = np.array([0.05, 0.31, 0.5, 0.98])
    at = result.at(t)
    ends = mu * (1 - bend) / (1 - delta)
    left = [e.time for e in result.events if e.liaison == "rough" and e.kind == "slip"]
    assert left[:1] == pytest.approx([ends], rel=1e-9)
    for name in ("bead", "point", "bar"):
        for axis in "xy":
            assert np.all(at[f"{name}.velocity.{axis}"] == 0)
    force = heavy * g * np.sin(values["w"] * t + 0.4) * np.sin(ahead)
    normal = at["rail.force.y"] * np.cos(turn) - at["rail.force.x"] * np.sin(turn)
    assert np.abs(normal) == pytest.approx(np.abs(force), rel=1e-9, abs=1e-12 * heavy * g)
    # about the pivot the rail's reaction balances the couple
    arm = -2 * size * np.array([np.cos(turn + 0.6), np.sin(turn + 0.6)])
    moment = arm[0] * at["guide.force.y"] - arm[1] * at["guide.force.x"]
    twist = heavy * g * size * np.sin(values["w"] * t + 0.4)
    assert np.abs(moment) == pytest.approx(np.abs(twist), rel=1e-8, abs=1e-11 * heavy * g * size)
    # which needs no friction, of the pin neither: couples are forces, whatever the lengths
    assert np.max(np.abs(at["hinge.torque"])) <= 1e-8 * heavy * g * size
    assert not [e for e in result.events if e.liaison == "hinge"]
    for k, x in (("x", np.sin(turn + 1)), ("y", -np.cos(turn + 1))):
        assert at[f"plate.position.{k}"] == pytest.approx(g * x * t**2 / 2, rel=1e-8)
    assert not [e for e in result.events if e.kind == "several"]


def test_a_disc_rests_on_its_floor_after_the_wall_has_let_it_go() -> None:
    """Pushed into a corner less and less, then out of it: rolling resistance of the floor holds it
    until it is passed, delta W = R F, however little friction the wall has."""
    model = frot.compile("""
planar model Corner
  world(gravity = 0 m/s^2);
  parameter Angle tilt = 0 rad;
  parameter Force weight = 100 N;
  parameter Force push = 50 N;
  parameter Real mu = 0.01;
  Real left = 1 - time/(1 s);
  body b: disc(mass = 2 kg, radius = 0.1 m);
  curve wall on ground: line(through = (0, 0) m, direction = (-sin(tilt), cos(tilt)));
  curve floor on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  liaison A: contact_ponctuel(b.rim, wall) with coulomb(mu), rolling_resistance(0.5 mm);
  liaison B: contact_ponctuel(b.rim, floor) with coulomb(0.4), rolling_resistance(2 mm);
  force into: on(b, value = push*left*(cos(tilt), sin(tilt)));
  force down: on(b, value = weight*(sin(tilt), -cos(tilt)));
initial
  b.angular_velocity = 0 rad/s;
  A.gap = 0 m;
  B.gap = 0 m;
  guess(b.position.x = -0.1 m*(cos(tilt) + sin(tilt)));
  guess(b.position.y = 0.1 m*(cos(tilt) - sin(tilt)));
  experiment(stop = 1.2 s);
end Corner;
""")
    for tilt, push, mu in ((0, 50, 0.01), (0.3, 50, 0.01), (-1.1, 120, 0.02), (2.5, 31, 0.004)):
        result = model.simulate(parameters={"tilt": tilt, "push": push, "mu": mu})
        rolls = [e.time for e in result.events if e.kind == "roll_start"]
        assert rolls == pytest.approx([1 + 0.02 * 100 / push], rel=1e-9)


WEDGED = """
planar model Wedged
  world(gravity = 9.81 m/s^2);
  parameter Real mu = 0;
  parameter Angle apart = 0.0442 rad;
  parameter Angle turn = 0.2 rad;
  parameter AngularVelocity spin = 1 rad/s;
  curve one on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  curve other on ground:
    line(through = (0, 0) m, direction = (cos(turn + apart), sin(turn + apart)));
  body beam: rod(mass = 0.86 kg, length = 0.53 m);
  body bead: particle(mass = 1.7 kg);
  curve groove on beam: line(through = (0, 0.1) m, direction = (1, 0));
  liaison a: point_courbe(beam, one) with coulomb(0.48);
  liaison b: point_courbe(beam, other) with coulomb(0.11);
  liaison slide: point_courbe(bead, groove){law};
initial
  beam.position = (0, 0) m;
  beam.angle = 0.3 rad;
  beam.angular_velocity = spin;
  slide.abscissa = 0.1 m; slide.slip = 0 m/s;
  experiment(stop = 2 s);
end Wedged;
"""


@functools.cache
def wedged(law: str) -> frot.Model:
    return frot.compile(WEDGED.replace("{law}", law))


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
@pytest.mark.parametrize("case", range(6))
def test_a_zero_coefficient_gives_no_friction(case: int, tolerance: float) -> None:
    """A beam turns about a point held by two rough lines that cross nearly; in its groove, whose
    coefficient happens to be zero, a bead comes to rest and goes back as in a smooth one."""
    turned = {"turn": 0.2 + 0.77 * case, "apart": 0.0442 * (1 + case), "spin": 1 - 0.7 * case}
    law = " with coulomb(mu*(1 + sin(bead.position.x/(1 m))*0.3))"
    rough = wedged(law).simulate(tolerance=tolerance, parameters=turned)
    smooth = wedged("").simulate(tolerance=tolerance, parameters=turned)
    for name in ("bead.position.x", "beam.angle", "a.normal_force"):
        largest = np.max(np.abs(smooth[name]))
        assert np.max(np.abs(rough[name] - smooth[name])) <= 1e3 * tolerance * largest
