"""Checked model to compiled program: the one place that knows the order of the passes."""

from __future__ import annotations

from dataclasses import replace
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from pathlib import Path

from frot.compiler.lowering.walk import as_number
from frot.compiler.mechanics.mechanize import mechanize
from frot.compiler.product.units import unit_of
from frot.compiler.toolchain.cache import store, write_manifest
from frot.compiler.toolchain.compilers import FLAGS, Toolchain, compile_objects, link_library
from frot.compiler.toolchain.objects import kept_objects
from frot.dsl import Log, default_values, evaluate
from frot.dsl.checked import Expression, Input, Model, Parameter
from frot.dsl.quantities.dimensions import dimension
from frot.runtime.program import (
    LIBRARY,
    MODEL_SOURCE,
    ExperimentInfo,
    ParameterInfo,
    Program,
    Unit,
    VariableInfo,
    read_program,
)

# An older installation has no metadata while it is being built.
try:
    VERSION = version("frot")
except PackageNotFoundError:
    VERSION = "0"


def kernel_folder() -> Path:
    """Where the kernel's sources lie."""
    return Path(str(files("frot.runtime.kernel")))


def kernel_sources() -> list[Path]:
    """The kernel's C files."""
    return sorted(kernel_folder().glob("*.c"))


def build(model: Model, file: str, key: str, toolchain: Toolchain, log: Log) -> Program | None:
    """Run every pass and the C compiler; what the text is to blame for goes to the log.

    `file` is the name of the text in the places of its equations.
    """
    from frot.compiler.lowering.lower import lower
    from frot.compiler.mechanics.reduce import reduce
    from frot.compiler.product.generate import generate

    mechanism = mechanize(model, log)
    if mechanism is None:
        return None
    reduced = reduce(mechanism, log)
    lowered = lower(reduced, log) if reduced is not None else None
    if reduced is None or lowered is None:
        return None
    values = default_values(model, {})
    parameters = tuple(
        ParameterInfo(
            p.name, p.type.base, _unit(p), as_number(evaluate(p.value, values)), p.doc, dependent
        )
        for p, dependent in zip(reduced.symbols.parameters, lowered.dependent, strict=True)
    )
    inputs = tuple(
        ParameterInfo(i.name, i.type.base, _unit(i), as_number(evaluate(i.start, values)), i.doc)
        for i in reduced.symbols.inputs
    )
    text = generate(lowered, key, [p.default for p in parameters], [i.default for i in inputs])
    kernel = kept_objects(toolchain, kernel_sources(), [kernel_folder()], FLAGS)

    def fill(folder: Path) -> None:
        source = folder / MODEL_SOURCE
        source.write_text(text, encoding="utf-8")
        made = compile_objects(toolchain, [source], [kernel_folder()], folder)
        link_library(toolchain, [*made, *sorted(kernel.folder.glob("*.o"))], folder / LIBRARY)
        made[0].unlink()
        write_manifest(
            Program(
                name=model.name,
                doc=model.doc,
                key=key,
                version=VERSION,
                planar=model.planar,
                parameters=parameters,
                inputs=inputs,
                variables=tuple(
                    VariableInfo(
                        v.name,
                        "mode" if v.mode else "real",
                        unit_of(v.dimension, v.quantity, v.unit),
                        "output" if v.output else "local",
                        v.doc,
                    )
                    for v in lowered.variables
                ),
                contacts=(
                    *(c.liaison.name for c in mechanism.contacts),
                    *(e.name for e in lowered.system.elements),
                ),
                experiment=_experiment(model),
                compiler=toolchain.command,
                flags=FLAGS,
                folder=folder,
                balanced=bool(model.bodies) and not lowered.system.elements,
                conditions=tuple(reduced.conditions.texts),
                fixed=tuple((p.name, p.structural) for p in model.parameters if p.structural),
                file=file,
            ),
            folder,
        )

    kept = store("programs", key, fill)
    return replace(read_program(kept.folder), hold=kept.hold)


def _unit(declared: Parameter | Input) -> Unit:
    if declared.type.base != "real":
        return unit_of(dimension())
    return unit_of(declared.type.dimension, declared.quantity, declared.unit)


def _experiment(model: Model) -> ExperimentInfo:
    values = default_values(model, {})

    def number(expression: Expression | None) -> float | None:
        return None if expression is None else as_number(evaluate(expression, values))

    experiment = model.experiment
    return ExperimentInfo(
        number(experiment.start),
        number(experiment.stop),
        number(experiment.tolerance),
        number(experiment.interval),
        experiment.on_indeterminate,
    )
