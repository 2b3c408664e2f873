"""Units, types and attributes of variables in a model description, as both versions write them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree import ElementTree as ET

from frot.runtime.fmi.scalars import MODE, Declared, Scalar
from frot.runtime.program import Unit

# Types that name no quantity.
UNNAMED = ("", "Real", "Integer", "Boolean")
# Unit.exponents are in this order.
BASE_UNITS = ("m", "kg", "s", "A", "K", "mol", "cd", "rad")


def text(value: str) -> str:
    """`value` without the control characters that XML cannot hold."""
    return re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", " ", value)


def unit_definitions(variables: Sequence[Scalar]) -> ET.Element:
    """All units with those to display; ValueError where a name has two meanings."""
    definitions = ET.Element("UnitDefinitions")
    exponents: dict[str, tuple[int, ...]] = {}
    displays: dict[str, dict[str, tuple[float, float]]] = {}
    for variable in variables:
        unit = variable.unit
        if unit is None or not unit.name:
            continue
        if exponents.setdefault(unit.name, unit.exponents) != unit.exponents:
            raise ValueError(f"unit '{unit.name}' has two meanings")
        shown = displays.setdefault(unit.name, {})
        scale = unit.display_factor, unit.display_offset
        if _display(unit) and shown.setdefault(unit.display, scale) != scale:
            raise ValueError(f"display unit '{unit.display}' has two meanings")
    for name, powers in exponents.items():
        element = ET.SubElement(definitions, "Unit", name=text(name))
        base = {key: str(power) for key, power in zip(BASE_UNITS, powers, strict=True) if power}
        ET.SubElement(element, "BaseUnit", base)
        for display, (factor, offset) in displays[name].items():
            # FMI's factor and offset lead from the unit to the display unit.
            attributes = {"name": text(display), "factor": repr(1 / factor)}
            if offset:
                attributes["offset"] = repr(-offset / factor)
            ET.SubElement(element, "DisplayUnit", attributes)
    return definitions


def _display(unit: Unit) -> str:
    """The display unit to write, empty where it is the unit itself."""
    return unit.display if unit.name and unit.display != unit.name else ""


def _real_attributes(variable: Scalar) -> dict[str, str]:
    if variable.unit is None or not variable.unit.name:
        return {}
    attributes = {"unit": text(variable.unit.name)}
    if variable.unit.quantity not in UNNAMED:
        attributes["quantity"] = text(variable.unit.quantity)
    if _display(variable.unit):
        attributes["displayUnit"] = text(variable.unit.display)
    return attributes


def type_attributes(variable: Scalar) -> dict[str, str]:
    """Type, bounds, nominal size, quantity and unit."""
    if variable.declared is not None:
        items = variable.declared.items
        bounds = {"min": str(items[0][1]), "max": str(items[-1][1])}
        return {"declaredType": text(variable.declared.name), **bounds}
    bounds = {
        name: repr(float(limit)) if variable.type == "real" else str(int(limit))
        for name, limit in (("min", variable.min), ("max", variable.max))
        if limit is not None
    }
    if variable.nominal:
        bounds["nominal"] = repr(abs(float(variable.nominal)))
    return bounds | (_real_attributes(variable) if variable.type == "real" else {})


def declared_types(variables: Sequence[Scalar]) -> list[Declared]:
    """All that are declared; ValueError if two share a name."""
    found = {MODE.name: MODE}
    for variable in variables:
        declared = variable.declared
        if declared and found.setdefault(declared.name, declared) != declared:
            raise ValueError(f"type '{declared.name}' has two meanings")
    return list(found.values())


def add_items(parent: ET.Element, declared: Declared) -> None:
    """The items of an enumeration."""
    for name, value, meaning in declared.items:
        described = {"description": meaning} if meaning else {}
        ET.SubElement(parent, "Item", {"name": text(name), "value": str(value), **described})


def described(declared: Declared) -> dict[str, str]:
    """Name and meaning of a type."""
    doc = {"description": declared.doc} if declared.doc else {}
    return {"name": text(declared.name), **doc}
