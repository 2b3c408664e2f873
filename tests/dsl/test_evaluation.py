"""Values of expressions of parameters."""

import math

import pytest
from frot.dsl import Log, NotConstant, checked, compile_text, default_values, evaluate, render_log


def compiled(body: str) -> checked.Model:
    log = Log()
    model = compile_text(f"planar model M\n{body}\nend M;\n", log)
    assert model is not None, render_log(log)
    return model


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("2 + 3*4", 14.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("10/4/5", 0.5),
        ("sin(pi/6)", 0.5),
        ("atan2(-1, 0)", -math.pi / 2),
        ("max(1, 3, 2) - min(4, 5)", -1.0),
        ("mod(-1, 3)", 2.0),
        ("norm((3, 4))", 5.0),
        ("dot((1, 2), (3, 4))", 11.0),
        ("cross((1, 2), (3, 4))", -2.0),
        ("((1, 2) + 2*(3, 4)).y", 10.0),
        ("(5, 6)[2]", 6.0),
        ("if 1 < 2 and not (1 m > 2 m) then 7 else 8", 7.0),
        ("(3 km)/(1 m)", 3000.0),
        ("sqrt(4 m^2)/(1 mm)", 2000.0),
        ("(8 m^3)^(1/3)/(1 m)", 2.0),
        ("sign(-3 kg)", -1.0),
        ("50 % + 90 deg", 0.5 + math.pi / 2),
    ],
)
def test_values(text: str, wanted: float) -> None:
    model = compiled(f"parameter Real x = {text};")
    assert evaluate(model.parameters[0].value, {}) == pytest.approx(wanted, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "a"),
    [
        ("1/a", 0.0),
        ("log(a)", 0.0),
        ("sqrt(a)", -1.0),
        ("a^0.5", -1.0),
        ("0^a", -1.0),
        ("10^a", 400.0),
        ("1e300*a", 1e300),
    ],
)
def test_what_has_no_value_is_a_sentence(text: str, a: float) -> None:
    model = compiled(f"parameter Real a = 2;\nparameter Real x = {text};")
    with pytest.raises(ValueError, match=r"\w+ \w+"):
        default_values(model, {"a": a})


def test_defaults_follow_what_they_depend_on() -> None:
    model = compiled(
        "parameter Length d = 2*r;\nparameter Length r = 10 mm;\nconstant Real n = 3;\n"
        "parameter Boolean kept = n > 2;"
    )
    names = {p.name: p for p in model.parameters}
    values = default_values(model, {"r": 1.0})
    assert [values[names[n]] for n in ("d", "r", "n", "kept")] == [2.0, 1.0, 3.0, True]
    with pytest.raises(KeyError):
        default_values(model, {"nobody": 1.0})
    with pytest.raises(ValueError, match="constant"):
        default_values(model, {"n": 1.0})


@pytest.mark.parametrize("text", ["time/(1 s)", "b.angle", "der(b.angle)*(1 s)", "u"])
def test_the_motion_is_not_constant(text: str) -> None:
    model = compiled(f"input Real u;\nbody b: rod(1 kg, 1 m);\noutput Real x = {text};")
    with pytest.raises(NotConstant):
        evaluate(model.outputs[0].value, {})
