"""Faces on a line that turns as time says: the same motion as on a body that turns so."""

import math

import numpy as np
import pytest

import frot

START = """
initial
  {more}
  block.position = (side*0.5, 0.05) m;
  guess(block.velocity = (-0.05*rate, side*0.5*rate)*1 m);
  guess(block.angular_velocity = rate);
  experiment(stop = 4.3 s);
end Tilting;
"""
HEAD = """
planar model Tilting
  parameter Real side = 1;
  parameter Real mu = 0.4;
  parameter Mass m = 2 kg;
  AngularVelocity rate = side*0.1 rad/s;
  body block: box(mass = m, size = (0.2, 0.1) m);
"""
LINE = (
    HEAD
    + """
  curve ramp on ground: line(through = (0, 0) m,
                             direction = (cos(side*0.1 rad/s*time), sin(side*0.1 rad/s*time)));
  liaison feet: appui_faces(block.bottom, ramp) with coulomb(mu);
"""
    + START.format(more="")
)
PLATE = (
    HEAD
    + """
  body plate: rod(mass = 1 kg, length = 4 m);
  curve ramp on plate: line(through = (0, 0) m, direction = (1, 0));
  liaison axis: rotoide(ground, plate.G) driven(angle = side*0.1 rad/s*time);
  liaison feet: appui_faces(block.bottom, ramp) with coulomb(mu);
"""
    + START.format(more="plate.angle = 0 rad;")
)


def begins(mu: float) -> float:
    """When it begins to slip: g sin a - w^2 x = mu (g cos a - w^2 y), a = w t, by Newton's rule."""
    w, x, y, t = 0.1, 0.5, 0.05, 3.0
    for _ in range(50):
        a = w * t
        value = 9.81 * math.sin(a) - w**2 * x - mu * (9.81 * math.cos(a) - w**2 * y)
        t -= value / (w * 9.81 * (math.cos(a) + mu * math.sin(a)))
    return t


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("mu", "mass"), [(0.4, 2), (0.25, 2e6), (0.3, 2e-6)])
def test_a_box_slips_on_a_line_that_tilts(
    tolerance: float, side: int, mu: float, mass: float
) -> None:
    given = {"mu": mu, "m": mass, "side": side}
    runs = [frot.compile(x).simulate(parameters=given, tolerance=tolerance) for x in (LINE, PLATE)]
    for run in runs:
        slips = [e.time for e in run.events if e.kind == "slip"]
        assert slips == [pytest.approx(begins(mu), rel=tolerance + 1e-12)] * 2
    for name in ("block.position.x", "block.position.y", "block.angle", "feet.normal_force"):
        a, b = (run[name] for run in runs)
        assert np.abs(a - b).max() <= 100 * tolerance * np.abs(a).max() + 1e-12, name


def test_the_known_time_of_the_tilting_line() -> None:
    assert begins(0.4) == pytest.approx(3.8096067765, abs=1e-10)
