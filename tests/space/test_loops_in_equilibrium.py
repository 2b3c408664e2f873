"""A loop of pins in space, whose relations are more than its freedoms, is asked to rest."""

from __future__ import annotations

from math import pi, remainder

import pytest

import frot

TEXT = """
model Loop
  parameter Mass m = 1 kg;
  body a: box(mass = m, size = (1, 0.1, 0.1) m);
  body b: box(mass = m, size = (1, 0.1, 0.1) m);
  body c: box(mass = m, size = (1, 0.1, 0.1) m);
  frame a0 on a at (-0.5, 0, 0) m;
  frame a1 on a at (0.5, 0, 0) m;
  frame b0 on b at (-0.5, 0, 0) m;
  frame b1 on b at (0.5, 0, 0) m;
  frame c0 on c at (-0.5, 0, 0) m;
  frame c1 on c at (0.5, 0, 0) m;
  frame near on ground at (2, 1, 0) m;
  frame far on near at (1.5, 0, 0) m;
  liaison A: rotoide(near, a0, axis = y);
  liaison B: rotoide(a1, b0, axis = y);
  liaison C: rotoide(b1, c0, axis = y);
  liaison D: rotoide(c1, far, axis = y);
initial
  {statements}
  guess(A.angle = 70 deg);
  experiment(stop = 1 ms);
end Loop;
"""
EACH = [f"{x}.angular_acceleration = (0, 0, 0) rad/s^2;" for x in "abc"]


@pytest.mark.parametrize("statements", [EACH[:1], EACH], ids=["of one body", "of all bodies"])
def test_three_links_hang_between_two_pins(statements):
    """The middle one is level; with 2 cos(a) = 0.5 the others stand as they reach.

    Whole turns of the pins are not compared.
    """
    model = frot.compile(TEXT.format(statements=" ".join(statements)))
    for mass in (1.0, 1e6):
        run = model.simulate(parameters={"m": mass})
        angles = [remainder(run[f"{x}.angle"][0], 2 * pi) for x in "ABC"]
        wanted = 1.3181160716528182
        assert angles == pytest.approx([wanted, -wanted, -wanted], abs=1e-9)
        assert [run[f"{x}.speed"][0] for x in "ABC"] == pytest.approx([0, 0, 0], abs=1e-12)
