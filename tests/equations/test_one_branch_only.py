"""What holds on one branch of a text alone is not taken for what holds always."""

from __future__ import annotations

import pytest

import frot

# a and b have 1 kg; b accelerates at 1 m/s^2, which the force on a may follow.
COUPLED = """
planar model Coupled
  world(gravity = 0 m/s^2);
  parameter Real k = -1;
  body a: particle(mass = 1 kg);
  body b: particle(mass = 1 kg);
  Force f;
  force on_a: on(a, value = (f, 0 N));
  force on_b: on(b, value = (1 N, 0 N));
equation
  f = {force};
  experiment(stop = 2 s);
end Coupled;
"""
FOLLOWS = "-0.5 kg*b.acceleration.x"


@pytest.mark.parametrize(
    ("force", "early", "late"),
    [
        (f"if time < 1 s then 0 N else {FOLLOWS}", 0, -0.5),
        (f"if time < 1 s then {FOLLOWS} else 0 N", -0.5, 0),
        (f"{FOLLOWS}*max(-k, 0)", -0.5, -0.5),
        (f"{FOLLOWS}*(abs(k) - k)/2", -0.5, -0.5),
        (f"{FOLLOWS}*max(time/(1 s) - 3, -1)", 0.5, 0.5),
    ],
)
def test_a_force_that_follows_an_acceleration_on_one_branch(
    force: str, early: float, late: float
) -> None:
    result = frot.compile(COUPLED.format(force=force)).simulate()
    assert result.at(0.5)["a.acceleration.x"] == pytest.approx(early, abs=1e-12)
    assert result.at(1.5)["a.acceleration.x"] == pytest.approx(late, abs=1e-12)
    assert result["a.velocity.x"][-1] == pytest.approx(early + late, abs=1e-7)


@pytest.mark.parametrize(
    "term",
    ["time < 1 s then 0/(1 s) else der(y)", "time >= 1 s then der(y) else 0/(1 s)"],
)
def test_equations_that_depend_on_each_other_on_one_branch_are_refused(term: str) -> None:
    """Until 1 s both say what der(x) + der(y) is: no number follows, and none is made up."""
    text = f"""
model Alike
  Real x(start = 0); Real y(start = 0);
equation
  der(x) + der(y) = 1/(1 s);
  der(x) + der(y) + (if {term}) = (1 + x - y)/(1 s);
  experiment(stop = 2 s);
end Alike;
"""
    with pytest.raises(frot.SimulationError, match="E0912"):
        frot.compile(text).simulate()


@pytest.mark.parametrize("tie", ["time < 1 s then v else i", "time >= 1 s then i else v"])
def test_a_potential_that_one_branch_ties_down_is_not_loose(tie: str) -> None:
    """A switch to ground, closed until 1 s."""
    text = f"""
import Electrical.*;
model Tie
  Pin p; Real v, i;
equation
  v = p.v/(1 V); i = p.i/(1 A);
  0 = if {tie};
end Tie;
model Switched
  ConstantVoltage s(V = 5 V); Resistor r(R = 10 Ohm); Tie tie;
equation
  connect(s.p, r.p); connect(r.n, s.n); connect(tie.p, s.n);
  experiment(stop = 0.1 s);
end Switched;
"""
    assert frot.compile(text).simulate()["s.p.v"][-1] == pytest.approx(5, rel=1e-12)
