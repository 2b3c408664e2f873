"""Nodes of resistors alone, one algebraic loop through all of them: every one keeps its digits.

Taken cell by cell the potentials grow by a factor a cell, (2.6 where all resistors are equal), and
nothing is left of them after some dozen. The values are those of numpy's solution of the nodes.
"""

import numpy as np
import pytest
from scipy.linalg import expm

import frot

NODES = """
model Nodes "a chain of resistors between nodes, from each a resistor and a coil to the ground"
  import Electrical.*;
  parameter Integer n = {n};
  parameter Resistance along = {along} Ohm;
  parameter Resistance across = {across} Ohm;
  ConstantVoltage source(V = 1 V);
  Resistor r[n](R = along);
  Resistor leak[n](R = across);
  Inductor l[n](L = 1 H);
  Ground earth;
initial
  for i in 1:n loop
    l[i].i = 0 A;
  end for;
equation
  connect(source.n, earth.p);
  connect(source.p, r[1].p);
  for i in 1:n loop
    connect(r[i].n, l[i].p);
    connect(r[i].n, leak[i].p);
    connect(l[i].n, earth.p);
    connect(leak[i].n, earth.p);
  end for;
  for i in 2:n loop
    connect(r[i - 1].n, r[i].p);
  end for;
  experiment(stop = {stop} s, tolerance = 1e-9);
end Nodes;
"""


def nodes(n: int, along: float, across: float, t: float) -> tuple[np.ndarray, np.ndarray]:
    """Currents of the coils and potentials of the nodes: G v = s - i, L i' = v."""
    conductance = np.diag(np.full(n, 2 / along + 1 / across))
    conductance -= (np.eye(n, k=1) + np.eye(n, k=-1)) / along
    conductance[-1, -1] -= 1 / along
    fed = np.zeros(n)
    fed[0] = 1 / along
    inverse = np.linalg.inv(conductance)
    current = fed - expm(-inverse * t) @ fed
    return current, inverse @ (fed - current)


def worst(result: frot.Result, n: int, along: float, across: float, t: float) -> float:
    current, potential = nodes(n, along, across, t)
    found = result.at(t)
    off = [abs(found[f"l[{k + 1}].i"] - current[k]) * along for k in range(n)]
    return max(*off, *(abs(found[f"r[{k + 1}].n.v"] - potential[k]) for k in range(n)))


@pytest.mark.parametrize("n", [2, 4, 7, 60])
@pytest.mark.parametrize("across", [1.0, 10.0])
def test_a_chain_of_nodes_keeps_its_digits(n: int, across: float) -> None:
    result = frot.compile(NODES.format(n=n, along=1, across=across, stop=2)).simulate()
    assert worst(result, n, 1, across, 2.0) < 1e-8


def test_it_keeps_them_for_other_resistors_than_those_of_the_text() -> None:
    n = 12
    model = frot.compile(NODES.format(n=n, along=1, across=1, stop=1))
    for along, across in ((1e3, 1.0), (1.0, 1e6), (1e-3, 1.0), (1e4, 1e4)):
        result = model.simulate(parameters={"along": along, "across": across})
        assert worst(result, n, along, across, 1.0) < 1e-7
