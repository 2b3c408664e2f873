"""Diodes whose voltages move a million times faster while they block than while they conduct.

At the instant at which one ceases to conduct rounding of its current is a voltage far from zero.
"""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np
import pytest
from frot.compiler.symbolic.slopes import without_what_cancels

import frot

BRIDGE = """
model Bridge "full bridge rectifier"
  import Electrical.*;
  parameter Frequency f = 50 Hz;
  VoltageSource s; Diode d[4](on_resistance = 0.1 Ohm); Capacitor c(C = 1 mF);
  Resistor load(R = 50 Ohm); Resistor rs(R = 0.2 Ohm); Ground g;
initial
  c.v = 0 V;
equation
  s.voltage = 24 V*sin(2*pi*f*time);
  connect(s.p, rs.p);
  connect(rs.n, d[1].p); connect(rs.n, d[2].n);
  connect(s.n, d[3].p); connect(s.n, d[4].n);
  connect(d[1].n, c.p); connect(d[3].n, c.p);
  connect(d[2].p, c.n); connect(d[4].p, c.n);
  connect(c.p, load.p); connect(c.n, load.n);
  connect(c.n, g.p);
  experiment(stop = 0.05 s);
end Bridge;
"""

THREE_PHASES = """
model ThreePhases "rectifier of three phases, their star point free"
  import Electrical.*;
  parameter Frequency f = 50 Hz;
  VoltageSource s[3]; Inductor ls[3](L = 1 mH); Resistor rs[3](R = 0.1 Ohm);
  Diode d[6](on_resistance = 0.1 Ohm); Capacitor c(C = 1 mF); Resistor load(R = 50 Ohm); Ground g;
initial
  c.v = 0 V; ls[1].i = 0 A; ls[2].i = 0 A;
equation
  for i in 1:3 loop
    s[i].voltage = 24 V*sin(2*pi*f*time + i*2*pi/3);
    connect(s[i].n, g.p); connect(s[i].p, ls[i].p); connect(ls[i].n, rs[i].p);
    connect(rs[i].n, d[i].p); connect(rs[i].n, d[i+3].n);
    connect(d[i].n, c.p); connect(d[i+3].p, c.n);
  end for;
  connect(c.p, load.p); connect(c.n, load.n);
  experiment(stop = 0.1 s);
end ThreePhases;
"""


@cache
def model(text: str) -> frot.Model:
    return frot.compile(text)


def draw(text: str, seed: int) -> dict[str, float]:
    """Resistances over two decades to either side, everything else within a factor of three."""
    rng = np.random.default_rng(seed)
    values = model(text).simulate(stop=1e-9).parameters
    return {
        name: float(value) * 10 ** rng.uniform(*((-2, 2) if "resistance" in name else (-0.5, 0.5)))
        for name, value in values.items()
        if rng.random() < 0.6
    }


@pytest.mark.parametrize("which", range(1, 5))
@pytest.mark.parametrize(("what", "times"), [("forward", 0.5), ("off_resistance", 3.0)])
def test_one_diode_is_unlike_the_others(which: int, what: str, times: float) -> None:
    usual = {"forward": 0.6, "off_resistance": 1e6}
    values = {f"d[{which}].{what}": usual[what] * times}
    exact = model(BRIDGE).simulate(tolerance=1e-12, parameters=values)
    for tolerance in (1e-4, 1e-8):
        result = model(BRIDGE).simulate(tolerance=tolerance, parameters=values)
        assert result["c.v"][-1] == pytest.approx(exact["c.v"][-1], rel=30 * tolerance)
        assert result.figures.steps < 1000


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("text", [BRIDGE, THREE_PHASES])
def test_no_diode_like_another(text: str, seed: int) -> None:
    values = draw(text, seed)
    exact = model(text).simulate(tolerance=1e-11, parameters=values)
    times = np.linspace(0, exact.time[-1], 9)[1:]
    wanted = np.array([exact.at(t)["c.v"] for t in times])
    for tolerance in (1e-3, 1e-5, 1e-8):
        result = model(text).simulate(tolerance=tolerance, parameters=values)
        found = np.array([result.at(t)["c.v"] for t in times])
        assert np.abs(found - wanted).max() < 100 * tolerance * np.abs(wanted).max()
        # stiff while diodes block: every time implicitly
        assert result.figures.steps < 60 * (10 + len(result.events))


@pytest.mark.parametrize(("seed", "tolerances"), [(2, (1e-3, 1e-9)), (4, (1e-3, 1e-7))])
def test_a_step_a_million_times_longer_than_the_way_to_its_event(
    seed: int, tolerances: tuple[float, ...]
) -> None:
    """Of a run ten times as long steps reach far beyond diodes that cease to conduct in 1 ns: that
    instant is found all the same, not one before it with currents that others take up."""
    values = draw(THREE_PHASES, seed)
    exact = model(THREE_PHASES).simulate(tolerance=1e-11, parameters=values)
    long = model(THREE_PHASES.replace("stop = 0.1 s", "stop = 1 s"))
    for tolerance in tolerances:
        result = long.simulate(stop=0.1, tolerance=tolerance, parameters=values)
        assert result["c.v"][-1] == pytest.approx(exact["c.v"][-1], rel=100 * tolerance)
        assert len(result.events) < 1.2 * len(exact.events)  # a diode may be just touched
        assert result.figures.steps < 60 * (10 + len(result.events))


def test_what_cancels_in_a_sum_stays_in_a_product() -> None:
    """0 = (a - p) + (p - b) + p y: only the potential p of the product is left."""
    a, b, p, y = (ca.SX.sym(name) for name in "abpy")
    left = without_what_cancels((a - p) + (p - b) + p * y)
    value = ca.Function("left", [a, b, p, y], [left])
    assert float(value(5, 3, 7, 2)) == 16
    assert not ca.depends_on(without_what_cancels((a - p) + (p - b)), p)


def test_numbers_that_cancel_in_a_sum_are_gone() -> None:
    """0 = (a - 27.2) - b + 27.2 + a b: sums lose the number, products what they are made of not."""
    a, b = (ca.SX.sym(name) for name in "ab")
    left = without_what_cancels((a - 27.2) - b + 27.2 + a * b)
    assert float(ca.Function("left", [a, b], [left])(1e-14, 3e-14)) == 1e-14 - 3e-14 + 3e-28
    left = without_what_cancels((a - 5) - (b - 7))
    assert float(ca.Function("left", [a, b], [left])(1, 2)) == 1


LEAK = """model Leak "A blocking diode fills a capacitor whose ends are both at 27.2 V"
  import Electrical.*;
  Ground g;
  VoltageSource e0;
  Resistor e1(R = 12.7 Ohm), e2(R = 0.125 Ohm), e3(R = 497 Ohm), e4(R = 561 Ohm);
  Diode e5(forward = 0.726 V, on_resistance = 0.0463 Ohm, off_resistance = 1.8e+08 Ohm);
  Switch e6;
  Resistor r7(R = 1.46 Ohm), e8(R = 665 Ohm), e9(R = 0.646 Ohm);
  Capacitor e7(C = 3.64e-05 F);
initial
  e7.v = 0 V;
equation
  e0.voltage = 27.2 V;
  e6.closed = sin(147.6 1/s*time + 4.27) > -0.347;
  connect(r7.n, e7.p); connect(g.p, e0.n); connect(g.p, e8.p); connect(e0.p, e1.p);
  connect(e0.p, e2.p); connect(e0.p, e3.p); connect(e1.n, e4.p); connect(e1.n, e7.n);
  connect(e1.n, e9.n); connect(e2.n, r7.p); connect(e2.n, e9.p); connect(e3.n, e5.p);
  connect(e0.p, e6.n); connect(e3.n, e6.p); connect(e3.n, e8.n); connect(e4.n, e5.n);
  experiment(stop = 0.05 s);
end Leak;
"""


@pytest.mark.parametrize("volts", ["27.2 V", "volts"])
def test_a_trace_beside_a_potential_keeps_its_digits(volts: str) -> None:
    """e7.v is 1e-10 of the source's voltage, which cancels: as a number as by its name."""
    text = LEAK.replace("27.2 V;", f"{volts};").replace(
        "  Ground g;", "  Ground g;\n  parameter Voltage volts = 27.2 V;"
    )
    exact = model(text).simulate(tolerance=1e-12)
    for tolerance in (1e-4, 1e-8):
        result = model(text).simulate(tolerance=tolerance)
        assert result["e7.v"][-1] == pytest.approx(exact["e7.v"][-1], rel=30 * tolerance)
        assert result.figures.steps < 300


def test_two_diodes_back_to_back_are_told_apart() -> None:
    """Where both conducted the equations would depend on each other, and they never do."""
    result = frot.compile("""
model FullWave
  Real u, s1, s2, v, i1, i2;
equation
  u = sin(6*time/(1 s));
  i1 = if s1 > 0 then s1 else 0;
  u - v = if s1 > 0 then 0 else s1;
  i2 = if s2 > 0 then s2 else 0;
  -u - v = if s2 > 0 then 0 else s2;
  v = 2*(i1 + i2);
  experiment(stop = 2 s);
end FullWave;
""").simulate()
    assert result["v"] == pytest.approx(np.abs(np.sin(6 * result.time)), abs=1e-12)
