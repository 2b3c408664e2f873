"""Inside implicit steps what is stiff follows the tolerance too, its accelerations with it."""

import numpy as np
import pytest

import frot

# A particle that a stiff damper drags along a sine.
DRAGGED = frot.compile("""
planar model Dragged
  world(gravity = 0 m/s^2);
  parameter Damping c = 1e6 N.s/m;
  parameter Mass m = 1 kg;
  parameter AngularVelocity w = 1 rad/s;
  parameter Velocity v0 = 1 m/s;
  body a: particle(mass = m);
  force drive: on(a.G, value = (c*(v0*sin(w*time) - a.velocity.x), 0 N));
initial
  a.position.x = -v0/w*(c/m)^2/((c/m)^2 + w^2);
  a.position.y = 0 m;
  a.velocity.x = -v0*(c/m)*w/((c/m)^2 + w^2);
  a.velocity.y = 0 m/s;
  experiment(stop = 10 s, method = implicit);
end Dragged;
""")


def velocity(t: np.ndarray, rate: float, w: float) -> np.ndarray:
    """v' = rate*(sin wt - v), without its transient, in closed form."""
    return rate * (rate * np.sin(w * t) - w * np.cos(w * t)) / (rate**2 + w**2)


@pytest.mark.parametrize("rate", [1e4, 1e6, 1e8])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8, 1e-10])
def test_accelerations_between_the_stages(tolerance: float, rate: float) -> None:
    for m, w in ((1.0, 1.0), (1e-6, 3.0), (1e6, 3.0)):
        result = DRAGGED.simulate(tolerance=tolerance, parameters={"c": rate * m, "m": m, "w": w})
        t = np.linspace(0.1, 10 / w, 3001)
        now = result.at(t)
        exact = velocity(t, rate, w)
        slope = rate * (np.sin(w * t) - exact)
        assert np.max(np.abs(now["a.velocity.x"] - exact)) <= 0.1 * tolerance + 1e-14
        misses = np.abs(now["a.acceleration.x"] - slope)
        assert np.max(misses) <= (1e-3 * rate + 100 * w) * tolerance + 3e-14 * rate
