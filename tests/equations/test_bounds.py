"""`min` and `max`: parameters are checked when they are set, what moves while it moves."""

import zipfile
from xml.etree import ElementTree as ET

import pytest

import frot

TEXT = """
type Percent = Real(min = 0, max = 100);
model Bounded
  parameter Percent p = 20;
  parameter Length l[2](min = 0 m, max = (1, 2) m) = (0.5, 1.5) m;
  parameter Angle a(max = 90 deg) = 20 deg;
  input Real f(start = 1, min = -5, max = 5);
  Real x(start = 0, max = 2*p);
  Integer n(start = 0, max = 3);
  output Length y[2](min = -5 m) = l*x;
initial
  x = 0;
equation
  der(x) = f*a*(1 1/s);
  when sample(0.1 s, 0.1 s) then
    n = pre(n) + 1;
  end when;
  experiment(stop = 0.3 s);
end Bounded;
"""


@pytest.fixture(scope="module")
def model():
    return frot.compile(TEXT)


def test_what_keeps_its_bounds_runs(model):
    assert model.simulate(parameters={"l[2]": 2, "p": 100})["n"][-1] == 3


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("p", 101, "'p', whose max is 100, is 101: it must not be above that"),
        ("l[2]", "2.01 m", "'l[2]', whose max is (1, 2) m, is 2.01: "),
        ("l[1]", -1, "'l[1]', whose min is 0 m, is -1: it must not be below that"),
        ("a", "91 deg", "'a', whose max is 90 deg, is 1.588"),
    ],
)
def test_parameters_outside_are_refused(model, name, value, words):
    with pytest.raises(frot.FrotError, match=r"E0401") as fault:
        model.simulate(parameters={name: value})
    assert words in str(fault.value)


def test_what_moves_outside_ends_the_run_at_that_instant(model):
    with pytest.raises(frot.FrotError, match="'n' is above its max, 3") as fault:
        model.simulate(stop=1.0)
    assert "t = 0.4" in str(fault.value)
    with pytest.raises(frot.FrotError, match="'f' is below its min, -5"):
        model.simulate(inputs={"f": -6})
    # y[2] = l[2] a f t is -5 m at 5/(2*5*pi/2) s
    with pytest.raises(frot.FrotError, match=r"'y\[2\]' is below its min, -5 m") as fault:
        values = {"p": 100, "a": "90 deg", "l[2]": 2, "l[1]": 0}
        model.simulate(inputs={"f": -5}, parameters=values, stop=0.39)
    assert "t = 0.3183" in str(fault.value)


def test_defaults_outside_are_refused_before_a_run():
    with pytest.raises(frot.FrotError, match=r"E0401.*'q', whose min is 3"):
        frot.compile("model M parameter Real q(min = 3) = 2; Real x = q; end M;").simulate()
    with pytest.raises(frot.FrotError, match=r"E0204.*no attribute 'min'"):
        frot.compile("model M Boolean b(min = 3) = true; end M;").simulate()


@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_importers_are_told(model, tmp_path, fmi):
    file = tmp_path / "bounded.fmu"
    model.export_fmu(file, fmi=fmi, platforms="native")
    with zipfile.ZipFile(file) as archive:
        root = ET.fromstring(archive.read("modelDescription.xml"))
    told = {}
    for variable in root.find("ModelVariables"):
        numbers = variable if fmi == "3.0" else variable[0]
        told[variable.get("name")] = (numbers.get("min"), numbers.get("max"))
    assert told["p"] == ("0.0", "100.0")
    assert told["l[2]"] == ("0.0", "2.0")
    assert told["x"] == (None, "40.0")
    assert told["f"] == ("-5.0", "5.0")
    assert told["y.y"] == ("-5.0", None)
