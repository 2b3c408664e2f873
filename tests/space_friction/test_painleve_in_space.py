"""Painlevé's examples in space without a model of their own: p. 45, 49, 57 and 110."""

from __future__ import annotations

import math

import numpy as np
import pytest
from space_models import G, last, model

import frot

SPHERES = """
    model Spheres
      parameter Mass m = 1 kg;
      parameter Angle about = 0 rad;
      parameter Velocity v = 1.5 m/s;
      parameter AngularVelocity spin = 0 rad/s;
      world(gravity = 0 m/s^2);
      body a: sphere(mass = m, radius = 0.5 m);
      body b: sphere(mass = m, radius = 0.5 m);
      liaison c: contact_ponctuel(a.surface, b.surface, unilateral = false) with coulomb(0.2);
    initial
      a.position = (0, 0, 0) m;
      b.position = (cos(about)*1 m, sin(about)*0.6 m, sin(about)*0.8 m);
      a.velocity = (sin(about)*v, -cos(about)*0.6*v, -cos(about)*0.8*v);
      b.velocity = -(sin(about)*v, -cos(about)*0.6*v, -cos(about)*0.8*v);
      a.angular_velocity = (cos(about)*spin, sin(about)*0.6*spin, sin(about)*0.8*spin);
      b.angular_velocity = (cos(about)*spin, sin(about)*0.6*spin, sin(about)*0.8*spin);
      experiment(stop = 1 s, tolerance = 1e-11);
    end Spheres;
    """


@pytest.mark.parametrize("about", [0, 0.7, -2])
@pytest.mark.parametrize(("mass", "sign"), [(1, 1), (1e6, -1), (1e-6, 1)])
def test_two_homogeneous_spheres_slide_on_each_other(about: float, mass: float, sign: int) -> None:
    """P. 45: with phi' = 3 1/s and no spins slip ends at 2/3 s, phi' = 15/7 1/s then.

    phi'' = -f phi'^2 by the normal reaction m d phi'^2/2, and each sphere is spun up to phi'/2.
    """
    result = model(SPHERES).simulate(
        parameters={"about": f"{about} rad", "m": f"{mass} kg", "v": f"{1.5 * sign} m/s"}
    )
    (stop,) = result.events
    assert stop.time == pytest.approx(2 / 3, rel=1e-10)
    a, b = (np.array(last(result, *(f"{n}.velocity.{c}" for c in "xyz"))) for n in "ab")
    assert np.linalg.norm(a - b) == pytest.approx(15 / 7, rel=1e-9)


POINTS = """
    model Points
      parameter Angle about = 0 rad;
      parameter Real mu = 0.4;
      body M: particle(mass = 1 kg);
      body M1: particle(mass = 1 kg);
      surface P on ground: plane(through = (0, 0, 0) m, normal = (cos(about), sin(about), 0));
      liaison c: point_surface(M, P) with coulomb(mu);
      liaison rod: tige(M, M1, length = 1 m);
      force press: on(M, value = (-cos(about)*10 N*(0.4/mu), -sin(about)*10 N*(0.4/mu), 0 N));
    initial
      M.position = (0, 0, 0) m;
      M1.position = (-sin(about)*sqrt(0.5)*1 m, cos(about)*sqrt(0.5)*1 m, sqrt(0.5)*1 m);
      M.velocity = (0, 0, 0) m/s;
      M1.velocity = (0, 0, 0) m/s;
      experiment(stop = 0.1 s, tolerance = 1e-11);
    end Points;
    """


@pytest.mark.parametrize("about", [0, 0.4, 2.9])
@pytest.mark.parametrize("mu", [0.4, 0.02, 3])
def test_a_departure_that_is_not_the_smooth_one(about: float, mu: float) -> None:
    """P. 49: M departs 5.733530 degrees off the vertical, for friction calls up the rod.

    (a + 4 N/m) d = g + 2 (d . e) e along the rod e, |d| = 1.
    """
    result = model(POINTS).simulate(parameters={"about": f"{about} rad", "mu": mu})
    for t in (0, 1e-7):
        at = result.at(t)
        x, y, z = (at[f"M.acceleration.{c}"] for c in "xyz")
        along = y * math.cos(about) - x * math.sin(about)
        assert math.hypot(along, z) == pytest.approx(6.959728, abs=1e-6)
        assert math.degrees(math.atan2(along, z)) == pytest.approx(5.733530 - 180, abs=1e-6)
        assert x * math.cos(about) + y * math.sin(about) == pytest.approx(0, abs=1e-12)


def test_a_tube_brakes_less_than_a_groove() -> None:
    """P. 57: at f = 0.3 a tube brakes by f g = 2.943 m/s^2, a groove of 45 degrees by 4.162031."""
    result = model("""
        model Tube
          body b: particle(mass = 1 kg);
          curve tube on ground: line(through = (0, 0, 0) m, direction = (0.6, 0.8, 0));
          liaison c: point_courbe(b, tube) with coulomb(0.3);
        initial
          c.u = 0 m;
          b.velocity = (1.2, 1.6, 0) m/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Tube;
        """).simulate()
    assert 2 / result.events[0].time == pytest.approx(2.943, rel=1e-11)


SPHERE = """
    model Sphere
      parameter Angle i = 0.1 rad;
      parameter Angle about = 0 rad;
      parameter Real f = 0.3;
      parameter Real f1 = 0.05 "rolling resistance over the radius";
      parameter Length r = 0.2 m;
      parameter AngularVelocity spin = 0 rad/s;
      body b: sphere(mass = 1 kg, radius = r);
      surface ramp on ground: plane(
        through = (0, 0, 0) m,
        normal = (sin(i)*cos(about), sin(i)*sin(about), cos(i)));
      liaison c: contact_ponctuel(b.surface, ramp)
        with coulomb(f), rolling_resistance(f1*r), pivoting_resistance(0.1*f1*r);
    initial
      b.position = (sin(i)*cos(about)*r, sin(i)*sin(about)*r, cos(i)*r);
      b.velocity = (0, 0, 0) m/s;
      b.angular_velocity =
        (sin(i)*cos(about)*spin, sin(i)*sin(about)*spin, cos(i)*spin);
      experiment(stop = 1 s, tolerance = 1e-11);
    end Sphere;
    """


def _down(result: frot.Result, incline: float, about: float) -> float:
    flat = math.cos(incline)
    way = (flat * math.cos(about), flat * math.sin(about), -math.sin(incline))
    return float(np.dot(way, last(result, *(f"b.velocity.{c}" for c in "xyz"))))


@pytest.mark.parametrize("about", [0, 1.1, -2.5])
@pytest.mark.parametrize("spin", [0, 2, -2])
@pytest.mark.parametrize(
    ("incline", "f", "f1"),
    [(0.04, 0.3, 0.05), (0.3, 0.3, 0.05), (0.75, 0.3, 0.05), (0.9, 0.3, 0.05), (0.3, 0.1, 0.02)],
)
def test_a_sphere_at_rest_on_a_slope_rests_rolls_or_slides(
    incline: float, f: float, f1: float, spin: float, about: float
) -> None:
    """P. 110: rests where tan i < f1, rolls where tan i < 7/2 f - 5/2 f1, else slides and rolls.

    Its spin about the normal ends by itself, K^2 r' = -f' g cos i.
    """
    result = model(SPHERE).simulate(
        parameters={"i": f"{incline} rad", "about": f"{about} rad", "f": f, "f1": f1,
                    "spin": f"{spin} rad/s"}
    )  # fmt: skip
    slope, load = math.tan(incline), G * math.cos(incline)
    speed = _down(result, incline, about)
    if slope < f1:
        assert last(result, *(f"b.velocity.{c}" for c in "xyz")) == [0, 0, 0]
    elif slope < 3.5 * f - 2.5 * f1:
        assert speed == pytest.approx(5 / 7 * load * (slope - f1), rel=1e-10)
        assert last(result, "c.mode") == [1]
    else:
        assert speed == pytest.approx(load * (slope - f), rel=1e-10)
        size = math.hypot(*last(result, *(f"b.angular_velocity.{c}" for c in "xyz")))
        about_normal = max(abs(spin) - 0.1 * f1 * load / (0.4 * 0.2), 0)
        rolling = load * (f - f1) / (0.4 * 0.2)
        assert size == pytest.approx(math.hypot(rolling, about_normal), rel=1e-10)
    if spin:
        ends = 0.4 * 0.2 * abs(spin) / (0.1 * f1 * load)
        found = [event.time for event in result.events if abs(event.time - ends) < 1e-9 * ends]
        assert len(found) == (ends < 1)
