"""A circuit without a ground is told so, whatever its parts; one with a ground runs."""

import pytest

import frot

CIRCUIT = """
import Electrical.*;
import Rotational.*;
model Floating
  {parts}
  {ground}
equation
  {connections}
  experiment(stop = 0.1 s);
end Floating;
"""
PARTS = {
    "resistor": ("Resistor r(R = 10 Ohm);", "connect(s.p, r.p); connect(r.n, s.n);"),
    "capacitor": (
        "Resistor r(R = 10 Ohm); Capacitor c(C = 1e-3 F, v(start = 0 V));",
        "connect(s.p, r.p); connect(r.n, c.p); connect(c.n, s.n);",
    ),
    "diode": (
        "Resistor r(R = 10 Ohm); Diode c;",
        "connect(s.p, r.p); connect(r.n, c.p); connect(c.n, s.n);",
    ),
    "inductor": (
        "Resistor r(R = 10 Ohm); Inductor c(L = 1 H);",
        "connect(s.p, r.p); connect(r.n, c.p); connect(c.n, s.n);",
    ),
    "open": (
        "Resistor r(R = 10 Ohm); Resistor q(R = 1 Ohm);",
        "connect(s.p, r.p); connect(r.n, s.n); connect(q.p, r.n);",
    ),
}


def circuit(kind: str, ground: bool) -> frot.Model:
    parts, connections = PARTS[kind]
    tie = "connect(g.p, s.n);" if ground else ""
    return frot.compile(
        CIRCUIT.format(
            parts="ConstantVoltage s(V = 5 V); " + parts,
            ground="Ground g;" if ground else "",
            connections=connections + tie,
        )
    )


@pytest.mark.parametrize("kind", PARTS)
def test_a_circuit_without_a_ground_is_told(kind: str) -> None:
    with pytest.raises(frot.FrotError, match="nothing fixes the potentials") as told:
        circuit(kind, False).simulate()
    assert [d.code for d in told.value.diagnostics] == ["E0611"]
    assert "`Ground`" in told.value.diagnostics[0].help


@pytest.mark.parametrize("kind", PARTS)
def test_a_circuit_with_a_ground_runs(kind: str) -> None:
    assert circuit(kind, True).simulate()["s.p.v"][-1] == pytest.approx(5, rel=1e-12)


def test_two_circuits_are_told_apart() -> None:
    text = CIRCUIT.format(
        parts="ConstantVoltage s, t; Resistor r, q;",
        ground="Ground g;",
        connections="connect(s.p, r.p); connect(r.n, s.n); connect(g.p, s.n);"
        "connect(t.p, q.p); connect(q.n, t.n);",
    )
    with pytest.raises(frot.FrotError) as told:
        frot.compile(text).simulate()
    message = told.value.diagnostics[0].message
    assert "'t.p.v'" in message
    assert "'s.p.v'" not in message
