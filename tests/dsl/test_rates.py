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
        ("parameter Frequency x = 2*(60 rpm);", 2.0),
        ("parameter Frequency x = (60 rpm)/4*3;", 0.75),
        ("parameter AngularVelocity x = -2*(1 Hz);", -4 * pi),
        ("parameter AngularVelocity x = 6.283*(1 Hz);", 6.283),
        ("parameter AngularVelocity x = (1 Hz)*2*pi;", 2 * pi),
        ("parameter Frequency x = max(30 rpm, 60 rpm);", 1.0),
        ("parameter AngularVelocity x = max(30 rpm, 1 Hz);", 2 * pi),
        ("parameter Frequency x = abs(-60 rpm);", 1.0),
        ("parameter Frequency x = if 61 rpm > 1 Hz then 60 rpm else 2 Hz;", 1.0),
        ("parameter Frequency x = sum((60 rpm, 3 Hz));", 4.0),
        ("parameter Frequency x = hypot(180 rpm, 4 Hz);", 5.0),
        ("parameter Angle x = (60 rpm + 1 Hz)*(1 s);", 4 * pi),
    ],
)
def test_a_rate_is_what_its_declaration_says(declaration: str, si: object) -> None:
    assert values(declaration)["x"] == pytest.approx(si, rel=1e-15)


def test_a_number_that_may_be_the_factor_between_them_converts_nothing() -> None:
    found = values(
        "constant Real tau = 2*pi;",
        "parameter Real k = 3;",
        "parameter Frequency f = k*(60 rpm);",
        "parameter AngularVelocity w = tau*f;",
        "parameter AngularVelocity v = k*w + 60*(1 Hz);",
        "parameter Frequency g = k*f + 30 rpm;",
    )
    assert (found["f"], found["g"]) == pytest.approx((3.0, 9.5))
    assert (found["w"], found["v"]) == pytest.approx((6 * pi, 138 * pi))


@pytest.mark.parametrize("k", [*range(1, 200), 3.5, 8.6, 12.1, 15.7, 0.3, 9.5, 12.6, 19.1])
def test_no_number_of_turns_is_taken_for_pi(k: float) -> None:
    assert values(f"parameter Frequency x = {k}*(60 rpm);")["x"] == pytest.approx(k)


@pytest.mark.parametrize("factor", ["3.14", "6.28", "6.2832", "12.566", "1.571"])
def test_pi_in_digits_is_taken_for_pi(factor: str) -> None:
    found = values(f"parameter AngularVelocity x = {factor}*(1 Hz);")
    assert found["x"] == pytest.approx(float(factor))


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
        "parameter Frequency f = 1 Hz;\n parameter AngularVelocity w = 3*f;",
        "parameter Frequency f = 1 Hz;\n parameter AngularVelocity w = max(f, 1 rad/s);",
        "parameter Angle a = 1;\n parameter Frequency f = a/(2 s);",
        "parameter AngularVelocity w = 1 Hz;\n parameter Frequency f[2] = (w, 2 Hz);",
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


DRIVEN = """
liaison Spin(a: frame, b: frame, AngularVelocity more) "turns b"
  kinematic b.angular_velocity - a.angular_velocity - more = 1 Hz;
end Spin;
planar model Driven
  body d: disc(mass = 1 kg, radius = 1 m);
  body e: disc(mass = 1 kg, radius = 1 m);
  body s: disc(mass = 1 kg, radius = 1 m);
  frame far on ground at (5, 0) m;
  liaison p: rotoide(ground, d) driven(speed = 1 Hz);
  liaison q: rotoide(far, e) driven(speed = 0.5*p.speed + 30 rpm);
  liaison spin: Spin(ground, s, 1 Hz);
end Driven;
"""


def test_what_drives_a_turn_is_an_angular_velocity() -> None:
    result = frot.compile(DRIVEN).simulate(stop=0.1)
    found = [result[f"{body}.angular_velocity"][-1] for body in "des"]
    assert found == pytest.approx([2 * pi, 2 * pi, 4 * pi])


@pytest.mark.parametrize("line", ["rotoide(ground, d) driven(speed = f)", "Spin(ground, d, f)"])
def test_a_frequency_drives_no_turn(line: str) -> None:
    text = DRIVEN.replace("rotoide(ground, d) driven(speed = 1 Hz)", line)
    text = text.replace("  body e", "  parameter Frequency f = 1 Hz;\n  body e")
    log = Log()
    assert compile_text(text.replace("0.5*p.speed", "0"), log) is None
    assert ("E0301", "an angular velocity is '2*pi*f'") in [(d.code, d.help) for d in log]
