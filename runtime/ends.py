"""Values at the end of runs that differ in their parameters alone: one instance runs them all."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Mapping, Sequence
from types import TracebackType

from frot.runtime.engine import OK, Engine, interrupts_noted
from frot.runtime.library import Monitor
from frot.runtime.program import Program
from frot.runtime.run import GOOD, Interrupted, fault_of, span_of
from frot.runtime.settings import read_option, read_settings


class Ends:
    """Runs a program again and again, and keeps nothing but the values of `names` at the end.

    Used in a `with`, in which Ctrl-C ends the run: `of` raises `Interrupted`.
    """

    def __init__(
        self,
        program: Program,
        names: Sequence[str],
        *,
        stop: float | str | None = None,
        start: float | str | None = None,
        tolerance: float | str | None = None,
        inputs: Mapping[str, object] | None = None,
    ) -> None:
        """Options are those of `simulate`; FrotError (E0805, E0806) for bad ones."""
        places = {v.name: k for k, v in enumerate(program.variables)}
        self._places = [-1 if name == "time" else places[name] for name in names]
        self._engine = Engine(program)
        self._blank = self._engine.save()
        self._options = (
            read_option("start", start, "s"),
            read_option("stop", stop, "s"),
            read_option("tolerance", tolerance, "1"),
        )
        self._inputs = read_settings(inputs, program.inputs, "input", program)
        self._indeterminate = program.experiment.on_indeterminate
        self._noted: list[BaseException] = []
        self._monitor = Monitor(lambda _, __: int(bool(self._noted)))
        self._signals = contextlib.ExitStack()

    def __enter__(self) -> Ends:
        self._signals.enter_context(interrupts_noted(self._noted))
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._signals.close()

    def of(self, parameters: Iterable[tuple[int, float]]) -> list[float]:
        """The values at the end of a run with these parameters, by index and in SI.

        Raises as `simulate`; its errors hold no result.
        """
        engine = self._engine
        engine.restore(self._blank)
        for index, value in parameters:
            engine.set_parameter(index, value)
        for index, value in self._inputs:
            engine.set_input(index, value)
        status, experiment = engine.settle_parameters()
        if status != OK:
            raise fault_of(engine, None)
        begin, end, tolerance = span_of(*self._options, experiment)
        if engine.start(begin, tolerance, self._indeterminate) != OK:
            raise fault_of(engine, None)
        status = engine.finish(end, self._monitor)
        if self._noted:
            raise Interrupted(engine.time, None)
        if status not in GOOD:
            raise fault_of(engine, None)
        values = engine.now()
        return [engine.time if place < 0 else values[place] for place in self._places]
