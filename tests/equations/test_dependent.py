"""Equations that depend on each other, and what is divided by zero, are told with their places."""

import pytest

import frot

UNDETERMINED = [
    ("Real x; Real y;", "x + y = 1; 2*x + 2*y = 2;", "`2*x + 2*y = 2` follows"),
    ("Real x; Real y;", "x + y = 1; 2*x + 2*y = 3;", "`2*x + 2*y = 3` contradicts"),
    ("Real x; Real y;", "x + 3*y = 1; 0.1*x + 0.3*y = 1;", "`0.1*x + 0.3*y = 1` contradicts"),
    ("Real x; Real y;", "x + y = 1; x + 1.00000000000001*y = 2;", "contradicts the others"),
    (
        "Real x; Real y; Real z;",
        "x + 3*y + z = time/(1 s); 0.1*x + 0.3*y - z = 2; 1.1*x + 3.3*y = 2;",
        "`0.1*x + 0.3*y - z = 2` determines nothing",
    ),
    (
        "Real x; Real y; Real z;",
        "x + y + z = 1; x - y + 2*z = 2; 2*x + 3*z = 3*time/(1 s);",
        "determines nothing",
    ),
    (
        "Real x; Real y; Real z;",
        "-x + 0.1*y + 0.1*z = 0; 0.3*x - y + z = 0; 0.299999*x - 0.9999999*y + 1.0000001*z = 0;",
        "determines nothing",
    ),
]


@pytest.mark.parametrize(("declared", "equations", "told"), UNDETERMINED)
def test_equations_that_leave_unknowns_open_are_told(
    declared: str, equations: str, told: str
) -> None:
    with pytest.raises(frot.FrotError, match="E0604") as error:
        frot.compile(f"model M\n  {declared}\nequation\n  {equations}\nend M;\n").simulate()
    assert told in str(error.value)
    assert str(error.value).count("E06") == 1


def test_hard_equations_that_do_not_depend_on_each_other_are_solved() -> None:
    result = frot.compile("""
model M
  Real x; Real y; Real z;
equation
  x + y = 2;
  x + 1.000001*y = 2.000001;
  z*1e12 + x*1e12 = 3e12;
end M;
""").simulate()
    assert result["x"][-1] == pytest.approx(1, abs=1e-9)
    assert result["z"][-1] == pytest.approx(2, abs=1e-9)


WITHOUT_VALUE = [
    ("Real x(start = 0);", "x*der(x) = 1 1/s;", "`x*der(x) = 1 1/s`", 0),
    ("Real x; Real y;", "x + y = 3; x*(1 + 4*time/(1 s)) + 2*y = 2;", "`x*(1 + 4*time", 0.25),
    (
        "parameter Real k = -1; Real n(start = 0);",
        "when sqrt(k*time/(1 s)) > 0.1 then n = 1; end when;",
        "`sqrt(k*time/(1 s)) > 0.1`",
        0,
    ),
]


@pytest.mark.parametrize(("declared", "equations", "named", "instant"), WITHOUT_VALUE)
def test_what_gives_no_number_is_named(
    declared: str, equations: str, named: str, instant: float
) -> None:
    with pytest.raises(frot.FrotError, match="E0904") as told:
        frot.compile(f"model M\n  {declared}\nequation\n  {equations}\nend M;\n").simulate()
    assert named in str(told.value)
    at = str(told.value).split("at t = ")[1].split(":")[0]
    assert float(at) == pytest.approx(instant, abs=1e-9)


def test_what_grows_without_limit_is_named_where_numbers_end() -> None:
    model = frot.compile("""
model M
  Real x(start = 1);
equation
  der(x) = 1000*x*1 1/s;
  experiment(stop = 10 s);
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0901.*'x' grows without limit") as told:
        model.simulate()
    at = float(str(told.value).split("at t = ")[1].split(",")[0])
    assert 0.2302 < at < 0.25  # x passes 1e100 at 0.23026 s


def test_small_factors_are_not_divided_by() -> None:
    """Exact values by fractions; solved for x4, the fourth equation would leave nine digits."""
    result = frot.compile("""
model M
  parameter Real k = 3;
  Real x[5];
equation
  -x[1] + x[2] + 0.7*x[4] - x[5] = 2;
  0.1*x[2] = 4;
  -x[2] + x[3] + k*x[4] = 0;
  0.1*x[2] + k*x[3] + x[4] + 1e-6*x[5] = 1;
  1e-6*x[1] + 1e-6*x[2] + 0.7*x[3] + 0.3*x[5] = 1;
end M;
""").simulate()
    exact = [31.137723246231246, 40.0, -6.125006609291861, 15.375002203097287, 17.624778295936856]
    assert [result[f"x[{i}]"][0] for i in range(1, 6)] == pytest.approx(exact, rel=1e-13)


def test_a_parameter_that_makes_equations_depend_on_each_other_is_refused() -> None:
    """The third equation is three times the first and the second: but for rounding, at k = 3."""
    model = frot.compile("""
model M
  parameter Real k = 3;
  Real x; Real y; Real z;
equation
  1e-6*x + y + z = 0.5;
  k*y + 0.7*z = 0;
  3e-6*x + 6*y + 3.7*z = 0.5;
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0401.*must not be zero"):
        model.simulate()
    result = model.simulate(parameters={"k": 2})
    assert result["y"][0] == pytest.approx(-1, rel=1e-9)
    assert result["z"][0] == pytest.approx(2 / 0.7, rel=1e-9)


SHARES = [
    ("Real x; Real y;", "x + y = 2; 1e6*x + y = 3;", {"x": 1 / 999999, "y": 1999997 / 999999}),
    (
        "parameter Real R = 1e6; Real x; Real y; Real z;",
        "x + y + z = 2; R*x + y - z = 3; x - 2*y + z = 4;",
        {"x": 19 / 3 / 1000001, "y": -2 / 3, "z": 2 + 2 / 3 - 19 / 3 / 1000001},
    ),
]


@pytest.mark.parametrize(("declared", "equations", "exact"), SHARES)
def test_no_unknown_is_the_small_difference_of_others(
    declared: str, equations: str, exact: dict[str, float]
) -> None:
    """By the factor 1 in the first equation x would keep ten digits."""
    model = frot.compile(f"model M\n  {declared}\nequation\n  {equations}\nend M;\n")
    result = model.simulate()
    assert {name: result[name][0] for name in exact} == pytest.approx(exact, rel=4e-15)


def test_factors_whose_terms_cancel_are_told_in_the_run() -> None:
    """Whatever time is, the second equation has one tenth of the factors of the first."""
    model = frot.compile("""
model M
  Real x, y, k = 1 + time/(1 s);
equation
  k*x + 3*y = 1;
  0.1*k*x + 0.3*y = 2;
end M;
""")
    with pytest.raises(frot.FrotError, match="E0904") as told:
        model.simulate()
    assert "3*y = 1`" in str(told.value) or "0.3*y = 2`" in str(told.value)


def test_parameters_for_which_three_equations_depend_on_each_other_are_told() -> None:
    """1 2 3, 4 5 6, 7 8 k: the determinant is 27 - 3 k, of products up to 105."""
    model = frot.compile("""
model M
  parameter Real k = 9.000000000000002;
  Real x, y, z;
equation
  x + 2*y + 3*z = 1;
  4*x + 5*y + 6*z = 2;
  7*x + 8*y + k*z = 4;
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0401.*must not be zero"):
        model.simulate()
    result = model.simulate(parameters={"k": 10})
    assert result["z"][0] == pytest.approx(1, rel=1e-13)


def test_unknowns_that_stand_together_wherever_they_stand_are_told() -> None:
    """Of x and z only the sum is in the equations, whatever k is."""
    model = frot.compile("""
model M
  parameter Real k = 2;
  Real x, y, z;
equation
  x + y + z = 1;
  x + k*y + z = 2;
  x + z = 3*y;
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0[49]0[14]"):
        model.simulate()
