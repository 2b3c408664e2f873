"""Components, bases, connectors: what a text with parts becomes."""

from pathlib import Path

from frot.dsl import Log, checked, compile_text, default_values, load, render_log
from frot.dsl.checked.show import show

EXAMPLES = Path(__file__).parent / "examples"
ELECTRIC = """
connector Pin
  Voltage v;
  flow Current i;
end Pin;
partial model TwoPin
  Pin p; Pin n;
  Voltage v;
equation
  v = p.v - n.v;
  p.i + n.i = 0 A;
end TwoPin;
model Resistor
  extends TwoPin;
  parameter Resistance R = 1 Ohm;
equation
  v = R*p.i;
end Resistor;
model Capacitor
  extends TwoPin;
  parameter Capacitance C = 1 uF;
equation
  C*der(v) = p.i;
end Capacitor;
model Ground
  Pin p;
equation
  p.v = 0 V;
end Ground;
"""
LADDER = (
    ELECTRIC
    + """
model Ladder
  parameter Integer n = 3;
  input Voltage u(start = 1 V);
  Resistor r[n](R = 2 Ohm);
  Capacitor c[n](C = (1, 2, 3) uF);
  Ground g;
equation
  r[1].p.v = u;
  for i in 1:n - 1 loop
    connect(r[i].n, r[i + 1].p);
  end for;
  for i in 1:n loop
    connect(r[i].n, c[i].p);
    connect(c[i].n, g.p);
  end for;
end Ladder;
"""
)


def compiled(text: str, model: str | None = None) -> checked.Model:
    log = Log()
    found = compile_text(text, log, model=model)
    assert found is not None, render_log(log)
    return found


def scalars(model: checked.Model) -> tuple[int, int]:
    """The numbers of scalar equations and of unknowns."""
    equations = [e for e in model.equations if isinstance(e, checked.Equation)]
    assert len(equations) == len(model.equations)
    unknowns = sum(v.type.count for v in model.variables if not v.discrete)
    return sum(e.left.type.count for e in equations), unknowns


def written(model: checked.Model) -> list[str]:
    return [
        f"{show(e.left)} = {show(e.right)}"
        for e in model.equations
        if isinstance(e, checked.Equation)
    ]


def test_geared_motor_is_complete() -> None:
    log = Log()
    model = load(EXAMPLES / "geared_motor.frot", log)
    assert model is not None, render_log(log)
    assert not log.diagnostics
    assert scalars(model) == (24, 24)
    assert {p.name for p in model.parameters} == {"r.R", "l.L", "emf.k", "rotor.J", "gear.ratio"}
    values = {p.name: v for p, v in default_values(model).items()}
    assert (values["r.R"], values["emf.k"], values["gear.ratio"]) == (2.0, 0.03, 40.0)
    (flange,) = model.flanges
    assert flange.liaison is model.liaisons[0]
    assert (flange.coordinate, flange.effort.name) == ("angle", "hinge.flange.torque")
    assert flange.effort in model.variables
    assert "gear.b.torque + hinge.flange.torque = 0 N.m" in written(model)
    assert "gear.b.angle = hinge.angle" in written(model)
    gear = next(e for e in model.equations if e.owner == "gear")
    assert gear.span.text == "a.angle = ratio*b.angle;"


def test_a_ladder_has_as_many_equations_as_unknowns() -> None:
    model = compiled(LADDER)
    assert scalars(model) == (32, 32)
    values = {p.name: v for p, v in default_values(model).items()}
    assert [values[f"c[{k}].C"] for k in (1, 2, 3)] == [1e-6, 2e-6, 3e-6]
    assert "r[1].n.i + r[2].p.i + c[1].p.i = 0 A" in written(model)
    (size,) = [p for p in model.parameters if p.name == "n"]
    assert size.constant
    assert size.structural.startswith("the size of 'r'")


def test_an_inner_connector_counts_with_the_other_sign() -> None:
    model = compiled(
        ELECTRIC
        + """
model Pair
  Pin p; Pin n;
  Resistor a(R = 3 Ohm), b;
equation
  connect(p, a.p);
  connect(a.n, b.p);
  connect(b.n, n);
end Pair;
model Example
  Pair pair(b(R = 5 Ohm));
  Resistor r;
  Ground g;
equation
  connect(pair.p, r.p);
  connect(pair.n, r.n);
  connect(g.p, r.n);
end Example;
"""
    )
    found = written(model)
    assert "-pair.p.i + pair.a.p.i = 0 A" in found
    assert "pair.p.i + r.p.i = 0 A" in found
    count, unknowns = scalars(model)
    assert count == unknowns
    values = {p.name: v for p, v in default_values(model).items()}
    assert values == {"pair.a.R": 3.0, "pair.b.R": 5.0, "r.R": 1.0}


def test_what_nobody_connects_carries_no_flow() -> None:
    model = compiled(
        ELECTRIC
        + """
model Example
  Resistor r;
  Voltage across;
equation
  r.n.v = 0 V;
  across = r.p.v;
end Example;
"""
    )
    # The second equation determines `across`, the first one holds r.n open.
    assert "r.p.i = 0 A" in written(model)
    assert "r.n.i = 0 A" not in written(model)
    assert scalars(model) == (6, 6)


def test_bodies_and_liaisons_stand_in_components() -> None:
    model = compiled(
        """
planar model Leg
  parameter Length l = 1 m;
  body thigh: rod(mass = 1 kg, length = l);
  frame knee on thigh at (l/2, 0 m);
  curve track on thigh: line(through = (0, 0) m, direction = (1, 0));
  liaison hip: rotoide(ground, thigh.start) with coulomb(0.1, radius = l/100);
  force push: couple(hip, value = 1 N.m);
  RotationalFlange flange;
equation
  connect(flange, hip.flange);
initial
  hip.angle = 30 deg;
  guess(thigh.position.x = l);
end Leg;
planar model Walker
  Leg left(l = 2 m), right;
  force link: spring(left.knee, right.knee, k = 1 N/m, length = 1 m);
  liaison meet: point_courbe(right.thigh.tip, left.track);
  output Angle a = left.hip.angle;
equation
  connect(left.flange, right.flange);
end Walker;
"""
    )
    assert [b.name for b in model.bodies] == ["left.thigh", "right.thigh"]
    assert [j.name for j in model.liaisons] == ["left.hip", "right.hip", "meet"]
    assert [f.name for f in model.forces] == ["left.push", "right.push", "link"]
    assert [f.name for f in model.frames] == ["left.knee", "right.knee"]
    assert model.forces[0].arguments["holder"] is model.liaisons[0]
    assert model.liaisons[2].b.curve is model.curves[0]
    assert [show(e.left) for e in model.initial if not e.guess] == [
        "left.hip.angle",
        "right.hip.angle",
    ]
    assert "left.flange.angle = left.hip.angle" in written(model)
    assert "-left.flange.torque + left.hip.flange.torque = 0 N.m" in written(model)
    assert [f.effort.name for f in model.flanges] == [
        "left.hip.flange.torque",
        "right.hip.flange.torque",
    ]


def test_arrays_of_bodies_and_liaisons_are_one_for_each() -> None:
    model = compiled(
        """
planar model Chain
  parameter Integer n = 3;
  body link[n]: rod(mass = (1, 2, 3) kg, length = 1 m);
  liaison first: rotoide(ground, link[1].start);
  liaison pin[n - 1]: rotoide(link[1:n - 1].tip, link[2:n].start)
    with coulomb((0.1, 0.2), radius = 1 mm);
  force pull[n]: on(link.tip, value = (1 N, 0 N));
initial
  for i in 1:n loop
    link[i].angle = i*10 deg;
  end for;
end Chain;
"""
    )
    assert [b.name for b in model.bodies] == ["link[1]", "link[2]", "link[3]"]
    values = default_values(model)
    from frot.dsl import evaluate

    assert [evaluate(b.arguments["mass"], values) for b in model.bodies] == [1.0, 2.0, 3.0]
    assert [(j.a.body.name, j.b.body.name) for j in model.liaisons[1:]] == [
        ("link[1]", "link[2]"),
        ("link[2]", "link[3]"),
    ]
    mus = [evaluate(j.laws[0].arguments["mu"], values) for j in model.liaisons[1:]]
    assert mus == [0.1, 0.2]
    assert [f.arguments["frame"].body.name for f in model.forces] == [b.name for b in model.bodies]
    assert len(model.initial) == 3


def test_modifiers_reach_down_and_keep_the_scope_of_their_author() -> None:
    model = compiled(
        """
model Inner
  parameter Length a = 1 m;
  parameter Length b = 2*a;
  Length x(start = a);
equation
  der(x) = -x/(1 s);
end Inner;
model Middle
  parameter Length a = 5 m;
  Inner inner(a = 2*a, x(start = a));
end Middle;
model Outer
  parameter Length a = 100 m;
  Middle m(inner(b = a));
  Middle n(inner.a = 7 m);
end Outer;
"""
    )
    values = {p.name: v for p, v in default_values(model).items()}
    assert values == {
        "a": 100.0,
        "m.a": 5.0,
        "m.inner.a": 10.0,
        "m.inner.b": 100.0,
        "n.a": 5.0,
        "n.inner.a": 7.0,
        "n.inner.b": 14.0,
    }
    assert [show(v.start) for v in model.variables if v.start is not None] == ["m.a", "n.a"]


def test_a_base_that_comes_twice_is_taken_once() -> None:
    model = compiled(
        """
partial model Base
  Real x;
equation
  der(x) = 1 1/s;
end Base;
partial model Left
  extends Base;
end Left;
partial model Right
  extends Base;
end Right;
model Both
  extends Left;
  extends Right;
end Both;
"""
    )
    assert [v.name for v in model.variables] == ["x"]
    assert len(model.equations) == 1


def test_functions_share_what_they_are_given() -> None:
    calls = "".join(
        f"function f{k}\n input Real x;\n output Real y = f{k - 1}(x)*f{k - 1}(x);\nend f{k};\n"
        for k in range(1, 12)
    )
    text = (
        f"function f0\n input Real x;\n output Real y = x*x;\nend f0;\n{calls}"
        "model M\n Real x = sin(time/(1 s));\n Real y = f11(x);\nend M;\n"
    )
    model = compiled(text)
    assert model.equations[1].right.type == model.variables[1].type
    doubled = "Real s0 = x*x;\n" + "".join(
        f"Real s{k} = s{k - 1} + s{k - 1};\n" for k in range(1, 99)
    )
    text = (
        f"function g\n input Real x;\n output Real y = s98;\n {doubled}\nend g;\n"
        "model M\n parameter Real p = g(2);\n parameter Real q = g(p);\nend M;\n"
    )
    values = {p.name: v for p, v in default_values(compiled(text)).items()}
    assert values["p"] == 4 * 2.0**98


def test_events() -> None:
    model = compiled(
        """
model Ball
  parameter Real e = 0.8;
  Length h(start = 1 m);
  Velocity v;
  Integer bounces(start = 0);
equation
  der(h) = v;
  der(v) = -9.81 m/s^2;
  when h < 0 m then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
  elsewhen (bounces > 3, time > 5 s) then
    terminate("at rest");
  end when;
  assert(h > -1 m, "below", level = warning);
end Ball;
"""
    )
    (when,) = model.whens
    (first, second) = when.branches
    assert [type(a).__name__ for a in first[1]] == ["Reinit", "Assign"]
    assert show(first[1][0].value) == "-(e*v)"
    assert first[1][1].variable.discrete
    assert len(second[0]) == 2
    assert [v.discrete for v in model.variables] == [False, False, True]
    assert [(a.level, a.message) for a in model.assertions] == [("warning", "below")]


def test_a_parameter_of_the_structure_chooses_a_branch() -> None:
    text = """
model M
  parameter Boolean fast = {0};
  parameter Real gain = 2;
  Real x, y;
equation
  if fast then
    x = 1;
    y = 2;
  else
    x = 3;
    y = 4;
  end if;
  {1}
end M;
"""
    model = compiled(text.format("true", ""))
    assert written(model) == ["x = 1", "y = 2"]
    assert [p.constant for p in model.parameters] == [True, False]
    model = compiled(text.format("false", "").replace("if fast", "if gain > 1"))
    (choice,) = model.equations
    assert isinstance(choice, checked.IfEquations)
    assert [len(made) for _, made in choice.branches] == [2, 2]
    assert choice.branches[1][0] is None


def test_one_number_stands_for_all_items_whole_numbers_too() -> None:
    log = Log()
    text = (
        "model M\n parameter Integer p[2] = 4;\n parameter Frequency f[3] = 60 rpm;\n"
        " Integer k[2, 2](start = 1);\nequation\n when time > 1 s then\n  k[1, 2] = p[1];\n"
        " end when;\nend M;\n"
    )
    model = compile_text(text, log)
    assert model is not None, render_log(log)
    values = {p.name: v for p, v in default_values(model).items()}
    assert values == {"p": (4, 4), "f": (1, 1, 1)}


RECORDS = """
record P
  Mass m; Length l = 7 m;
end P;
model A
  parameter P p = P(m = 1 kg, l = 0.5 m);
end A;
model B
  A a(p(l = 0.3 m));
end B;
model Example
  A plain;
  A inner(p(l = 0.3 m));
  A dotted(p.l = 0.3 m);
  A whole(p = P(2 kg, 4 m));
  A each[2](p(l = (0.3, 0.4) m, m = 9 kg));
  B further(a(p(m = 5 kg)));
  B over(a(p = P(2 kg, 4 m)));
  B last(a(p(l = 6 m)));
end Example;
"""


def test_what_is_said_of_a_member_from_outside_counts_before_the_whole_record() -> None:
    log = Log()
    model = compile_text(RECORDS, log)
    assert model is not None, render_log(log)
    values = {p.name: v for p, v in default_values(model).items()}
    names = ("plain", "inner", "dotted", "whole", "each[1]", "each[2]", "further.a", "over.a")
    found = [(values[f"{n}.p.m"], values[f"{n}.p.l"]) for n in (*names, "last.a")]
    assert found == [
        (1, 0.5),
        (1, 0.3),
        (1, 0.3),
        (2, 4),
        (9, 0.3),
        (9, 0.4),
        (5, 0.3),
        (2, 4),
        (1, 6),
    ]
