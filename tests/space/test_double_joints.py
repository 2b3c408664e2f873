"""Two universal joints in phase turn a parallel shaft at the speed of the first."""

from __future__ import annotations

from math import radians

import pytest

import frot

TEXT = """
model DoubleJoint
  parameter Mass m = 1 kg;
  world(gravity = 0 m/s^2);
  body s1: cylinder(mass = m, radius = 0.02 m, length = 0.2 m);
  body s2: cylinder(mass = m, radius = 0.02 m, length = 0.4 m);
  body s3: cylinder(mass = m, radius = 0.02 m, length = 0.2 m);
  frame base on ground at ({place}) m rotated(axis = ({axis}), angle = {turned});
  frame mid on base rotated(axis = y, angle = {beta} deg);
  frame far on mid at (0, 0, 0.4) m;
  frame out on far rotated(axis = y, angle = -{beta} deg);
  frame a1 on s1 at (0, 0, 0.1) m;
  frame a2 on s2 at (0, 0, -0.2) m;
  frame b2 on s2 at (0, 0, 0.2) m;
  frame b3 on s3 at (0, 0, -0.1) m;
  liaison drive: rotoide(base, a1, axis = z) driven(speed = {speed} rad/s);
  liaison j1: cardan(a1, a2, axis_a = x, axis_b = y);
  liaison j2: cardan(b2, b3, axis_a = y, axis_b = x);
  liaison carrier: rotoide(out, b3, axis = z);
initial
  drive.angle = 0;
  experiment(stop = 20 ms, tolerance = 1e-9);
end DoubleJoint;
"""
STRAIGHT = {"place": "0, 0, 0", "axis": "1, 0, 0", "turned": 0, "speed": 20}
ASKEW = {"place": "3, -1, 2", "axis": "1, 2, -0.5", "turned": 0.8, "speed": -20}


@pytest.mark.parametrize("scene", [STRAIGHT, ASKEW], ids=["straight", "askew"])
@pytest.mark.parametrize("beta", [1, 5, 10, 25, 45, 60, 75])
def test_it_starts_at_any_angle(beta, scene):
    """The distance of the centres is met with slope zero: they cannot be farther apart."""
    model = frot.compile(TEXT.format(beta=beta, **scene))
    for mass in (1.0, 1e6):
        run = model.simulate(parameters={"m": mass})
        assert run["carrier.speed"] == pytest.approx(scene["speed"], rel=1e-9)
        assert run["j1.angle_a"][0] == pytest.approx(0, abs=1e-9)
        assert run["j1.angle_b"][0] == pytest.approx(radians(beta), abs=1e-9)
