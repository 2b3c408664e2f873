"""Terminals of FMI 3.0: inputs and outputs that are a flange together, and the icon beside them.

A force or torque and the motion of the place at which it acts belong together: one is an input, the
other an output, and their names begin alike (`load_torque`, `load_angle`, `load_speed`).
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Container, Iterator, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
from frot.runtime.fmi.arrays import Variable
from frot.runtime.fmi.description import to_xml
from lxml import etree

# By the types of the text: the names of members. Efforts come first.
FLANGES: Mapping[str, Mapping[str, str]] = {
    "RotationalFlange": {"Torque": "torque", "Angle": "angle", "AngularVelocity": "speed"},
    "TranslationalFlange": {"Force": "force", "Length": "displacement", "Velocity": "velocity"},
}
EFFORTS = ("Torque", "Force")
# Of a terminal whose members have no common beginning.
PLAIN = "flange"
_STEM = re.compile(r"(?:(?P<stem>.*[^_.])[_.])?[^_.]+")
_MEMBER = "terminalsAndIcons/terminalsAndIcons.xml"
_ICON = {"x1": "-128", "y1": "-96", "x2": "128", "y2": "96"}


def terminals(variables: Sequence[Variable]) -> tuple[ET.Element, ...]:
    """The `Terminal` elements of a model, in the order of their first variables."""
    by_stem: dict[str, list[Variable]] = {}
    for variable in variables:
        match = _STEM.fullmatch(variable.name)
        if match and variable.first.causality in ("input", "output"):
            by_stem.setdefault(match["stem"] or "", []).append(variable)
    return tuple(_terminals(by_stem))


def _terminals(by_stem: Mapping[str, Sequence[Variable]]) -> Iterator[ET.Element]:
    for stem, members in by_stem.items():
        for kind, names in FLANGES.items():
            own = [one for one in members if _quantity(one) in names]
            if _is_flange(own):
                yield _terminal(stem or PLAIN, kind, own, names)
                break


def _quantity(variable: Variable) -> str:
    unit = variable.first.unit
    return unit.quantity if unit else ""


def _is_flange(members: Sequence[Variable]) -> bool:
    """Whether an effort faces motions of its size, each of them once."""
    quantities = [_quantity(one) for one in members]
    efforts = [one for one in members if _quantity(one) in EFFORTS]
    if len(set(quantities)) < len(quantities) or len(efforts) != 1 or len(members) < 2:
        return False
    effort = efforts[0].first.causality
    alike = all(one.dimensions == members[0].dimensions for one in members)
    return alike and all(one.first.causality != effort for one in members if one not in efforts)


def _terminal(
    name: str, kind: str, members: Sequence[Variable], names: Mapping[str, str]
) -> ET.Element:
    """An effort that is an input flows in; one that is an output acts on what is outside."""
    element = ET.Element("Terminal", name=name, matchingRule="plug", terminalKind=f"frot.{kind}")
    flows = {"input": "inflow", "output": "outflow"}
    for one in members:
        is_effort = _quantity(one) in EFFORTS
        ET.SubElement(
            element,
            "TerminalMemberVariable",
            variableName=one.name,
            memberName=names[_quantity(one)],
            variableKind=flows[one.first.causality] if is_effort else "signal",
        )
    return element


def terminals_and_icon(variables: Sequence[Variable], icon: bytes | None) -> dict[str, bytes]:
    """The files of the folder `terminalsAndIcons`: none where there is neither."""
    found = terminals(variables)
    if not found and icon is None:
        return {}
    root = ET.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    if icon is not None:
        shown = ET.SubElement(root, "GraphicalRepresentation")
        ET.SubElement(shown, "CoordinateSystem", _ICON, suggestedScalingFactorTo_mm="0.1")
        ET.SubElement(shown, "Icon", _ICON)
    if found:
        ET.SubElement(root, "Terminals").extend(found)
    files = {_MEMBER: to_xml(root)}
    return files if icon is None else files | {"terminalsAndIcons/icon.png": icon}


def terminal_problems(path: Path, names: Container[str]) -> tuple[str, ...]:
    """What is wrong with the terminals of an archive, by FMI's schema and the names of variables.

    OSError or BadZipFile if it cannot be read.
    """
    with zipfile.ZipFile(path) as archive:
        if _MEMBER not in archive.namelist():
            return ()
        content = archive.read(_MEMBER)
    try:
        root = etree.fromstring(content)
    except etree.XMLSyntaxError as error:
        return (f"{_MEMBER} cannot be read: {error}",)
    folder = Path(fmpy.__file__).parent / "schema" / "fmi3"
    schema = etree.XMLSchema(etree.parse(str(folder / "fmi3TerminalsAndIcons.xsd")))
    schema.validate(root)
    wrong = [f"{_MEMBER}, line {one.line}: {one.message}" for one in schema.error_log]
    named = (one.get("variableName") for one in root.iter("TerminalMemberVariable"))
    wrong += [f"{_MEMBER}: there is no variable {one}" for one in named if one not in names]
    return tuple(wrong)
