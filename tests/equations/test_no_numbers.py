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
