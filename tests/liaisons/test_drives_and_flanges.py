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


SOURCES = """
model Motor
  RotationalFlange flange;
equation
  flange.torque = -3 N.m;
end Motor;
model M
  body p: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body s: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  curve bent on ground: parametric((1 m*u, 0.2 m*u^2, 0 m), u = (-3, 3));
  curve bar on ground: line(through = (0, 0, 0) m, direction = (3, 0, 4));
  frame high on ground at (0, 0, 0.6) m;
  Real w;
  Motor m1, m2, m3;
  liaison by_time: rotoide(ground, p, axis = y) driven(angle = time^2/(1 s^2));
  liaison by_text: rotoide(ground, q, axis = y) driven(angle = w);
  liaison hook: spherique(high, s.top);
  liaison along: point_courbe(s.bottom, bent);
  body bead: particle(mass = 1 kg);
  liaison slide: point_courbe(bead, bar) driven(abscissa = 1 m/s^2*time^2);
  output Torque one = by_time.torque.y;
  output Torque other = by_text.torque.y;
  output Length way = slide.abscissa;
  output Force push = dot(slide.force, (0.6, 0, 0.8));
  output Force hold = hook.force;
  output Force guide = along.force;
  output Torque effort = along.flange.torque;
initial
  guess(along.u = 0.3);
equation
  w = time^2/(1 s^2);
  connect(m1.flange, by_time.flange);
  connect(m2.flange, by_text.flange);
  connect(m3.flange, along.flange);
  experiment(stop = 0.2 s);
end M;
"""


def test_flanges_push_where_time_drives_and_where_rows_keep_a_curve() -> None:
    """What a motor gives, a drive need not; along a curve that closes a loop it pushes."""
    run = frot.compile(SOURCES).simulate(tolerance=1e-9)
    needed = 2 * (0.3**2 + 0.7**2) / 12 * 2 - 3
    assert run["one"] == pytest.approx(needed, rel=1e-12)
    assert run["other"] == pytest.approx(needed, rel=1e-9)
    assert run["way"] == pytest.approx(run.time**2, abs=1e-15)
    assert run["push"] == pytest.approx(-(2 + 9.81 * 0.8), rel=1e-12)
    at = run.at(0.1)
    hold, guide, gone = (
        np.array([at[f"{x}.{c}"] for c in "xyz"], dtype=float)
        for x in ("hold", "guide", "s.acceleration")
    )
    u = float(at["along.u"])
    along = np.array([1, 0.4 * u, 0])
    left = hold - guide + at["effort"] * along / (along @ along)
    assert left == pytest.approx(2 * gone + np.array([0, 0, 2 * 9.81]), abs=1e-10)


@pytest.mark.parametrize("kind", ["planar model", "model"])
@pytest.mark.parametrize("length", ["", ", length = 1 m"])
def test_a_drive_says_how_long_a_rod_is(kind: str, length: str) -> None:
    """With a length and without one, which a rod that is not driven needs."""
    text = f"""
{kind} Rod
  body p: particle(mass = 1 kg);
  liaison rod: tige(ground, p{length}) driven(length = 1 m + 0.1 m*sin(time/(1 s)));
initial
  guess(p.position.x = 1 m);
  experiment(stop = 0.3 s);
end Rod;
"""
    run = frot.compile(text).simulate()
    assert run["rod.length"] == pytest.approx(1 + 0.1 * np.sin(run.time), abs=1e-12)
    if not length:
        with pytest.raises(frot.FrotError, match=r"E0204.*'tige' needs 'length'"):
            frot.compile(text.replace("driven(length", "driven(gap"))
