"""Conditions, whole numbers and what follows from themselves: found where they agree, else told."""

import pytest

import frot

NO_TRUTH = {
    "a number of its own condition": ("Real y;", "y = if y > 0.5 then 0 else 1;", "y > 0.5", 0),
    "a whole number": ("Integer i;", "i = if i > 0 then 0 else 1;", "i > 0", 0),
    "two that go round": (
        "Real y; Real z;",
        "y = if z > 0.5 then 0 else 1; z = if y > 0.5 then 1 else 0;",
        "z > 0.5",
        0,
    ),
    "with a state": (
        "Real x(start = 0); Real y;",
        "der(x) = y*1 1/s; y = if y + x > 0.5 then -1 else 1;",
        "y + x > 0.5",
        0,
    ),
    "from the first instant on": (
        "Real y;",
        "2*y = (if y > 0.5 then 0 else 1) + 0.1*time/(1 s);",
        "y > 0.5",
        0,
    ),
    "from an instant on": (
        "Integer i;",
        "i = if i > 0 and time > 0.5 s then 0 else 1;",
        "i > 0",
        0.5,
    ),
    "where a state passes it": (
        "Real x(start = 2); Real y;",
        "der(x) = -2 1/s; y = if y > x then 0 else 1;",
        "y > x",
        0.5,
    ),
}


@pytest.mark.parametrize("name", NO_TRUTH)
def test_contradictory_conditions_are_reported(name: str) -> None:
    declared, equations, condition, instant = NO_TRUTH[name]
    text = f"model M\n  {declared}\nequation\n  {equations}\nend M;\n"
    with pytest.raises(frot.FrotError, match="E0903") as told:
        frot.compile(text).simulate()
    assert f"`{condition}`" in str(told.value)
    assert "no truth of it agrees" in str(told.value)
    at = str(told.value).split("at t = ")[1].split(":")[0]
    assert float(at) == pytest.approx(instant, abs=1e-12)


def test_of_two_truths_one_is_found_and_long_chains_settle() -> None:
    chain = "".join(f" y[{i}] = if y[{i - 1}] > 0.5 then 0 else 1;" for i in range(2, 31))
    result = frot.compile(f"""
model M
  Real a; Real b; Real y[30];
equation
  a = if b > 0.5 then 0 else 1;
  b = if a > 0.5 then 0 else 1;
  y[1] = if time > -1 s then 1 else 0;
 {chain}
end M;
""").simulate()
    assert {result["a"][0], result["b"][0]} == {0, 1}
    assert [result[f"y[{i}]"][0] for i in range(1, 31)] == [i % 2 for i in range(1, 31)]


@pytest.mark.parametrize(
    ("declared", "equations", "name"),
    [
        ("Boolean b;", "b = not b;", "b"),
        ("Boolean b; Boolean c;", "b = not c; c = b;", "c"),
        ("Integer i;", "2*i = 6;", "i"),
        ("Integer i; Real x;", "x = i + 1.5; x = 3;", "i"),
        ("Integer i; Integer j;", "i + j = 5; i - j = 2;", "j"),
    ],
)
def test_integers_and_booleans_need_an_explicit_equation(
    declared: str, equations: str, name: str
) -> None:
    text = f"model M\n  {declared}\nequation\n  {equations}\nend M;\n"
    with pytest.raises(frot.FrotError, match=f"E0610.*'{name}'"):
        frot.compile(text).simulate()


def test_whole_numbers_and_conditions_follow_from_sums_and_branches() -> None:
    result = frot.compile("""
model M
  Integer i; Integer j; Integer k;
  Boolean b; Boolean c;
  Real x(start = 0);
equation
  der(x) = 1 1/s;
  j = if x > 0.5 then 2 else 1;
  k = if time > 0.3 s then 7 else 5;
  3 = i + j - k;
  if time > 0.6 s then b = true; else b = x > 0.2; end if;
  not c = b;
end M;
""").simulate(stop=0.8, interval=0.1)
    there = [0, 1, 4, 7]  # at 0, 0.1, 0.4 and 0.7 s
    assert list(result["i"][there]) == [7, 7, 9, 8]
    assert list(result["b"][there]) == [0, 0, 1, 1]
    assert list(result["c"][there]) == [1, 1, 0, 0]
