"""Records as parameters, variables, inputs and outputs of one model."""

from __future__ import annotations

import frot

PAIRS = """
record Pair
  Real x, y;
end Pair;
record Named
  Pair a;
  Force f;
end Named;
model Within
  input Pair u;
  Real sum = u.x + u.y;
end Within;
model Roles
  parameter Pair p = Pair(1, 2);
  input Named u(f(start = 4 N), a(x(start = 3)));
  Pair q, r = Pair(u.a.x, p.y);
  Within w;
  output Pair o = Pair(q.x + p.x, q.y);
  output Force push = u.f*r.y;
equation
  q = Pair(y = time/(1 s), x = 5);
  w.u = q;
end Roles;
"""


def test_each_record_of_a_model_has_its_own_role() -> None:
    """One that is a parameter makes none of the others one; members of an input are inputs."""
    model = frot.compile(PAIRS, model="Roles")
    run = model.simulate(stop=2, parameters={"p.x": 7.0}, inputs={"u.a.x": 6.0})
    found = {x: run[x][-1] for x in ("o.x", "o.y", "push", "r.x", "w.sum")}
    assert found == {"o.x": 12, "o.y": 2, "push": 8, "r.x": 6, "w.sum": 7}
