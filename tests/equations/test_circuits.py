"""Circuits written as plain equations and with the library, against closed forms."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh

import frot

DIVIDER = """
model Charging
  import Electrical.*;
  parameter Resistance R = {r} Ohm;
  parameter Capacitance C = {c} F;
  ConstantVoltage source(V = 5 V);
  Resistor r(R = R);
  Capacitor c(C = C);
  Ground earth;
initial
  c.v = {start} V;
equation
  connect(source.p, r.p);
  connect(r.n, c.p);
  connect(c.n, source.n);
  connect(source.n, earth.p);
  experiment(stop = 3 s, tolerance = 1e-10);
end Charging;
"""


@pytest.mark.parametrize(("r", "c", "start"), [(1.0, 1.0, 0.0), (2.5, 0.3, -1.0), (0.2, 4.0, 9.0)])
def test_a_capacitor_charges_exponentially(r: float, c: float, start: float) -> None:
    result = frot.compile(DIVIDER.format(r=r, c=c, start=start)).simulate()
    exact = 5 + (start - 5) * np.exp(-result.time / (r * c))
    assert np.abs(result["c.v"] - exact).max() < 1e-9
    assert np.abs(result["r.i"] - (5 - exact) / r).max() < 1e-9 / r


def test_the_error_follows_the_tolerance() -> None:
    model = frot.compile(DIVIDER.format(r=1.0, c=0.5, start=0.0))
    errors = []
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
        result = model.simulate(tolerance=tolerance)
        errors.append(np.abs(result["c.v"] - 5 * (1 - np.exp(-2 * result.time))).max())
    for tolerance, error in zip((1e-4, 1e-6, 1e-8, 1e-10, 1e-12), errors, strict=True):
        assert error < 10 * tolerance


def test_a_parameter_of_a_part_is_set_from_outside_without_compiling() -> None:
    model = frot.compile(DIVIDER.format(r=1.0, c=1.0, start=0.0))
    result = model.simulate(parameters={"c.C": 2.0, "source.V": 1.0})
    assert result["c.v"][-1] == pytest.approx(1 - math.exp(-1.5), abs=1e-9)


def test_a_divisor_that_is_zero_is_told_by_name() -> None:
    model = frot.compile(DIVIDER.format(r=1.0, c=1.0, start=0.0))
    with pytest.raises(frot.FrotError, match=r"must not be zero.*divided") as told:
        model.simulate(parameters={"R": 0.0})
    assert "nan" not in str(told.value).lower()


PARALLEL = """
model Parallel "two capacitors on one node: their voltages are one state"
  import Electrical.*;
  Capacitor a(C = 1 F);
  Capacitor b(C = 3 F);
  Resistor r(R = 2 Ohm);
  Ground earth;
initial
  {initial}
equation
  connect(a.p, b.p);
  connect(a.p, r.p);
  connect(a.n, b.n);
  connect(a.n, r.n);
  connect(a.n, earth.p);
  experiment(stop = 10 s, tolerance = 1e-10);
end Parallel;
"""


def test_capacitors_in_parallel_share_one_state() -> None:
    model = frot.compile(PARALLEL.format(initial="a.v = 4 V;"))
    result = model.simulate()
    exact = 4 * np.exp(-result.time / 8)
    assert np.abs(result["b.v"] - exact).max() < 1e-9
    assert np.abs(result["a.i"] * 3 - result["b.i"]).max() < 1e-12


def test_capacitors_in_parallel_cannot_begin_apart() -> None:
    with pytest.raises(frot.FrotError, match=r"a\.v = 4 V.*b\.v = 1 V|b\.v = 1 V.*a\.v = 4 V"):
        frot.compile(PARALLEL.format(initial="a.v = 4 V; b.v = 1 V;")).simulate()


BRIDGE = """
model Bridge "Wheatstone's bridge: a linear algebraic loop"
  import Electrical.*;
  parameter Resistance R1 = 1 Ohm; parameter Resistance R2 = 2 Ohm;
  parameter Resistance R3 = 3 Ohm; parameter Resistance R4 = 5 Ohm;
  parameter Resistance R5 = 7 Ohm;
  Resistor r1(R = R1); Resistor r2(R = R2); Resistor r3(R = R3); Resistor r4(R = R4);
  Resistor r5(R = R5);
  VoltageSource source;
  Ground earth;
equation
  source.voltage = 10 V*cos(3 Hz*time);
  connect(source.p, r1.p); connect(source.p, r2.p);
  connect(r1.n, r3.p); connect(r2.n, r4.p);
  connect(r1.n, r5.p); connect(r2.n, r5.n);
  connect(r3.n, earth.p); connect(r4.n, earth.p); connect(source.n, earth.p);
  experiment(stop = 2 s);
end Bridge;
"""


def test_a_bridge_is_solved_as_a_linear_loop() -> None:
    result = frot.compile(BRIDGE).simulate()
    r1, r2, r3, r4, r5 = 1.0, 2.0, 3.0, 5.0, 7.0
    nodes = np.array([[1 / r1 + 1 / r3 + 1 / r5, -1 / r5], [-1 / r5, 1 / r2 + 1 / r4 + 1 / r5]])
    v = np.linalg.solve(nodes, np.array([1 / r1, 1 / r2]))
    exact = 10 * np.cos(3 * result.time) * (v[0] - v[1]) / r5
    assert np.abs(result["r5.i"] - exact).max() < 1e-13


LADDER = """
model Ladder
  parameter Integer n = 20;
  parameter Time tau = 0.1 s;
  Real v[n];
initial
  for k in 1:n loop
    v[k] = 0;
  end for;
equation
  tau*der(v[1]) = 1 - 2*v[1] + v[2];
  for k in 2:n - 1 loop
    tau*der(v[k]) = v[k - 1] - 2*v[k] + v[k + 1];
  end for;
  tau*der(v[n]) = v[n - 1] - v[n];
  experiment(stop = 20 s, tolerance = 1e-10);
end Ladder;
"""


def test_a_ladder_follows_its_eigenvectors() -> None:
    result = frot.compile(LADDER).simulate()
    n, tau = 20, 0.1
    a = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    a[-1, -1] = 1
    values, vectors = eigh(a)
    for k in (1, 10, n):
        start = vectors.T @ -np.ones(n)
        exact = 1 + (vectors[k - 1] * start) @ np.exp(-np.outer(values, result.time) / tau)
        assert np.abs(result[f"v[{k}]"] - exact).max() < 1e-8


RECTIFIER = """
model Rectifier "a diode with straight lines: conduction begins and ends at located events"
  import Electrical.*;
  VoltageSource source;
  Diode d(forward = 0.5 V, on_resistance = 1 Ohm, off_resistance = 1e9 Ohm);
  Resistor r(R = 9 Ohm);
  Ground earth;
equation
  source.voltage = 2 V*sin(1 rad/s*time);
  connect(source.p, d.p); connect(d.n, r.p); connect(r.n, earth.p); connect(source.n, earth.p);
  experiment(stop = 6 s, tolerance = 1e-10);
end Rectifier;
"""


def test_a_diode_opens_and_closes_at_the_right_instants() -> None:
    result = frot.compile(RECTIFIER).simulate()
    times = [e.time for e in result.events]
    first = math.asin(0.25)
    assert times == pytest.approx([first, math.pi - first], abs=1e-8)
    at = result.at(math.pi / 2)["r.i"]
    assert at == pytest.approx((2 - 0.5) / 10, abs=1e-8)
