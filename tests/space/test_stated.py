"""Liaisons of the user: relations between places and velocities, with their reactions."""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Link, Place, box, residual, vector

TEXT = """
liaison HalfRate(a: frame, b: frame, Real ratio = 0.5) "b turns about z at a part of the rate of a"
  kinematic b.angular_velocity.z - ratio*a.angular_velocity.z = 0;
end HalfRate;

liaison Sphere(a: frame, b: frame, Length away) "b keeps its distance from a"
  geometric norm(b.position - a.position) = away;
end Sphere;

liaison Lean(a: frame, b: frame) "two axes keep their angle, one point its height over time"
  geometric dot(a.ex, b.ey) = 0.3;
  geometric b.position.z = 0.1 m*sin(2*time/(1 s));
end Lean;

model Stated "Boxes held by relations"
  body p: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);
  body r: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body s: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body t: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  frame g on q at (0.1, 0.2, 0.1) m rotated(axis = (1, 2, 3), angle = 0.7);
  frame f on r at (0.1, -0.1, 0.2) m rotated(axis = (3, 1, 1), angle = 0.4);
  frame far on ground at (2, 0, 0) m;
  liaison A: HalfRate(p, g, ratio = 0.25);
  liaison B: Sphere(ground, f, away = 0.8 m);
  liaison C: Lean(ground, s);
  liaison D: tige(far, t, length = 0.8 m);
  liaison E: Sphere(far, t, 0.8 m);
  output Torque u = A.torque.z; output Force v = B.force.x; output Force w = C.force.z;
initial
  p.angular_velocity = (1, 2, 3) rad/s;
  q.angular_velocity.x = 1 rad/s;
  guess(r.position = (0.5, 0.3, -0.4) m, s.orientation = (0.8, 0.1, 0.3, 0.4));
  guess(t.position = (2.5, 0, -0.6) m);
  experiment(stop = 0.5 s, tolerance = 1e-11);
end Stated;
"""


def test_relations_of_the_user_obey_newton_and_euler() -> None:
    """Those between velocities too; one that says what a rod says is redundant and does no harm.

    Of p, which feels a quarter of the couple on q, the ground makes up the rest.
    """
    result = frot.compile(TEXT).simulate()
    bodies = [box(x, 2, (0.3, 0.5, 0.7)) for x in "rs"] + [box("q", 1, (0.4, 0.2, 0.3))]
    ground = Place(None, (0, 0, 0))
    links = [
        Link("A", Place("p", (0, 0, 0)), Place("q", (0.1, 0.2, 0.1))),
        Link("B", ground, Place("r", (0.1, -0.1, 0.2))),
        Link("C", ground, Place("s", (0, 0, 0))),
    ]
    times = (0.0, 0.21, 0.5)
    assert residual(result, bodies, links, times) < 1e-10
    turns = result["q.angular_velocity.z"] - 0.25 * result["p.angular_velocity.z"]
    assert np.abs(turns).max() < 1e-12
    assert np.abs(result["s.position.z"] - 0.1 * np.sin(2 * result.time)).max() < 1e-12
    for at in map(result.at, times):
        away = vector(at, "t.position") - np.array([2, 0, 0])
        assert np.linalg.norm(away) == pytest.approx(0.8, abs=1e-12)


def test_what_a_relation_cannot_hold_is_told() -> None:
    for relation, said in (
        ("geometric b.velocity.x = 0 m/s", "b.velocity"),
        ("kinematic b.acceleration.x = 0 m/s^2", "b.acceleration"),
    ):
        text = f"""
liaison Wrong(a: frame, b: frame)
  {relation};
end Wrong;
model M "One body"
  body p: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  liaison A: Wrong(ground, p);
end M;
"""
        with pytest.raises(frot.FrotError, match=said):
            frot.compile(text).simulate(stop=1)
