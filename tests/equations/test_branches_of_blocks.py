"""Which of several solutions a block of equations takes, and how one passes a singular place."""

from __future__ import annotations

import math

import pytest

import frot

NEAREST = [
    ("abs(x) = 2;", 1, 2),
    ("abs(x) = 2;", -1, -2),
    ("noEvent(abs(x)) = 2;", 0.1, 2),
    ("abs(x)*x^2 = 8;", -1, -2),
    ("x^2 = 4;", 0.1, 2),
    ("x^2 = 4;", -0.1, -2),
    ("x^2 = 4;", 0, 2),
    ("cosh(x) = 4;", 0.1, math.acosh(4)),
    ("sin(x) = 0.5;", 1.5, math.pi / 6),
    ("sin(x) = 0.5;", 1.6, 5 * math.pi / 6),
    ("sin(x) = 0.5;", -3, -7 * math.pi / 6),
    ("exp(x) = 1e10 - x;", 0, 23.02585092763996),
    ("x*exp(x) = -0.1;", -2, -3.577152063957297),
    ("x*exp(x) = -0.1;", 0, -0.111832559158963),
]


@pytest.mark.parametrize(("equation", "start", "solution"), NEAREST)
def test_of_several_solutions_the_one_on_the_side_of_the_start_is_taken(
    equation: str, start: float, solution: float
) -> None:
    model = frot.compile(f"model M\n  Real x(start = {start});\nequation\n  {equation}\nend M;\n")
    assert model.simulate()["x"][0] == pytest.approx(solution, rel=1e-13)


def test_a_solution_is_followed_past_others_that_come_near() -> None:
    """Of sin(x) = s the root beyond the crest, while s swings to within 1e-4 of one."""
    model = frot.compile("""
model M
  Real x(start = 3);
equation
  sin(x) = 0.9999*sin(5*time/(1 s));
  experiment(stop = 5 s);
end M;
""")
    for tolerance in (1e-3, 1e-6, 1e-12):
        run = model.simulate(tolerance=tolerance)
        for t in (0.1, 0.314, 1.0, 1.5708, 2.5, 4.9):
            exact = math.pi - math.asin(0.9999 * math.sin(5 * t))
            assert run.at(t)["x"] == pytest.approx(exact, rel=1e-12)


ROOTS = [
    ("x*abs(x) = r;", 2),
    ("3*x*abs(x) = 2*r + x*noEvent(abs(x));", 2),
    ("sign(x)*x^2 = r;", 2),
    ("if x > 0 then x^2 = r; else -x^2 = r; end if;", 2),
    ("x^3 = r;", 3),
    ("x^5 = r;", 5),
    ("x*abs(x)^0.75 = r;", 1.75),
]


@pytest.mark.parametrize(("equation", "power"), ROOTS)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12, 1e-13])
def test_a_root_passes_zero_in_an_implicit_equation(
    equation: str, power: float, tolerance: float
) -> None:
    """x is the root of 1/2 - t with its sign, y its integral: the slope at t = 1/2 has no bound."""
    model = frot.compile(f"""
model M
  Real x(start = 1), y, r = 0.5 - time/(1 s);
initial
  y = 0;
equation
  {equation}
  der(y) = x/(1 s);
  experiment(stop = 1.37 s);
end M;
""")
    run = model.simulate(tolerance=tolerance)
    part = 1 / power + 1
    for t in (0.2, 0.5, 0.51, 1.0, 1.37):
        r = 0.5 - t
        exact = math.copysign(abs(r) ** (1 / power), r)
        area = (0.5**part - abs(r) ** part) / part
        if r != 0:
            assert run.at(t)["x"] == pytest.approx(exact, rel=1e-11)
        assert run.at(t)["y"] == pytest.approx(area, abs=10 * tolerance)
    changes = [e.time for e in run.events]
    assert all(t == pytest.approx(0.5, abs=1e-14) for t in changes)


def test_a_solution_that_ends_is_told() -> None:
    model = frot.compile("""
model M
  Real x(start = 1);
equation
  x^2 = 0.5 - time/(1 s);
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0907.*x was found at t = 0\.[45]") as told:
        model.simulate()
    assert "x was found" in str(told.value)


NETWORKS = [
    # two orifices in a row: q|q| (2 + 3) = cos 2 t
    (
        "Real q(start = 1), p;",
        "cos(2*time/(1 s)) - p = 2*q*abs(q); p = 3*q*abs(q);",
        1 / 5,
    ),
    # one in front of two: k of the two by 1/sqrt(k) = 1/sqrt(2) + 1/sqrt(5)
    (
        "Real q(start = 1), a(start = 1), b(start = 1), p;",
        "cos(2*time/(1 s)) - p = q*abs(q); p = 2*a*abs(a); p = 5*b*abs(b); q = a + b;",
        1 / (1 + 1 / (2**-0.5 + 5**-0.5) ** 2),
    ),
]


@pytest.mark.parametrize(("declared", "equations", "part"), NETWORKS)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
def test_turbulent_flows_of_a_network_turn_together(
    declared: str, equations: str, part: float, tolerance: float
) -> None:
    model = frot.compile(f"model M\n  {declared}\nequation\n  {equations}\nend M;\n")
    run = model.simulate(stop=5, tolerance=tolerance)
    for t in (0.1, 0.78, 0.8, 2.0, 3.5, 4.9):
        q2 = part * math.cos(2 * t)
        assert run.at(t)["q"] == pytest.approx(math.copysign(abs(q2) ** 0.5, q2), rel=1e-12)


def test_tanks_even_out_through_an_implicit_orifice() -> None:
    """Of q|q| = d and der(d) = -2 q the square root of d falls steadily to zero at t = 1."""
    model = frot.compile("""
model M
  Real a, b, q(start = 1);
initial
  a = 2; b = 1;
equation
  der(a) = -q*(1 1/s);
  der(b) = q*(1 1/s);
  q*abs(q) = a - b;
  experiment(stop = 0.99 s);
end M;
""")
    for tolerance in (1e-4, 1e-8, 1e-12):
        run = model.simulate(tolerance=tolerance)
        for t in (0.3, 0.8, 0.99):
            assert run.at(t)["a"] == pytest.approx(1.5 + 0.5 * (1 - t) ** 2, rel=10 * tolerance)


def test_a_diode_conducts_from_where_it_carries_nothing() -> None:
    """exp(v/V) - 1 leaves at v = 0 the rounding of 1. The value by SciPy's Radau, in v as state."""
    model = frot.compile("""
model M
  Real v(start = 0.1), i, u;
initial
  u = 0;
equation
  i = 1e-12*(exp(v/0.025) - 1);
  5*sin(10*time/(1 s)) - v - u = 100*i;
  1e-3*der(u)*(1 s) = i - u/1000;
  experiment(stop = 1 s);
end M;
""")
    for tolerance in (1e-3, 1e-6, 1e-9):
        run = model.simulate(tolerance=tolerance)
        assert run["u"][-1] == pytest.approx(2.86565441888, rel=max(3 * tolerance, 1e-9))


def test_what_has_no_slope_where_the_search_begins_asks_for_a_start() -> None:
    text = """
model Drain
  Real h, q{start};
initial
  h = 1;
equation
  der(h) = -q*(1 1/s);
  h = q*sqrt(abs(q));
  experiment(stop = 1 s);
end Drain;"""
    with pytest.raises(frot.SimulationError, match=r"(?s)E0904.*give the unknown a start") as told:
        frot.compile(text.format(start="")).simulate()
    assert "for q" in str(told.value)
    run = frot.compile(text.format(start="(start = 1)")).simulate(tolerance=1e-9)
    assert run["h"][-1] == pytest.approx((2 / 3) ** 3, abs=1e-8)
