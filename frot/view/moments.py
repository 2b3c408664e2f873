"""The values of a run at the moments of a picture, by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from frot.view.outline import Array
from frot.view.seen import PREFIX, list_seen

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel
    from frot.runtime.program import Program
    from frot.runtime.run_report import Event
    from frot.runtime.run_values import RunValues

RATE = 30.0  # pictures a second of a run that is played as fast as it is
EACH = 1  # pictures for each step: between them places go straight
MOST = 4000
MOST_POSES = 60_000  # of all that is drawn; a pose takes 37 bytes of a page
MOST_BESIDE = 1500  # events at both sides of which there is a picture
LEAST = 120


class Moments:
    """Values of the variables of a picture's program at `times` (s)."""

    def __init__(
        self,
        program: Program,
        times: Array,
        values: Array,
        parameters: Mapping[str, float],
        events: tuple[Event, ...] = (),
    ) -> None:
        """`values`: times x variables."""
        self.program, self.times, self.values = program, times, values
        self.parameters, self.events = parameters, events
        self._columns = {v.name: k for k, v in enumerate(program.variables)}

    def has(self, name: str) -> bool:
        """Whether the program gives this variable."""
        return name in self._columns

    def column(self, name: str) -> Array | None:
        """The values of a variable, None where there is none."""
        return self.values[:, self._columns[name]] if self.has(name) else None

    def vector(self, name: str, size: int) -> Array:
        """A vector variable that only the picture reads (times x size)."""
        first = self._columns[f"{PREFIX}{name}[0]"]
        return self.values[:, first : first + size]

    def vector_of(self, name: str) -> Array | None:
        """A vector of the program with three components, None where there is none."""
        parts = [self.column(f"{name}.{axis}") for axis in "xyz"]
        if parts[0] is None or parts[1] is None:
            return None
        third = np.zeros(len(self.times)) if parts[2] is None else parts[2]
        return np.column_stack((parts[0], parts[1], third))


def picture_program(model: CompiledModel, moving: frozenset[str] = frozenset()) -> Program:
    """The program that gives what a picture reads."""
    from frot.second import second_program

    return second_program(model, "picture", list_seen, moving)


def times_of(result: RunValues, drawn: int = 1) -> Array:
    """The moments of a page: evenly, as many as the motion needs, and both sides of each event.

    `drawn` is the number of things that have a pose at each of them.
    """
    first, last = float(result.time[0]), float(result.time[-1])
    most = np.clip(MOST_POSES / max(drawn, 1), LEAST, MOST)
    count = int(np.clip(max((last - first) * RATE, EACH * result.figures.steps), LEAST, most)) + 1
    inner = [e.time for e in result.events if first < e.time < last][:MOST_BESIDE]
    return np.unique([*np.linspace(first, last, count), *inner, *np.nextafter(inner, first)])


def moments_of(result: RunValues, model: CompiledModel, times: Array) -> Moments:
    """Variables that a picture reads from a run at these times; ValueError as `Second`."""
    from frot.second import Second

    program = picture_program(model, result.moving)
    values = Second(result, program).at(times)
    return Moments(program, np.asarray(times), values, result.parameters, result.events)


def start_of(
    model: CompiledModel,
    *,
    start: float | str | None = None,
    parameters: Mapping[str, object] | None = None,
    inputs: Mapping[str, object] | None = None,
) -> Moments:
    """Variables that a picture reads from the start of a run; FrotError if there is none."""
    from frot.inputs_over_time import driven_program
    from frot.runtime.run import begin
    from frot.runtime.tables import moving_of

    _, constants, tables = driven_program(model, inputs, start, None)
    program = picture_program(model, moving_of(tables))
    engine = begin(
        program,
        start=start,
        parameters=parameters,
        inputs=constants,
        tables=tables,
    )
    values = np.array([engine.now()])
    known = {p.name: engine.get_parameter(k) for k, p in enumerate(program.parameters)}
    return Moments(program, np.array([engine.time]), values, known)
