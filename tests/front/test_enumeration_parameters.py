"""Parameters and inputs of an enumeration take its literals, by name or number, and no others."""

import pytest

import frot

LEVELS = """type Level = enumeration(low, middle, high);
model Levels
  parameter Level one = Level.low;
  parameter Level two[2] = (Level.low, Level.low);
  input Level given(start = Level.low);
  output Real sum = (if one == Level.high then 1 else 0) + (if two[2] == Level.high then 10 else 0)
    + (if given == Level.middle then 100 else 0);
end Levels;
"""


@pytest.fixture(scope="module")
def levels() -> frot.Model:
    return frot.compile(LEVELS)


@pytest.mark.parametrize("one", ["high", "Level.high", 3, "3"])
@pytest.mark.parametrize("two", ["(low, high)", ["low", "Level.high"], (1, 3)])
def test_literals_are_taken(levels: frot.Model, one: object, two: object) -> None:
    given = {"one": one, "two": two}
    result = levels.simulate(parameters=given, inputs={"given": "middle"}, stop=0.1)
    assert result["sum"][-1] == 111


@pytest.mark.parametrize("value", ["hgh", "", 0, 4, 1.5])
def test_other_values_are_refused(levels: frot.Model, value: object) -> None:
    with pytest.raises(frot.FrotError, match=r"E0806") as error:
        levels.simulate(parameters={"one": value})
    assert "low, middle, high" in str(error.value)
