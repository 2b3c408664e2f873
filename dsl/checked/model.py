"""The checked model, and the options of its run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.checked.expressions import Expression, Input, Output, Parameter, Variable
    from frot.dsl.checked.mechanics import (
        Body,
        Curve,
        Flange,
        Force,
        Frame,
        Liaison,
        Surface,
        World,
    )
    from frot.dsl.checked.statements import Assertion, Equation, IfEquations, InitialEquation, When
    from frot.dsl.messages.source import Source, Span


@dataclass(frozen=True, slots=True, eq=False)
class Experiment:
    """Defaults of a run; expressions of parameters, None where the text is silent."""

    stop: Expression | None
    start: Expression | None
    tolerance: Expression | None
    interval: Expression | None
    max_step: Expression | None
    method: str
    on_impasse: str
    on_indeterminate: str
    span: Span | None


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A checked model. `files` are all sources it was read from."""

    name: str
    planar: bool
    parameters: tuple[Parameter, ...]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    world: World
    ground: Body
    bodies: tuple[Body, ...]
    frames: tuple[Frame, ...]
    curves: tuple[Curve, ...]
    liaisons: tuple[Liaison, ...]
    forces: tuple[Force, ...]
    initial: tuple[InitialEquation, ...]
    experiment: Experiment
    files: tuple[Source, ...]
    span: Span
    doc: str = ""
    variables: tuple[Variable, ...] = ()
    equations: tuple[Equation | IfEquations, ...] = ()
    flanges: tuple[Flange, ...] = ()
    whens: tuple[When, ...] = ()
    assertions: tuple[Assertion, ...] = ()
    surfaces: tuple[Surface, ...] = ()
