"""The page documentation/index.html of an FMU: what the model is and what can be set and read."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from frot.runtime.fmi.definitions import text
from frot.runtime.fmi.scalars import Scalar, scalars
from frot.runtime.fmi.sources import MOST_WORK
from frot.runtime.program import Program

_GROUPS = (
    ("Parameters", ("parameter",)),
    ("Parameters that follow from others", ("calculatedParameter",)),
    ("Inputs", ("input",)),
    ("Outputs", ("output",)),
    ("Other variables", ("local",)),
)


def _element(parent: ET.Element, tag: str, content: str) -> ET.Element:
    element = ET.SubElement(parent, tag)
    element.text = text(content)
    return element


def _start(variable: Scalar) -> str:
    if variable.start is None:
        return ""
    if variable.type == "boolean":
        return "true" if variable.start else "false"
    return f"{variable.start:.15g}"


def _table(body: ET.Element, title: str, variables: Sequence[Scalar]) -> None:
    _element(body, "h2", title)
    table = ET.SubElement(body, "table")
    head = ET.SubElement(table, "tr")
    for column in ("name", "start", "unit", "meaning"):
        _element(head, "th", column)
    for variable in variables:
        row = ET.SubElement(table, "tr")
        _element(ET.SubElement(row, "td"), "code", variable.name)
        _element(row, "td", _start(variable))
        unit = "" if variable.unit is None else variable.unit.name
        _element(row, "td", "open, stick or slip" if variable.type == "mode" else unit)
        _element(row, "td", variable.doc)


def documentation(program: Program) -> bytes:
    """A page of HTML in UTF-8."""
    _, variables = scalars(program)
    page = ET.Element("html", lang="en")
    head = ET.SubElement(page, "head")
    ET.SubElement(head, "meta", charset="utf-8")
    _element(head, "title", program.name)
    _element(head, "style", "body{font-family:sans-serif} td,th{padding:0 1em 0 0;text-align:left}")
    body = ET.SubElement(page, "body")
    _element(body, "h1", program.name)
    _element(body, "p", program.doc)
    _element(
        body,
        "p",
        "Rigid bodies with liaisons and dry friction, exported by "
        f"Frot {program.version}. All values are in SI units. Steps of any length give the same "
        "motion; a change of a parameter or an input takes effect at the time reached, or is "
        "refused as a whole with the next step, and the former values hold. "
        "Where the motion cannot go on, a step is discarded and the log says why; so is one that "
        f"takes more than {MOST_WORK} evaluations of the model.",
    )
    for title, causalities in _GROUPS:
        members = [v for v in variables if v.causality in causalities]
        if members:
            _table(body, title, members)
    ET.indent(page)
    return b"<!DOCTYPE html>\n" + bytes(ET.tostring(page, encoding="UTF-8", method="html")) + b"\n"
