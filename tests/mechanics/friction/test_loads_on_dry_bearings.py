"""A rotor in a dry bearing that a drive sets off, and a load on it that equations of the text give.

At the departure the load leaves zero by the third power of time. What rounding makes of the rotor's
speed moves the load too, by far more than that at first, and says nothing of its size.
"""

import math

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding

SHAFT = """
planar model Whole "Motor and load"
  parameter Real mu = 0.2;
  parameter Torque peak = 1 N.m;
  parameter Mass m = 5 kg;
  parameter Inertia J = 0.05 kg.m^2;
  parameter RotationalStiffness k = 10 N.m;
  parameter RotationalDamping c = 0.05 N.m.s;
  body rotor: disc(mass = m, radius = 100 mm);
  liaison hinge: rotoide(ground, rotor.G) with coulomb(mu, radius = 20 mm);
  force drive: couple(hinge, value = peak*sin(6*time/(1 s)) - shaft);
  Angle b;
  AngularVelocity wb, last;
  output Torque shaft;
initial
  hinge.angle = 0 rad;
  hinge.speed = 0 rad/s;
  b = 0 rad;
  wb = 0 rad/s;
  last = 0 rad/s;
equation
  der(b) = wb;
  J*der(wb) = shaft;
  shaft = k*(hinge.angle - b) + c*(hinge.speed - wb);
  der(last) = (wb - last)*20 1/s;
  experiment(stop = 3 s);
end Whole;
"""
TOLERANCES = [10.0**-k for k in range(3, 14)]


@pytest.fixture(scope="module")
def shaft() -> frot.Model:
    return frot.compile(SHAFT)


def after_departure(
    t: float, mass: float, k: float, c: float, load: float, peak: float, mu: float
) -> np.ndarray:
    """Angle and speed of rotor and load and the filtered speed, before the first slip ends.

    x' = A x with the drive's sine and cosine and the constant friction among x: by the series of
    the exponential, scaled and squared.
    """
    inertia, friction = mass * 0.1**2 / 2, mu * mass * 9.81 * 0.02
    start = math.asin(friction / peak) / 6
    a = np.zeros((8, 8))
    a[0, 1] = a[2, 3] = 1
    pull = np.array([-k, -c, k, c])
    a[1, :4], a[1, 5], a[1, 7] = pull / inertia, peak / inertia, -friction / inertia
    a[3, :4] = -pull / load
    a[4, 3], a[4, 4] = 20, -20
    a[5, 6], a[6, 5] = 6, -6
    x = np.array([0, 0, 0, 0, 0, math.sin(6 * start), math.cos(6 * start), 1])
    halvings = 12
    step, term, whole = a * (t - start) / 2**halvings, np.eye(8), np.eye(8)
    for order in range(1, 16):
        term = term @ step / order
        whole = whole + term
    for _ in range(halvings):
        whole = whole @ whole
    return (whole @ x)[:5]


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("k", [10.0, 0.0])
def test_a_load_on_a_shaft_is_followed_from_the_departure_on(
    tolerance: float, scale: float, k: float, shaft: frot.Model
) -> None:
    given = {"m": 5 * scale, "J": 0.05 * scale, "k": k * scale, "c": 0.05 * scale, "peak": scale}
    run = shaft.simulate(parameters=given, tolerance=tolerance)
    assert run.figures.steps < 800 and run.figures.rejected < 80
    (first, second) = run.events[:2]
    assert first.kind == "slip"
    assert first.time == pytest.approx(math.asin(0.2 * 5 * 9.81 * 0.02) / 6, rel=1e-10)
    assert second.time > 0.6
    for t in (0.0331, 0.05, 0.3, 0.6):
        now = run.at(t)
        found = [now[x] for x in ("hinge.angle", "hinge.speed", "b", "wb", "last")]
        expected = after_departure(t, 5, k, 0.05, 0.05, 1, 0.2)
        largest = np.abs(after_departure(0.6, 5, k, 0.05, 0.05, 1, 0.2)).max()
        assert np.abs(np.array(found) - expected).max() < 100 * tolerance * largest + 1e-12


@pytest.mark.parametrize("stop", [0.04, 0.5, 3.0, 30.0])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_the_stop_time_changes_nothing(stop: float, tolerance: float, shaft: frot.Model) -> None:
    run = shaft.simulate(stop=stop, tolerance=tolerance)
    assert run.figures.steps < 60 + 300 * stop
    assert run.events[0].time == pytest.approx(math.asin(0.2 * 5 * 9.81 * 0.02) / 6, rel=1e-10)


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_same_in_equations_alone_takes_as_many_steps(tolerance: float) -> None:
    run = frot.compile("""
model Whole
  Angle a;
  AngularVelocity w, wb;
  Torque shaft, M;
initial
  a = 0 rad;
  w = 0 rad/s;
  wb = 0 rad/s;
equation
  der(a) = w;
  M = friction(w, 0.1962 N.m);
  0.025 kg.m^2*der(w) = 1 N.m*sin(6*time/(1 s)) - shaft + M;
  0.05 kg.m^2*der(wb) = shaft;
  shaft = 0.05 N.m.s*(w - wb);
  experiment(stop = 3 s);
end Whole;
""").simulate(tolerance=tolerance)
    assert run.figures.steps < 300
    now = run.at(0.3)
    expected = after_departure(0.3, 5, 0, 0.05, 0.05, 1, 0.2)
    assert now["wb"] == pytest.approx(expected[3], rel=100 * tolerance, abs=1e-12)
    assert now["w"] == pytest.approx(expected[1], rel=100 * tolerance, abs=1e-12)
