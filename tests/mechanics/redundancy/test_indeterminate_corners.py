"""Reactions that are not unique beside a rest that none of them allows."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@functools.cache
def scene() -> frot.Model:
    """A plate that two rough slots hold, and more of its reactions than is needed, with a bead in a
    corner of it; a rod swings on a dry pin of the plate, and another one on the ground."""
    return frot.compile("""
planar model Held
  world(gravity = g);
  parameter Acceleration g = 10 m/s^2;
  parameter Length size = 1 m;
  parameter Mass heavy = 1 kg;
  parameter Angle turn = 0;
  parameter Angle wedge = 0.3;
  parameter Real mu = 0.6;
  parameter Real sign = 1;
  parameter Angle first = 0.86;
  parameter Angle up = turn + wedge;
  parameter Angle down = turn - wedge;
  parameter Length x = size*cos(turn);
  parameter Length y = size*sin(turn);
  curve one on ground: line(through = (-x, -y), direction = (cos(up), sin(up)));
  curve two on ground: line(through = (x, y), direction = (cos(down), sin(down)));
  body plate: rod(mass = 9*heavy, length = 2*size);
  liaison slot: contact_ponctuel(plate.start, one, unilateral = false) with coulomb(mu);
  liaison other: point_courbe(plate.tip, two, unilateral = false) with coulomb(1.2*mu);
  curve smooth on plate: line(through = (0, 0) m, direction = (cos(turn + 0.4), -sin(turn + 0.4)));
  curve rough on plate: line(through = (0, 0) m, direction = (cos(turn + 0.3), sin(-turn - 0.3)));
  body bead: particle(mass = heavy);
  liaison slide: contact_ponctuel(bead, smooth, unilateral = false) with coulomb(0*time/(1 s));
  liaison stop: contact_ponctuel(bead, rough) with coulomb(0.2, mu_s = 0.3);
  body rod: rod(mass = heavy, length = size);
  body alone: rod(mass = heavy, length = size);
  frame middle on plate at (0, 0) m;
  liaison hung: rotoide(middle, rod.start) with coulomb(0.8, radius = 0.01*size);
  liaison pin: rotoide(ground, alone.start) with coulomb(0.8, radius = 0.01*size);
initial
  plate.position = (0, 0) m;
  plate.angle = turn;
  bead.position = (0, 0) m;
  rod.angle = -1.5707963267948966 + sign*first;
  alone.angle = -1.5707963267948966 + sign*first;
  experiment(stop = 6 s, tolerance = 1e-9);
end Held;
""")


@pytest.mark.parametrize(
    ("mu", "wedge", "turn", "sign", "heavy", "size"),
    [
        (0.88, -0.58, 1.97, 1, 1.0, 1.0),
        (0.88, -0.58, 1.97, -1, 1e6, 1e-3),
        (0.24, 0.75, 2.74, 1, 1e-6, 1.0),
        (0.24, 0.75, 2.74, -1, 1.0, 1e4),
    ],
)
def test_a_pin_turns_back_on_a_redundantly_held_plate(
    mu: float, wedge: float, turn: float, sign: float, heavy: float, size: float
) -> None:
    """The plate does not move, so that the rod on it goes as the one on the ground. That the pin
    sticks no reactions allow; to look for them there left none for where it turns back."""
    values = {"mu": mu, "wedge": wedge, "turn": turn, "sign": sign, "heavy": heavy, "size": size}
    result = scene().simulate(stop=2 * np.sqrt(size), parameters=values)
    assert np.all(result["plate.velocity.x"] == 0)
    assert [e.liaison for e in result.events].count("hung") >= 2
    assert result["rod.angle"] == pytest.approx(result["alone.angle"], abs=1e-11)
