"""First values of models of equations: steady states, values of what is not a state, guesses."""

from math import exp

import numpy as np
import pytest

import frot

TANK = """
model Tank
  parameter Real inflow = 2;
  Real level; Real out;
initial
  {initial}
equation
  der(level) = (inflow - out)/(1 s);
  out = 0.5*sqrt(max(level, 0));
  experiment(stop = 1 s, tolerance = 1e-10);
end Tank;
"""


def test_a_steady_state_is_found_from_a_guess() -> None:
    result = frot.compile(TANK.format(initial="guess(level = 3); der(level) = 0/(1 s);")).simulate()
    assert result["level"][0] == pytest.approx(16, rel=1e-9)
    assert result["level"][-1] == pytest.approx(16, rel=1e-8)


def test_the_value_of_an_algebraic_variable_fixes_the_state() -> None:
    result = frot.compile(TANK.format(initial="guess(level = 1); out = 1;")).simulate()
    assert result["level"][0] == pytest.approx(4, rel=1e-9)


def test_contradicting_statements_are_named() -> None:
    with pytest.raises(frot.FrotError, match="level = 1"):
        frot.compile(TANK.format(initial="level = 1; level = 2;")).simulate()


def test_start_values_guide() -> None:
    text = """
model Root
  Real x(start = {start}); Real s;
initial
  s = 0;
equation
  der(s) = 0/(1 s);
  x^2 - 3*x + 2 = 0;
  experiment(stop = 1 s);
end Root;
"""
    assert frot.compile(text.format(start=0)).simulate()["x"][0] == pytest.approx(1, abs=1e-12)
    assert frot.compile(text.format(start=5)).simulate()["x"][0] == pytest.approx(2, abs=1e-12)


GUESSED = """
model Guessed
  Real x(start = 1); Real y;
initial
  {guesses}
equation
  der(x) = -x/(1 s);
  2*y + 0.5*x = 1;
  experiment(stop = 1 s);
end Guessed;
"""


@pytest.mark.parametrize(
    ("guesses", "x"),
    [
        ("", 1.0),
        ("guess(x = 2);", 2.0),
        ("guess(y = 0);", 2.0),
        ("guess(x = 3); guess(y = 0);", 3.0),
    ],
)
def test_guesses_do_not_add_up(guesses: str, x: float) -> None:
    result = frot.compile(GUESSED.format(guesses=guesses)).simulate()
    assert result["x"][0] == pytest.approx(x, abs=1e-14)
    assert result["y"][0] == pytest.approx((1 - 0.5 * x) / 2, abs=1e-14)


STEADY = """
model Steady
  parameter Real high = 2;
  Real x;
initial
  der(x) = 0 1/s;
equation
  der(x) = ((if {condition} then 1 else high) - x)/(1 s);
  experiment(stop = 1 s, tolerance = 1e-10);
end Steady;
"""


def test_a_steady_state_follows_a_condition_on_time() -> None:
    # Before 0.5 s the value rests at 1, then it goes to 2 with a time constant of 1 s.
    result = frot.compile(STEADY.format(condition="time < 0.5 s")).simulate()
    assert result["x"][0] == 1
    assert result["x"][-1] == pytest.approx(2 - exp(-0.5), rel=1e-9)
    assert [e.time for e in result.events] == [0.5]


@pytest.mark.parametrize(("high", "start"), [(2.0, 2.0), (3.0, 3.0)])
def test_a_steady_state_agrees_with_the_condition_that_reads_it(high: float, start: float) -> None:
    result = frot.compile(STEADY.format(condition="x < -1")).simulate(parameters={"high": high})
    assert result["x"][[0, -1]] == pytest.approx([start, start], rel=1e-12)


def test_a_steady_state_that_contradicts_its_condition_is_told() -> None:
    with pytest.raises(frot.FrotError) as told:
        frot.compile(STEADY.format(condition="x > 1.5")).simulate()
    assert told.value.diagnostics[0].code in ("E0601", "E0903")


def test_a_first_value_that_only_the_motion_gives_is_told_with_its_remedy() -> None:
    text = """
model Stepped
  Real x; Integer n;
initial
  x = 3; {statement}
equation
  der(x) = -x/(1 s);
  when {condition} then n = 7; {other}end when;
  experiment(stop = 0.5 s);
end Stepped;
"""
    stated = text.format(statement="n = if x > 1 then 2 else 1;", condition="x < 1", other="")
    with pytest.raises(frot.FrotError, match="'n'") as told:
        frot.compile(stated).simulate()
    assert told.value.diagnostics[0].code == "E0602"
    assert "when initial()" in told.value.diagnostics[0].help
    set_by = text.format(
        statement="", condition="x < 1", other="elsewhen initial() then n = if x > 1 then 2 else 1;"
    )
    assert frot.compile(set_by).simulate()["n"][-1] == 2


def test_a_guess_may_be_of_what_a_condition_changes() -> None:
    """x' = -3 x below one, from the root of x^3 + x = 2 that the guess is near."""
    text = """
model Switched
  Real x; Real g;
initial
  x^3 + x = 2;
  guess(g = 3);
equation
  der(x) = -g/(1 s);
  g = 2*min(1, x) + x;
  experiment(stop = 1 s, tolerance = 1e-9);
end Switched;
"""
    result = frot.compile(text).simulate()
    assert result["x"][[0, -1]] == pytest.approx([1, np.exp(-3)], rel=1e-8)


def test_a_coefficient_may_be_negative_where_the_start_is_looked_for() -> None:
    """The rod lies along x there, and the coefficient is mu (1 - 0.5/0.3)."""
    text = """
planar model Falling
  world(gravity = 9.81 m/s^2);
  parameter Real mu = 0.4;
  body b: rod(mass = 1 kg, length = 1 m);
  liaison c: rotoide(ground, b.start) with coulomb(mu*(1 - b.position.x/(0.3 m)), radius = 1 cm);
initial
  b.position.x = 0.1 m;
  experiment(stop = 0.1 s);
end Falling;
"""
    result = frot.compile(text).simulate()
    assert result["b.position.x"][0] == pytest.approx(0.1, rel=1e-12)
