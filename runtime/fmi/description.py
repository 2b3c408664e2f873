"""The model description (modelDescription.xml) of a program, for FMI 2.0 and FMI 3.0.

Value references count time (0), the parameters, the inputs and the variables of a program in their
order; instance.h relies on it. In FMI 2.0 the index of a variable is its value reference plus one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree as ET

from frot.dsl.data.classes import dataclass
from frot.runtime.fmi.names import model_identifier, variable_names
from frot.runtime.program import (
    DEFAULT_POINTS,
    DEFAULT_TOLERANCE,
    ParameterInfo,
    Program,
    Unit,
    VariableInfo,
)

MODE_TYPE = "FrotMode"
MODES = (
    ("open", 0, "the liaison is open"),
    ("stick", 1, "closed, without slip"),
    ("slip", 2, "closed, slipping"),
)
LOG_CATEGORIES = (
    ("logEvents", "changes of the modes of liaisons and of conditions"),
    ("logStatusDiscard", "why the motion ends before the end of a step"),
    ("logStatusError", "why a call is refused"),
    ("logAll", "everything"),
)
# Unit.exponents are in this order.
BASE_UNITS = ("m", "kg", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True, slots=True)
class Scalar:
    """One entry of ModelVariables; `start` is None where a value is calculated."""

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    initial: str
    start: float | None
    unit: Unit | None
    doc: str
    min: float | None = None
    max: float | None = None


def text(value: str) -> str:
    """`value` without the control characters that XML cannot hold."""
    return re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]", " ", value)


def _from_parameter(name: str, reference: int, info: ParameterInfo, causality: str) -> Scalar:
    unit = info.unit if info.type == "real" else None
    if causality == "input":
        variability = "continuous" if info.type == "real" else "discrete"
        return Scalar(
            name,
            reference,
            info.type,
            "input",
            variability=variability,
            initial="",
            start=info.default,
            unit=unit,
            doc=info.doc,
            min=info.min,
            max=info.max,
        )
    if info.dependent:
        causality = "calculatedParameter"
    initial, start = ("calculated", None) if info.dependent else ("exact", info.default)
    return Scalar(
        name,
        reference,
        info.type,
        causality,
        variability="tunable",
        initial=initial,
        start=start,
        unit=unit,
        doc=info.doc,
        min=info.min,
        max=info.max,
    )


def _from_variable(name: str, reference: int, info: VariableInfo) -> Scalar:
    real = info.type == "real"
    return Scalar(
        name,
        reference,
        info.type,
        info.causality,
        variability="continuous" if real else "discrete",
        initial="calculated",
        start=None,
        unit=info.unit if real else None,
        doc=info.doc,
        min=info.min,
        max=info.max,
    )


def scalars(program: Program) -> tuple[str, tuple[Scalar, ...]]:
    """The naming convention and all variables of an FMU of `program`, by value reference."""
    infos: tuple[ParameterInfo | VariableInfo, ...] = (
        *program.parameters,
        *program.inputs,
        *program.variables,
    )
    convention, names = variable_names(("time", *(info.name for info in infos)))
    second = Unit("s", (0, 0, 1, 0, 0, 0, 0, 0))
    found = [
        Scalar(
            "time",
            0,
            "real",
            "independent",
            variability="continuous",
            initial="",
            start=None,
            unit=second,
            doc="time",
        )
    ]
    for info, name in zip(infos, names[1:], strict=True):
        reference = len(found)
        if isinstance(info, VariableInfo):
            found.append(_from_variable(name, reference, info))
        else:
            causality = "parameter" if reference <= len(program.parameters) else "input"
            found.append(_from_parameter(name, reference, info, causality))
    return convention, tuple(found)


def _units(variables: Sequence[Scalar]) -> ET.Element:
    definitions = ET.Element("UnitDefinitions")
    exponents: dict[str, tuple[int, ...]] = {}
    displays: dict[str, dict[str, float]] = {}
    for variable in variables:
        unit = variable.unit
        if unit is None or not unit.name:
            continue
        if exponents.setdefault(unit.name, unit.exponents) != unit.exponents:
            raise ValueError(f"unit '{unit.name}' has two meanings")
        shown = displays.setdefault(unit.name, {})
        if _display(unit) and shown.setdefault(unit.display, unit.display_factor) != (
            unit.display_factor
        ):
            raise ValueError(f"display unit '{unit.display}' has two meanings")
    for name, powers in exponents.items():
        element = ET.SubElement(definitions, "Unit", name=text(name))
        base = {key: str(power) for key, power in zip(BASE_UNITS, powers, strict=True) if power}
        ET.SubElement(element, "BaseUnit", base)
        for display, factor in displays[name].items():
            # FMI's factor leads from the unit to the display unit.
            ET.SubElement(element, "DisplayUnit", name=text(display), factor=repr(1 / factor))
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
    if variable.type == "integer":
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
    if variable.type == "mode":
        return {"declaredType": MODE_TYPE}
    bounds = {
        name: repr(float(limit)) if variable.type == "real" else str(int(limit))
        for name, limit in (("min", variable.min), ("max", variable.max))
        if limit is not None
    }
    return bounds | (_real_attributes(variable) if variable.type == "real" else {})


def _default_experiment(program: Program) -> ET.Element:
    """What `frot simulate` would take: all four, for importers guess what is not there."""
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
    return (v for v in variables if v.causality in ("output", "calculatedParameter"))


def _root(program: Program, fmi: str, token: str, convention: str) -> ET.Element:
    attributes = {"fmiVersion": fmi, "modelName": text(program.name), token: program.key}
    if program.doc:
        attributes["description"] = text(program.doc)
    attributes["generationTool"] = f"Frot {program.version}"
    attributes["variableNamingConvention"] = convention
    return ET.Element("fmiModelDescription", attributes)


def _description_2(program: Program, sources: Sequence[str]) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "2.0", "guid", convention)
    simulation = ET.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model_identifier(program.name),
        needsExecutionTool="false",
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs="false",
        maxOutputDerivativeOrder="0",
        canBeInstantiatedOnlyOncePerProcess="false",
        canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
        providesDirectionalDerivative="false",
    )
    files = ET.SubElement(simulation, "SourceFiles")
    for source in sources:
        ET.SubElement(files, "File", name=source)
    root.append(_units(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    mode = ET.SubElement(types, "SimpleType", name=MODE_TYPE, description="mode of a liaison")
    items = ET.SubElement(mode, "Enumeration")
    for name, value, meaning in MODES:
        ET.SubElement(items, "Item", name=name, value=str(value), description=meaning)
    root.append(_log_categories())
    root.append(_default_experiment(program))
    listed = ET.SubElement(root, "ModelVariables")
    tags = {"real": "Real", "integer": "Integer", "boolean": "Boolean", "mode": "Enumeration"}
    for variable in variables:
        element = ET.SubElement(listed, "ScalarVariable", _common(variable))
        attributes = _type_attributes(variable) | _start(variable)
        ET.SubElement(element, tags[variable.type], attributes)
    structure = ET.SubElement(root, "ModelStructure")
    for tag, unknowns in (
        ("Outputs", tuple(_outputs(variables))),
        ("InitialUnknowns", tuple(_initial_unknowns(variables))),
    ):
        if unknowns:
            group = ET.SubElement(structure, tag)
            for variable in unknowns:
                ET.SubElement(group, "Unknown", index=str(variable.reference + 1))
    return root


def _description_3(program: Program) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "3.0", "instantiationToken", convention)
    ET.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=model_identifier(program.name),
        needsExecutionTool="false",
        canBeInstantiatedOnlyOncePerProcess="false",
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        providesDirectionalDerivatives="false",
        canHandleVariableCommunicationStepSize="true",
        maxOutputDerivativeOrder="0",
        providesIntermediateUpdate="false",
        mightReturnEarlyFromDoStep="true",
        hasEventMode="false",
    )
    root.append(_units(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    mode = ET.SubElement(types, "EnumerationType", name=MODE_TYPE, description="mode of a liaison")
    for name, value, meaning in MODES:
        ET.SubElement(mode, "Item", name=name, value=str(value), description=meaning)
    root.append(_log_categories())
    root.append(_default_experiment(program))
    listed = ET.SubElement(root, "ModelVariables")
    tags = {"real": "Float64", "integer": "Int32", "boolean": "Boolean", "mode": "Enumeration"}
    for variable in variables:
        attributes = _common(variable) | _type_attributes(variable) | _start(variable)
        ET.SubElement(listed, tags[variable.type], attributes)
    structure = ET.SubElement(root, "ModelStructure")
    for variable in _outputs(variables):
        ET.SubElement(structure, "Output", valueReference=str(variable.reference))
    for variable in _initial_unknowns(variables):
        ET.SubElement(structure, "InitialUnknown", valueReference=str(variable.reference))
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
