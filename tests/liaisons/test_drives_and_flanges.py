"""Rods that are drawn out, contacts held at a distance, flanges of points on curves: one text."""

from __future__ import annotations

import numpy as np
import pytest

import frot

TEXT = """
model Drawn "Points on a rod, on curves, a ball over a plane"
  body a: particle(mass = 2 kg);
  body b: box(mass = 1 kg, size = (0.3, 0.2, 0.1) m);
  body ball: sphere(mass = 2 kg, radius = 0.1 m);
  body bead: particle(mass = 2 kg);
  body slide: particle(mass = 3 kg);
  curve round on ground: circle(radius = 0.5 m, normal = z, centre = (5, 0, 0) m);
  curve bar on ground: line(through = (8, 0, 0) m, direction = (0, 2, 0));
  Length x;
  Velocity v;
  liaison t: tige(ground, a, length = 1 m) driven(length = x);
  liaison pair: tige(a, b.corners[1], length = 1 m) driven(length = 1.5 m - 0.5*x);
  liaison over: contact_ponctuel(ground.plane, ball.surface, unilateral = false)
    driven(gap = 0.1 m*sin(3*time/(1 s)));
  liaison ring: point_courbe(bead, round);
  liaison rail: point_courbe(slide, bar);
  output Force pull = t.force.z;
  output Force push = pair.force.x;
  output Force load = over.force.z;
initial
  x = 1 m;
  v = 0.1 m/s;
  guess(a.position = (0.3, 0.2, -0.9) m, b.position = (0.5, 0.4, -1.8) m);
  guess(ball.position = (-3, 0, 0.1) m);
  ring.u = 0.3;
  rail.u = 0 m;
equation
  der(x) = v;
  der(v) = 4 1/s^2*(1 m - x);
  ring.flange.torque = 3 N.m;
  rail.flange.force = -1.5 N;
  experiment(stop = 1 s, tolerance = 1e-11);
end Drawn;
"""


@pytest.fixture(scope="module")
def result() -> frot.Result:
    return frot.compile(TEXT).simulate()


def vectors(result: frot.Result, name: str) -> np.ndarray:
    return np.array([result[f"{name}.{c}"] for c in "xyz"])


def test_a_rod_follows_a_variable_of_the_text(result: frot.Result) -> None:
    """x = 1 + 0.05 sin 2t; m a is what the rods and the weight do."""
    want = 1 + 0.05 * np.sin(2 * result.time)
    assert np.abs(result["x"] - want).max() < 1e-10
    assert np.abs(np.linalg.norm(vectors(result, "a.position"), axis=0) - want).max() < 1e-10
    assert np.abs(result["t.length"] - want).max() < 1e-10
    assert np.abs(result["pair.length"] - (1.5 - want / 2)).max() < 1e-10
    pulls = vectors(result, "t.force") - vectors(result, "pair.force")
    left = 2 * vectors(result, "a.acceleration") - pulls
    assert np.abs(left - 2 * np.array([[0], [0], [-9.81]])).max() < 1e-9
    assert np.abs(np.cross(pulls.T, vectors(result, "a.position").T)).max() > 0.1  # both pull


def test_a_contact_stays_apart_as_time_tells(result: frot.Result) -> None:
    """N = m (g + h'') with h = 0.1 sin 3t."""
    height = 0.1 * np.sin(3 * result.time)
    assert np.abs(result["over.gap"] - height).max() < 1e-12
    assert np.abs(result["load"] - 2 * (9.81 - 9 * height)).max() < 1e-9


def test_flanges_of_points_on_curves_turn_and_push(result: frot.Result) -> None:
    """u'' = T/(m r^2) on a circle, F/m on a line."""
    t = result.time
    assert np.abs(result["ring.u"] - (0.3 + 3 / (2 * 0.25) * t**2 / 2)).max() < 1e-10
    assert np.abs(result["rail.u"] + 0.5 * t**2 / 2).max() < 1e-10
    assert np.abs(result["slide.position.y"] + 0.5 * t**2 / 2).max() < 1e-10
