"""The C sources an FMU is built from and carries: model, kernel, FMI face, table, FMI headers."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
from frot.dsl.files.folders import room
from frot.runtime.fmi.arrays import grouped
from frot.runtime.fmi.description import to_xml
from frot.runtime.fmi.names import model_identifier
from frot.runtime.fmi.reached import reached
from frot.runtime.fmi.scalars import MODE, Scalar, scalars
from frot.runtime.program import MODEL_SOURCE, Program

TABLE_SOURCE = "fmu_table.c"
# Evaluations of the model in one step of the environment, after which it is given up: some minutes.
# A step of 1e300 s, or one with a stiffness set to 1e30, would not end in a lifetime.
MOST_WORK = 20_000_000

# An include of the kernel is written from its root: folder and name.
_INCLUDE = re.compile(rb'^(#include ")[a-z_/]+/', re.MULTILINE)
_COMMON = (
    "instance.c",
    "lifecycle.c",
    "stepping.c",
    "limits.c",
    "exchange.c",
    "events.c",
    "inputs.c",
    "derivatives.c",
    "adjoint.c",
    "access.c",
    "snapshot.c",
    "instance.h",
)
_FACES = {
    "2.0": ("fmi2.c", "fmi2_derivatives.c", "fmi2_exchange.c", "fmi2_refused.c", "fmi2_instance.h"),
    "3.0": (
        "fmi3.c",
        "fmi3_dependencies.c",
        "fmi3_derivatives.c",
        "fmi3_elements.c",
        "fmi3_events.c",
        "fmi3_exchange.c",
        "fmi3_refused.c",
        "fmi3_refused_types.c",
        "fmi3_instance.h",
    ),
}
_FMI_HEADERS = {
    "2.0": ("fmi2TypesPlatform.h", "fmi2FunctionTypes.h", "fmi2Functions.h"),
    "3.0": ("fmi3PlatformTypes.h", "fmi3FunctionTypes.h", "fmi3Functions.h"),
}
_TYPES = {
    "real": "FROT_REAL",
    "integer": "FROT_INTEGER",
    "boolean": "FROT_BOOLEAN",
    "enumeration": "FROT_MODE",
}
_ROLES = {
    "independent": "FROT_FMU_TIME",
    "parameter": "FROT_FMU_PARAMETER",
    "calculatedParameter": "FROT_FMU_DEPENDENT",
    "input": "FROT_FMU_INPUT",
    "output": "FROT_FMU_VARIABLE",
    "local": "FROT_FMU_VARIABLE",
}
_MOTION = {"state": "FROT_FMU_STATE", "rate": "FROT_FMU_RATE", "guard": "FROT_FMU_GUARD"}
_ON_INDETERMINATE = {
    "rest": "FROT_REST",
    "continue": "FROT_CONTINUE",
    "stop": "FROT_HALT",
    "impact": "FROT_COLLIDE",
}


def _string(value: str) -> str:
    """A C string literal of UTF-8 (octal escapes end after three digits, hexadecimal never)."""
    plain = {ord(c) for c in map(chr, range(32, 127))} - {ord('"'), ord("\\"), ord("?")}
    return (
        '"' + "".join(chr(b) if b in plain else f"\\{b:03o}" for b in value.encode("utf-8")) + '"'
    )


def _literals(variable: Scalar) -> int:
    """The number of values an enumeration of the text has, counted from 1."""
    return len(variable.declared.items) if variable.declared not in (None, MODE) else 0


def _role(variable: Scalar) -> str:
    return _MOTION.get(variable.motion) or _ROLES[variable.causality]


def _dependencies(variables: Sequence[Scalar]) -> Iterator[tuple[int, str]]:
    """References of each output and rate with those of what it depends on."""
    references = {v.plain: v.reference for v in variables}
    for one in variables:
        if one.causality != "output" and one.motion != "rate":
            continue
        if one.knowns is None:
            yield one.reference, "FROT_FMU_ANY"
        for name in one.knowns or ():
            yield one.reference, f"{references[name]}u"


def variable_table(program: Program, arrays: bool = False) -> str:
    """The C of the table of variables by value reference, see instance.h."""
    _, variables = scalars(program)
    sizes = dict.fromkeys((v.reference for v in variables), 0)
    sizes |= {one.first.reference: len(one.elements) for one in grouped(variables, arrays)}
    rows = "\n".join(
        f"    {{{_string(v.name)}, {_TYPES[v.type]}, {_role(v)}, "
        f"{int(v.variability == 'fixed')}, {_literals(v)}, {sizes[v.reference]}}},"
        for v in variables
    )
    pairs = list(_dependencies(variables)) if arrays else []
    listed = "\n".join(f"    {{{a}u, {b}}}," for a, b in pairs) or "    {0u, 0u},"
    choice = _ON_INDETERMINATE[program.experiment.on_indeterminate]
    return (
        "/* What lies behind each value reference. */\n"
        '#include "instance.h"\n\n'
        f"const frot_fmu_variable frot_fmu_variables[] = {{\n{rows}\n}};\n"
        f"const unsigned frot_fmu_variable_count = {len(variables)}u;\n"
        f"const frot_fmu_dependency frot_fmu_dependencies[] = {{\n{listed}\n}};\n"
        f"const unsigned frot_fmu_dependency_count = {len(pairs)}u;\n"
        f"const int frot_fmu_lists_dependencies = {int(arrays)};\n"
        f"const int frot_fmu_exchange = {int(program.exchanges)};\n"
        f"const int frot_fmu_on_indeterminate = {choice};\n"
        f"const int frot_fmu_on_impasse = {int(program.experiment.on_impasse == 'stop')};\n"
        f"const long long frot_fmu_most_work = {MOST_WORK};\n"
    )


def flat(content: bytes) -> bytes:
    """A C source whose includes name files of its own folder alone."""
    return _INCLUDE.sub(rb"\1", content)


def source_files(program: Program, fmi: str, arrays: bool = False) -> dict[str, bytes]:
    """All sources by name, in order, for one flat folder: of the kernel what an FMU may call.

    OSError if a file cannot be read; RuntimeError if two files have the same name.
    """
    found: dict[str, bytes] = {MODEL_SOURCE: flat(program.source.read_bytes())}
    kernel = room("frot.runtime.kernel")
    headers = Path(fmpy.__file__).parent / "c-code"
    parts = [
        *sorted(
            (entry.name, flat(entry.read_bytes()))
            for entry in kernel.rglob("*")
            if entry.suffix in (".c", ".h")
        ),
        *(
            (name, files("frot.runtime.fmi").joinpath(name).read_bytes())
            for name in (*_COMMON, *_FACES[fmi])
        ),
        (TABLE_SOURCE, variable_table(program, arrays).encode("ascii")),
        *((name, (headers / name).read_bytes()) for name in _FMI_HEADERS[fmi]),
    ]
    for name, content in parts:
        if name in found:
            raise RuntimeError(f"two C sources are called {name}")
        found[name] = content
    own = [MODEL_SOURCE, TABLE_SOURCE, *_COMMON, *_FACES[fmi]]
    return {name: found[name] for name in reached(found, own)}


def to_compile(sources: dict[str, bytes]) -> tuple[str, ...]:
    """The names among `sources` that are compiled."""
    return tuple(name for name in sources if name.endswith(".c"))


def build_description(program: Program, compiled: tuple[str, ...]) -> bytes:
    """The text of FMI 3.0's sources/buildDescription.xml."""
    root = ET.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = ET.SubElement(
        root,
        "BuildConfiguration",
        modelIdentifier=model_identifier(program.name),
        description="Needs the C library with its mathematics and nothing else.",
    )
    group = ET.SubElement(
        configuration,
        "SourceFileSet",
        language="C99",
        # Contracted multiplications and additions would give other bits.
        compilerOptions="-O2 -ffp-contract=off",
    )
    for name in compiled:
        ET.SubElement(group, "SourceFile", name=name)
    return to_xml(root)
