"""The side of a curve on which a contact begins whose point is on the curve itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

import frot

G = 9.81
ROUND = {
    "disc": ("disc(mass = 20 kg, radius = 0.15 m)", 0.15, 0.15),
    "ellipse": ("ellipse(mass = 20 kg, a = 0.3 m, b = 0.15 m)", 0.3, 0.15),
    "ring": ("ring(mass = 20 kg, radius = 0.15 m)", 0.15, 0.15),
}
ORDERS = ("point, drum.rim", "drum.rim, point")


def on_a_rim(shape: str, order: str) -> frot.Model:
    """A particle at the angle `u` of a fixed rim that leans; `push` is along the outer normal."""
    made, a, b = ROUND[shape]
    return frot.compile(f"""planar model OnRim
  parameter Acceleration g = 0 m/s^2;
  parameter Angle lean = 0;
  parameter Angle u = 0;
  parameter Force push = 0 N;
  world(gravity = g);
  body drum: {made};
  body point: particle(mass = 1 kg);
  frame pin on ground at (0.7, -0.4) m rotated(angle = lean);
  liaison fixed: encastrement(pin, drum);
  liaison rub: contact_ponctuel({order});
  Real nx = cos(u)/{a}/norm((cos(u)/{a}, sin(u)/{b}));
  Real ny = sin(u)/{b}/norm((cos(u)/{a}, sin(u)/{b}));
  force press: on(point, value = push*(nx*cos(lean) - ny*sin(lean), nx*sin(lean) + ny*cos(lean)));
initial
  point.position = (0.7, -0.4) m + {a} m*cos(u)*(cos(lean), sin(lean))
                   + {b} m*sin(u)*(-sin(lean), cos(lean));
  experiment(stop = 10 ms);
end OnRim;""")


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("shape", ["disc", "ellipse"])
@pytest.mark.parametrize("g", [0.0, G])
def test_a_particle_on_the_rim_of_a_disc_is_outside_of_its_matter(
    shape: str, order: str, g: float
) -> None:
    model, (_, a, b) = on_a_rim(shape, order), ROUND[shape]
    for u, lean in ((0.0, 0.0), (90.0, 0.0), (-90.0, 0.3), (200.0, 1.2), (33.0, -2.5)):
        given = {"g": g, "u": math.radians(u), "lean": lean}
        normal = np.array((math.cos(given["u"]) / a, math.sin(given["u"]) / b))
        normal /= np.linalg.norm(normal)
        weight = -g * (normal[0] * math.sin(lean) + normal[1] * math.cos(lean))
        pressed = model.simulate(parameters={**given, "push": -50.0})
        assert pressed.at(0)["rub.normal_force"] == pytest.approx(50 - weight, rel=1e-9)
        drawn = model.simulate(parameters={**given, "push": 50.0})
        assert drawn.at(0)["rub.mode"] == 0
        assert drawn.at(0.01)["rub.gap"] == pytest.approx((50 + weight) / 2 * 1e-4, rel=0.02)


@pytest.mark.parametrize("order", ORDERS)
def test_a_particle_on_a_ring_is_on_the_side_against_gravity_or_within(order: str) -> None:
    model = on_a_rim("ring", order)
    for u, g, out in ((90, G, 1), (-90, G, -1), (0, G, -1), (90, 0, -1), (-90, 0, -1), (40, G, 1)):
        given = {"g": g, "u": math.radians(u), "lean": 0.0}
        pressed = model.simulate(parameters={**given, "push": -out * 50.0})
        weight = g * math.sin(given["u"]) * out
        assert pressed.at(0)["rub.normal_force"] == pytest.approx(50 + weight, rel=1e-9)


LEVER = """planar model Lever
  parameter Angle lean = 0;
  parameter Force push = 5 N;
  world(gravity = 0 m/s^2);
  {drum}
  body lever: solid(mass = 1 kg, inertia = 0.05 kg.m^2);
  frame shoe on lever at ({x}, {y}) m;
  liaison pad: contact_ponctuel({order});
  force press: on(shoe, value = push*(sin(lean), -cos(lean)));
initial
  lever.angle = lean;
  shoe.position = (1, 2) m + 0.15 m*(-sin(lean), cos(lean));
  experiment(stop = 10 ms);
end Lever;
"""
BY_BODY = "body drum: {}; frame pin on ground at (1, 2) m; liaison fixed: encastrement(pin, drum);"
DRUMS = {
    "disc": BY_BODY.format("disc(mass = 20 kg, radius = 0.15 m)"),
    "ring": BY_BODY.format("ring(mass = 20 kg, radius = 0.15 m)"),
    "circle": "curve hoop on ground: circle(radius = 0.15 m, centre = (1, 2) m);",
    "oval": "curve hoop on ground: ellipse(a = 0.4 m, b = 0.15 m, centre = (1, 2) m);",
    "path": "curve hoop on ground: parametric((0.3*cos(u), 0.15*sin(u)) m + (1, 2) m, "
    "u = (0, 2*pi), periodic = true);",
}


@pytest.mark.parametrize("drum", DRUMS)
@pytest.mark.parametrize("swapped", [False, True])
def test_without_gravity_the_shoe_of_a_lever_is_on_the_side_of_its_centre_of_mass(
    drum: str, swapped: bool
) -> None:
    """It presses where G is outside of the rim, and where G is beside the drum below its top."""
    rim = "drum.rim" if drum in ("disc", "ring") else "hoop"
    order = f"{rim}, shoe" if swapped else f"shoe, {rim}"
    places = [(0.0, -0.05)] if drum == "path" else [(0.0, -0.05), (0.6, 0.1)]
    for x, y in places:
        model = frot.compile(LEVER.format(drum=DRUMS[drum], order=order, x=x, y=y))
        for lean in (0.0,) if drum in ("oval", "path") else (0.0, 1.0, -2.2):
            start = model.simulate(parameters={"lean": lean}).at(0)
            assert start["pad.mode"] != 0
            assert start["pad.normal_force"] == pytest.approx(5, rel=1e-9)


@pytest.mark.parametrize("drum", ["ring", "circle", "oval"])
def test_without_gravity_a_lever_inside_of_a_ring_stays_inside(drum: str) -> None:
    rim = "drum.rim" if drum == "ring" else "hoop"
    model = frot.compile(LEVER.format(drum=DRUMS[drum], order=f"shoe, {rim}", x=0, y=0.1))
    pressed = model.simulate(parameters={"push": -5}).at(0)
    assert pressed["pad.normal_force"] == pytest.approx(5, rel=1e-9)
    assert model.simulate(parameters={"push": 5}).at(0)["pad.mode"] == 0


PEG = """planar model Peg
  parameter Acceleration g = 0 m/s^2;
  parameter Angle lean = 0;
  world(gravity = 0 m/s^2);
  frame floor on ground at (3, -2) m rotated(angle = lean);
  {post}
  body plate: solid(mass = 2 kg, inertia = 0.1 kg.m^2);
  curve sole on plate: line(through = (0, -0.2) m, direction = ({sense}, 0));
  liaison rest: contact_ponctuel({order});
  force weight: on(plate, value = 7 N*(sin(lean), -cos(lean)));
initial
  plate.angle = lean;
  plate.position = (3, -2) m + 0.2 m*(-sin(lean), cos(lean));
  experiment(stop = 10 ms);
end Peg;
"""
POSTS = {
    "floor": "",
    "post": "body post: solid(mass = 1 kg, inertia = 1 kg.m^2);"
    "liaison fixed: encastrement(floor, post);",
    "cap": "body post: solid(mass = 1 kg, inertia = 1 kg.m^2);"
    "liaison fixed: encastrement(floor, post);"
    "body cap: solid(mass = 1 kg, inertia = 1 kg.m^2); liaison glued: encastrement(cap, post);",
}


@pytest.mark.parametrize("peg", POSTS)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("gravity", [True, False])
def test_a_plate_lies_with_its_line_on_a_peg_that_is_fixed(
    peg: str, sense: int, gravity: bool
) -> None:
    """The peg is beyond the line from the plate's G, wherever the ground has its origin."""
    for order in (f"{peg}, sole", f"sole, {peg}"):
        text = PEG.format(post=POSTS[peg], sense=sense, order=order)
        if gravity:
            text = text.replace("gravity = 0 m/s^2", "gravity = 3.5 m/s^2").replace("7 N", "0 N")
        for lean in (0.0, 0.4) if gravity else (0.0, 0.4, 2.0, -1.6):
            start = frot.compile(text).simulate(parameters={"lean": lean}).at(0)
            pressed = 7 * math.cos(lean) if gravity else 7.0
            assert start["rest.normal_force"] == pytest.approx(pressed, rel=1e-9)


@pytest.mark.parametrize("clockwise", [False, True])
def test_a_particle_in_the_corner_of_an_angle_iron_is_outside_of_its_sides(clockwise: bool) -> None:
    """The centroid (1.1, 1.1) is on the free side of both inner legs of the L."""
    corners = ["(0, 0)", "(3, 0)", "(3, 1)", "(1, 1)", "(1, 3)", "(0, 3)"]
    sides = {"over": 3, "beside": 4}
    if clockwise:
        corners.reverse()
        sides = {"over": 3, "beside": 2}
    text = f"""planar model Iron
  world(gravity = 0 m/s^2);
  parameter Angle lean = 0;
  body iron: polygon(mass = 1 kg, vertices = ({", ".join(corners)}) m);
  frame pin on ground at (0, 0) m rotated(angle = lean);
  liaison fixed: encastrement(pin, iron);
  body p: particle(mass = 1 kg);
  body q: particle(mass = 1 kg);
  liaison over: contact_ponctuel(p, iron.sides[{sides["over"]}]);
  liaison beside: contact_ponctuel(iron.sides[{sides["beside"]}], q);
  force down: on(p, value = 4 N*(sin(lean), -cos(lean)));
  force left: on(q, value = 6 N*(-cos(lean), -sin(lean)));
initial
  p.position = 0.9 m*(cos(lean), sin(lean)) - 0.1 m*(-sin(lean), cos(lean));
  q.position = -0.1 m*(cos(lean), sin(lean)) + 0.9 m*(-sin(lean), cos(lean));
  experiment(stop = 10 ms);
end Iron;"""
    model = frot.compile(text)
    for lean in (0.0, 0.7, 3.0):
        start = model.simulate(parameters={"lean": lean}).at(0)
        assert start["over.normal_force"] == pytest.approx(4)
        assert start["beside.normal_force"] == pytest.approx(6)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("order", ["rail, runner", "runner, rail"])
def test_a_runner_stands_with_the_middle_of_its_arc_on_a_line(sense: int, order: str) -> None:
    """No gravity: of the arc itself no point tells the side, so its centre of mass does."""
    text = f"""planar model Runner
  world(gravity = 0 m/s^2);
  parameter Angle lean = 0;
  body sledge: solid(mass = 1 kg, inertia = 0.1 kg.m^2);
  curve runner on sledge: parametric((u, u^2 - 0.3) m, u = (-1, 1));
  curve rail on ground: line(through = (2, 1) m, direction = {sense}*(cos(lean), sin(lean)));
  liaison glide: contact_ponctuel({order});
  force press: on(sledge, value = 5 N*(sin(lean), -cos(lean)));
initial
  sledge.angle = lean;
  sledge.position = (2, 1) m + 0.3 m*(-sin(lean), cos(lean));
  experiment(stop = 10 ms);
end Runner;"""
    model = frot.compile(text)
    for lean in (0.0, 1.1, -2.6):
        assert model.simulate(parameters={"lean": lean}).at(0)["glide.normal_force"] == (
            pytest.approx(5, rel=1e-9)
        )
