"""Statements of `initial` on accelerations and reactions find places, or speeds."""

from math import cos, sin, sqrt

import pytest

import frot

G = 9.81
TEXT = """
planar model Starts
  parameter Mass m = 2 kg;
  parameter Stiffness k = 40 N/m;
  parameter RotationalStiffness kt = 20 N.m;
  body hung: particle(mass = m);
  force rope: spring((0, 0) m, hung, k = k, length = 1 m);
  force oil: damper((1, 0) m, hung, c = 3 N.s/m);
  body arm: rod(mass = m, length = 1 m);
  liaison pin: rotoide(ground, arm.start);
  force turn: couple(pin, value = -kt*pin.angle - 2 N.m.s*pin.speed);
  body bead: particle(mass = m);
  curve ring on ground: circle(radius = 1.5 m);
  liaison wire: point_courbe(bead, ring);
  body puck: particle(mass = m);
  force push: on(puck, value = (-k*puck.position.x - 4 N.s/m*puck.velocity.x, 20 N));
  body crank: rod(mass = m, length = 0.4 m);
  body coupler: rod(mass = m, length = 1 m);
  curve rail on ground: line(through = (0, -3) m, direction = (1, 0));
  liaison a: rotoide(ground, crank.start);
  liaison b: rotoide(crank.tip, coupler.start);
  liaison c: point_courbe(coupler.tip, slide);
  frame low on ground at (0, 0) m;
  curve slide on low: line(through = (0, 0) m, direction = (1, 0));
  force load: on(coupler.tip, value = (30 N, 0 N));
  Real x(start = 1);
initial
  der(hung.velocity) = (0, 0) m/s^2;
  guess(hung.position = (0.1, -1.2) m);
  arm.angular_acceleration = 0 rad/s^2;
  wire.u = -90 deg;
  wire.normal_force = 3*m*9.81 m/s^2;
  guess(bead.velocity = (1, 0) m/s);
  puck.acceleration.x = -6 m/s^2;
  puck.velocity.x = 0.5 m/s;
  crank.angular_acceleration = 0 rad/s^2;
  guess(crank.angle = -0.3);
  guess(coupler.angle = 0.1);
  der(x) = -0.5 1/s;
equation
  der(x) = -x/(1 s);
  experiment(stop = 0.01 s, tolerance = 1e-11);
end Starts;
"""


@pytest.fixture(scope="module")
def run():
    return frot.compile(TEXT).simulate()


def test_an_equilibrium_is_found_with_dampers_too(run):
    assert run["hung.position.x"][0] == pytest.approx(0, abs=1e-10)
    assert run["hung.position.y"] == pytest.approx(-1 - 2 * G / 40, rel=1e-10)
    assert run["hung.velocity.y"] == pytest.approx(0, abs=1e-10)
    angle = run["pin.angle"][0]
    assert 20 * angle == pytest.approx(-2 * G * 0.5 * cos(angle), rel=1e-10)
    assert run["pin.speed"] == pytest.approx(0, abs=1e-10)


def test_a_loop_is_found_in_balance(run):
    # virtual work of the weights and the load, with r sin(a) + l sin(b) = 0
    a, b = run["crank.angle"][0], run["coupler.angle"][0]
    assert 0.4 * sin(a) + sin(b) == pytest.approx(0, abs=1e-11)
    turn = -0.4 * cos(a) / cos(b)
    weights = 2 * G * (0.2 * cos(a) + 0.4 * cos(a) + 0.5 * cos(b) * turn)
    load = 30 * (-0.4 * sin(a) - sin(b) * turn)
    assert load == pytest.approx(weights, abs=1e-9)
    assert run["crank.angular_velocity"] == pytest.approx(0, abs=1e-8)


def test_a_reaction_tells_the_speed_where_the_place_is_known(run):
    assert run["bead.velocity.x"][0] == pytest.approx(sqrt(2 * G * 1.5), rel=1e-10)


def test_a_place_is_found_at_the_speed_that_is_stated(run):
    assert run["puck.velocity.x"][0] == pytest.approx(0.5, rel=1e-12)
    assert run["puck.position.x"][0] == pytest.approx((12 - 4 * 0.5) / 40, rel=1e-10)
    assert run["x"][0] == pytest.approx(0.5, rel=1e-12)


def test_what_friction_decides_is_told():
    text = """
    planar model M
      body b: particle(mass = 1 kg);
      liaison floor: contact_ponctuel(ground.line, b) with coulomb(0.2);
    initial
      b.acceleration.x = 1 m/s^2;
    end M;
    """
    with pytest.raises(frot.FrotError, match=r"E0602.*friction, a contact that parts"):
        frot.compile(text).simulate()
    text = """
    planar model M
      body b: particle(mass = 1 kg);
      force f: on(b, value = (-1 N/m*b.position.x, 0 N));
    initial
      b.acceleration.x = 1 m/s^2;
      b.position.x = 2 m;
    end M;
    """
    with pytest.raises(frot.FrotError, match="E0601"):
        frot.compile(text).simulate()
