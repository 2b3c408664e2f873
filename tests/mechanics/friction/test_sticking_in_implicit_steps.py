"""What friction holds has a speed of exactly zero in implicit steps too."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

TOLERANCES = [1e-5, 1e-8, 1e-11]
MASSES = [1e-6, 1.0, 1e6]


@functools.cache
def held_rod() -> frot.Model:
    """A rod turns in a dry pin until its friction stops it; a stiff damper ties a bob to it."""
    return frot.compile("""
planar model HeldRod
  world(gravity = 0 m/s^2);
  parameter Real scale = 1;
  parameter Angle tilt = 0;
  parameter AngularVelocity turns = 0.2 rad/s;
  body arm: rod(mass = scale*1 kg, length = 1 m);
  body bob: particle(mass = scale*0.01 kg);
  parameter Stiffness k = scale*0.2 N/m;
  parameter Damping c = scale*1e3 N.s/m;
  liaison pin: rotoide(ground, arm.start) with coulomb(0.4, radius = 0.1 m);
  force press: on(arm.G, value = (scale*100*cos(tilt), scale*100*sin(tilt))*1 N);
  force tie: damper(arm.tip, bob, c = c);
  force back: spring(arm.G, bob, k = k, length = 0.3 m);
initial
  arm.angle = tilt;
  arm.angular_velocity = turns;
  bob.position = (1.2*cos(tilt) - 0.3*sin(tilt), 1.2*sin(tilt) + 0.3*cos(tilt)) m;
  bob.velocity = (0, 0) m/s;
  experiment(stop = 1 s, method = implicit);
end HeldRod;""")


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("scale", MASSES)
@pytest.mark.parametrize("tilt", [0.0, 0.7])
@pytest.mark.parametrize("turns", [0.2, -0.2])
def test_a_rod_stopped_by_its_dry_pin_has_no_speed(
    turns: float, tilt: float, scale: float, tolerance: float
) -> None:
    """From the end of the slip on the rod rests, while the bob moves on."""
    values = {"turns": turns, "tilt": tilt, "scale": scale}
    result = held_rod().simulate(parameters=values, tolerance=tolerance)
    assert result.events[-1].kind == "stick"
    rests = result.time > result.events[-1].time
    assert np.count_nonzero(rests) > 10
    assert np.all(np.hypot(result["bob.velocity.x"], result["bob.velocity.y"])[rests] > 0)
    for name in ("velocity.x", "velocity.y", "angular_velocity"):
        assert np.all(result[f"arm.{name}"][rests] == 0)
    assert np.ptp(result["arm.angle"][rests]) == 0
