"""A wheel wider than its trough meets both sides of it; what cannot part bends like its curve."""

from __future__ import annotations

import numpy as np
import pytest
from frot.runtime.engine import Engine

import frot

TROUGH = """planar model Trough "A wheel of radius r in y = x^2/(2 a), in axes that lean"
  parameter Length r = 1.2 m;
  parameter Length a = 1 m;
  parameter Length x = 0.8 m;
  parameter Angle lean = 0;
  parameter Real mu = 0;
  world(gravity = 0 m/s^2);
  frame f on ground at (1, -2) m rotated(angle = lean);
  body wheel: disc(mass = 2 kg, radius = r);
  curve wall on f: parametric((a*u, a*u^2/2), u = (-3, 3));
  liaison C: contact_ponctuel({places}, unilateral = {parts}) with coulomb(mu);
  force weight: on(wheel, value = 19.62 N*(sin(lean), -cos(lean)));
initial
  guess(wheel.position = (1, -2) m + x*f.ex + (0.1*r + 2*a)*f.ey);
  C.gap = 0 m;
  experiment(stop = 3 s);
end Trough;"""


def place(result: frot.Result, lean: float) -> np.ndarray:
    """Where the centre is at the end, in the axes of the trough."""
    x, y = result["wheel.position.x"][-1] - 1, result["wheel.position.y"][-1] + 2
    return np.array([x * np.cos(lean) + y * np.sin(lean), y * np.cos(lean) - x * np.sin(lean)])


@pytest.mark.parametrize("places", ["wheel.rim, wall", "wall, wheel.rim"])
def test_a_wheel_that_meets_the_other_side_says_so(places: str) -> None:
    """In the middle, where (a u)^2 + (a u^2/2 - Y)^2 = r^2 twice: u^2 = (r/a)^2 - 1."""
    model = frot.compile(TROUGH.format(places=places, parts="true"))
    for given in ({}, {"r": 1.5, "a": 0.7, "lean": 2.0}, {"mu": 0.1, "x": 1.0}):
        r, a, lean = given.get("r", 1.2), given.get("a", 1.0), given.get("lean", 0.0)
        for tolerance in (1e-4, 1e-8, 1e-11, 1e-13):
            with pytest.raises(frot.SimulationError, match=r"E0905.*'C'.*second place") as told:
                model.simulate(tolerance=tolerance, parameters=given)
            result = told.value.result
            assert result is not None
            middle = np.array([0, a * (1 + ((r / a) ** 2 - 1) / 2)])
            assert place(result, lean) == pytest.approx(middle, abs=1e-8)


def test_a_wheel_that_bends_more_rolls_to_and_fro() -> None:
    model = frot.compile(TROUGH.format(places="wheel.rim, wall", parts="true"))
    assert model.simulate(parameters={"r": 0.8}).time[-1] == 3


def test_what_cannot_part_ends_where_it_bends_like_its_curve() -> None:
    """The radius of curvature a (1 + u^2)^(3/2) is r: Huygens' evolute, which has an edge there."""
    model = frot.compile(TROUGH.format(places="wheel.rim, wall", parts="false"))
    for given in ({}, {"r": 1.5, "a": 0.7, "lean": 2.0}):
        r, a, lean = given.get("r", 1.2), given.get("a", 1.0), given.get("lean", 0.0)
        for tolerance in (1e-6, 1e-9, 1e-12):
            with pytest.raises(frot.SimulationError, match=r"E0911.*'C'.*bend alike") as told:
                model.simulate(tolerance=tolerance, parameters=given)
            result = told.value.result
            assert result is not None
            u = np.sqrt((r / a) ** (2 / 3) - 1)
            edge = a * np.array([u, u**2 / 2]) + r * np.array([-u, 1]) / np.sqrt(1 + u**2)
            assert place(result, lean) == pytest.approx(edge, abs=1e-7)


RIM = """model Rim "A ring that cannot part from a tube, turning until it bends as the tube does"
  parameter Length r = 0.4 m;
  world(gravity = 0 m/s^2);
  frame f on ground rotated(axis = (1, 2, 3), angle = 40 deg);
  body d: ring(mass = 1 kg, radius = r);
  surface s on f: cylinder(radius = 0.5 m, axis = x);
  liaison L: {kind};
  force weight: on(d, value = -9.81 N*f.ez);
initial
  guess(d.position = 0.05 m*f.ey + 0.1 m*f.ez);
  guess(d.orientation = (cos(0.5), sin(0.5), 0.2, 0));
  guess(d.angular_velocity = (1, 0.3, 0.2) rad/s);
  experiment(stop = 10 s);
end Rim;"""


@pytest.mark.parametrize(
    "kind", ["contact_ponctuel(d.rim, s, unilateral = false)", "roulement(s, d.rim)"]
)
def test_a_rim_in_a_tube_names_its_liaison(kind: str) -> None:
    with pytest.raises(frot.SimulationError, match=r"E0911.*'L'.*bend alike"):
        frot.compile(RIM.format(kind=kind)).simulate()


def test_a_wheel_that_is_lifted_before_it_meets_the_other_side_meets_nothing() -> None:
    """The step that leads there has run already: it no longer counts."""
    text = TROUGH.format(places="wheel.rim, wall", parts="true").replace(
        "19.62 N*", "(if time < 2 s then down else 0.5*down)*"
    )
    text = text.replace(
        "  parameter Real mu", "  parameter Force down = 19.62 N;\n  parameter Real mu"
    )
    program = frot.compile(text).program()
    engine = Engine(program)
    engine.start(0.0, 1e-8, "rest")
    engine.advance(3.0)
    met = engine.time
    assert "second place" in engine.fault_text
    engine = Engine(program)
    engine.start(0.0, 1e-8, "rest")
    engine.advance(met * (1 - 1e-6))
    engine.set_parameter([p.name for p in program.parameters].index("down"), -1e7)
    assert engine.advance(3.0).status == 0
    assert engine.time == 3
