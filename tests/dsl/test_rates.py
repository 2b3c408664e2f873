"""One turn a second is 1 Hz and 2 pi rad/s: a rate means the same wherever it is written."""

from math import pi

import pytest
from frot.dsl import Log, compile_text, default_values, render_log

import frot


def values(*declarations: str) -> dict[str, object]:
    log = Log()
    body = "".join(f"  {d}\n" for d in declarations)
    model = compile_text(f"model Rates\n{body}end Rates;\n", log)
    assert model is not None, render_log(log)
    return {p.name: v for p, v in default_values(model).items()}


@pytest.mark.parametrize(
    ("declaration", "si"),
    [
        ("parameter Frequency x = 60 rpm;", 1.0),
        ("parameter Frequency x = -60 rpm;", -1.0),
        ("parameter Frequency x = 360 deg/s;", 1.0),
        ("parameter Frequency x = 2 tour/s;", 2.0),
        ("parameter Frequency x = 3 kHz;", 3000.0),
        ("parameter Frequency x = 3 1/s;", 3.0),
        ('parameter Frequency x(unit = "rpm") = 120;', 2.0),
        ("parameter AngularVelocity x = 1 Hz;", 2 * pi),
        ("parameter AngularVelocity x = 60 rpm;", 2 * pi),
        ("parameter AngularVelocity x = 3 1/s;", 3.0),
        ('parameter Real x(unit = "rad/s") = 1 Hz;', 2 * pi),
        ("parameter AngularVelocity x = 2*pi*(1 Hz);", 2 * pi),
        ("parameter AngularVelocity x = 1 Hz + 60 rpm;", 4 * pi),
        ("parameter Boolean x = 61 rpm > 1 Hz and 59 rpm < 1 Hz;", True),
    ],
)
def test_a_rate_is_what_its_declaration_says(declaration: str, si: object) -> None:
    assert values(declaration)["x"] == pytest.approx(si, rel=1e-15)


def test_the_items_of_an_array_are_converted() -> None:
    assert values("parameter Frequency x[2] = (60, 120) rpm;")["x"] == pytest.approx((1, 2))


@pytest.mark.parametrize(
    "text",
    [
        "parameter Frequency f = 1 Hz;\n parameter AngularVelocity w = f;",
        "parameter AngularVelocity w = 1 rad/s;\n parameter Frequency f = w;",
        "parameter Frequency f = 1 Hz;\n AngularVelocity w;\nequation\n w = f;",
        "parameter Frequency f = 1 Hz;\n AngularVelocity w;\nequation\n w = f + 1 rad/s;",
        "parameter Frequency f = 1 Hz;\n Angle a;\nequation\n der(a) = f;",
    ],
)
def test_one_kind_of_rate_is_not_taken_for_the_other(text: str) -> None:
    log = Log()
    compile_text(f"model Rates\n {text}\nend Rates;\n", log)
    assert [d.code for d in log] == ["E0301"], render_log(log)
    assert "2*pi" in next(iter(log)).help


RUN = """
planar model Turning
  parameter Frequency f = 60 rpm;
  parameter AngularVelocity w = 1 Hz;
  body b: disc(mass = 1 kg, radius = 1 m);
  output Frequency g = f;
initial
  b.angular_velocity = 1 Hz;
  experiment(stop = 1 s);
end Turning;
"""


def test_a_run_and_its_settings_agree_with_the_text() -> None:
    model = frot.compile(RUN)
    result = model.simulate()
    assert result["b.angular_velocity"] == pytest.approx(2 * pi)
    assert result["g"] == pytest.approx(1.0)
    assert model.simulate(parameters={"f": "90 rpm"})["g"] == pytest.approx(1.5)
    assert model.simulate(parameters={"f": "2 Hz"})["g"] == pytest.approx(2.0)
    units = {p.name: p.unit for p in model.program().parameters}
    assert (units["f"].name, units["f"].display) == ("Hz", "rpm")
    assert units["f"].display_factor == pytest.approx(1 / 60)
    assert (units["w"].name, units["w"].display) == ("rad/s", "Hz")
    assert units["w"].display_factor == pytest.approx(2 * pi)
