"""Terminals of FMI 3.0: which inputs and outputs are a flange, and how it is described."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest
from fmpy.validation import validate_fmu
from frot.runtime.fmi.arrays import grouped
from frot.runtime.fmi.scalars import scalars
from frot.runtime.fmi.terminals import terminals
from lxml import etree

import frot

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
TEXT = """model Arm
  input Torque load_torque(start = 0 N.m);
  input Force tip_force[3](start = (0, 0, 0) N);
  input Length length_of_pull(start = 0 m);
  parameter Angle load_limit = 1 rad;
  body b: rod(mass = 1 kg, length = 1 m, inertia = (0.01, 0.1, 0.1) kg.m^2);
  liaison h: rotoide(ground, b.start, axis = z);
  force f: couple(h, value = load_torque);
  force g: on(b, value = (tip_force[1], tip_force[2], tip_force[3]));
  output Angle load_angle = h.angle;
  output AngularVelocity load_speed = h.speed;
  output Length tip_position[3] = b.tip.position;
  output Force pulled = 1 N*length_of_pull/(1 m);
initial
  h.angle = 0 rad;
  h.speed = 0 rad/s;
  guess(b.position = (0.5, 0, 0) m);
  experiment(stop = 1 s);
end Arm;
"""


def described(path: Path) -> ET.Element | None:
    with zipfile.ZipFile(path) as archive:
        name = "terminalsAndIcons/terminalsAndIcons.xml"
        return ET.fromstring(archive.read(name)) if name in archive.namelist() else None


def members(terminal: ET.Element) -> list[tuple[str | None, ...]]:
    keys = ("variableName", "memberName", "variableKind")
    return [tuple(map(one.get, keys)) for one in terminal]


@pytest.fixture(scope="module")
def model() -> frot.Model:
    return frot.compile(TEXT)


@pytest.mark.parametrize("arrays", [False, True])
def test_what_begins_alike_is_a_flange(model: frot.Model, tmp_path: Path, arrays: bool) -> None:
    """A torque and the angle and speed it moves; of vectors where they are variables."""
    path = tmp_path / "a.fmu"
    model.export_fmu(path, "3.0", "native", arrays=arrays)
    assert not validate_fmu(str(path))
    root = described(path)
    assert root is not None
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(etree.fromstring(ET.tostring(root)))
    found = {one.get("name"): one for one in root.iter("Terminal")}
    assert set(found) == ({"load", "tip"} if arrays else {"load"})
    load = found["load"]
    assert load.get("terminalKind") == "frot.RotationalFlange"
    assert load.get("matchingRule") == "plug"
    assert members(load) == [
        ("load_torque", "torque", "inflow"),
        ("load_angle", "angle", "signal"),
        ("load_speed", "speed", "signal"),
    ]
    if arrays:
        assert found["tip"].get("terminalKind") == "frot.TranslationalFlange"
        assert members(found["tip"]) == [
            ("tip_force", "force", "inflow"),
            ("tip_position", "displacement", "signal"),
        ]


def flanges(text: str) -> dict[str | None, list[tuple[str | None, ...]]]:
    _, variables = scalars(frot.compile(text).program())
    found = terminals(grouped(variables, arrays=False))
    return {one.get("name"): members(one) for one in found}


def text_of(*lines: str) -> str:
    body = "\n".join(f"  {line};" for line in lines)
    return f"""model Parts
  body b: particle(mass = 1 kg);
{body}
initial
  b.position = (0, 0, 0) m;
  b.velocity = (0, 0, 0) m/s;
  experiment(stop = 1 s);
end Parts;
"""


def test_a_prescribed_motion_faces_the_force_it_takes() -> None:
    """The other causality; without a beginning the terminal has a plain name."""
    found = flanges(text_of("input Length displacement(start = 0 m)", "output Force force = 2 N"))
    assert found == {
        "flange": [("displacement", "displacement", "signal"), ("force", "force", "outflow")]
    }


@pytest.mark.parametrize(
    "lines",
    [
        # both known, both given
        ("input Force a_force(start = 0 N)", "input Length a_way(start = 0 m)"),
        ("output Force a_force = 1 N", "output Length a_way = 1 m"),
        # of which place?
        ("input Force a_force(start = 0 N)", "output Length b_way = 1 m"),
        # which of them?
        (
            "input Force a_force(start = 0 N)",
            "output Length a_x = 1 m",
            "output Length a_y = 1 m",
        ),
        # a force turns nothing
        ("input Force a_force(start = 0 N)", "output Angle a_angle = 1 rad"),
        ("input Real a_force(start = 0)", "output Real a_way = 1"),
    ],
)
def test_what_is_no_pair_is_no_flange(lines: tuple[str, ...]) -> None:
    assert flanges(text_of(*lines)) == {}


def test_without_flange_and_icon_there_is_no_such_file(tmp_path: Path) -> None:
    path = tmp_path / "a.fmu"
    frot.compile(text_of("output Length a = 1 m")).export_fmu(path, "3.0", "native")
    assert described(path) is None


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('variableName="load_speed"', 'variableName="load_sped"', "no variable load_sped"),
        ('matchingRule="plug"', 'rule="plug"', "matchingRule"),
        ("</Terminals>", "</Terminal>", "cannot be read"),
    ],
)
def test_wrong_terminals_are_told_by_the_check(
    model: frot.Model, tmp_path: Path, old: str, new: str, told: str
) -> None:
    path, other = tmp_path / "a.fmu", tmp_path / "b.fmu"
    model.export_fmu(path, "3.0", "native")
    assert model.check_fmu(path).good
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(other, "w") as copy:
        for name in source.namelist():
            text = source.read(name)
            if name.endswith("terminalsAndIcons.xml"):
                assert old.encode() in text
                text = text.replace(old.encode(), new.encode())
            copy.writestr(name, text)
    checked = model.check_fmu(other)
    assert not checked.good and told in "; ".join(checked.problems)
