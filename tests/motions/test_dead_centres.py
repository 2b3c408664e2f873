"""Motions from an exact dead centre and from places 1e-9 rad beside it.

A row that is zero in the dead centre says nothing of accelerations; at order 2 it contradicts rest,
so that friction is at its bound from the first instant on, as it is beside the dead centre.
"""

from __future__ import annotations

import math

import pytest
from test_planar_motions import compiled, word

TRAMMEL = """
planar model Trammel
  world(gravity = 0 m/s^2);
  parameter Angle tilt = 0;
  parameter Angle aside = 0;
  parameter Real scale = 1;
  body rod: rod(mass = 1 kg*scale, length = 0.1 m);
  curve one on ground: line(through = (0, 0) m, direction = (cos(tilt), sin(tilt)));
  curve two on ground: line(through = (0, 0) m, direction = (-sin(tilt), cos(tilt)));
  liaison a: point_courbe(rod.start, one) with coulomb(0.001);
  liaison b: point_courbe(rod.tip, two) with coulomb(0.36);
  force turn: couple(rod, value = 3 N.m*scale*(1 + 0.1*sin(time*20 rad/s)));
initial
  rod.start.position = (-cos(aside)*cos(tilt)*0.1 m, -cos(aside)*sin(tilt)*0.1 m);
  rod.angle = tilt + aside;
  rod.angular_velocity = 0 rad/s;
  experiment(stop = 0.5 s);
end Trammel;
"""

CRANK = """
planar model Crank
  world(gravity = g);
  parameter Acceleration g = 0 m/s^2;
  parameter Angle aside = 0;
  parameter Torque motor = 5 N.m;
  body arm: rod(mass = 1 kg, length = 0.1 m);
  body link: rod(mass = 1 kg, length = 0.3 m);
  body piston: particle(mass = 0.5 kg);
  curve bore on ground: line(through = (0, 0) m, direction = (1, 0));
  liaison O: rotoide(ground, arm.start) with coulomb(0.1, radius = 1 cm);
  liaison A: rotoide(arm.tip, link.start) with coulomb(0.1, radius = 1 cm);
  liaison B: rotoide(link.tip, piston) with coulomb(0.1, radius = 1 cm);
  liaison C: point_courbe(piston, bore) with coulomb(0.1);
  force turn: couple(arm, value = motor + time*@ N.m/(1 s));
initial
  arm.angle = aside;
  arm.angular_velocity = 0 rad/s;
  guess(link.angle = 0);
  experiment(stop = 0.5 s);
end Crank;
"""


@pytest.mark.parametrize("scale", [1.0, 1e6])
@pytest.mark.parametrize("tilt", [0.0, 1.0, -2.5])
def test_a_trammel_leaves_its_dead_centre_as_its_neighbours(tilt: float, scale: float) -> None:
    found = {}
    for aside, right in ((0.0, "+2+"), (1e-9, "++"), (-1e-9, "-+")):
        values = {"tilt": tilt, "aside": aside, "scale": scale}
        motions = list(compiled(TRAMMEL).motions(parameters=values))
        assert [word(m) for m in motions] == [right]
        found[aside] = motions[0]["rod.angular_acceleration"]
    assert found[1e-9] == pytest.approx(found[0.0], rel=1e-6)
    assert found[-1e-9] == pytest.approx(found[0.0], rel=1e-6)


@pytest.mark.parametrize("g", [0.0, 9.81])
def test_a_dry_crank_leaves_its_dead_centre_as_its_neighbours(g: float) -> None:
    text = CRANK.replace("@", "1")
    found = {}
    for aside in (0.0, 1e-9, -1e-9):
        motions = list(compiled(text).motions(parameters={"g": g, "aside": aside}))
        assert len(motions) == 1, aside
        slides = [law for law in motions[0].laws if law.liaison == "C"]
        assert slides[0].moving and slides[0].since == (2 if aside == 0 else 0)
        assert slides[0].direction == ((1.0,) if aside < 0 else (-1.0,))
        found[aside] = motions[0]["arm.angular_acceleration"]
    assert found[1e-9] == pytest.approx(found[0.0], rel=1e-6)
    assert found[-1e-9] == pytest.approx(found[0.0], rel=1e-6)


def test_the_greatest_couple_of_rest_is_that_of_the_neighbours() -> None:
    """A heavy crank of constant couple rests up to 1.0041492 N.m, in and beside its dead centre."""
    text = CRANK.replace("@", "0")

    def rests(couple: float, aside: float) -> bool:
        values = {"g": 9.81, "aside": aside, "motor": couple}
        (motion,) = compiled(text).motions(parameters=values)
        return all(x == 0 for x in motion.accelerations.values())

    for aside in (0.0, 1e-9, -1e-9):
        low, high = 1.0, 1.1
        assert rests(low, aside) and not rests(high, aside)
        while high - low > 1e-8:
            middle = (low + high) / 2
            low, high = (middle, high) if rests(middle, aside) else (low, middle)
        assert math.isclose(low, 1.0041492, abs_tol=2e-6)
