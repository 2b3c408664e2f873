"""Closed loops that say more than they need, moved by a drive."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def shaft() -> frot.Model:
    """Two universal joints in phase between parallel shafts that are fixed: one relation is
    redundant."""
    return frot.compile("""
model DoubleHooke
  parameter Angle beta = 25 deg;
  parameter AngularVelocity turns = 20 rad/s;
  parameter Mass middle = 1 kg;
  body s1: cylinder(mass = 1 kg, radius = 0.02 m, length = 0.2 m);
  body s2: cylinder(mass = middle, radius = 0.02 m, length = 0.4 m);
  body s3: cylinder(mass = 1 kg, radius = 0.02 m, length = 0.2 m);
  frame mid on ground rotated(axis = y, angle = beta);
  frame far on mid at (0, 0, 0.4) m;
  frame out on far rotated(axis = y, angle = -beta);
  frame a1 on s1 at (0, 0, 0.1) m;
  frame a2 on s2 at (0, 0, -0.2) m;
  frame b2 on s2 at (0, 0, 0.2) m;
  frame b3 on s3 at (0, 0, -0.1) m;
  liaison drive: rotoide(ground, a1, axis = z) driven(speed = turns);
  liaison j1: cardan(a1, a2, axis_a = x, axis_b = y);
  liaison j2: cardan(b2, b3, axis_a = y, axis_b = x);
  liaison carrier: rotoide(out, b3, axis = z);
initial
  drive.angle = 0;
  guess(s2.orientation = (cos(beta/2), 0, sin(beta/2), 0));
  guess(j2.angle_b = 0);
  experiment(stop = 1 s);
end DoubleHooke;""")


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13])
@pytest.mark.parametrize("degrees", [5, 25, 40])
def test_a_double_joint_hands_on_the_speed_of_its_drive(degrees: float, tolerance: float) -> None:
    """The second joint undoes what the first one does: the shaft behind it turns as the drive, and
    by as much. The shaft between them, at beta, has the speed of a Hooke's joint between cos(beta)
    and 1/cos(beta) of that."""
    for turns in (20.0, -0.3):
        for middle in (1.0, 1e-3, 1e3):
            beta = float(np.radians(degrees))
            values = {"beta": beta, "turns": turns, "middle": middle}
            result = shaft().simulate(parameters=values, tolerance=tolerance)
            assert np.abs(result["carrier.speed"] - turns).max() < 1e-12 * abs(turns)
            turned = result["carrier.angle"] - result["carrier.angle"][0]
            assert np.abs(turned - turns * result.time).max() < (tolerance + 1e-12) * abs(turns)
            assert result.figures.steps < 500
            assert result.figures.rejected < 0.3 * result.figures.steps + 10
            # of the middle shaft along its axis
            w = np.stack([result[f"s2.angular_velocity.{k}"] for k in "xyz"])
            own = w[0] * np.sin(beta) + w[2] * np.cos(beta)
            angle = turns * result.time
            slow = turns * np.cos(beta) / (1 - (np.sin(beta) * np.sin(angle)) ** 2)
            fast = turns * np.cos(beta) / (1 - (np.sin(beta) * np.cos(angle)) ** 2)
            error = min(np.abs(own - x).max() for x in (slow, fast))
            assert error < (20 * tolerance + 1e-11) * abs(turns)
