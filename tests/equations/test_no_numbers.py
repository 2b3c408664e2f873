"""What gives no finite number is named, with its place."""

import pytest

import frot


def refused(text: str) -> str:
    with pytest.raises(frot.FrotError) as error:
        frot.compile(text).simulate()
    return str(error.value)


@pytest.mark.parametrize(
    ("equation", "named"),
    [
        ("y = log(k - time/(0.1 s));", "`y = log(k - time/(0.1 s))`"),
        ("when time > 0.1 s then y = log(-k); end when;", "`time > 0.1 s`"),
    ],
)
def test_the_equation_is_named(equation: str, named: str) -> None:
    text = refused(
        f"model M\n parameter Real k = 1;\n Real y(start = 0);\nequation\n {equation}\nend M;\n"
    )
    assert "E0904" in text and named in text and ":5:" in text


def test_forces_that_take_the_inertia_away_are_told() -> None:
    text = refused(
        "planar model M\n body b: particle(mass = 1 kg);\n"
        " force f: on(b, value = (b.acceleration.x*(1 kg) + 1 N, 0 N));\nend M;\n"
    )
    assert text.count("error[") == 1 and "take its inertia away" in text


def test_numbers_that_are_too_large_to_compute_with_are_refused() -> None:
    model = frot.compile("""
planar model M
  parameter Real mu = 0.1;
  body b: particle(mass = 2 kg);
  liaison f: contact_ponctuel(b, ground.line) with coulomb(mu);
initial
  b.velocity.x = 1 m/s;
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0401.*mu.*more than can be computed with"):
        model.simulate(parameters={"mu": 1e300})
    assert model.simulate(parameters={"mu": 1e100})["b.velocity.x"][-1] == 0


def test_equations_that_have_no_solution_where_a_value_is_asked_for_are_named() -> None:
    """There is none within a millionth of 0.55 s, which the run steps over; it is asked for."""
    model = frot.compile("""
model M
  Real x(start = 1);
equation
  x^2 = (0.55 - time/(1 s))^2 - 1e-12;
end M;
""")
    with pytest.raises(frot.FrotError, match=r"E0907.*the equations for x.*at t = 0\.55"):
        model.simulate(interval=0.11)
