"""The checked model: objects, SI values, choices."""

import math
from pathlib import Path

import pytest
from frot.dsl import Log, checked, compile_text, default_values, dump, evaluate, load, render_log
from frot.dsl.quantities.dimensions import dimension

EXAMPLES = Path(__file__).parent / "examples"


def example(name: str) -> checked.Model:
    log = Log()
    model = load(EXAMPLES / f"{name}.frot", log)
    assert model is not None, render_log(log)
    assert not log.diagnostics
    return model


def compiled(body: str) -> checked.Model:
    log = Log()
    model = compile_text(f"planar model M\n{body}\nend M;\n", log)
    assert model is not None, render_log(log)
    return model


def test_inclined_block() -> None:
    model = example("inclined_block")
    values = default_values(model)
    assert {p.name: v for p, v in values.items()} == pytest.approx(
        {"slope": math.radians(20), "mu": 0.5, "v0": 3.0}
    )
    assert [p.unit for p in model.parameters] == ["deg", "", "m/s"]
    (block,) = model.bodies
    assert block.shape is not None and block.shape.name == "particle"
    (support,) = model.liaisons
    assert support.kind.name == "point_courbe"
    assert isinstance(support.a, checked.BodyPoint) and support.a.body is block
    assert isinstance(support.b, checked.CurvePlace) and support.b.curve is model.curves[0]
    direction = evaluate(model.curves[0].arguments["direction"], values)
    assert direction == pytest.approx((math.cos(math.radians(20)), -math.sin(math.radians(20))))
    (law,) = support.laws
    assert law.arguments["mu_s"] is law.arguments["mu"]
    assert "radius" not in law.arguments
    assert evaluate(support.options["unilateral"], values) is False
    (output,) = model.outputs
    assert isinstance(output.value, checked.Quantity)
    assert (output.value.owner, output.value.name) == (support, "abscissa")
    assert output.type.dimension == dimension(m=1)
    assert model.world.down == "-y" and model.world.gravity is None
    assert evaluate(model.experiment.stop, values) == 3.0
    assert model.experiment.tolerance is None
    launch = model.initial[1]
    assert evaluate(launch.right, values)[1] == pytest.approx(-3 * math.sin(math.radians(20)))


def test_backspin_hoop() -> None:
    model = example("backspin_hoop")
    values = default_values(model)
    (hoop,) = model.bodies
    assert evaluate(hoop.arguments["radius"], values) == 0.5
    assert "inertia" not in hoop.arguments
    (floor,) = model.liaisons
    assert isinstance(floor.a, checked.CurvePlace)
    assert floor.a.curve.owner is model.ground and floor.a.curve.span is None
    assert isinstance(floor.b, checked.BodyGeometry)
    assert (floor.b.body, floor.b.name) == (hoop, "rim")
    assert evaluate(floor.options["unilateral"], values) is True
    assert [law.kind.name for law in floor.laws] == ["coulomb", "rolling_resistance"]
    starts = [evaluate(e.right, values) for e in model.initial]
    assert starts == [(0.0, 0.5), (1.0, 0.0), 20.0]
    assert all(e.left.owner is hoop for e in model.initial)


def test_coulomb_oscillator() -> None:
    model = example("coulomb_oscillator")
    values = default_values(model)
    (pull,) = model.forces
    assert pull.kind.name == "attraction"
    assert isinstance(pull.arguments["point"], checked.BodyPoint)
    assert evaluate(pull.arguments["centre"], values) == (0.0, 0.0)
    assert evaluate(pull.arguments["k"], values) == 9.0


@pytest.mark.parametrize("name", ["bouncing_ball", "elliptic_disc", "painleve_rod", "slider_crank"])
def test_other_planar_examples_check(name: str) -> None:
    example(name)


def test_a_couple_is_held_by_its_liaison() -> None:
    model = example("slider_crank")
    assert model.forces[0].arguments["holder"] is model.liaisons[0]
    assert [i.name for i in model.inputs] == ["drive"]
    assert evaluate(model.inputs[0].start, {}) == 4.0


def test_components_of_vectors_are_elements() -> None:
    model = compiled("body m: particle(mass = 1 kg);\noutput Length x = m.position.x;")
    value = model.outputs[0].value
    assert isinstance(value, checked.Element) and value.index == 0
    assert isinstance(value.operand, checked.Quantity)
    assert value.operand.owner is model.bodies[0]


def test_a_unit_after_a_tuple_multiplies_its_items() -> None:
    model = compiled("curve c on ground: line(through = (1, -2*3) mm, direction = (1, 0));")
    through = model.curves[0].arguments["through"]
    assert evaluate(through, {}) == pytest.approx((0.001, -0.006))
    assert through.type.dimension == dimension(m=1)
    assert all(i.type.dimension == dimension(m=1) for i in through.items)


def test_declarations_may_stand_in_any_order() -> None:
    model = compiled(
        "liaison j: rotoide(f, bar.start);\nframe f on ground at (a, 0 m);\n"
        "parameter Length a = 2*b;\nparameter Length b = 1 m;\nbody bar: rod(1 kg, a);"
    )
    assert [p.name for p in model.parameters] == ["a", "b"]
    assert list(default_values(model).values()) == [2.0, 1.0]
    assert model.liaisons[0].a is model.frames[0]


def test_derivatives_and_guesses() -> None:
    model = compiled(
        "body bar: rod(1 kg, 1 m);\ninitial\nder(bar.angle) = 2 1/s;\nguess(bar.angle = 20 deg);"
    )
    rate, guess = model.initial
    assert isinstance(rate.left, checked.Derivative)
    assert rate.left.type.dimension == dimension(s=-1)
    assert [rate.guess, guess.guess] == [False, True]


def test_a_unit_modifier_gives_the_dimension() -> None:
    model = compiled('parameter Real k(unit = "mN.m") = 5;')
    assert model.parameters[0].type.dimension == dimension(m=2, kg=1, s=-2)
    assert evaluate(model.parameters[0].value, {}) == pytest.approx(0.005)


def test_names_without_accents_and_in_english() -> None:
    model = compiled(
        "body bar: rod(1 kg, 1 m);\nbody m: particle(1 kg);\n"
        "joint a: rotoïde(ground, bar.start);\njoint b: revolute(bar.tip, m);"
    )
    assert {j.kind.name for j in model.liaisons} == {"rotoide"}


TWO = """planar model Part
end Part;
partial planar model Base
end Base;
planar model Other
end Other;
"""


def test_the_model_is_chosen_by_name() -> None:
    log = Log()
    model = compile_text(TWO, log, model="Other")
    assert model is not None and model.name == "Other"
    for name, code in (("Nobody", "E0207"), ("Base", "E0509"), (None, "E0510")):
        log = Log()
        assert compile_text(TWO, log, model=name) is None
        assert [d.code for d in log] == [code]


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    latin = tmp_path / "latin.frot"
    latin.write_bytes("// Painlevé\n".encode("latin-1"))
    for path in (tmp_path / "none.frot", tmp_path, latin, "a\0b"):
        log = Log()
        assert load(path, log) is None
        assert [d.code for d in log] == ["E0804"]


def test_dump_shows_a_model() -> None:
    shown = dump(example("backspin_hoop"))
    assert "LawKind coulomb" in shown
    assert "Body hoop (above)" in shown


def test_degrees_celsius_are_absolute() -> None:
    model = compiled(
        "parameter Temperature a = 20 degC;\nparameter Temperature b = -5 degC;\n"
        "parameter Temperature c = a - b;\noutput Boolean warm = a > 0 degC;"
    )
    assert list(default_values(model).values()) == pytest.approx([293.15, 268.15, 25.0])
    for written in ("a + 5 degC", "2*20 degC", "a/(1 degC)*a", "1 degC + a"):
        log = Log()
        text = f"planar model M\nparameter Temperature a = 1 K;\noutput Temperature b = {written};"
        assert compile_text(f"{text}\nend M;\n", log) is None
        assert [d.code for d in log] == ["E0302"], render_log(log)


def test_units_are_shown_as_they_are_written() -> None:
    log = Log()
    compile_text(
        "model M\n parameter Length l = 12 mm;\n Length x;\nequation\n l = 2 kN;\n"
        " x = l + 3 kN;\nend M;\n",
        log,
    )
    assert [d.message for d in log] == [
        "expected a length (mm), found a force (kN)",
        "cannot add these: a length (mm) + a force (kN)",
    ]


@pytest.mark.parametrize(
    "left", ["(b.position.x - a.position.x)*2", "2*a.position.x - b.position.x"]
)
def test_a_relation_begins_as_any_expression(left: str) -> None:
    log = Log()
    text = f"""
liaison Twice(a: frame, b: frame)
  geometric {left} = 0;
end Twice;
planar model M
  body p: disc(mass = 1 kg, radius = 1 m);
  body q: disc(mass = 1 kg, radius = 1 m);
  liaison t: Twice(p, q);
end M;
"""
    model = compile_text(text, log)
    assert model is not None, render_log(log)
    assert len(model.liaisons[0].relations) == 1


def test_a_relation_that_begins_with_a_sign_is_told_its_remedy() -> None:
    log = Log()
    text = """
liaison Twice(a: frame, b: frame)
  geometric -a.position.x + b.position.x = 0;
end Twice;
planar model M
  body p: disc(mass = 1 kg, radius = 1 m);
  body q: disc(mass = 1 kg, radius = 1 m);
  liaison t: Twice(p, q);
end M;
"""
    compile_text(text, log)
    (told,) = log.diagnostics
    assert told.code == "E0501" and "parentheses" in told.help
