"""A rod that slides on its end where p < 0, in space and in the plane: the same motions and events.

Two motions are admissible at the start: the end slips on, pressed by N = -b/p, or it parts.
"""

from __future__ import annotations

import functools
import math

import pytest

import frot

ANGLE = 0.25 * math.pi


@functools.cache
def planar(choice: str) -> frot.Model:
    return frot.compile(f"""
planar model Rod
  parameter AngularVelocity w = -6 rad/s;
  parameter Mass m = 1 kg;
  body b: rod(mass = m, length = 1 m);
  liaison k: contact_ponctuel(ground.line, b.start) with coulomb(2);
initial
  b.angle = {ANGLE} rad;
  b.angular_velocity = w;
  b.start.position = (0, 0) m;
  b.start.velocity = (-1, 0) m/s;
  experiment(stop = 0.2 s, tolerance = 1e-10, on_indeterminate = {choice});
end Rod;
""")


@functools.cache
def spatial(choice: str) -> frot.Model:
    half = 0.5 * ANGLE
    return frot.compile(f"""
model Rod
  parameter AngularVelocity w = -6 rad/s;
  parameter Mass m = 1 kg;
  parameter Angle azimuth = 0 rad;
  body b: rod(mass = m, length = 1 m);
  liaison k: contact_ponctuel(ground.plane, b.start) with coulomb(2);
initial
  b.start.position = (0, 0, 0) m;
  b.orientation = (cos(azimuth/2)*{math.cos(half)}, sin(azimuth/2)*{math.sin(half)},
    -cos(azimuth/2)*{math.sin(half)}, sin(azimuth/2)*{math.cos(half)});
  b.angular_velocity = (w*sin(azimuth), -w*cos(azimuth), 0 rad/s);
  b.start.velocity = (-cos(azimuth)*(1 m/s), -sin(azimuth)*(1 m/s), 0 m/s);
  experiment(stop = 0.2 s, tolerance = 1e-10, on_indeterminate = {choice});
end Rod;
""")


@pytest.mark.parametrize("azimuth", [0.0, 0.7, -2.4])
@pytest.mark.parametrize("mass", [1.0, 1e6])
@pytest.mark.parametrize("choice", ["rest", "continue", "impact"])
def test_events_are_those_of_the_planar_twin(choice: str, mass: float, azimuth: float) -> None:
    flat = planar(choice).simulate(parameters={"m": mass})
    run = spatial(choice).simulate(parameters={"m": mass, "azimuth": azimuth})
    kinds = ("several", "tangential_impact")
    own, other = ([e for e in r.events if e.kind in kinds] for r in (run, flat))
    assert [e.kind for e in own] == [e.kind for e in other] and own
    for a, b in zip(own, other, strict=True):
        assert a.time == pytest.approx(b.time, abs=1e-9)
        if b.impulse:
            assert a.impulse == pytest.approx(b.impulse, rel=1e-7)
    along = run["b.position.x"] * math.cos(azimuth) + run["b.position.y"] * math.sin(azimuth)
    assert along == pytest.approx(flat["b.position.x"], abs=1e-7)
    assert run["b.position.z"] == pytest.approx(flat["b.position.y"], abs=1e-7)


def test_where_nothing_presses_there_is_one_motion() -> None:
    events = spatial("rest").simulate(parameters={"w": 6.0}).events
    flat = planar("rest").simulate(parameters={"w": 6.0}).events
    assert [e.kind for e in events if e.time == 0] == [e.kind for e in flat if e.time == 0]
