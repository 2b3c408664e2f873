"""Results in a pickle: the text of the model, the state of the kernel and the recorded steps."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from frot.runtime.scheduled import Scheduled

if TYPE_CHECKING:
    from frot.runtime.program import Program
    from frot.runtime.run_values import RunValues

    from frot.compiled_model import CompiledModel

# The class of results: made by program, engine, grid, record, events, figures.
Made = TypeVar("Made", bound="RunValues")


def keep(result: RunValues) -> tuple[Any, ...]:
    """The data from which a result is made again; TypeError where its model is not known.

    Inputs over time are among them as tables.
    """
    if result.model is None:
        raise TypeError("a result without its model has no pickle: take one of model.simulate(...)")
    engine = result.engine
    schedule = engine.taken if isinstance(engine, Scheduled) else None
    options = {k: v for k, v in result.options.items() if k != "watch"}
    kept = {"moving": result.moving, "fault": result.fault, "options": options}
    arrays = (bytes(result.grid), bytes(result.record))
    return result.model, engine.save(), schedule, arrays, result.events, result.figures, kept


def revive(
    kind: Callable[..., Made],
    model: CompiledModel,
    state: bytes,
    schedule: Any,
    arrays: tuple[bytes, bytes],
    events: Any,
    figures: Any,
    kept: dict[str, Any],
    check: Callable[[Program], None] = lambda _: None,
) -> Made:
    """The result of class `kind` again; its program is compiled where the cache has none.

    `check` is called with it before anything is read by it.
    """
    from frot.runtime.engine import Engine

    from frot.second import second_program

    moving = kept["moving"]
    program = second_program(model, "", moving=moving) if moving else model.program()
    check(program)
    engine: Engine = Engine(program)
    if schedule is not None:
        engine = Scheduled(program, ())
        engine.taken = schedule
    if len(engine.save()) != len(state):
        raise ValueError("the result was kept by another version of Frot")
    engine.restore(state)
    grid, record = (array("d", one) for one in arrays)
    result = kind(program, engine, grid, record, events, figures)
    result.model, result.moving = model, moving
    result.fault, result.options = kept["fault"], kept["options"]
    return result
