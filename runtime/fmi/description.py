"""The model description (modelDescription.xml) of a program, for FMI 2.0 and FMI 3.0.

In FMI 2.0 the index of a variable is its value reference plus one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from xml.etree import ElementTree as ET

from frot.runtime.fmi.names import model_identifier
from frot.runtime.fmi.scalars import MODE, Declared, Scalar, scalars
from frot.runtime.program import (
    DEFAULT_POINTS,
    DEFAULT_TOLERANCE,
    Program,
    Unit,
)

LOG_CATEGORIES = (
    ("logEvents", "changes of the modes of liaisons and of conditions"),
    ("logStatusDiscard", "why the motion ends before the end of a step"),
    ("logStatusError", "why a call is refused"),
    ("logAll", "everything"),
)
# Unit.exponents are in this order.
BASE_UNITS = ("m", "kg", "s", "A", "K", "mol", "cd", "rad")


def text(value: str) -> str:
    """`value` without the control characters that XML cannot hold."""
    return re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", " ", value)


def _units(variables: Sequence[Scalar]) -> ET.Element:
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
    if _display(variable.unit):
        attributes["displayUnit"] = text(variable.unit.display)
    return attributes


def _start(variable: Scalar) -> dict[str, str]:
    if variable.start is None:
        return {}
    if variable.type == "boolean":
        return {"start": "true" if variable.start else "false"}
    if variable.type in ("integer", "enumeration"):
        return {"start": str(int(variable.start))}
    return {"start": repr(float(variable.start))}


def _common(variable: Scalar) -> dict[str, str]:
    attributes = {"name": text(variable.name), "valueReference": str(variable.reference)}
    if variable.doc:
        attributes["description"] = text(variable.doc)
    attributes |= {"causality": variable.causality, "variability": variable.variability}
    if variable.initial:
        attributes["initial"] = variable.initial
    return attributes


def _type_attributes(variable: Scalar) -> dict[str, str]:
    if variable.declared is not None:
        items = variable.declared.items
        bounds = {"min": str(items[0][1]), "max": str(items[-1][1])}
        return {"declaredType": text(variable.declared.name), **bounds}
    bounds = {
        name: repr(float(limit)) if variable.type == "real" else str(int(limit))
        for name, limit in (("min", variable.min), ("max", variable.max))
        if limit is not None
    }
    return bounds | (_real_attributes(variable) if variable.type == "real" else {})


def _types(variables: Sequence[Scalar]) -> list[Declared]:
    """All that are declared; ValueError if two share a name."""
    found = {MODE.name: MODE}
    for variable in variables:
        declared = variable.declared
        if declared and found.setdefault(declared.name, declared) != declared:
            raise ValueError(f"type '{declared.name}' has two meanings")
    return list(found.values())


def _items(parent: ET.Element, declared: Declared) -> None:
    for name, value, meaning in declared.items:
        described = {"description": meaning} if meaning else {}
        ET.SubElement(parent, "Item", {"name": text(name), "value": str(value), **described})


def _described(declared: Declared) -> dict[str, str]:
    doc = {"description": declared.doc} if declared.doc else {}
    return {"name": text(declared.name), **doc}


def _dependencies(variable: Scalar, numbers: Mapping[str, int]) -> dict[str, str]:
    """Numbers of the variables that an unknown depends on."""
    if variable.knowns is None:
        return {}
    return {"dependencies": " ".join(str(numbers[name]) for name in variable.knowns)}


def _default_experiment(program: Program) -> ET.Element:
    """The experiment of `frot simulate`, with all four values: importers guess missing ones."""
    experiment = program.experiment
    begin, end = experiment.times()
    values = {
        "startTime": begin,
        "stopTime": end,
        "tolerance": experiment.tolerance or DEFAULT_TOLERANCE,
        "stepSize": experiment.interval or (end - begin) / DEFAULT_POINTS,
    }
    known = {key: repr(float(value)) for key, value in values.items()}
    return ET.Element("DefaultExperiment", known)


def _log_categories() -> ET.Element:
    categories = ET.Element("LogCategories")
    for name, meaning in LOG_CATEGORIES:
        ET.SubElement(categories, "Category", name=name, description=meaning)
    return categories


def _outputs(variables: Sequence[Scalar]) -> Iterator[Scalar]:
    return (v for v in variables if v.causality == "output")


def _initial_unknowns(variables: Sequence[Scalar]) -> Iterator[Scalar]:
    return (
        v
        for v in variables
        if v.causality in ("output", "calculatedParameter") or v.motion in ("state", "rate")
    )


def _of_kind(variables: Sequence[Scalar], kind: str) -> Iterator[Scalar]:
    return (v for v in variables if v.motion == kind)


def _shown(variable: Scalar) -> str:
    """Where its dependencies are given: at the start an output may depend on any parameter."""
    return "Outputs" if variable.causality == "output" else "InitialUnknowns"


def _root(program: Program, fmi: str, token: str, convention: str) -> ET.Element:
    attributes = {"fmiVersion": fmi, "modelName": text(program.name), token: program.key}
    if program.doc:
        attributes["description"] = text(program.doc)
    attributes["generationTool"] = f"Frot {program.version}"
    attributes["variableNamingConvention"] = convention
    return ET.Element("fmiModelDescription", attributes)


def _offers_2(program: Program) -> dict[str, str]:
    """What model exchange and co-simulation both say, FMI 2.0."""
    return {
        "modelIdentifier": model_identifier(program.name),
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "true",
    }


def _exchange_2(root: ET.Element, program: Program) -> ET.Element:
    return ET.SubElement(
        root,
        "ModelExchange",
        _offers_2(program),
        completedIntegratorStepNotNeeded="false",
    )


def _sources(parent: ET.Element, sources: Sequence[str]) -> None:
    files = ET.SubElement(parent, "SourceFiles")
    for source in sources:
        ET.SubElement(files, "File", name=source)


def _offers_3(program: Program) -> dict[str, str]:
    """What model exchange and co-simulation both say, FMI 3.0."""
    return {
        "modelIdentifier": model_identifier(program.name),
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
        "providesDirectionalDerivatives": "true",
    }


def _exchange_3(root: ET.Element, program: Program) -> None:
    ET.SubElement(
        root,
        "ModelExchange",
        _offers_3(program),
        needsCompletedIntegratorStep="true",
    )


def _description_2(program: Program, sources: Sequence[str]) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "2.0", "guid", convention)
    if program.exchanges:
        root.set("numberOfEventIndicators", str(program.guards))
        _sources(_exchange_2(root, program), sources)
    simulation = ET.SubElement(
        root,
        "CoSimulation",
        _offers_2(program),
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs="true",
        maxOutputDerivativeOrder="1",
    )
    _sources(simulation, sources)
    root.append(_units(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    for declared in _types(variables):
        simple = ET.SubElement(types, "SimpleType", _described(declared))
        _items(ET.SubElement(simple, "Enumeration"), declared)
    root.append(_log_categories())
    root.append(_default_experiment(program))
    listed = ET.SubElement(root, "ModelVariables")
    tags = {
        "real": "Real",
        "integer": "Integer",
        "boolean": "Boolean",
        "enumeration": "Enumeration",
    }
    # the guards have no place in this version, and come last
    for variable in (v for v in variables if v.motion != "guard"):
        element = ET.SubElement(listed, "ScalarVariable", _common(variable))
        attributes = _type_attributes(variable) | _start(variable)
        if variable.rate_of >= 0:
            attributes["derivative"] = str(variable.rate_of + 1)
        ET.SubElement(element, tags[variable.type], attributes)
    structure = ET.SubElement(root, "ModelStructure")
    indices = {v.plain: v.reference + 1 for v in variables}
    for tag, unknowns in (
        ("Outputs", tuple(_outputs(variables))),
        ("Derivatives", tuple(_of_kind(variables, "rate"))),
        ("InitialUnknowns", tuple(_initial_unknowns(variables))),
    ):
        if unknowns:
            group = ET.SubElement(structure, tag)
            for variable in unknowns:
                named = {"index": str(variable.reference + 1)}
                known = _dependencies(variable, indices) if tag in _shown(variable) else {}
                ET.SubElement(group, "Unknown", named | known)
    return root


def _description_3(program: Program) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "3.0", "instantiationToken", convention)
    if program.exchanges:
        _exchange_3(root, program)
    ET.SubElement(
        root,
        "CoSimulation",
        _offers_3(program),
        canHandleVariableCommunicationStepSize="true",
        maxOutputDerivativeOrder="1",
        providesIntermediateUpdate="true",
        canReturnEarlyAfterIntermediateUpdate="true",
        mightReturnEarlyFromDoStep="true",
        hasEventMode="true",
    )
    root.append(_units(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    for declared in _types(variables):
        _items(ET.SubElement(types, "EnumerationType", _described(declared)), declared)
    root.append(_log_categories())
    root.append(_default_experiment(program))
    listed = ET.SubElement(root, "ModelVariables")
    tags = {
        "real": "Float64",
        "integer": "Int32",
        "boolean": "Boolean",
        "enumeration": "Enumeration",
    }
    for variable in variables:
        attributes = _common(variable) | _type_attributes(variable) | _start(variable)
        if variable.rate_of >= 0:
            attributes["derivative"] = str(variable.rate_of)
        ET.SubElement(listed, tags[variable.type], attributes)
    structure = ET.SubElement(root, "ModelStructure")
    references = {v.plain: v.reference for v in variables}
    for tag, unknowns in (
        ("Output", _outputs(variables)),
        ("ContinuousStateDerivative", _of_kind(variables, "rate")),
        ("InitialUnknown", _initial_unknowns(variables)),
        ("EventIndicator", _of_kind(variables, "guard")),
    ):
        for variable in unknowns:
            named = {"valueReference": str(variable.reference)}
            known = _dependencies(variable, references) if f"{tag}s" in _shown(variable) else {}
            ET.SubElement(structure, tag, named | known)
    return root


def to_xml(root: ET.Element) -> bytes:
    """A document in UTF-8, indented."""
    ET.indent(root)
    return bytes(ET.tostring(root, encoding="UTF-8", xml_declaration=True)) + b"\n"


def model_description(program: Program, fmi: str, sources: Sequence[str]) -> bytes:
    """The text of modelDescription.xml; `sources` are the C files of an FMI 2.0 archive.

    ValueError if two variables share a name or a unit has two meanings.
    """
    root = _description_2(program, sources) if fmi == "2.0" else _description_3(program)
    return to_xml(root)
