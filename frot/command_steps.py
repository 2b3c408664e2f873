"""Steps that commands share: compile a model, run it, print messages."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from frot.dsl.messages.diagnostics import Diagnostic
    from frot.model import Model
    from frot.runtime.result import Result


def compiled(options: argparse.Namespace) -> Model:
    """The model with its program, which is compiled if the cache has none."""
    from frot.model import load
    from frot.progress import Busy

    model = load(options.file, options.model)
    with Busy(f"compiling {model.name}") as busy:
        try:
            model.program(busy.tell)
        except KeyboardInterrupt:
            words = f"interrupted while compiling '{model.name}'; nothing half made is left"
            raise KeyboardInterrupt(words) from None
    if model.warnings:
        _tell(model.warnings)
    return model


def run_watched(model: Model, options: argparse.Namespace, **changed: Any) -> Result:
    """Run a model with the options of a command, and show how far it is."""
    program = model.program()
    given = {
        "start": options.start,
        "stop": options.stop,
        "tolerance": options.tolerance,
        "parameters": dict(options.set),
        "inputs": dict(options.input),
    } | changed
    from frot.progress import Progress

    with Progress(f"simulating {program.name}") as progress:
        watch = progress.watch(options.stop or program.experiment.stop)
        return model.simulate(**given, watch=watch)


def run_as_far(
    model: Model, options: argparse.Namespace, **changed: Any
) -> tuple[Result, BaseException | None]:
    """The run, as far as it went, and what ended it; Ctrl-C is raised."""
    from frot.runtime import SimulationError

    try:
        return run_watched(model, options, **changed), None
    except SimulationError as error:
        if error.result is None:
            raise
        return error.result, error


def complain(error: Exception) -> None:
    """Print the messages of a FrotError."""
    from frot.dsl.messages.errors import FrotError

    assert isinstance(error, FrotError)
    _tell(error.diagnostics)


def _tell(diagnostics: Sequence[Diagnostic]) -> None:
    from frot.dsl import render

    colour = sys.stderr.isatty()
    for diagnostic in diagnostics:
        print(render(diagnostic, colour), file=sys.stderr)
