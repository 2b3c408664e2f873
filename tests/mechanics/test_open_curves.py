"""Open contacts of curves that bend inwards: what is nearest is seen along the whole curve."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

A, B, G = 1.0, 0.6, 9.81


def bowl() -> str:
    turned = "({0}*cos(lean) - {1}*sin(lean), {0}*sin(lean) + {1}*cos(lean))"
    wall = turned.format(f"{A} m*cos(u)", f"{B} m*sin(u)")
    return f"""planar model Bowl "A particle thrown inside of an ellipse"
  parameter Length x = 0 m;
  parameter Length y = 0 m;
  parameter Velocity vx = 0 m/s;
  parameter Velocity vy = 0 m/s;
  parameter Angle lean = 0;
  world(gravity = 0 m/s^2);
  body p: particle(mass = 2 kg);
  curve wall on ground: parametric({wall}, u = (0, 2*pi), periodic = true);
  force weight: on(p, value = {2 * G} N*(sin(lean), -cos(lean)));
  liaison C: point_courbe(p, wall, unilateral = true) with coulomb(0.2);
initial
  p.position = {turned.format("x", "y")};
  p.velocity = {turned.format("vx", "vy")};
  experiment(stop = 5 s);
end Bowl;"""


@pytest.fixture(scope="module")
def thrown() -> frot.Model:
    return frot.compile(bowl())


def meets(x: float, y: float, u: float, v: float) -> float:
    """When the parabola first comes to the ellipse."""
    place = np.polynomial.Polynomial([x, u]), np.polynomial.Polynomial([y, v, -G / 2])
    outside = (place[0] / A) ** 2 + (place[1] / B) ** 2 - 1
    roots = outside.roots()
    return min(r.real for r in roots if abs(r.imag) < 1e-9 and r.real > 1e-9)


@pytest.mark.parametrize("lean", [0.0, 2.2])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_a_particle_meets_the_wall_wherever_it_is_thrown(
    thrown: frot.Model, lean: float, tolerance: float
) -> None:
    """Straight across too, where the place that is followed stays behind it all the way."""
    throws = [(0.0, -0.55, 0.0, 6.0), (0.1, -0.5, 0.0, 9.0), (-0.8, 0.0, 8.0, 2.0)]
    throws += [(0.3, 0.2, -7.0, 1.0), (0.0, 0.0, 0.5, 0.1), (0.0, -0.55, 1.0, 4.5)]
    for x, y, u, v in throws:
        given = {"x": x, "y": y, "vx": u, "vy": v, "lean": lean}
        first = thrown.simulate(tolerance=tolerance, parameters=given).events[0]
        assert first.kind == "impact"
        assert first.time == pytest.approx(meets(x, y, u, v), abs=1e-13 + tolerance)


def test_the_gap_is_that_to_the_nearest_place_at_every_time(thrown: frot.Model) -> None:
    """Inside of a step too: the instant is found at which another place comes to be nearer."""
    angles = np.linspace(-np.pi, np.pi, 200_001)
    wall = np.array([A * np.cos(angles), B * np.sin(angles)])
    for x, y, u, v in [(0.0, -0.55, 0.0, 6.0), (-0.8, 0.0, 8.0, 2.0)]:
        given = {"x": x, "y": y, "vx": u, "vy": v, "lean": 0.0}
        end = meets(x, y, u, v)
        result = thrown.simulate(parameters=given, tolerance=1e-6, stop=0.99 * end)
        places = np.array([result["p.position.x"], result["p.position.y"]]).T
        apart = np.array([np.hypot(*(wall - p[:, None])).min() for p in places])
        assert np.abs(np.abs(result["C.gap"]) - apart).max() < 1e-6
        here = np.array([A * np.cos(result["C.u"]), B * np.sin(result["C.u"])])
        assert np.abs(np.hypot(*(here - places.T)) - apart).max() < 1e-6


def test_an_ellipse_falls_across_a_ring() -> None:
    """From touching the top, without a speed, onto the bottom: its lowest point falls freely."""
    text = """planar model Across
  parameter Angle turned = 0.4 rad;
  body e: ellipse(mass = 2 kg, a = 30 cm, b = 20 cm);
  curve ring on ground: circle(radius = 1 m);
  liaison C: contact_ponctuel(ring, e.rim);
initial
  e.angle = turned;
  guess(e.position.y = 0.7 m);
  e.position.x = 0 m;
  C.gap = 1e-3 m;
  experiment(stop = 1 s, tolerance = 1e-10);
end Across;"""
    model = frot.compile(text)
    for turned in (0.0, math.pi / 2, 0.4):
        result = model.simulate(parameters={"turned": turned})
        assert result.events[0].kind == "impact"
        hit = result.events[0].time
        t = result.time[result.time < hit]
        y = result["e.position.y"][: len(t)]
        assert np.abs(y - (y[0] - G / 2 * t**2)).max() < 1e-9
        # the ring and the ellipse are alike above and below
        at = result.at(hit)
        assert at["e.position.y"] == pytest.approx(-y[0], abs=5e-3)
        assert abs(at["C.gap"]) < 1e-9


def test_what_flies_beyond_the_end_of_a_curve_goes_on() -> None:
    """A curve that has ends is left while the contact is open; E0906 is of what is on it."""
    text = f"""planar model Beside
  curve arc on ground: parametric((1 m*u, 0.3 m*u^2), u = (-1, 1));
  body p: particle(mass = 1 kg);
  world(gravity = {G} m/s^2);
  liaison C: point_courbe(p, arc, unilateral = true);
initial
  p.position = (0.2, 0.6) m;
  p.velocity = (4, 3) m/s;
  experiment(stop = 0.35 s);
end Beside;"""
    result = frot.compile(text).simulate()
    assert result["p.position.x"][-1] == pytest.approx(0.2 + 4 * 0.35, rel=1e-9)
