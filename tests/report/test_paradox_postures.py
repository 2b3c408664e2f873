"""Postures in which a paradox is possible, of any contact of plane and space, by closed forms."""

from __future__ import annotations

import re

import numpy as np
import pytest

import frot

TURNED_ROD = """
planar model Rod
  parameter Mass m = 1 kg;
  parameter Length l = 2 m;
  parameter Angle slope = 0 rad;
  parameter Real way = 1;
  body rod: rod(mass = m, length = l);
  curve track on ground: line(through = (3, 1) m, direction = (way*cos(slope), way*sin(slope)));
  liaison foot: contact_ponctuel(track, rod.start) with coulomb(0.5);
initial
  rod.start.position = (3, 1) m;
  rod.angle = slope + 1.1 rad;
end Rod;
"""


def at_angle(a: float) -> float:
    """Painlevé 1895, p. 99: from which coefficient of a uniform rod at the angle a to the line."""
    s, c = np.sin(a), np.cos(a)
    return float((1 + 3 * c * c) / (3 * s * c))


def with_values(text: str, **values: str) -> str:
    """The text with other default values of parameters."""
    for name, value in values.items():
        text, count = re.subn(rf"(parameter \w+ {name} = )[^;]*;", rf"\g<1>{value};", text)
        assert count == 1
    return text


@pytest.mark.parametrize(
    ("way", "slope", "m", "l"),
    [
        ("1", "0 rad", "1e6 kg", "2 m"),
        ("-1", "0.7 rad", "1e-6 kg", "3 mm"),
        ("1", "-2 rad", "1 kg", "4 km"),
        ("-1", "-0.4 rad", "1 kg", "2 m"),
    ],
)
def test_a_rod_on_any_line_from_four_thirds(way: str, slope: str, m: str, l: str) -> None:  # noqa: E741
    text = with_values(TURNED_ROD, way=way, slope=slope, m=m, l=l)
    (rod,) = frot.compile(text).report().analysis.paradoxes
    assert rod.at_start == pytest.approx(at_angle(1.1), rel=1e-9)
    assert rod.least == pytest.approx(4 / 3, rel=1e-6)
    ((_, angle),) = rod.where
    assert abs(np.tan(angle - float(slope.split()[0]))) == pytest.approx(2, rel=3e-3)


def test_only_postures_count_in_which_nothing_else_is_entered() -> None:
    """Below a ceiling at the height h the rod of length 2 m leans by sin(a) <= h/2 at most."""
    text = with_values(TURNED_ROD, way="1").replace(
        "initial",
        """  curve ceiling on ground: line(through = (0 m, 2.2 m), direction = (1, 0));
  liaison above: contact_ponctuel(ceiling, rod.tip);
  liaison below: contact_ponctuel(track, rod.tip);
initial""",
    )
    (rod,) = frot.compile(text.replace("1.1 rad", "0.3 rad")).report().analysis.paradoxes
    assert rod.least == pytest.approx(at_angle(np.arcsin(0.6)), rel=1e-3)
    ((name, angle),) = rod.where
    assert name == "rod.angle" and np.sin(angle) == pytest.approx(0.6, abs=1e-3)


BLOCK = """
planar model Block "On two corners: N1 + N2 is given, and friction tilts it"
  parameter Mass m = 1 kg;
  parameter Real mu = 0.3;
  parameter Real way = 1;
  body block: box(mass = m, size = (0.4, 1) m);
  frame one on block at (-0.2*way*(1 m), -0.5 m);
  frame two on block at (0.2*way*(1 m), -0.5 m);
  liaison front: contact_ponctuel(ground.line, one) with coulomb(mu);
  liaison back: contact_ponctuel(ground.line, two) with coulomb(0.1);
initial
  block.position = (0, 0.5) m;
  block.angle = 0 rad;
end Block;
"""


@pytest.mark.parametrize(("m", "way"), [("1 kg", "1"), ("1e6 kg", "-1"), ("1e-6 kg", "1")])
def test_two_contacts_of_a_block_beside_each_other(m: str, way: str) -> None:
    """N1 + N2 = W, (N2 - N1) w + (f1 + f2) h = 0, f = mu N: singular at mu1 = mu2 + 2 w/h."""
    report = frot.compile(with_values(BLOCK, m=m, way=way)).report()
    front, back = report.analysis.paradoxes
    assert (front.at_start, front.least) == pytest.approx((0.9, 0.9), rel=1e-9)
    assert (back.at_start, back.least) == pytest.approx((1.1, 1.1), rel=1e-9)
    assert (front.beside, back.beside) == (("back",), ("front",))
    assert "with back closed" in str(report)


LADDER = """
planar model Ladder
  parameter Mass m = 1 kg;
  parameter Real mu = 0.2;
  body rod: rod(mass = m, length = 2 m);
  curve wall on ground: line(through = (0, 0) m, direction = (0, 1));
  liaison low: contact_ponctuel(ground.line, rod.start) with coulomb(mu);
  liaison high: contact_ponctuel(wall, rod.tip) with coulomb(0.4);
initial
  rod.start.position = (2 m*cos(1.1), 0 m);
  rod.angle = pi - 1.1;
end Ladder;
"""


def ladder(a: float, mu_wall: float) -> float:
    """The coefficient of the floor at which the normal accelerations do not fix the reactions.

    Rod of half length 1 and mass 1, I = 1/3; its end on the floor at (c, -s) from G, that on the
    wall at (-c, s). Where the first slides out, x x' + y y' = 0 gives the sign of y' of the other.
    A force F at r accelerates the point p by F + (r x F)/I (-p_y, p_x).
    """
    c, s = np.cos(a), np.sin(a)
    low, high = np.array([c, -s]), np.array([-c, s])

    def determinant(mu: float, way: int) -> float:
        columns = []
        for r, f in ((low, (-way * mu, 1)), (high, (1, way * np.sign(c * s) * mu_wall))):
            turn = 3 * (r[0] * f[1] - r[1] * f[0])
            columns.append([f[1] + turn * low[0], f[0] - turn * high[1]])
        return float(np.linalg.det(np.array(columns)))

    found = [np.inf]
    for way in (1, -1):
        zero, one = determinant(0, way), determinant(1, way)
        if zero > 0 and zero > one:
            found.append(zero / (zero - one))
    return min(found)


@pytest.mark.parametrize("m", ["1 kg", "1e6 kg"])
def test_a_ladder_between_floor_and_wall(m: str) -> None:
    """The least coefficient of the floor where both ends slide, or its end alone."""
    low, _ = frot.compile(with_values(LADDER, m=m)).report().analysis.paradoxes
    assert low.at_start == pytest.approx(min(at_angle(1.1), ladder(1.1, 0.4)), rel=1e-9)
    # the points alone are kept out: the rod may stand through the floor
    least = min(ladder(a, 0.4) for a in np.linspace(0.01, 2 * np.pi, 4001))
    assert low.least == pytest.approx(min(least, 4 / 3), rel=1e-3)


ROD_IN_SPACE = """
model Rod
  parameter Mass m = 1 kg;
  parameter Angle turn = 0 rad;
  parameter Angle slope = 0 rad;
  body rod: solid(mass = m, inertia = (m*1e-4*1 m^2, m/12*1 m^2, m/12*1 m^2));
  frame foot on rod at (-0.5, 0, 0) m;
  surface floor on ground: plane(through = (0, 0, 0) m, normal = (sin(slope), 0, cos(slope)));
  liaison stands: contact_ponctuel(floor, foot) with coulomb(0.5);
initial
  foot.position = (0, 0, 0) m;
  rod.orientation = (cos(turn/2)*cos(0.55), sin(turn/2)*sin(0.55),
                     -cos(turn/2)*sin(0.55), sin(turn/2)*cos(0.55));
end Rod;
"""


@pytest.mark.parametrize(("m", "turn"), [("1 kg", "0 rad"), ("1e6 kg", "1 rad")])
def test_a_rod_in_space_slides_in_any_direction(m: str, turn: str) -> None:
    """The worst slip is in the plane of the rod and the normal, as of the rod in the plane."""
    text = with_values(ROD_IN_SPACE, m=m, turn=turn)
    report = frot.compile(text).report()
    (rod,) = report.analysis.paradoxes
    assert rod.at_start == pytest.approx(at_angle(1.1), rel=1e-9)
    assert rod.least == pytest.approx(4 / 3, rel=1e-6)
    w, x, y, z = (value for _, value in rod.where)
    assert abs(2 * (x * z - w * y)) == pytest.approx(2 / np.sqrt(5), abs=1e-3)
    assert "at rod.orientation = (" in str(report)


def test_a_rod_on_a_slope_in_space() -> None:
    text = with_values(ROD_IN_SPACE, slope="0.6 rad")
    (rod,) = frot.compile(text).report().analysis.paradoxes
    assert rod.least == pytest.approx(4 / 3, rel=1e-6)


def test_a_spheroid_in_space_as_the_ellipse_of_its_meridian() -> None:
    """c = x y m/(I + m x^2) of the lowest point (x, -y), I = m (a^2 + b^2)/5; a ball has none."""
    text = """
model Egg
  body egg: ellipsoid(mass = 2 kg, semi_axes = (0.5, 0.1, 0.1) m);
  body ball: sphere(mass = 2 kg, radius = 0.3 m);
  surface floor on ground: plane(through = (0, 0, 0) m, normal = (0, 0, 1));
  liaison lies: contact_ponctuel(floor, egg.surface) with coulomb(0.5);
  liaison rolls: contact_ponctuel(floor, ball.surface) with coulomb(0.5);
initial
  egg.position = (0, 0, 0.1) m;
  ball.position = (3, 0, 0.3) m;
end Egg;
"""
    (egg,) = frot.compile(text).report().analysis.paradoxes
    a = np.linspace(0, np.pi / 2, 100_001)
    y = np.sqrt(0.25 * np.sin(a) ** 2 + 0.01 * np.cos(a) ** 2)
    x = 0.24 * np.sin(a) * np.cos(a) / y
    worst = np.max(x * y / (0.26 / 5 + x * x))
    assert egg.liaison == "lies"
    assert egg.least == pytest.approx(1 / worst, rel=1e-5)
    assert len(egg.where) == 4


def test_a_contact_at_an_edge_in_space_is_left_out() -> None:
    """Beyond the ends of an edge its gap is a constant."""
    text = """
model Coin
  body board: box(mass = 1 kg, size = (0.2, 0.1, 0.02) m);
  body coin: disc(mass = 7 g, radius = 12 mm);
  liaison base: encastrement(ground, board);
  liaison on: contact_ponctuel(coin.rim, board.top) with coulomb(0.4);
initial
  coin.position = (0.04, 0, 0.022) m;
  coin.orientation = (cos(pi/4), sin(pi/4), 0, 0);
end Coin;
"""
    found = frot.compile(text).report().analysis.paradoxes
    assert [x.liaison for x in found] == ["on[1]"]
