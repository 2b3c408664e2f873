"""Components, bases, connectors: what a text with parts becomes."""

from pathlib import Path

from frot.dsl import Log, checked, compile_text, default_values, load, render_log
from frot.dsl.show import show

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
    assert not log.diagnostics, render_log(log)
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
    assert "gear.b.torque + hinge.flange.torque = 0 m^2.kg/s^2" in written(model)
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
