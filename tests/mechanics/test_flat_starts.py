"""Loops that start in a singular posture with speed: they go the way that the speeds say, or the
message tells which speed would say it."""

from __future__ import annotations

import math

import casadi as ca
import pytest
from four_bars import G, one_line
from scipy.integrate import quad

import frot

FLAT = """
planar model Flat "A four-bar whose links all lie on one line, which may lean"
  parameter Length a = 1 m;
  parameter Length b = 1 m;
  parameter Length c = 2 m;
  parameter Length g = 2 m;
  parameter Angle lean = 0;
  parameter AngularVelocity w = 1 rad/s;
  parameter AngularVelocity f = 1 rad/s;
  world(gravity = 0 m/s^2);
  body crank: rod(mass = 1 kg, length = a);
  body coupler: rod(mass = 1 kg, length = c);
  body follower: rod(mass = 1 kg, length = b);
  frame far on ground at (g*cos(lean), g*sin(lean));
  liaison A: rotoide(ground, crank.start);
  liaison B: rotoide(crank.tip, coupler.start);
  liaison C: rotoide(coupler.tip, follower.tip);
  liaison D: rotoide(far, follower.start);
  force G1: on(crank, value = 9.81 N*(sin(lean), -cos(lean)));
  force G2: on(coupler, value = 9.81 N*(sin(lean), -cos(lean)));
  force G3: on(follower, value = 9.81 N*(sin(lean), -cos(lean)));
initial
  crank.angle = lean;
  guess(coupler.angle = lean, follower.angle = lean);
  crank.angular_velocity = w;
  SPEED
  experiment(stop = 1 s);
end Flat;
"""


@pytest.fixture(scope="module")
def guessed() -> frot.Model:
    return frot.compile(FLAT.replace("SPEED", "guess(follower.angular_velocity = f);"))


@pytest.fixture(scope="module")
def stated() -> frot.Model:
    return frot.compile(FLAT.replace("SPEED", "follower.angular_velocity = f;"))


def ways(a: float, b: float, c: float, g: float) -> list[float]:
    """Rates of the follower over the crank's with which the flat loop goes on: twice differentiated
    a + c = g + b says a x^2 + c y^2 = b z^2, where a x + c y = b z for the speeds across."""
    p, q, r = b * b - b * c, -2 * a * b, a * c + a * a
    root = math.sqrt(q * q - 4 * p * r)
    return [(-q + side * root) / (2 * p) for side in (1, -1)]


def energies(a: float, b: float, c: float, g: float, side: int) -> ca.Function:
    """Twice the kinetic energy at unit crank speed and the potential, by the crank's angle x, with
    their slopes; the follower's speed."""
    x = ca.SX.sym("x")
    kinetic, potential, end = one_line(a, b, c, g, x, side)
    both, end_rate = ca.vertcat(kinetic, potential), ca.jacobian(end, x)
    return ca.Function("energies", [x], [both, ca.jacobian(both, x), end_rate[1] / b])


@pytest.mark.parametrize("lean", [0.0, -2.1])
@pytest.mark.parametrize(
    ("a", "b", "g", "w"),
    [(0.625, 1.75, 0.875, 6.0), (1.0, 2.125, 1.375, -9.0), (0.375, 1.625, 1.25, -9.0)],
)
def test_a_flat_four_bar_goes_the_way_that_is_guessed(
    guessed: frot.Model, a: float, b: float, g: float, w: float, lean: float
) -> None:
    """When the crank has turned by 1.5 rad, by quadrature; its acceleration in the flat posture."""
    c = b + g - a
    for side in (1, -1):
        of = energies(a, b, c, g, side)
        values, slopes, rate = (x.full().ravel() for x in of(0))
        assert min(abs(rate[0] - way) for way in ways(a, b, c, g)) < 1e-9
        energy = values[1] + values[0] * w**2 / 2

        def slowness(x: float, of: ca.Function = of, energy: float = energy) -> float:
            twice, height = of(x)[0].full().ravel()
            return math.sqrt(twice / (2 * (energy - height)))

        end = math.copysign(1.5, w)
        t = quad(slowness, *sorted((0, end)), epsabs=1e-14, epsrel=1e-13, limit=200)[0]
        acceleration = -(slopes[0] * w**2 / 2 + slopes[1]) / values[0]
        given = {"a": a, "b": b, "c": c, "g": g, "lean": lean, "w": w, "f": 1.1 * rate[0] * w}
        for tolerance in (1e-5, 1e-8, 1e-11, 1e-13):
            result = guessed.simulate(stop=t, tolerance=tolerance, parameters=given)
            assert abs(result.at(t)["crank.angle"] - lean - end) < 100 * tolerance + 3e-11
            first = result.at(0.0)["crank.angular_acceleration"]
            assert abs(first - acceleration) < 1e-10 * (w**2 + (rate[0] * w) ** 2)


def test_speeds_that_say_one_way_are_gone_along(stated: frot.Model) -> None:
    """Without gravity a parallelogram turns evenly, from the flat posture too, slow or fast."""
    model = frot.compile(
        FLAT.replace("SPEED", "follower.angular_velocity = f;").replace("9.81", "0")
    )
    for lean in (0.0, 0.7, 3.0):
        for w in (1.0, -250.0, 1e-3):
            given = {"lean": lean, "w": w, "f": w}
            now = model.simulate(stop=1.3 / abs(w), parameters=given).at(1.3 / abs(w))
            for leg in ("crank", "follower"):
                assert abs(now[f"{leg}.angle"] - lean - math.copysign(1.3, w)) < 1e-11
    with pytest.raises(frot.FrotError) as told:
        stated.simulate(parameters={"w": 1.0, "f": 0.5})
    assert told.value.diagnostics[0].code == "E0910"
    assert "liaison 'D'" in str(told.value)
    assert "no motion begins there with the speeds that are stated" in str(told.value)


@pytest.mark.parametrize("dry", ["A", "D", "BD", "ABCD"])
@pytest.mark.parametrize("speed", [0.0, 1.0])
def test_what_friction_does_there_is_told(dry: str, speed: float) -> None:
    """The reactions that friction follows have no limit next to the posture: no way is looked for,
    at rest where friction does not hold, nor in motion, and the posture is named, not a jam."""
    text = FLAT.replace("SPEED", "follower.angular_velocity = f;")
    for pin in dry:
        end = text.index(";", text.index(f"liaison {pin}:"))
        text = text[:end] + " with coulomb(0.3, radius = 5 mm)" + text[end:]
    model = frot.compile(text)
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        with pytest.raises(frot.FrotError, match=r"E0910.* at the start, t = 0, relations"):
            model.simulate(tolerance=tolerance, parameters={"w": speed, "f": speed})


def test_what_would_say_the_way_is_told() -> None:
    """The coupler would go on with the crank's rate less 1, or less 3."""
    model = frot.compile(FLAT.replace("SPEED", ""))
    with pytest.raises(frot.FrotError) as told:
        model.simulate()
    assert told.value.diagnostics[0].code == "E0910"
    assert "liaison 'D'" in str(told.value)
    assert "the rate of B.angle may be -1 or -3" in str(told.value)
    assert "guess it" in str(told.value)


def test_a_crank_and_a_rod_as_long_turn_together_where_the_slide_is_on_the_pin() -> None:
    """A pendulum of two rods of 1 m side by side: 2/3 th'' = -g cos(th), the slide at rest."""
    text = """
planar model Folded
  parameter Angle from = -90 deg;
  parameter AngularVelocity w = 2 rad/s;
  body crank: rod(mass = 1 kg, length = 1 m);
  body bar: rod(mass = 1 kg, length = 1 m);
  body slide: box(mass = 2 kg, size = (0.2, 0.1) m);
  liaison A: rotoide(ground, crank.start);
  liaison B: rotoide(crank.tip, bar.start);
  liaison C: rotoide(bar.tip, slide);
  liaison D: prismatique(ground, slide);
initial
  crank.angle = from;
  guess(bar.angle = from + 180 deg);
  crank.angular_velocity = w;
  bar.angular_velocity = w;
  experiment(stop = 1 s);
end Folded;
"""
    model = frot.compile(text)
    for tolerance in (1e-6, 1e-9, 1e-12):
        result = model.simulate(tolerance=tolerance)
        energy = 2 * result["crank.kinetic_energy"] + 2 * G * result["crank.position.y"]
        assert abs(energy - energy[0]).max() < 100 * tolerance + 1e-10
        assert abs(result["slide.position.x"]).max() < 1e-12


def test_in_space_rows_that_depend_for_good_say_nothing_of_the_way() -> None:
    """A planar loop in space keeps three relations twice, and one more where it is flat."""
    text = """
model Space
  parameter Angle turn = 0.8;
  world(gravity = 0 m/s^2);
  body l: rod(mass = 1 kg, length = 1 m);
  body t: rod(mass = 1 kg, length = 2 m);
  body r: rod(mass = 1 kg, length = 1 m);
  frame base on ground rotated(axis = (1, 2, 0.5), angle = turn);
  frame far on base at (2 m, 0 m, 0 m);
  liaison A: rotoide(base, l.start, axis = y);
  liaison B: rotoide(l.tip, t.start, axis = y);
  liaison C: rotoide(t.tip, r.tip, axis = y);
  liaison D: rotoide(far, r.start, axis = y);
initial
  A.angle = 0;
  A.speed = -1.5 rad/s;
  SPEED
  experiment(stop = 1 s);
end Space;
"""
    now = frot.compile(text.replace("SPEED", "D.speed = -1.5 rad/s;")).simulate().at(1.0)
    for leg in "AD":
        assert abs(now[f"{leg}.angle"] + 1.5) < 1e-11
    with pytest.raises(frot.FrotError, match="several motions begin there: the rate of"):
        frot.compile(text.replace("SPEED", "")).simulate()
