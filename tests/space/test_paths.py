"""Curves given by their points in space, on the ground and on bodies, which carry what follows."""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Body, Link, Place, box, place_of, residual, vector

HELIX = """
model Helix "A bead on a helix; a box whose point follows one, and a bead that follows the box"
  body bead: particle(mass = 1 kg);
  body b: box(mass = 2 kg, size = (0.4, 0.2, 0.3) m);
  body c: particle(mass = 0.5 kg);
  frame p on b at (0.1, -0.1, 0.15) m rotated(axis = (1, 2, 3), angle = 0.4);
  frame g on ground at (3, 0, 0) m rotated(axis = (1, 0.2, 0), angle = 0.5);
  curve h on ground: parametric((1 m*cos(u), 1 m*sin(u), 0.3 m*u), u = (-20, 20));
  curve k on g: parametric((1 m*cos(u), 1 m*sin(u), 0.3 m*u^2), u = (-20, 20));
  curve t on p: parametric((0.1 m*cos(u), 0.2 m*sin(u), 0.1 m*u), u = (-20, 20));
  liaison A: point_courbe(bead, h);
  liaison B: point_courbe(p, k);
  liaison C: point_courbe(c, t);
  output Force f = A.force.z + B.force.x + C.force.x;
initial
  B.u = 0.3;
  experiment(stop = 1 s, tolerance = 1e-11);
end Helix;
"""


def test_what_follows_a_curve_obeys_newton_and_euler() -> None:
    """A bead on a helix of radius R that rises by h a radian: u'' = -g h/(R^2 + h^2)."""
    result = frot.compile(HELIX).simulate()
    assert result.at(1)["A.u"] == pytest.approx(-9.81 * 0.3 / 1.09 / 2, abs=1e-12)
    mark = Place("b", (0.1, -0.1, 0.15))
    links = [
        Link("B", mark, Place(None, (0, 0, 0)), lambda at: place_of(at, mark)),
        Link("C", Place("c", (0, 0, 0)), mark, lambda at: vector(at, "c.position")),
    ]
    body = Body("b", 2, box("b", 2, (0.4, 0.2, 0.3)).moments)
    assert residual(result, [body], links, (0.0, 0.4, 1.0)) < 1e-12
    energy = result["energy.kinetic"] + result["energy.potential"]
    assert np.ptp(energy) < 1e-9


LOOP = """
model Loop "A bar whose ends follow a helix, one of them on a turned ball joint"
  parameter Length h = 0.3 m;
  body b: box(mass = 2 kg, size = (0.4, 0.2, 0.3) m);
  body c: box(mass = 2 kg, size = (0.4, 0.2, 0.3) m);
  body base: box(mass = 5 kg, size = (1, 1, 1) m);
  frame p on b at (0.2, 0.1, 0) m;
  frame q on b at (-0.2, 0, 0.1) m;
  frame r on c at (0.2, 0.1, 0) m;
  curve k on base: parametric((1 m*cos(u), 1 m*sin(u), h*u), u = (-20, 20));
  parameter AngularVelocity w = 3 rad/s;
  curve s on base: parametric((1 m*cos(u) + 0.1 m*sin(w*time), 1 m*sin(u), 0.2 m*u^2), u = (-6, 6));
  liaison A: point_courbe(p, k);
  liaison B: point_courbe(q, k);
  liaison C: point_courbe(r, s);
  liaison D: tige(c, b, length = 1.5 m);
  output Force f = A.force.z + B.force.x + C.force.x + D.force.x;
  output Length way = B.u*h;
initial
  guess(A.u = 0.3, B.u = 0.7, C.u = 3);
  guess(b.angular_velocity = (1, 2, 0.5) rad/s);
  guess(base.angular_velocity = (0, 0.2, 0.5) rad/s);
  experiment(stop = 0.5 s, tolerance = 1e-11);
end Loop;
"""


def test_a_parametric_curve_on_a_moving_body_closes_a_loop() -> None:
    """One of the curves swings as time tells; Newton-Euler for all three bodies."""
    result = frot.compile(LOOP).simulate()
    p, q, r = Place("b", (0.2, 0.1, 0)), Place("b", (-0.2, 0, 0.1)), Place("c", (0.2, 0.1, 0))
    base, none = Place("base", (0, 0, 0)), (0, 0, 0)
    links = [Link("D", Place("c", none), Place("b", none))]
    for name, own in (("A", p), ("B", q), ("C", r)):
        links.append(Link(name, own, base, lambda at, own=own: place_of(at, own)))
    bodies = [box(x, 2, (0.4, 0.2, 0.3)) for x in "bc"] + [box("base", 5, (1, 1, 1))]
    assert residual(result, bodies, links, (0.0, 0.2, 0.5)) < 1e-10
    for t in (0.0, 0.3, 0.5):
        at = result.at(t)
        swing, (a, b, c) = 0.1 * np.sin(3 * t), (at[f"{name}.u"] for name in "ABC")
        for own, point in (
            (p, (np.cos(a), np.sin(a), 0.3 * a)),
            (q, (np.cos(b), np.sin(b), 0.3 * b)),
            (r, (np.cos(c) + swing, np.sin(c), 0.2 * c**2)),
        ):
            there = place_of(at, Place("base", point))
            assert np.abs(there - place_of(at, own)).max() < 1e-12, (own, t)
