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


def test_a_parametric_curve_closes_no_loop() -> None:
    text = HELIX.replace("liaison B:", "liaison D: rotoide(ground, b); liaison B:")
    with pytest.raises(frot.FrotError, match="closes a loop"):
        frot.compile(text).report()
