"""A second program of a model, with more variables, and its values over the steps of a run."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from typing import TYPE_CHECKING

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.errors import FrotError
from frot.dsl.messages.interrupts import DeferredInterrupts

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel
    from frot.compiler.driver import Extra
    from frot.dsl.checked import Model as Checked
    from frot.runtime.engine import Engine
    from frot.runtime.number_arrays import Floats
    from frot.runtime.program import Program
    from frot.runtime.run_values import RunValues


def second_program(
    model: CompiledModel,
    tag: str,
    extra: Extra | None = None,
    moving: frozenset[str] = frozenset(),
    change: Callable[[Checked], Checked] | None = None,
    tell: Callable[[str], None] | None = None,
    orders: bool = False,
) -> Program:
    """The program of a model with `extra` variables, and with `moving` inputs over time, cached.

    `change` makes another checked model of it. `tag` says in what the program differs from the
    model's own. `orders`: see `build`. FrotError where it cannot be made.
    """
    from frot.compiler import build, find_program

    key = model.key_of(f"{tag}\ninputs over time: {', '.join(sorted(moving))}")
    found = find_program(key)
    if found is not None:
        return model.named(found)
    log = Log()
    told = (lambda _: None) if tell is None else tell
    with DeferredInterrupts():
        built = build(
            checked_of(model, moving) if change is None else change(checked_of(model, moving)),
            model.file,
            key,
            model.toolchain,
            log,
            tell=told,
            extra=extra,
            orders=orders,
        )
    if built is None:
        raise FrotError(log)
    return model.named(built)


def checked_of(model: CompiledModel, moving: frozenset[str]) -> Checked:
    """The checked model, with these inputs as functions of time."""
    if not moving:
        return model.checked()
    from frot.polynomial_inputs import with_time

    return with_time(model.checked(), moving)


class Second:
    """Evaluates a second program over the recorded steps of a result."""

    def __init__(self, result: RunValues, program: Program) -> None:
        """ValueError where the two programs have other states, so that steps mean other things."""
        self.program = program
        self._engine: Engine = result.engine.like(program)
        self._record = result.record
        if not result.engine.is_like(self._engine):
            raise ValueError("the programs have other states")
        self._engine.restore(result.engine.save())

    def at(self, times: Floats) -> Floats:
        """Values (times x variables) at times in ascending order."""
        return self._engine.rows(self._record, array("d", times))

    def in_step(self, place: int, time: float) -> array[float]:
        """Values at a time of the recorded step that begins at this place of the record."""
        return self._engine.values(self._record, array("d", [time]), place)
