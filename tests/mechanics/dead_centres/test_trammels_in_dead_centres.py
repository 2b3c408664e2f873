"""A rod on two dry lines at right angles that starts along one of them, where no speed of the rod
moves its end on that line: the slip begins with the third power of time."""

from __future__ import annotations

import functools
import math

import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def trammel() -> frot.Model:
    return frot.compile("""
planar model Trammel
  parameter Angle tilt = 0;
  parameter Angle start = 0;
  parameter Mass m = 5000 kg;
  parameter Torque c = 0 N.m;
  body bar: rod(mass = m, length = 0.1 m);
  curve h on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  curve v on ground: line(through = (0, 0) m, direction = (-sin(tilt), cos(tilt)));
  liaison H: point_courbe(bar.start, h) with coulomb(0.001);
  liaison V: point_courbe(bar.tip, v) with coulomb(0.36);
  force motor: couple(bar, value = c*(1 + 0.1*sin(20 rad/s*time)));
initial
  bar.angle = start;
  bar.angular_velocity = 0 rad/s;
end Trammel;
""")


def run(tilt: float, start: float, tolerance: float, couple: float = 3427.0) -> float:
    result = trammel().simulate(
        tolerance=tolerance,
        stop=0.1,
        parameters={"tilt": tilt, "start": start, "c": couple},
    )
    assert result.figures.steps < 400
    return float(result["bar.angle"][-1] - result["bar.angle"][0])


@pytest.mark.parametrize("tilt", [0, math.pi, math.pi / 2, 1, -2.5])
@pytest.mark.parametrize("part", [0, math.pi])
@pytest.mark.parametrize("couple", [-3427.0, 1510.0, 3427.0])
def test_it_leaves_its_dead_centre(tilt: float, part: float, couple: float) -> None:
    """What begins beside the posture, on either side of it, comes to the same place but for that
    much: no friction holds it there, and none of its reactions is free."""
    moved = run(tilt, tilt + part, 1e-8, couple)
    for aside in (1e-9, -1e-9):
        assert abs(run(tilt, tilt + part + aside, 1e-8, couple) - moved) < 1e-6


@pytest.mark.parametrize("exponent", range(-16, -6))
def test_no_distance_from_its_dead_centre_stops_it(exponent: int) -> None:
    """It turns through the posture soon after the start, and its slip reverses then: what friction
    does until then is in proportion to that time, which goes with the root of the distance."""
    tilt = math.pi / 2
    moved = run(tilt, tilt, 1e-10, -3427.0)
    for aside in (10.0**exponent, -(10.0**exponent)):
        for tolerance in (1e-4, 1e-10):
            other = run(tilt, tilt + aside, tolerance, -3427.0)
            assert abs(other - moved) < 10 * tolerance + 0.01 * math.sqrt(abs(aside))
