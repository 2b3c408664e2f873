"""Whole numbers, conditions and enumerations of a text are such in its FMU too."""

from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

import frot

TEXT = """
type Colour = enumeration(red, green);
model Counter
  parameter Real step = 1;
  Integer n(start = 0);
  Colour shown(start = Colour.red);
  output Integer twice = 2*n;
  output Boolean many;
  output Colour colour = shown;
  output Real level = step*n;
  output Integer grown = if n > 5 then 3000000000 else 1;
equation
  many = n > 2;
  when sample(0.1 s, 0.1 s) then
    n = pre(n) + 1;
  end when;
  when n > 1 then
    shown = Colour.green;
  end when;
  experiment(stop = 0.45 s);
end Counter;
"""
TYPES = {
    "2.0": ("Integer", "Boolean", "Enumeration", "Real"),
    "3.0": ("Int32", "Boolean", "Enumeration", "Float64"),
}


@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_outputs_have_the_types_of_the_text(fmi: str, tmp_path: Path) -> None:
    model = frot.compile(TEXT)
    model.export_fmu(tmp_path / "counter.fmu", fmi, "native")
    assert validate_fmu(str(tmp_path / "counter.fmu")) == []
    found = {
        v.name: v for v in read_model_description(str(tmp_path / "counter.fmu")).modelVariables
    }
    names = ("twice", "many", "colour", "level")
    assert tuple(found[name].type for name in names) == TYPES[fmi]
    assert [found[name].variability for name in names] == [*["discrete"] * 3, "continuous"]
    told = simulate_fmu(tmp_path / "counter.fmu", output=[*names, "grown"], output_interval=0.05)
    result = model.simulate(interval=0.05)
    for name in names:
        assert told[name].astype(float).tolist() == result[name].tolist()
    with pytest.raises(Exception, match="Get"):
        simulate_fmu(tmp_path / "counter.fmu", output=["grown"], stop_time=1.0)
