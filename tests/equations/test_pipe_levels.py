"""Levels that pipes even out in finite time, by a root of their difference, and that stay even."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

import frot

TOLERANCES = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
LAWS = {
    "sign": "K[i]*sign(h[i] - h[i+1])*sqrt(abs(h[i] - h[i+1]))",
    "if": "K[i]*(if h[i] > h[i+1] then sqrt(h[i] - h[i+1]) else -sqrt(h[i+1] - h[i]))",
    "variable": "K[i]*sign(d[i])*(2*abs(d[i])/2)^0.5",
}


@cache
def row_of_tanks(count: int, law: str = "sign") -> frot.Model:
    """Tanks of areas A with a pipe from each to the next; a pump fills the first at 8 s."""
    flows = ["pump*(if time > 8 s and time < 9 s then 1 else 0)"]
    flows += [f"q[{i}]" for i in range(1, count)] + ["0"]
    rates = "\n".join(
        f"  A[{i}]*der(h[{i}]) = ({enters} - {leaves})*(1 1/s);"
        for i, (enters, leaves) in enumerate(pairwise(flows), 1)
    )
    return frot.compile(f"""
model Tanks
  parameter Real A[{count}] = fill(1.0, {count}), K[{count - 1}] = fill(1.0, {count - 1});
  parameter Real first[{count}] = fill(0.0, {count}), pump = 0;
  Real h[{count}], q[{count - 1}], d[{count - 1}];
initial
  h = first;
equation
  for i in 1:{count - 1} loop d[i] = h[i] - h[i+1]; q[i] = {LAWS[law]}; end for;
{rates}
  experiment(stop = 20 s);
end Tanks;
""")


def given(name: str, values: list[float]) -> dict[str, float]:
    return {f"{name}[{i}]": value for i, value in enumerate(values, 1)}


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("areas", [(1.0, 2.0), (1.0, 1.0), (3e6, 1.3e6), (1e-5, 0.7)])
def test_two_levels_come_even(law: str, areas: tuple[float, float], tolerance: float) -> None:
    """E. Torricelli: sqrt(d) falls at c/2 a second, c = K (1/A1 + 1/A2)."""
    a, b = areas
    k = 1 / (1 / a + 1 / b)
    values = given("first", [1, 0.3]) | given("A", [a, b]) | {"K[1]": k}
    result = row_of_tanks(2, law).simulate(parameters=values, tolerance=tolerance)
    difference = np.maximum(0.7**0.5 - result.time / 2, 0) ** 2
    even = (a + 0.3 * b) / (a + b)
    assert np.abs(result["h[1]"] - even - difference * b / (a + b)).max() < tolerance
    assert np.abs(result["h[2]"] - even + difference * a / (a + b)).max() < tolerance
    assert result.figures.steps < 300


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_three_levels_come_even_at_one_instant(tolerance: float) -> None:
    """From (x, 0, -x) both pipes carry the same: d falls as in one of them at half the rate."""
    first = given("first", [0.5, 0, -0.5])
    result = row_of_tanks(3).simulate(parameters=first, tolerance=tolerance)
    difference = np.maximum(0.5**0.5 - result.time / 2, 0) ** 2
    for name, sign in (("h[1]", 1), ("h[2]", 0), ("h[3]", -1)):
        assert np.abs(result[name] - sign * difference).max() < tolerance


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize("kind", ["all but one empty", "all unlike"])
def test_a_row_of_tanks_comes_even_again(count: int, kind: str, tolerance: float) -> None:
    """What was in them and what the pump brings is spread over all, before it works and after."""
    unlike = kind == "all unlike"
    areas = [1, 0.4, 1.7, 0.09, 0.8][:count] if unlike else [1.0] * count
    first = [0.9, -0.2, 0.5, 0.1, 0.3][:count] if unlike else [1.0] + [0.0] * (count - 1)
    pipes = [1.1, 2.3, 0.7, 3.1][: count - 1] if unlike else [1.0] * (count - 1)
    values = given("A", areas) | given("first", first) | given("K", pipes) | {"pump": 0.5}
    result = row_of_tanks(count).simulate(parameters=values, tolerance=tolerance)
    held = sum(a * h for a, h in zip(areas, first, strict=True))
    names = [f"h[{i}]" for i in range(1, count + 1)]
    for time, water in ((7.9, held), (20.0, held + 0.5)):
        at = result.at(time)
        even = water / sum(areas)
        assert max(abs(at[name] - even) for name in names) < tolerance
    while_pumped = result.at(8.9)
    assert while_pumped["h[1]"] - while_pumped["h[2]"] > 0.01
    assert result.figures.steps < 2000


EMPTY = """
model Empty
  Real h[3], q[3];
initial
  h = (1, 0, 0);
equation
  for i in 1:2 loop q[i] = sign(h[i] - h[i+1])*sqrt(abs(h[i] - h[i+1])); end for;
  q[3] = if h[3] > 0 then sqrt(h[3]) else 0;
  der(h[1]) = -q[1]*(1 1/s);
  der(h[2]) = (q[1] - q[2])*(1 1/s);
  der(h[3]) = (q[2] - q[3])*(1 1/s);
  experiment(stop = 20 s);
end Empty;
"""


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_tanks_in_a_row_run_empty_together(tolerance: float) -> None:
    model = frot.compile(EMPTY)
    result = model.simulate(tolerance=tolerance)
    exact = model.simulate(tolerance=1e-13)
    for name in ("h[1]", "h[2]", "h[3]"):
        assert np.abs(result[name] - exact[name]).max() < 4 * tolerance
        assert abs(result[name][-1]) < 1e-20


UNSWITCHED = """
model Unswitched
  Real x, y, z;
initial
  x = 1; z = 0;
equation
  y = if {condition} then sqrt(x - 0.25) else 0;
  der(x) = -1/(1 s);
  der(z) = y/(1 s);
  experiment(stop = 3 s);
end Unswitched;
"""


@pytest.mark.parametrize("condition", ["time < 2 s", "z < 5", "x > 0"])
def test_an_unguarded_root_is_still_reported(condition: str) -> None:
    with pytest.raises(frot.FrotError, match=r"E0904"):
        frot.compile(UNSWITCHED.format(condition=condition)).simulate()
