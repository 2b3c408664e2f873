"""Rates whose sums cancel: digits that rounding takes are reported, and no others.

References: E5 of W. H. Enright, T. E. Hull, B. Lindberg, BIT 15 (1975) 10, by SciPy's Radau at
1e-12 on the logarithms of its states (see test_dying_states.py); ends of the stiff problems: F.
Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, 2008. A chain of two decays beside
a large store has a closed form.
"""

from __future__ import annotations

import math

import pytest

import frot

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10)
E5 = """model E5
  constant AngularVelocity k = 1 s^-1;
  Real y[4]OPTIONS;
initial
  y[1] = 1.76e-3; y[2] = 0; THIRD_START y[4] = 0;
equation
  der(y[1]) = -k*(7.89e-10*y[1] + 1.1e7*y[1]*y[3]);
  der(y[2]) = k*(7.89e-10*y[1] - 1.13e9*y[2]*y[3]);
  THIRD;
  der(y[4]) = k*(1.1e7*y[1]*y[3] - 1.13e3*y[4]);
  experiment(stop = 1e13 s);
end E5;
"""
E5_END = 8.861233521e-23  # of y[2] and y[3]
CANCELLING = (
    "der(y[3]) = k*(7.89e-10*y[1] - 1.1e7*y[1]*y[3] - 1.13e9*y[2]*y[3] + 1.13e3*y[4])",
    "der(y[3]) = k*(7.89e-10*y[1] - 1.13e9*y[2]*y[3] - 1.1e7*y[1]*y[3] + 1.13e3*y[4])",
    "der(y[3]) = der(y[2]) - der(y[4])",
)


def e5(third: str, options: str = "") -> str:
    """The text with an equation for the third state."""
    start = "y[3] = 0;" if "der(y[3])" in third else ""
    text = E5.replace("THIRD_START", start).replace("THIRD", third)
    return text.replace("OPTIONS", options)


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("third", CANCELLING)
def test_a_state_without_digits_is_named(third: str, tolerance: float) -> None:
    """The end is wrong by half of itself at least, and the summary says so."""
    result = frot.compile(e5(third)).simulate(tolerance=tolerance)
    end = result.at(1e13)
    assert abs(end["y[2]"] / E5_END - 1) > 0.5
    assert result.figures.lost > 0.1
    assert result.figures.lost_state in ("y[2]", "y[3]")
    assert f"digits of '{result.figures.lost_state}' are lost" in result.summary()


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_conserved_sum_as_an_equation_keeps_the_digits(tolerance: float) -> None:
    """What the warning advises: the error is within the tolerance, and nothing is reported."""
    result = frot.compile(e5("y[3] = y[2] - y[4]")).simulate(tolerance=tolerance)
    assert result.at(1e13)["y[2]"] == pytest.approx(E5_END, rel=10 * tolerance)
    assert result.figures.lost == 0
    assert result.figures.lost_state == ""
    assert "are lost" not in result.summary()


@pytest.mark.parametrize("tolerance", [1e-8, 1e-10])
def test_digits_below_the_nominal_size_are_no_loss(tolerance: float) -> None:
    """A nominal size of 1e-10 asks for no digits of 1e-22."""
    third = CANCELLING[0]
    result = frot.compile(e5(third, "(nominal = 1e-10)")).simulate(tolerance=tolerance)
    assert result.at(1e13)["y[2]"] == pytest.approx(E5_END, abs=tolerance * 1e-10)
    assert result.figures.lost == 0


ROBERTSON = """model Robertson
  constant AngularVelocity k = 1 s^-1;
  Real a, b, c;
initial
  a = 1; b = 0; c = 0;
equation
  der(a) = k*(-0.04*a + 1e4*b*c);
  der(b) = k*(0.04*a - 1e4*b*c - 3e7*b^2);
  der(c) = k*3e7*b^2;
  experiment(stop = 1e11 s);
end Robertson;
"""
OREGONATOR = """model Oregonator
  Real x, y, z;
initial
  x = 1; y = 2; z = 3;
equation
  der(x) = 77.27/s*(y + x*(1 - 8.375e-6*x - y));
  der(y) = (z - (1 + x)*y)/(77.27*s);
  der(z) = 0.161/s*(x - z);
  experiment(stop = 360 s);
end Oregonator;
"""
OREGONATOR = OREGONATOR.replace("model Oregonator", "model Oregonator\n  constant Time s = 1 s;")
VAN_DER_POL = """model VanDerPol
  constant Time s = 1 s;
  Real y, z;
initial
  y = 2; z = 0;
equation
  der(y) = z/s;
  der(z) = ((1 - y^2)*z - y)/(1e-6*s);
  experiment(stop = 2 s);
end VanDerPol;
"""
ENDS = (
    (ROBERTSON, 1e11, {"a": 0.2083340149701255e-7, "b": 0.8333360770334713e-13}),
    (OREGONATOR, 360.0, {"x": 0.1000814870318523e1, "y": 0.1228178521549917e4}),
    (VAN_DER_POL, 2.0, {"y": 0.1706167732170483e1, "z": -0.8928097010247975}),
)


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(("text", "stop", "exact"), ENDS)
def test_no_loss_is_reported_where_the_error_is_near_the_tolerance(
    text: str, stop: float, exact: dict[str, float], tolerance: float
) -> None:
    """Terms cancel here too, and small states stand beside large ones, but digits are kept."""
    result = frot.compile(text).simulate(tolerance=tolerance)
    end = result.at(stop)
    for name, value in exact.items():
        assert end[name] == pytest.approx(value, rel=100 * tolerance)
    assert result.figures.lost == 0


STORE = """model Store
  parameter Real size = 1e6;
  parameter Frequency fast = 1e5 Hz;
  Real x, y;
initial
  x = size; y = 0;
equation
  der(x) = -1e-3*x*(1 Hz);
  der(y) = 1e-3*x*(1 Hz) - fast*y;
  experiment(stop = 3e4 s);
end Store;
"""


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("size", [1e-20, 1.0, 1e12])
def test_a_state_that_dies_out_with_what_feeds_it_keeps_its_digits(
    size: float, tolerance: float
) -> None:
    """Thirteen decades down: rounding made before has died out as well."""
    result = frot.compile(STORE).simulate(tolerance=tolerance, parameters={"size": size})
    x = size * math.exp(-30.0)
    end = result.at(3e4)
    assert end["x"] == pytest.approx(x, rel=100 * tolerance)
    assert end["y"] == pytest.approx(1e-3 * x / (1e5 - 1e-3), rel=100 * tolerance)
    assert result.figures.lost == 0
