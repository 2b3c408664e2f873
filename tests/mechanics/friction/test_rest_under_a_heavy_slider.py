"""What friction holds rests to the last bit while something far heavier slides on it."""

from __future__ import annotations

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

BOWL = """planar model Bowl
  parameter Mass M = 1 kg;
  parameter Real mu = 3;
  body base: box(mass = M, size = (4, 0.5) m);
  body p: particle(mass = 1 kg);
  curve bowl on base: circle(centre = (0, 1) m, radius = 1 m);
  liaison F: appui_faces(base.bottom, ground.line) with coulomb(mu);
  liaison C: contact_ponctuel(p, bowl);
  Real z;
equation
  der(z) = 1 / (1 s);
  when time > 2 s then reinit(z, 0); end when;
initial
  z = 0;
  base.position = (0, 0.25) m;
  p.position = (0.8 m, 0.25 m + 1 m - 0.6 m);
  p.velocity = (0, 0) m/s;
  experiment(stop = 5 s, tolerance = 1e-6);
end Bowl;"""


@pytest.mark.parametrize("mass", [1e3, 1.0, 1e-2, 1e-4, 1e-6])
def test_a_bowl_rests_under_a_sliding_body(mass: float) -> None:
    """The relation of the two is put right by the one that moves, however much heavier it is."""
    model = frot.compile(BOWL)
    exact = model.simulate(tolerance=1e-12, parameters={"M": 1e3})
    for tolerance in (1e-4, 1e-6, 1e-9):
        run = model.simulate(tolerance=tolerance, parameters={"M": mass})
        for name in ("base.velocity.x", "base.velocity.y", "base.angular_velocity"):
            assert np.all(run[name] == 0)
        assert np.all(run["base.position.x"] == 0)
        away = np.hypot(run["p.position.x"], run["p.position.y"] - 1.25) - 1
        assert np.max(np.abs(away)) < 1e-14
        assert run["p.position.x"][-1] == pytest.approx(
            exact["p.position.x"][-1], abs=100 * tolerance
        )
