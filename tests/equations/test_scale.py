"""What a text costs grows with its length: counted, not timed."""

from __future__ import annotations

import cProfile
import pstats
import re

import numpy as np
import pytest
from frot.compiler.driver import lowered_of
from frot.compiler.lowering.lower import Lowered
from frot.compiler.product import reroll, split
from frot.compiler.product.generate import generate
from frot.compiler.product.split import LONGEST
from frot.dsl import Log, compile_text
from scale_texts import circuit

import frot

SPHERE = """
model Points "points that repel each other on a sphere: index 3"
  constant Integer n = {n};
  Real x[n, 3];
  Real w[n, n];
  Real g[n](unit = "1/s^2");
initial
  for i in 1:n loop
    guess(x[i, 1] = cos(2.4*i)*sqrt(1 - (1 - (2*i - 1)/n)^2));
    guess(x[i, 2] = sin(2.4*i)*sqrt(1 - (1 - (2*i - 1)/n)^2));
    guess(x[i, 3] = 1 - (2*i - 1)/n);
  end for;
equation
  for i in 1:n loop
    for j in 1:n loop
      w[i, j] = if i == j then 0 else
        1/((x[i, 1] - x[j, 1])^2 + (x[i, 2] - x[j, 2])^2 + (x[i, 3] - x[j, 3])^2)^1.5;
    end for;
    for k in 1:3 loop
      der(der(x[i, k])) = g[i]*x[i, k]
        + (sum(w[i, 1:n])*x[i, k] - dot(w[i, 1:n], x[1:n, k]))*1 1/s^2;
    end for;
    x[i, 1]^2 + x[i, 2]^2 + x[i, 3]^2 = 1;
  end for;
  experiment(stop = 0.1 s);
end Points;
"""


def lowered(text: str) -> Lowered:
    log = Log()
    model = compile_text(text, log)
    assert model is not None
    found = lowered_of(model, log)
    assert found is not None
    return found


def c_text(made: Lowered) -> str:
    """The C of a model, every parameter with the value one."""
    return generate(made, "key", [1.0] * len(made.reduced.symbols.parameters), [])


def calls(text: str) -> int:
    """Calls of Python's and CasADi's functions from the text to C."""
    profile = cProfile.Profile()
    profile.enable()
    c_text(lowered(text))
    profile.disable()
    return int(pstats.Stats(profile).total_calls)


def test_twice_the_cells_take_twice_the_calls() -> None:
    lowered(circuit(3))  # what is loaded once
    one, two, four = (calls(circuit(n)) for n in (40, 80, 160))
    assert (four - two) < 2.3 * (two - one)


def test_the_ladder_of_parts_costs_what_its_states_cost() -> None:
    """Seven operations a state at most: two currents, their difference, by R and by C."""
    for n in (50, 100):
        rates = lowered(circuit(n)).whole.functions["dynamics"]
        operations = rates.n_instructions() - n - sum(rates.nnz_in(k) for k in range(rates.n_in()))
        assert operations < 10 * n


def test_no_function_of_c_is_long() -> None:
    made = lowered(SPHERE.format(n=8))
    assert max(f.n_instructions() for f in made.whole.functions.values()) > 4 * LONGEST
    longest = max(function.count(";\n") for function in re.split(r"\n}\n", c_text(made)))
    assert longest < 1.2 * LONGEST


def test_a_function_in_pieces_gives_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole, cut, and with one function for what stands at several places of several functions."""
    found = []
    for longest, many in ((10**9, 10**9), (40, 10**9), (40, 0)):
        monkeypatch.setattr(split, "LONGEST", longest)
        monkeypatch.setattr(reroll, "MANY", many)
        program = frot.compile(f"// {longest} {many}\n{SPHERE.format(n=4)}")
        result = program.simulate(interval=0.01)
        found.append(np.array([result[name] for name in result]))
        text = program.program().source.read_text(encoding="utf-8")
        calls = set(re.findall(r"^  (casadi_f\d+_\d+)\(arg, res, w, (casadi_f\d+)_t", text, re.M))
        assert (len(calls) > len({piece for piece, _ in calls})) == (many == 0)
    assert all(np.array_equal(found[0], other, equal_nan=True) for other in found[1:])
