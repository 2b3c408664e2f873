"""What a model description says of its variables is true of the library beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from fmu_host import ERROR, OK, Host, unpack_library

import frot

MODELS = Path(__file__).parents[2] / "models"
TEXT = """
type Gear = enumeration(low, middle, high);
planar model Two "Two blocks on rough tables, and equations beside them"
  parameter Real mu = 0.3;
  parameter Length x0 = 3 mm;
  parameter Length y0 = 2*x0;
  parameter Force grip = mu*(10 N);
  parameter Gear gear = Gear.low;
  parameter Temperature room = 20 degC;
  input Force F(start = 1 N);
  input Force G(start = 1 N);
  input Real s(start = 0);
  input Real w(start = 0);
  input Gear chosen(start = Gear.low);
  body a: particle(mass = 1 kg);
  body b: particle(mass = 1 kg);
  curve low on ground: line(through = (0, 0) m, direction = (1, 0));
  curve high on ground: line(through = (0, 1) m, direction = (1, 0));
  liaison la: point_courbe(a, low) with coulomb(mu);
  liaison lb: point_courbe(b, high) with coulomb(mu);
  force f: on(a, value = (F, 0 N));
  force g: on(b, value = (G, 0 N));
  Real root(start = 0);
  Real level(start = 1);
  output Length place = a.position.x;
  output Acceleration of_a = a.acceleration.x;
  output Acceleration of_b = b.acceleration.x;
  output Force held = la.tangential_force;
  output Real twice = 2*s;
  output Real wave = sin(time/(1 s));
  output Real above = if w > 1 then 1 else 0;
  output Real solved = root;
  output Real slope = der(level)*(1 s);
  output Real level_now = level;
  output Gear shown = chosen;
  output Temperature warm = room;
  output Real geared = if gear == Gear.high then 2 else 1;
equation
  root + root^3 = s;
  der(level) = (w - level)/(1 s);
initial
  a.position = (x0, 0 m);
  b.position = (y0, 1 m);
  a.velocity = (0, 0) m/s;
  b.velocity = (0, 0) m/s;
end Two;
"""
# By the equations: a force on one block moves the other one no more than a number beside them. What
# sticks slips by its speed.
ACTING = {
    "place": {"la.u"},
    "of_a": {"F", "der(la.u)"},
    "of_b": {"G", "der(lb.u)"},
    "held": {"F", "der(la.u)"},
    "twice": {"s"},
    "wave": {"time"},
    "above": {"w"},
    "solved": {"s"},
    "slope": {"w", "level"},
    "level_now": {"level"},
    "shown": {"chosen"},
    "warm": set(),
    "geared": set(),
}


class Described:
    """A model as an FMU, its description, and instances of it."""

    def __init__(self, model: frot.Model, version: str, folder: Path) -> None:
        self.version = version
        archive = folder / "model.fmu"
        model.export_fmu(archive, version, "native")
        assert validate_fmu(str(archive)) == []
        self.description = read_model_description(str(archive))
        self.root = ET.fromstring(_member(archive, "modelDescription.xml"))
        self.library = unpack_library(archive, version, folder)
        self.key = model.program().key.encode()
        self.named: dict[str, Any] = {v.name: v for v in self.description.modelVariables}
        self.reference = {name: v.valueReference for name, v in self.named.items()}

    def dependencies(self) -> dict[str, set[str]]:
        """Of each output, by names."""
        return {
            one.variable.name: {self.meaning(known) for known in one.dependencies}
            for one in self.description.outputs
        }

    def meaning(self, known: Any) -> str:
        """The name in the text: a state has it as its description."""
        return str(known.description if known.name.startswith("exchange.") else known.name)

    def kind(self, name: str) -> str:
        """The type of the functions that read and set it."""
        of = self.named[name].type
        whole = {"2.0": "Integer", "3.0": "Int64"}
        real = {"2.0": "Real", "3.0": "Float64"}
        return {"Enumeration": whole, "Real": real, "Float64": real}[of][self.version]

    def host(self) -> Host:
        return Host(self.library, int(self.version[0]), token=self.key)

    def outputs(self, one: Host) -> dict[str, float]:
        """All of them now."""
        return {
            name: one.get(self.reference[name], self.kind(name))
            for name, v in self.named.items()
            if v.causality == "output"
        }

    def changed(self, one: Host, name: str, value: float) -> set[str]:
        """The outputs that setting a value changes at once."""
        before = self.outputs(one)
        assert one.set(self.reference[name], value, self.kind(name)) == OK, one.messages
        after = self.outputs(one)
        return {output for output in before if before[output] != after[output]}


def _member(archive: Path, name: str) -> bytes:
    import zipfile

    with zipfile.ZipFile(archive) as file:
        return file.read(name)


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def two(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Described:
    folder = tmp_path_factory.mktemp("two")
    return Described(frot.compile(TEXT), str(request.param), folder)


def test_outputs_depend_on_what_the_equations_say(two: Described) -> None:
    assert two.dependencies() == ACTING


@pytest.mark.parametrize("name", ["F", "G", "s", "w", "chosen"])
def test_an_input_changes_at_once_what_depends_on_it_and_nothing_else(
    two: Described, name: str
) -> None:
    """At rest and in motion, by pushes that friction holds and such that it does not."""
    one = two.host()
    one.start()
    found: set[str] = set()
    for i, value in enumerate((2, 1, 3)):
        found |= two.changed(one, name, value if name == "chosen" else 2.5 * value - 2)
        assert one.step(0.5 * i, 0.5) == OK, one.messages
    one.free()
    assert found == {output for output, acting in ACTING.items() if name in acting}


@pytest.mark.parametrize("model", ["geared_motor", "slider_crank"])
def test_no_output_of_a_worked_model_depends_on_more_than_is_said(
    model: str, tmp_path: Path
) -> None:
    described = Described(frot.load(MODELS / f"{model}.frot"), "3.0", tmp_path)
    one = described.host()
    one.start()
    said = described.dependencies()
    inputs = [name for name, v in described.named.items() if v.causality == "input"]
    assert inputs
    for i, name in enumerate(inputs):
        value = float(described.named[name].start)
        assert one.step(0.01 * i, 0.01) == OK, one.messages
        changed = described.changed(one, name, 1.1 * value + 0.1)
        assert changed <= {output for output, known in said.items() if name in known}
    one.free()


def test_what_is_calculated_at_the_start_follows_from_its_parameters(two: Described) -> None:
    found = {
        one.variable.name: None if one.dependencies is None else {k.name for k in one.dependencies}
        for one in two.description.initialUnknowns
        if one.variable.causality == "calculatedParameter"
    }
    assert found == {"y0": {"x0"}, "grip": {"mu"}}


def test_parameters_that_act_at_the_start_alone_are_fixed(two: Described) -> None:
    found = {
        name: v.variability
        for name, v in two.named.items()
        if v.causality in ("parameter", "calculatedParameter")
    }
    fixed = {"x0": "fixed", "y0": "fixed"}
    assert found == {**dict.fromkeys(("mu", "grip", "gear", "room"), "tunable"), **fixed}


def test_a_fixed_parameter_is_not_set_in_a_run(two: Described) -> None:
    one = two.host()
    assert one.set(two.reference["x0"], 5e-3) == OK
    one.start()
    assert one.get(two.reference["place"]) == 5e-3
    assert one.set(two.reference["x0"], 7e-3) == ERROR
    assert "'x0' cannot be set now: it acts at the start alone" in one.last
    assert one.set(two.reference["mu"], 0.2) == OK
    assert one.step(0.0, 0.1) == OK
    one.free()


def test_an_enumeration_of_the_text_is_one_with_its_bounds(two: Described) -> None:
    gear = two.named["gear"]
    assert (gear.type, gear.declaredType.name, gear.start) == ("Enumeration", "Gear", "1")
    assert [(item.name, int(item.value)) for item in gear.declaredType.items] == [
        ("low", 1),
        ("middle", 2),
        ("high", 3),
    ]
    assert (float(gear.min), float(gear.max)) == (1, 3)
    one, reference, kind = two.host(), two.reference["gear"], two.kind("gear")
    for value in (0, 4, -1):
        assert one.set(reference, value, kind) == ERROR
        assert "from 1 to 3" in one.last
    assert one.set(reference, 3, kind) == OK
    one.start()
    assert one.get(reference, kind) == 3 and one.get(two.reference["geared"]) == 2.0
    one.free()


def test_degrees_of_celsius_are_shown_from_their_own_zero(two: Described) -> None:
    """FMI: the number shown is factor times the value plus offset."""
    (kelvin,) = (unit for unit in two.root.iter("Unit") if unit.get("name") == "K")
    (shown,) = kelvin.iter("DisplayUnit")
    room = two.named["room"]
    assert (room.displayUnit, shown.get("name")) == ("degC", "degC")
    factor, offset = float(shown.get("factor", 1)), float(shown.get("offset", 0))
    assert factor * float(room.start) + offset == pytest.approx(20.0, abs=1e-12)
