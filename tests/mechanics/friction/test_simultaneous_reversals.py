"""Slips that are multiples of each other reverse at one instant, and so do their events."""

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

# Four rotors rub on a heavy fifth: each carries its own drive and limit, in proportion to its
# slip. So w - w5 of each is a multiple of one motion, w' = sin(3 t) +- 0.3.
CLUTCHES = """
model Clutches
  parameter Real k = 2;
  parameter Real n = 3;
  parameter AngularVelocity w = 0.7 rad/s;
  Angle a, b, c, d, s;
  Torque M, N, P, Q;
initial
  a = 0 rad; b = 0 rad; c = 0 rad; d = 0 rad; s = 0 rad;
  der(s) = w;
  der(a) = w + 1 rad/s; der(b) = w + k*1 rad/s; der(c) = w - n*1 rad/s; der(d) = w + 1 rad/s;
equation
  M = friction(der(a) - der(s), 0.3 N.m);
  N = friction(der(b) - der(s), 0.3 N.m*k);
  P = friction(der(c) - der(s), 0.3 N.m*n);
  Q = friction(der(d) - der(s), 0.3 N.m*(1 + 0*sin(time/(1 s))));
  1 kg.m^2*der(der(a)) = M + 1 N.m*sin(3*time/(1 s));
  1 kg.m^2*der(der(b)) = N + k*1 N.m*sin(3*time/(1 s));
  1 kg.m^2*der(der(c)) = P - n*1 N.m*sin(3*time/(1 s));
  1 kg.m^2*der(der(d)) = Q + 1 N.m*sin(3*time/(1 s));
  1e3 kg.m^2*der(der(s)) = 0 N.m;
  experiment(stop = 6 s);
end Clutches;
"""


def reversals() -> list[float]:
    """When w = w0 - 0.3 s (t - t0) + (cos 3 t0 - cos 3 t)/3 is zero, one after the other."""
    found, t, speed = [], 0.0, 1.0
    for _ in range(3):
        start, begun, sense = t, speed, 1 if not len(found) % 2 else -1

        def slip(x: float, start=start, begun=begun, sense=sense) -> float:
            return begun - 0.3 * sense * (x - start) + (np.cos(3 * start) - np.cos(3 * x)) / 3

        low = t + 0.05
        while slip(low) * sense > 0:
            low += 1e-3
        high, low = low, low - 1e-3
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if slip(middle) * sense > 0 else (low, middle)
        t, speed = low, 0.0
        found.append(t)
    return found


@pytest.fixture(scope="module")
def clutches() -> frot.Model:
    return frot.compile(CLUTCHES)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7, 1e-9, 1e-12])
@pytest.mark.parametrize(
    ("k", "n"), [(1, 1), (2, 1 / 3), (1e-3, 0.9), (1e3, 1e-3), (1e3, 1e-4), (1e-5, 1 / 1.7)]
)
def test_clutches_reverse_together(
    k: float, n: float, tolerance: float, clutches: frot.Model
) -> None:
    if tolerance < 1e-9 and min(k, n) < 1e-3:
        tolerance = 1e-9  # a slip of 1e-5 beside 0.7 is known to 1e-11 of itself
    run = clutches.simulate(parameters={"k": k, "n": n}, tolerance=tolerance)
    times = sorted({e.time for e in run.events})
    assert times == pytest.approx(reversals(), rel=10 * tolerance + 1e-10)
    assert len(run.events) == 12 and {e.kind for e in run.events} == {"reversal"}


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(("k", "mass"), [(1, 1), (2, 3), (7.1, 1e6), (1e3, 1e-6), (0.1, 1)])
def test_blocks_stop_together(k: float, mass: float, tolerance: float) -> None:
    run = frot.compile("""
planar model Two
  parameter Real k = 2;
  parameter Mass m = 1 kg;
  body a: particle(mass = 1 kg);
  body b: particle(mass = m);
  liaison fa: contact_ponctuel(ground.line, a) with coulomb(0.3);
  liaison fb: contact_ponctuel(ground.line, b) with coulomb(0.3*k);
initial
  a.position = (0, 0) m; b.position = (1, 0) m;
  a.velocity = (1, 0) m/s; b.velocity = (-k, 0)*1 m/s;
  experiment(stop = 1 s);
end Two;
""").simulate(parameters={"k": k, "m": mass}, tolerance=tolerance)
    (first, second) = run.events
    assert first.time == second.time == pytest.approx(1 / (0.3 * 9.81), rel=1e-11)
