"""Where an instant leaves several motions, the one that lasts is taken."""

from __future__ import annotations

import functools
from collections.abc import Callable
from math import cos, sin

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

Finding = Callable[..., frot.Model]
G = 9.81
TILT, GRIP, LIGHT, PULL, ROUGH = -0.225, 0.3, 1e-3, 2.0, 0.4


def let_go() -> float:
    """When the friction that rolling needs of the ring is what the plank can give, T = -grip N.

    With X the acceleration of the plank, of the ring along and across it and of the plank
    2 T = m (X cos a + g sin a), N = m (g cos a - X sin a), M X = -F + N sin a - T cos a.
    """
    c, s = cos(TILT), sin(TILT)
    x = -G * (GRIP * c + s / 2) / (c / 2 - GRIP * s)
    normal = G * c - x * s
    return (normal * s + GRIP * normal * c - LIGHT * x) / PULL


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("across", [2.0, -2.0])
def test_the_lasting_motion_of_an_instant_is_taken(
    finding: Finding, across: float, tolerance: float
) -> None:
    model = finding("choice_of_motion")
    result = model.simulate(tolerance=tolerance, stop=1.2, parameters={"across": across})
    allowed = 10 * tolerance + 1e-12
    # the disc: held by two cones of which one widens, then pushed the other way
    assert np.abs(result["d.velocity.x"]).max() == np.abs(result["d.angular_velocity"]).max() == 0
    # the bead: a = (3 - 0.4 * 2) t / m from the start, whatever the side
    speed = (3 - ROUGH * 2) / 0.5 * 1.2**2 / 2
    assert result.at(1.2)["c.velocity.x"] == pytest.approx(speed, rel=allowed)
    assert np.sign(result.at(1.2)["W.normal_force"]) == -np.sign(across)
    # the ring: Painleve's case, W_nn < grip W_nt, in which no slip follows the end of rolling
    (gone,) = [e.time for e in result.events if e.liaison == "K" and e.kind == "separation"]
    assert gone == pytest.approx(let_go(), rel=allowed)
    assert not [e for e in result.events if e.liaison == "K" and e.kind == "slip"]
    fall = result.at(1.2)["r.velocity.y"] - result.at(gone)["r.velocity.y"]
    assert fall == pytest.approx(-G * (1.2 - gone), rel=allowed)
    held = finding("choice_of_motion").simulate(parameters={"rough": 1.6, "across": across})
    assert np.abs(held["c.velocity.x"]).max() == 0


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(("first", "growth"), [(3.0, 0.0), (3.0, 1.0), (3.0, -0.5), (1e-6, 1e-6)])
def test_a_brake_lets_go_where_a_spring_outgrows_its_bound(
    way: float, first: float, growth: float
) -> None:
    """At its bound nothing accelerates: what lets go is the strain, a state that is no coordinate.

    c w + k w t = first + growth t, with the speed w of a flywheel that nothing slows.
    """
    stiffness, damping, speed = 4.0, 0.25, 0.5
    text = """model Wound
  import Rotational.*;
  parameter Torque first = 1 N.m;
  parameter Real growth = 0;
  parameter AngularVelocity speed = 1 rad/s;
  Inertia held(J = 0.02 kg.m^2);
  Inertia wheel(J = 1e15 kg.m^2);
  SpringDamper spring(k = 4 N.m, c = 0.25 N.m.s);
  Brake brake(mu = 0.5, radius = 2 m);
initial
  held.angle = 0 rad; held.speed = 0 rad/s;
  wheel.angle = 0 rad; wheel.speed = speed;
equation
  brake.force = (first + growth*1 N.m/s*time)/(1 m);
  connect(held.b, spring.a); connect(spring.b, wheel.a); connect(brake.a, held.a);
  experiment(stop = 4 s);
end Wound;
"""
    model = frot.compile(text)
    given = {"first": first + damping * speed, "growth": growth, "speed": way * speed}
    wanted = first / (stiffness * speed - growth)
    for tolerance in (1e-4, 1e-9):
        result = model.simulate(tolerance=tolerance, parameters=given)
        lets_go = next(e for e in result.events if e.liaison == "brake")
        assert lets_go.time == pytest.approx(wanted, rel=1e-9, abs=1e-12)
        assert way * float(result.at(wanted + 0.1)["held.speed"]) > 0


@functools.cache
def beside() -> frot.Model:
    """A wheel that its dry pin slows, and a particle on the floor far under it that is lifted the
    more the slower the wheel turns, but for a lift that falls with time by itself."""
    return frot.compile("""
planar model Beside
  parameter Mass heavy = 1 kg;
  parameter Angle turn = 0 rad;
  parameter AngularAcceleration slower = 1 rad/s^2;
  world(gravity = 0 m/s^2);
  body wheel: disc(mass = 2*heavy, radius = 0.5 m);
  body b: particle(mass = heavy);
  curve floor on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  frame hub on ground at 9 m*(-sin(turn), cos(turn));
  liaison pin: rotoide(hub, wheel) with coulomb(0.2, radius = 0.1 m);
  liaison lies: contact_ponctuel(b, floor) with coulomb(0.3);
  liaison far: contact_ponctuel(b, wheel.rim);
  Real lifted = (19 rad/s - wheel.angular_velocity - slower*time)/(1 rad/s);
  force lift: on(b, value = heavy*(20 m/s^2*lifted - 10 m/s^2)*(-sin(turn), cos(turn)));
  force weight: on(wheel, value = 2*heavy*10 m/s^2*(sin(turn), -cos(turn)));
initial
  wheel.angular_velocity = 20 rad/s;
  b.position = (0, 0) m;
  b.velocity = (0, 0) m/s;
  experiment(stop = 3.5 s);
end Beside;
""")


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("slower", [0.9, 0.5])
@pytest.mark.parametrize(("heavy", "turn"), [(1.0, 0.0), (1e-6, 2.1), (1e6, -0.7)])
def test_a_neighbouring_force_drives_a_departure(
    heavy: float, turn: float, slower: float, tolerance: float
) -> None:
    """w' = -mu r m g / J: the lift passes the weight at t, and the particle goes up with its cube.

    Without the pin's friction, which does nothing to the particle, it would lie on."""
    grows = 0.2 * 0.1 * 10 / 0.125 - slower
    wanted = (20 - 19 + 0.5) / grows
    values = {"heavy": heavy, "turn": turn, "slower": slower}
    result = beside().simulate(parameters=values, tolerance=tolerance, stop=wanted + 1)
    (gone,) = [e.time for e in result.events]
    assert gone == pytest.approx(wanted, rel=10 * tolerance + 1e-12)
    at = result.at(wanted + 1)
    height = at["b.position.y"] * cos(turn) - at["b.position.x"] * sin(turn)
    assert height == pytest.approx(20 * grows / 6, rel=100 * tolerance + 1e-10)
