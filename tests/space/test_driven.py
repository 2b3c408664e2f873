"""Prescribed coordinates: in the tree, in loops, alone; supports that time moves."""

import numpy as np
import pytest

import frot
from tests.space.newton_euler import Link, Place, box, residual, vector
from tests.space.test_loops import AXES, ring

# Of each liaison: its options and the coordinate that is driven.
DRIVEN = {
    "rotoide": (", axis = (0.2, 1, 0.3)", "angle"),
    "prismatique": (", axis = (1, 0.3, -0.5)", "displacement"),
    "verrou": (", axis = (0.5, 1, 0.1)", "displacement"),
    "helicoidale": (", axis = (0.1, 1, 0.2), pitch = 300 mm", "angle"),
    "cardan": (", axis_a = y, axis_b = x", "angle_b"),
    "appui_plan": (", normal = (0.3, 0.1, 1)", "angle"),
}
TIMES = (0.0, 0.31, 0.77, 1.5)


def value(coordinate: str) -> str:
    """A motion of the coordinate, as the text writes it."""
    swing = "0.3*sin(3*time/(1 s)) + 0.4*(time/(1 s))^2"
    return f"({swing})*(1 m)" if coordinate == "displacement" else swing


def swing(t: float) -> float:
    """The same motion."""
    return 0.3 * np.sin(3 * t) + 0.4 * t**2


def pair(kind: str, back: bool) -> str:
    """Two boxes, the first driven from the ground; `back` exchanges its places."""
    options, coordinate = DRIVEN[kind]
    first, sign = (f"g_{kind}, f0", "-") if back else (f"f0, g_{kind}", "")
    if back and kind == "cardan":
        options, coordinate = ", axis_a = x, axis_b = y", "angle_a"
    return f"""
  body p_{kind}: box(mass = 2 kg, size = (0.3, 0.5, 0.7) m);
  body q_{kind}: box(mass = 1 kg, size = (0.4, 0.2, 0.3) m);
  frame g_{kind} on p_{kind} at (0.15, 0.1, 0.35) m rotated(axis = (1, 0, 1), angle = -30 deg);
  frame h_{kind} on p_{kind} at (-0.15, 0.1, -0.35) m rotated(axis = x, angle = 10 deg);
  frame k_{kind} on q_{kind} at (0.2, 0.1, 0.1) m rotated(axis = z, angle = 40 deg);
  liaison A_{kind}: {kind}({first}{options}) driven({coordinate} = {sign}({value(coordinate)}));
  liaison B_{kind}: spherique(h_{kind}, k_{kind});
  output Real a_{kind} = A_{kind}.force.x/(1 N) + B_{kind}.torque.z/(1 N.m);
"""


# Those whose places are exchanged.
BACK = ("prismatique", "helicoidale", "cardan")


def test_each_liaison_driven_obeys_newton_and_euler() -> None:
    """With every reaction, that of the drive among them, and the value that is prescribed."""
    parts = "".join(pair(kind, kind in BACK) for kind in DRIVEN)
    result = frot.compile(
        f"""
model Driven "Two boxes for each liaison"
  frame f0 on ground at (0.1, 0.2, 0.3) m rotated(axis = (1, 2, 3), angle = 20 deg);{parts}
  experiment(stop = 1.5 s, tolerance = 1e-11);
end Driven;
"""
    ).simulate()
    bodies, links = [], []
    base = Place(None, (0.1, 0.2, 0.3))
    for kind, (_, coordinate) in DRIVEN.items():
        back = kind in BACK
        p, q = f"p_{kind}", f"q_{kind}"
        bodies += [box(p, 2, (0.3, 0.5, 0.7)), box(q, 1, (0.4, 0.2, 0.3))]
        first = Place(p, (0.15, 0.1, 0.35))
        links.append(Link(f"A_{kind}", *((first, base) if back else (base, first))))
        far = Place(p, (-0.15, 0.1, -0.35)), Place(q, (0.2, 0.1, 0.1))
        links.append(Link(f"B_{kind}", *far))
        name = "angle_a" if back and kind == "cardan" else coordinate
        for t in TIMES:
            want = -swing(t) if back else swing(t)
            assert result.at(t)[f"A_{kind}.{name}"] == pytest.approx(want, abs=1e-13)
    assert residual(result, bodies, links, TIMES) < 1e-11


def test_a_drive_that_closes_a_loop_moves_as_one_in_the_tree() -> None:
    """Six pins and a driven liaison, once last (it is cut), once first (it is built in)."""
    text = ring("rotoide", 7, 6, [f", axis = {a}" for a in AXES])
    plain = next(x for x in text.splitlines() if "liaison J6" in x)
    options = ", axis_a = y, axis_b = z) driven(angle_b = 0.4*cos(2*time/(1 s)) - 0.4);"
    driven = plain.replace("rotoide", "cardan").split(", axis")[0] + options
    driven += " output Real f = J6.force.x/(1 N);"
    names = [f"b{k}.position" for k in range(1, 7)]
    ends = []
    for written in (
        text.replace(plain, driven),
        text.replace(plain, "").replace("  liaison J0", f"{driven}\n  liaison J0"),
    ):
        result = frot.compile(written).simulate(stop=0.5)
        ends.append(np.concatenate([vector(result.at(0.5), n) for n in names]))
        ends[-1] = np.append(ends[-1], result.at(0.5)["f"])
        for t in (0.0, 0.2, 0.5):
            want = 0.4 * (np.cos(2 * t) - 1)
            assert result.at(t)["J6.angle_b"] == pytest.approx(want, abs=1e-11)
    assert ends[0] == pytest.approx(ends[1], abs=1e-8)


def test_what_is_driven_altogether_has_its_couple() -> None:
    """A rod that swings as told: I a = couple + weight, without any freedom left."""
    result = frot.compile(
        """
model Told "A rod whose angle is given"
  parameter AngularVelocity w = 1 rad/s;
  body b: rod(mass = 1 kg, length = 1 m);
  liaison A: rotoide(ground, b.start, axis = y) driven(angle = sin(w*time));
  output Torque drive = A.torque.y;
  experiment(stop = 2 s, tolerance = 1e-11);
end Told;
"""
    ).simulate(parameters={"w": 1.5})
    for t in (0.0, 0.8, 2.0):
        angle = np.sin(1.5 * t)
        want = -(1.5**2) * angle / 3 - 9.81 * 0.5 * np.cos(angle)
        assert result.at(t)["drive"] == pytest.approx(want, abs=1e-12)


def test_a_bead_on_a_line_that_time_turns() -> None:
    """Painlevé (1895, p. 65) without friction: r'' = (w sin(a))^2 r."""
    result = frot.compile(
        """
model Turning "Bead on a line about Oz"
  parameter AngularVelocity w = 2 rad/s;
  world(gravity = 0 m/s^2);
  body b: particle(mass = 1 kg);
  frame f on ground rotated(axis = z, angle = w*time);
  frame g on f rotated(axis = y, angle = 0.5 rad);
  liaison A: prismatique(g, b, axis = z);
initial
  A.displacement = 1 m;
  A.speed = 0.1 m/s;
  experiment(stop = 2 s, tolerance = 1e-11);
end Turning;
"""
    ).simulate()
    k = 2 * np.sin(0.5)
    want = np.cosh(2 * k) + 0.1 / k * np.sinh(2 * k)
    assert result["A.displacement"][-1] == pytest.approx(want, abs=1e-10)


def test_what_cannot_be_driven_is_told() -> None:
    text = """
model Wrong "A drive"
  body b: rod(mass = 1 kg, length = 1 m);
  liaison A: rotoide(ground, b.start, axis = y) driven({drive});
end Wrong;
"""
    for drive, said in (
        ("angle = 1, angle = 2", "driven twice"),
        ("way = 1", "not a coordinate"),
    ):
        with pytest.raises(frot.FrotError, match=said):
            frot.compile(text.format(drive=drive)).report()
