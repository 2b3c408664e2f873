"""Faces of boxes and sides of cylinders end: what cannot part and comes there is told by name."""

from __future__ import annotations

import numpy as np
import pytest

import frot

ON_FACE = """model OnFace "Something slides over a box that stands anywhere"
  parameter Angle lean = 0;
  parameter Velocity vx = 1 m/s;
  parameter Velocity vy = 0 m/s;
  world(gravity = 0 m/s^2);
  frame f on ground at (1, 2, 3) m rotated(axis = (1, 2, 3), angle = lean);
  body block: {block};
  liaison weld: encastrement(f, block);
  {thing}
initial
  guess(p.position = f.position + 0.15 m*f.ex + 0.1 m*f.ey + {height}*f.ez);
  dot(p.velocity, f.ex) = vx;
  dot(p.velocity, f.ey) = vy;
  experiment(stop = 1 s);
end OnFace;"""
BOX = "box(mass = 1 kg, size = (1, 0.6, 0.2) m)"
POINT = "body p: particle(mass = 1 kg); liaison L: point_surface({});"
BALL = "body p: sphere(mass = 1 kg, radius = 0.2 m); liaison L: {};"
LYING = (
    "body p: cylinder(mass = 1 kg, radius = 0.1 m, length = 3 m); "
    "frame g on p rotated(axis = x, angle = 90 deg); liaison L: roulement(p.side, block.top);"
)


def left(text: str, given: dict[str, float]) -> tuple[float, str]:
    with pytest.raises(frot.SimulationError, match="E0906") as told:
        frot.compile(text).simulate(parameters=given)
    assert told.value.result is not None
    return told.value.result.time[-1], str(told.value)


@pytest.mark.parametrize(
    ("thing", "height"),
    [
        (POINT.format("p, block.top"), "0.1 m"),
        (BALL.format("contact_ponctuel(p.surface, block.top, unilateral = false)"), "0.3 m"),
        (BALL.format("roulement(block.top, p.surface)"), "0.3 m"),
    ],
)
def test_what_slides_over_the_border_of_a_face_ends_there(thing: str, height: str) -> None:
    """At 0.5 m along x, or 0.3 m along y, whichever comes first."""
    text = ON_FACE.format(block=BOX, thing=thing, height=height)
    for lean in (0.0, 2.0):
        for vx, vy in ((1.0, 0.0), (-1.0, 0.1), (0.3, -0.9)):
            t, told = left(text, {"lean": lean, "vx": vx, "vy": vy})
            ways = [
                ((s * half - place) / v)
                for place, half, v in ((0.15, 0.5, vx), (0.1, 0.3, vy))
                for s in (1, -1)
                if v != 0
            ]
            assert t == pytest.approx(min(x for x in ways if x > 0), abs=1e-9)
            assert "liaison 'L' leaves 'block.top'" in told


def test_a_ball_leaves_the_side_of_a_cylinder_at_its_end() -> None:
    thing = BALL.format("contact_ponctuel(p.surface, block.side, unilateral = false)")
    text = ON_FACE.format(
        block="cylinder(mass = 1 kg, radius = 0.2 m, length = 1 m)", thing=thing, height="0.3 m"
    ).replace("f.ex) = vx", "f.ez) = vx")
    t, told = left(text, {"lean": 1.0})
    assert t == pytest.approx(0.2, abs=1e-9)
    assert "leaves 'block.side'" in told


def test_what_lies_along_a_line_reaches_beyond_a_face() -> None:
    """A long roller on a block: its middle may be beside the block."""
    text = ON_FACE.format(block=BOX, thing=LYING, height="0.2 m").replace(
        "dot(p.velocity, f.ex) =",
        "guess(p.orientation = (cos(pi/4), sin(pi/4), 0, 0));\n  dot(p.velocity, f.ex) = 0.2*",
    )
    text = text.replace("0.1 m*f.ey", "0.9 m*f.ey")
    result = frot.compile(text).simulate()
    assert result.time[-1] == 1
    assert np.ptp(result["p.position.x"]) == pytest.approx(0.2, abs=1e-9)
