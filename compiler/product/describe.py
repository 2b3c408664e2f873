"""Description of a compiled program: parameters, inputs, variables, experiment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from frot.compiler.lowering.lower import Lowered
from frot.compiler.lowering.result_variables import FirstIntegral, integral_name, listed_integrals
from frot.compiler.lowering.units import unit_of
from frot.compiler.mechanics.mechanism import is_unilateral, relations_of
from frot.compiler.product.c_arrays import state_names
from frot.compiler.product.influence import influence_of
from frot.compiler.toolchain.compiler_choice import Toolchain, model_flags
from frot.compiler.translate.walk import as_number
from frot.dsl import default_values, evaluate
from frot.dsl.checked import Expression, Input, Model, Parameter
from frot.dsl.messages.source import escaped
from frot.dsl.quantities.dimensions import Enumeration, dimension
from frot.runtime.program import (
    ExperimentInfo,
    IntegralInfo,
    ParameterInfo,
    Program,
    RateInfo,
    Unit,
    VariableInfo,
)

# Guards of an element of friction: FROT_ELEMENT_GUARDS of the kernel.
GUARDS_OF_ELEMENT = 4

# An older installation has no metadata while it is being built.
try:
    VERSION = version("frot")
except PackageNotFoundError:
    VERSION = "0"


def describe(
    lowered: Lowered, file: str, key: str, toolchain: Toolchain, folder: Path, kernel: str
) -> Program:
    """The program of these functions, compiled in `folder` from the text `file`.

    `kernel` is the library that it needs, empty if it needs none.
    """
    reduced = lowered.reduced
    mechanism, model = reduced.mechanism, reduced.mechanism.model
    values = default_values(model, {})
    influence = influence_of(lowered)
    return Program(
        name=model.name,
        doc=model.doc,
        key=key,
        version=VERSION,
        planar=model.planar,
        parameters=tuple(
            replace(info, needed=needed if info.dependent else (), started=started)
            for info, needed, started in zip(
                parameters_of(lowered), influence.needed, influence.started, strict=True
            )
        ),
        inputs=inputs_of(lowered),
        variables=tuple(
            VariableInfo(
                v.name,
                "mode" if v.mode else v.base,
                unit_of(v.dimension, v.quantity, v.unit),
                "output" if v.output else "local",
                v.doc,
                **_limits(v.bounds, values),
                declared=v.declared,
                changes=v.changes,
                acting=acting if v.output else None,
                acting_states=states if v.output else (),
                **_of_enumeration(v.enumeration),
            )
            for v, acting, states in zip(
                lowered.variables, influence.inputs, influence.states, strict=True
            )
        ),
        contacts=(
            *(c.liaison.name for c in mechanism.contacts),
            *(e.name for e in lowered.system.elements),
        ),
        experiment=_experiment(model),
        compiler=toolchain.command,
        flags=model_flags(),
        folder=folder,
        balanced=bool(model.bodies) and not lowered.system.elements and not mechanism.is_driven,
        conditions=tuple(escaped(text) for text in reduced.conditions.texts),
        fixed=tuple((p.name, p.structural) for p in model.parameters if p.structural),
        file=file,
        kernel=kernel,
        first_integrals=_integrals(lowered.integrals),
        holders=_holders(lowered),
        states=state_names(lowered.system),
        rates=tuple(one and RateInfo(*one) for one in influence.rates),
        guards=_guards(lowered),
    )


def _guards(lowered: Lowered) -> int:
    """One of each contact, two of each element, those of the conditions that motion changes."""
    contacts = len(lowered.reduced.mechanism.contacts) + len(lowered.system.elements)
    elements = len(lowered.grouping.elements)
    return contacts + GUARDS_OF_ELEMENT * elements + lowered.reduced.conditions.located


def _holders(lowered: Lowered) -> tuple[str, ...]:
    """The liaisons that always hold, where nothing but forces moves the bodies."""
    mechanism, system = lowered.reduced.mechanism, lowered.system
    if mechanism.is_driven or not mechanism.model.bodies or mechanism.model.equations:
        return ()
    if system.nv != lowered.reduced.symbols.v.numel():
        return ()
    kept = relations_of(mechanism)
    return tuple(x.name for x, count in kept.items() if count and not is_unilateral(x))


def _integrals(integrals: tuple[FirstIntegral, ...]) -> tuple[IntegralInfo, ...]:
    listed = listed_integrals(integrals)
    found = [
        IntegralInfo(x.text, (integral_name(k + 1),), unit_of(x.dimension), x.always)
        for k, x in enumerate(listed)
    ]
    energy = [x for x in integrals if x.text == "energy"]
    parts = ("energy.kinetic", "energy.potential")
    return (
        *(IntegralInfo(x.text, parts, unit_of(x.dimension), x.always) for x in energy),
        *found,
    )


def parameters_of(lowered: Lowered) -> tuple[ParameterInfo, ...]:
    """The parameters with their defaults in SI, in the order of p."""
    values = default_values(lowered.reduced.mechanism.model, {})
    return tuple(
        ParameterInfo(
            p.name,
            p.type.base,
            _unit(p),
            as_number(evaluate(p.value, values)),
            p.doc,
            dependent,
            **_limits(p.bounds, values),
            **_of_enumeration(p.type.enumeration),
        )
        for p, dependent in zip(lowered.reduced.symbols.parameters, lowered.dependent, strict=True)
    )


def inputs_of(lowered: Lowered) -> tuple[ParameterInfo, ...]:
    """The inputs with their start values in SI, in the order of u."""
    values = default_values(lowered.reduced.mechanism.model, {})
    return tuple(
        ParameterInfo(
            i.name,
            i.type.base,
            _unit(i),
            as_number(evaluate(i.start, values)),
            i.doc,
            dependent=False,
            **_limits(i.bounds, values),
            **_of_enumeration(i.type.enumeration),
        )
        for i in lowered.reduced.symbols.inputs
    )


def _limits(
    bounds: tuple[tuple[str, Expression], ...], values: Mapping[Parameter, object]
) -> dict[str, Any]:
    """`min` and `max`, as far as they are numbers at the default parameters."""
    return {name: as_number(evaluate(bound, values)) for name, bound in bounds}


def _of_enumeration(of: Enumeration | None) -> dict[str, Any]:
    return {} if of is None else {"literals": of.literals, "enumeration": of.name}


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
        experiment.on_impasse,
    )
