"""Sizes against which the errors of states are measured: what a state is worth now.

References: F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, 2008 (Oregonator,
van der Pol); closed forms.
"""

from __future__ import annotations

import numpy as np
import pytest
from frot.runtime.result import Result

import frot

TOLERANCES = [1e-4, 1e-6, 1e-8]


def solved(text: str, tolerance: float, **options: object) -> Result:
    return frot.compile(text).simulate(tolerance=tolerance, **options)  # type: ignore[arg-type]


VAN_DER_POL = """model VanDerPol
  parameter Real eps = 1e-6;
  Real y; {z};
initial
  y = 2; z = 0{unit};
equation
  {first};
  eps*der(z)*(1 s){square} = (1 - y^2)*z - y{rate};
  experiment(stop = 2 s);
end VanDerPol;
"""
SPELLINGS = {
    "numbers": {
        "z": "Real z", "unit": "", "first": "der(y)*(1 s) = z", "square": "", "rate": "",
    },
    "rates": {
        "z": "Frequency z", "unit": " 1/s", "first": "der(y) = z", "square": "", "rate": "*(1 1/s)",
    },
}  # fmt: skip


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("spelling", SPELLINGS)
def test_a_spike_of_a_million_is_forgotten(spelling: str, tolerance: float) -> None:
    """z jumps to 1e6 and comes back to 1 in a millionth of the period."""
    result = solved(VAN_DER_POL.format(**SPELLINGS[spelling]), tolerance)
    end = [result.at(2.0)[name] for name in ("y", "z")]
    exact = [0.1706167732170483e1, -0.8928097010247975]
    assert np.abs(np.array(end) / exact - 1).max() <= 10 * tolerance


OREGONATOR = """model Oregonator
  constant AngularVelocity k = 1 s^-1;
  Real x, y, z;
initial
  x = 1; y = 2; z = 3;
equation
  der(x) = k*77.27*(y + x*(1 - 8.375e-6*x - y));
  der(y) = k*(z - (1 + x)*y)/77.27;
  der(z) = k*0.161*(x - z);
  experiment(stop = 360 s);
end Oregonator;
"""


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_an_oscillating_reaction_over_five_decades(tolerance: float) -> None:
    result = solved(OREGONATOR, tolerance)
    end = np.array([result.at(360.0)[name] for name in "xyz"])
    exact = np.array([0.1000814870318523e1, 0.1228178521549917e4, 0.1320554942846706e3])
    assert np.abs(end / exact - 1).max() <= 10 * tolerance


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_a_trace_species_decays_a_mass(tolerance: float) -> None:
    """b, a millionth of a at most, is all that makes a decay: a = exp(-int 1e6 b)."""
    text = """model Trace
  constant Frequency k = 1 s^-1;
  Real a; Real b;
initial
  a = 1; b = 0;
equation
  der(a) = -1e6*k*a*b;
  der(b) = k*(1e-6 - b);
  experiment(stop = 20 s);
end Trace;
"""
    end = solved(text, tolerance).at(20.0)
    assert end["b"] == pytest.approx(1e-6 * (1 - np.exp(-20)), rel=10 * tolerance)
    assert end["a"] == pytest.approx(np.exp(-(20 - (1 - np.exp(-20)))), rel=100 * tolerance)


@pytest.mark.parametrize("small", [1e-6, 1e-12])
@pytest.mark.parametrize("tolerance", [1e-5, 1e-9])
def test_uncoupled_neighbours(small: float, tolerance: float) -> None:
    """A kilovolt beside a microvolt, each an oscillation of its own."""
    text = f"""model Two
  constant AngularVelocity k = 1 s^-1;
  parameter Real small = {small!r};
  Real a, b, c, d;
initial
  a = 1e3; b = 0; c = small; d = 0;
equation
  der(a) = k*b; der(b) = -k*a; der(c) = 3*k*d; der(d) = -3*k*c;
  experiment(stop = 20 s);
end Two;
"""
    result = solved(text, tolerance)
    assert np.abs(result["c"] - small * np.cos(3 * result.time)).max() <= 200 * tolerance * small


def test_a_decayed_state_costs_nothing_more() -> None:
    """Of a million time constants the 69 of the first thirty decades are followed."""
    text = """model Decay
  Real x;
initial
  x = 1;
equation
  der(x) = -x*(1e6 1/s);
  experiment(stop = 1 s);
end Decay;
"""
    for tolerance in (1e-4, 1e-8, 1e-12):
        result = solved(text, tolerance)
        assert result.figures.steps < 9 * 69 + 30
        assert result.at(1e-5)["x"] == pytest.approx(np.exp(-10), rel=10 * tolerance)


@pytest.mark.parametrize("method", ["auto", "explicit", "implicit"])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-6])
def test_a_decaying_state_has_a_relative_error(tolerance: float, method: str) -> None:
    """x = y = exp(-t): where nothing but their decay limits the steps they lose no sign."""
    text = f"""model Tail
  Real x, y(nominal = 1e-12);
initial
  x = 1; y = 1;
equation
  der(x) = -x*1 1/s;
  der(y) = -y*1 1/s;
  experiment(stop = 60 s, method = {method});
end Tail;
"""
    result = solved(text, tolerance, interval=0.25)
    exact = np.exp(-result.time)
    assert np.abs(result["x"] / exact - 1).max() <= 10 * tolerance
    assert np.all(np.abs(result["y"] - exact) <= 10 * tolerance * np.maximum(exact, 1e-12))
    assert result.figures.steps < 100 or method == "implicit"


@pytest.mark.parametrize("method", ["auto", "explicit", "implicit"])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-11])
def test_a_state_of_zero_with_a_rate_of_rounding(tolerance: float, method: str) -> None:
    text = f"""model Noise
  Real x(start = 0);
  parameter Real w = 100;
initial
  x = 0;
equation
  der(x) = (0.1*sin(w*time/(1 s)) + 0.2*sin(w*time/(1 s)) - 0.3*sin(w*time/(1 s)))*1 1/s;
  experiment(stop = 1 s, method = {method});
end Noise;
"""
    result = solved(text, tolerance)
    assert np.abs(result["x"]).max() < 1e-16
    assert result.figures.steps < 2000


def test_a_bridge_charges_a_capacitor_from_zero() -> None:
    """While no diode conducts all is zero but for rounding."""
    text = """model Bridge
  import Electrical.*;
  VoltageSource s; Diode d[4](on_resistance = 0.1 Ohm); Capacitor c(C = 1 mF);
  Resistor load(R = 50 Ohm); Resistor rs(R = 0.2 Ohm); Ground g;
  output Voltage u = c.v;
initial
  c.v = 0 V;
equation
  s.voltage = 24 V*sin(2*pi*50 Hz*time);
  connect(s.p, rs.p);
  connect(rs.n, d[1].p); connect(rs.n, d[2].n);
  connect(s.n, d[3].p); connect(s.n, d[4].n);
  connect(d[1].n, c.p); connect(d[3].n, c.p);
  connect(d[2].p, c.n); connect(d[4].p, c.n);
  connect(c.p, load.p); connect(c.n, load.n);
  connect(c.n, g.p);
  experiment(stop = 0.04 s);
end Bridge;
"""
    loose, tight = solved(text, 1e-6), solved(text, 1e-10)
    assert loose.figures.steps < 1000
    assert np.abs(loose["u"] - tight["u"]).max() < 24 * 1e-5
    first = next(e.time for e in tight.events if e.time > 0)
    # two diodes in the loop, each with its forward voltage, before more than leakage flows
    assert 24 * np.sin(2 * np.pi * 50 * first) == pytest.approx(1.2, abs=1e-6)


@pytest.mark.parametrize("links", [12, 30])
def test_a_one_way_cascade_starts_at_zero(links: int) -> None:
    """The last of k lags begins as t^k; A. K. Erlang's distribution."""
    text = f"""model Cascade
  constant Integer n = {links};
  Real x[n];
initial
  for i in 1:n loop
    x[i] = 0;
  end for;
equation
  der(x[1]) = (1 - x[1])/(1 s);
  for i in 2:n loop
    der(x[i]) = (x[i - 1] - x[i])/(1 s);
  end for;
  experiment(stop = 40 s);
end Cascade;
"""
    result = solved(text, 1e-9)
    terms = np.cumsum(
        [np.exp(-40.0 + k * np.log(40.0) - sum(np.log(range(1, k + 1)))) for k in range(links)]
    )
    assert result.at(40.0)[f"x[{links}]"] == pytest.approx(1 - terms[-1], abs=1e-7)
    assert result.figures.steps < 1000


NOMINAL = """model Nominal
  constant AngularVelocity k = 1 s^-1;
  parameter Real size = 1e-3;
  Real x(start = 0, nominal = size);
  Real y[2](nominal = size);
initial
  x = 0;
  y[1] = 1e-6; y[2] = 0;
equation
  der(x) = k*1e-6*cos(10*k*time);
  der(y[1]) = 10*k*y[2];
  der(y[2]) = -10*k*y[1];
  experiment(stop = 20 s);
end Nominal;
"""


@pytest.mark.parametrize("size", [1e-6, 1e-3, 1.0])
def test_errors_are_measured_against_the_nominal_size(size: float) -> None:
    """A thousandth of what its author calls its size may be off by a thousand times as much."""
    result = frot.compile(NOMINAL).simulate(tolerance=1e-9, parameters={"size": size})
    exact = 1e-7 * np.sin(10 * result.time), 1e-6 * np.cos(10 * result.time)
    for name, value in zip(("x", "y[1]"), exact, strict=True):
        assert np.abs(result[name] - value).max() <= 200e-9 * size
    if size == 1e-6:
        exacting = result.figures.evaluations
        loose = frot.compile(NOMINAL).simulate(tolerance=1e-9, parameters={"size": 1.0})
        assert loose.figures.evaluations < exacting / 2


def test_invalid_nominal_sizes() -> None:
    with pytest.raises(frot.FrotError, match=r"E0305.*nominal value must depend on parameters"):
        frot.compile(
            NOMINAL.replace("nominal = size);\ninitial", "nominal = time/(1 s));\ninitial")
        )
    with pytest.raises(frot.FrotError, match="its attributes are: min, max, nominal, start, unit"):
        frot.compile(NOMINAL.replace("nominal = size);\ninitial", "nomnal = size);\ninitial"))
