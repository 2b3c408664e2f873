"""The model description (modelDescription.xml) of a program, for FMI 2.0 and FMI 3.0.

In FMI 2.0 the index of a variable is its value reference plus one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from xml.etree import ElementTree as ET

from frot.runtime.fmi.about import About
from frot.runtime.fmi.arrays import grouped
from frot.runtime.fmi.definitions import (
    add_items,
    declared_types,
    described,
    text,
    type_attributes,
    unit_definitions,
)
from frot.runtime.fmi.names import model_identifier
from frot.runtime.fmi.scalars import Scalar, scalars
from frot.runtime.program import (
    DEFAULT_POINTS,
    DEFAULT_TOLERANCE,
    Program,
)

NOTHING = About()
LOG_CATEGORIES = (
    ("logEvents", "changes of the modes of liaisons and of conditions"),
    ("logStatusDiscard", "why the motion ends before the end of a step"),
    ("logStatusError", "why a call is refused"),
    ("logAll", "everything"),
)


def _start(*elements: Scalar) -> dict[str, str]:
    values = [_number(v.type, v.start) for v in elements if v.start is not None]
    return {"start": " ".join(values)} if values else {}


def _number(kind: str, value: float) -> str:
    if kind == "boolean":
        return "true" if value else "false"
    return str(int(value)) if kind in ("integer", "enumeration") else repr(float(value))


def _common(variable: Scalar) -> dict[str, str]:
    attributes = {"name": text(variable.name), "valueReference": str(variable.reference)}
    if variable.doc:
        attributes["description"] = text(variable.doc)
    attributes |= {"causality": variable.causality, "variability": variable.variability}
    if variable.initial:
        attributes["initial"] = variable.initial
    return attributes


def _dependencies(variable: Scalar, numbers: Mapping[str, int]) -> dict[str, str]:
    """Numbers of the variables that an unknown depends on."""
    if variable.knowns is None:
        return {}
    places = dict.fromkeys(numbers[name] for name in variable.knowns)
    return {"dependencies": " ".join(map(str, places))}


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
    """Where its dependencies are given: at the start it may depend on any parameter."""
    if variable.motion == "rate":
        return "Derivatives ContinuousStateDerivatives"
    return "Outputs" if variable.causality == "output" else "InitialUnknowns"


def _root(program: Program, fmi: str, token: str, convention: str, about: About) -> ET.Element:
    attributes = {"fmiVersion": fmi, "modelName": text(program.name), token: program.key}
    if program.doc:
        attributes["description"] = text(program.doc)
    attributes |= {name: text(value) for name, value in about.attributes().items()}
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


def _offers_3(program: Program, arrays: bool) -> dict[str, str]:
    """What model exchange and co-simulation both say, FMI 3.0."""
    return {
        "modelIdentifier": model_identifier(program.name),
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
        "providesDirectionalDerivatives": "true",
        "providesAdjointDerivatives": "true",
        "providesPerElementDependencies": str(arrays).lower(),
    }


def _exchange_3(root: ET.Element, program: Program, arrays: bool) -> None:
    ET.SubElement(
        root,
        "ModelExchange",
        _offers_3(program, arrays),
        needsCompletedIntegratorStep="true",
    )


def _description_2(program: Program, sources: Sequence[str], about: About) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "2.0", "guid", convention, about)
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
    root.append(unit_definitions(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    for declared in declared_types(variables):
        simple = ET.SubElement(types, "SimpleType", described(declared))
        add_items(ET.SubElement(simple, "Enumeration"), declared)
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
        attributes = type_attributes(variable) | _start(variable)
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


def _description_3(program: Program, about: About, arrays: bool) -> ET.Element:
    convention, variables = scalars(program)
    root = _root(program, "3.0", "instantiationToken", convention, about)
    if program.exchanges:
        _exchange_3(root, program, arrays)
    ET.SubElement(
        root,
        "CoSimulation",
        _offers_3(program, arrays),
        canHandleVariableCommunicationStepSize="true",
        maxOutputDerivativeOrder="1",
        providesIntermediateUpdate="true",
        canReturnEarlyAfterIntermediateUpdate="true",
        mightReturnEarlyFromDoStep="true",
        hasEventMode="true",
    )
    root.append(unit_definitions(variables))
    types = ET.SubElement(root, "TypeDefinitions")
    for declared in declared_types(variables):
        add_items(ET.SubElement(types, "EnumerationType", described(declared)), declared)
    root.append(_log_categories())
    root.append(_default_experiment(program))
    listed = ET.SubElement(root, "ModelVariables")
    tags = {
        "real": "Float64",
        "integer": "Int32",
        "boolean": "Boolean",
        "enumeration": "Enumeration",
    }
    groups = grouped(variables, arrays)
    for one in groups:
        variable = replace(one.first, name=one.name)
        attributes = _common(variable) | type_attributes(variable) | _start(*one.elements)
        if variable.rate_of >= 0:
            attributes["derivative"] = str(variable.rate_of)
        element = ET.SubElement(listed, tags[variable.type], attributes)
        for size in one.dimensions:
            ET.SubElement(element, "Dimension", start=str(size))
    structure = ET.SubElement(root, "ModelStructure")
    references = {v.plain: one.first.reference for one in groups for v in one.elements}
    variables = tuple(replace(one.first, knowns=one.knowns) for one in groups)
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


def model_description(
    program: Program,
    fmi: str,
    sources: Sequence[str],
    about: About = NOTHING,
    arrays: bool = False,
) -> bytes:
    """The text of modelDescription.xml.

    `sources` are the C files of an FMI 2.0 archive, `arrays` is for FMI 3.0 alone.
    ValueError if two variables share a name, a unit has two meanings or a date is none.
    """
    if fmi == "2.0":
        return to_xml(_description_2(program, sources, about))
    return to_xml(_description_3(program, about, arrays))
