"""A rim on a straight rail: one of two tangent curves may be straight, whichever it is."""

from __future__ import annotations

from math import cos, sqrt

import numpy as np
import pytest

import frot

G, R = 9.81, 0.3
TEXT = """
model RimOnALine
  parameter Mass m = 1 kg;
  parameter Real lean = 0;
  parameter Velocity along = 1 m/s;
  body w: disc(mass = m, radius = 0.3 m);
  frame base on ground at ({place}) m rotated(axis = z, angle = {turned});
  curve rail on base: line(through = (0.2, 0, 0) m, direction = ({direction}, 0, 0));
  frame wheel on w at (0, 0, 0) m;
  liaison touch: courbe_courbe({figures});
  output Length height = w.position.z;
initial
  w.position = base.position + 0.3 m*sin(lean)*base.ey + 0.3 m*cos(lean)*base.ez;
  wheel.ey = sin(lean)*base.ey + cos(lean)*base.ez;
  guess(w.orientation = (cos({turned}/2)*cos(45 deg), cos({turned}/2)*sin(45 deg),
                         sin({turned}/2)*sin(45 deg), sin({turned}/2)*cos(45 deg)));
  w.velocity = along*base.ex;
  w.angular_velocity = 4 rad/s*wheel.ez;
  experiment(stop = 0.4 s, tolerance = 1e-10);
end RimOnALine;
"""


def scene(figures: str, place: str = "0, 0, 0", turned: float = 0, direction: int = 1) -> str:
    """The text with its figures in an order, where the rail lies, and how it is run along."""
    return TEXT.format(figures=figures, place=place, turned=turned, direction=direction)


@pytest.mark.parametrize("figures", ["rail, w.rim", "w.rim, rail"])
def test_a_wheel_stands_in_the_plane_of_the_line(figures):
    """Nothing tips it, and without friction nothing slows it."""
    run = frot.compile(scene(figures)).simulate()
    assert run["height"] == pytest.approx(R, rel=1e-12)
    assert run["w.velocity.x"] == pytest.approx(1, rel=1e-12)
    assert run["w.position.x"][-1] == pytest.approx(run.time[-1], rel=1e-12)


@pytest.mark.parametrize("figures", ["rail, w.rim", "w.rim, rail"])
@pytest.mark.parametrize("place", [("0, 0, 0", 0, 1), ("2, -1, 0", 0.9, -1)])
def test_a_leaning_wheel_falls_about_the_line(figures, place):
    """Its plane keeps the line, so that its spin does nothing: (5/4) m R^2 about the line falls."""
    model = frot.compile(scene(figures, *place))
    for mass, along in ((1.0, 1.0), (1e6, -2.0)):
        run = model.simulate(parameters={"lean": 0.2, "m": mass, "along": along})
        level = float(place[0].split(",")[2])
        height = run["height"] - level
        fallen = G * (R * cos(0.2) - height)
        across = run["w.velocity.z"] / np.sqrt(1 - (height / R) ** 2)
        assert across**2 / R**2 * 1.25 * R**2 / 2 == pytest.approx(fallen, abs=1e-8)
        assert height[-1] < 0.9 * R
        ends = [run[f"w.velocity.{c}"][-1] for c in "xy"]
        assert sqrt(ends[0] ** 2 + ends[1] ** 2) >= abs(along) * (1 - 1e-9)
