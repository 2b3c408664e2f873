"""Equations that must be differentiated: written plainly, without hints."""

import math

import numpy as np
import pytest
from scipy.special import ellipk

import frot

PENDULUM = """
model Pendulum "a point on a massless rod, in x and y, with the length as an equation (index 3)"
  parameter Length L = {length} m;
  parameter Acceleration g = 9.81 m/s^2;
  Length x; Length y;
  Real tension(unit = "1/s^2") "over mass and length";
initial
  x = {sign}*L*sin({angle}); y = -L*cos({angle}); der(x) = 0 m/s; der(y) = 0 m/s;
equation
  der(der(x)) = -tension*x;
  der(der(y)) = -tension*y - g;
  x^2 + y^2 = L^2;
  experiment(stop = {stop} s, tolerance = 1e-11);
end Pendulum;
"""


def period(length: float, angle: float) -> float:
    return 4 * math.sqrt(length / 9.81) * float(ellipk(math.sin(angle / 2) ** 2))


@pytest.mark.parametrize(
    ("length", "angle", "sign"), [(1.0, 1.2, 1), (2.5, 2.6, -1), (0.3, 3.1, 1)]
)
def test_a_pendulum_in_x_and_y_keeps_its_period(length: float, angle: float, sign: int) -> None:
    t = period(length, angle)
    text = PENDULUM.format(length=length, angle=angle, sign=sign, stop=2 * t)
    result = frot.compile(text).simulate(interval=t / 2)
    for k in (0, 2, 4):
        assert result["x"][k] == pytest.approx(sign * length * math.sin(angle), abs=1e-6 * length)
    assert result["x"][1] == pytest.approx(-sign * length * math.sin(angle), abs=1e-6 * length)


def test_it_swings_a_thousand_periods_with_its_length() -> None:
    t = period(1.0, 1.5)
    text = PENDULUM.format(length=1.0, angle=1.5, sign=1, stop=1000 * t)
    result = frot.compile(text).simulate(interval=t / 3.3)
    length = np.hypot(result["x"], result["y"])
    assert np.abs(length - 1).max() < 1e-12
    energy = 0.5 * (result["der(x)"] ** 2 + result["der(y)"] ** 2) + 9.81 * result["y"]
    assert np.abs(energy - energy[0]).max() < 1e-6


def test_a_full_turn_passes_through_every_posture() -> None:
    text = PENDULUM.format(length=1.0, angle=0.0, sign=1, stop=5)
    text = text.replace("der(x) = 0 m/s; der(y) = 0 m/s;", "der(x) = 8 m/s; der(y) = 0 m/s;")
    result = frot.compile(text).simulate(interval=0.01)
    assert result["y"].max() > 0.99 and result["y"].min() < -0.99
    energy = 0.5 * (result["der(x)"] ** 2 + result["der(y)"] ** 2) + 9.81 * result["y"]
    assert np.abs(energy - energy[0]).max() < 1e-8


GEARS = """
model Gears "a chain of gears and inertias: one state, whatever its length"
  import Rotational.*;
  parameter Integer n = {n};
  Inertia wheel[n + 1](J = 0.5 kg.m^2);
  Gear gear[n](ratio = {ratio});
  TorqueSource motor;
initial
  wheel[1].angle = 0 rad; wheel[1].speed = 0 rad/s;
equation
  motor.torque = 2 N.m;
  connect(motor.a, wheel[1].a);
  for k in 1:n loop
    connect(wheel[k].b, gear[k].a);
    connect(gear[k].b, wheel[k + 1].a);
  end for;
  experiment(stop = 1 s, tolerance = 1e-10);
end Gears;
"""


@pytest.mark.parametrize(("n", "ratio"), [(1, 3.0), (6, 2.0), (5, -0.5), (30, 0.9)])
def test_a_chain_of_gears_accelerates_as_one(n: int, ratio: float) -> None:
    result = frot.compile(GEARS.format(n=n, ratio=ratio)).simulate()
    reduced = sum(0.5 / ratio ** (2 * k) for k in range(n + 1))
    exact = 2 / reduced * result.time**2 / 2
    scale = np.abs(exact).max()
    assert np.abs(result["wheel[1].angle"] - exact).max() < 1e-11 * scale
    last = result[f"wheel[{n + 1}].angle"]
    assert np.abs(last - exact / ratio**n).max() < 1e-11 * np.abs(last).max()


PLANETARY = """
model Differential
  import Rotational.*;
  Inertia sun(J = 1 kg.m^2); Inertia carrier(J = 2 kg.m^2); Inertia ring(J = 3 kg.m^2);
  Planetary gear(ratio = 2);
  TorqueSource motor;
initial
  sun.speed = 0 rad/s; ring.speed = 0 rad/s; sun.angle = 0 rad; ring.angle = 0 rad;
equation
  motor.torque = 1 N.m;
  connect(motor.a, sun.a);
  connect(sun.b, gear.sun); connect(carrier.a, gear.carrier); connect(ring.a, gear.ring);
  experiment(stop = 2 s, tolerance = 1e-10);
end Differential;
"""


def test_a_planetary_gear_divides_the_motion() -> None:
    result = frot.compile(PLANETARY).simulate()
    # J ws' = 1 - c, Jr wr' = -2 c, Jc wc' = 3 c with 3 wc = ws + 2 wr (c: couple on the sun)
    m = np.array([[1.0, 0, 0, 1], [0, 2.0, 0, -3], [0, 0, 3.0, 2], [1, -3, 2, 0]])
    a = np.linalg.solve(m, np.array([1.0, 0, 0, 0]))
    for name, k in (("sun", 0), ("carrier", 1), ("ring", 2)):
        assert result[f"{name}.speed"][-1] == pytest.approx(2 * a[k], rel=1e-10)


DRIVEN = """
model Crank "a slider crank as plain equations, driven at a given angle"
  Length x; Angle q;
  Force f;
equation
  x = 0.3 m*cos(q) + sqrt((1 m)^2 - (0.3 m*sin(q))^2);
  q = 2 rad/s*time;
  2 kg*der(der(x)) = f;
  experiment(stop = 4 s, tolerance = 1e-10);
end Crank;
"""


def test_the_force_of_a_prescribed_motion_needs_no_state() -> None:
    result = frot.compile(DRIVEN).simulate()
    t = result.time
    h = 1e-4

    def x(t: np.ndarray) -> np.ndarray:
        return 0.3 * np.cos(2 * t) + np.sqrt(1 - (0.3 * np.sin(2 * t)) ** 2)

    numeric = 2 * (x(t + h) - 2 * x(t) + x(t - h)) / h**2
    assert np.abs(result["f"] - numeric).max() < 1e-5


def test_an_input_is_never_differentiated_in_silence() -> None:
    text = """
model Pushed
  input Length u;
  Length x; Force f;
equation
  x = u;
  1 kg*der(der(x)) = f;
end Pushed;
"""
    with pytest.raises(frot.FrotError, match="E0606"):
        frot.compile(text).simulate(stop=1.0)


HIDDEN = """
model Loop "two capacitors side by side, between nodes of which neither is the ground"
  import Electrical.*;
  Capacitor one(C = 1 F); Capacitor two(C = {c} F);
  Resistor left(R = 0.4 Ohm); Resistor right(R = 1.3 Ohm);
  Inductor across(L = 1.5 H);
  CurrentSource source; Ground earth;
equation
  source.current = (1 A)*sin(2*time/(1 s));
  connect(one.n, two.p); connect(one.p, two.n);
  connect(one.n, left.p); connect(one.p, right.p); connect(one.p, across.p);
  connect(left.n, earth.p); connect(right.n, earth.p); connect(across.n, earth.p);
  connect(source.p, one.n); connect(source.n, earth.p);
  experiment(stop = 3 s, tolerance = 1e-11);
end Loop;
"""


def test_a_relation_hidden_among_potentials_is_found() -> None:
    result = frot.compile(HIDDEN.format(c=2)).simulate(parameters={"two.C": 3.0})
    assert np.abs(result["one.v"] + result["two.v"]).max() < 1e-14
    direct = HIDDEN.format(c=2).replace("Capacitor two(C = 2 F)", "Conductor two(G = 0)")
    single = frot.compile(direct).simulate(parameters={"one.C": 4.0})
    assert np.abs(result["one.v"] - single["one.v"]).max() < 1e-9


def test_equations_dependent_in_their_rates_are_of_higher_index() -> None:
    text = """
model Dependent
  Real x; Real y;
equation
  der(x) + der(y) = 1/(1 s);
  der(x) + der(y) = 2/(1 s) - x/(1 s) + sin(time/(1 s))/(1 s);
  experiment(stop = 2 s, tolerance = 1e-11);
end Dependent;
"""
    result = frot.compile(text).simulate()
    assert np.abs(result["x"] - 1 - np.sin(result.time)).max() < 1e-12
    growth = result.time - np.sin(result.time)
    assert np.abs(result["y"] - result["y"][0] - growth).max() < 1e-9


PRESCRIBED = """
planar model Prescribed
  body rod: rod(mass = 2 kg, length = 1 m);
  liaison hinge: pivot(ground, rod.start);
  Torque motor;
equation
  hinge.flange.angle = 0.7*sin(2*time/(1 s));
  motor = hinge.flange.torque;
  experiment(stop = 3 s, tolerance = 1e-10);
end Prescribed;
"""


def test_the_couple_of_a_prescribed_hinge_is_that_of_inverse_dynamics() -> None:
    result = frot.compile(PRESCRIBED).simulate()
    angle = 0.7 * np.sin(2 * result.time)
    exact = 2 / 3 * (-4 * angle) + 2 * 9.81 * 0.5 * np.cos(angle)
    assert np.abs(result["motor"] - exact).max() < 1e-12 * np.abs(exact).max()


HELD = """
planar model Held "a particle held on a circle by a force of unknown size"
  body p: particle(mass = 1 kg);
  Real pull(unit = "N/m");
  force f: on(p, value = (-pull*p.position.x, -pull*p.position.y));
initial
  p.position = (1, 0) m; p.velocity = (0, 0) m/s;
equation
  p.position.x^2 + p.position.y^2 = (1 m)^2;
  experiment(stop = 5 s, tolerance = 1e-10);
end Held;
"""


def test_a_force_of_unknown_size_holds_a_particle_on_a_circle() -> None:
    result = frot.compile(HELD).simulate()
    x, y = result["p.position.x"], result["p.position.y"]
    speed = result["p.velocity.x"] ** 2 + result["p.velocity.y"] ** 2
    assert np.abs(np.hypot(x, y) - 1).max() < 1e-13
    assert np.abs(speed / 2 + 9.81 * y).max() < 1e-8
    assert np.abs(result["pull"] - (speed - 9.81 * y)).max() < 1e-10 * 9.81 * 3
