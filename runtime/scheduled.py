"""An instance whose inputs follow tables: they change at knots, where steps begin anew."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.errors import FrotError
from frot.runtime.engine import FULL, MOST_MEMORY, OK, Engine, Run
from frot.runtime.tables import Table

if TYPE_CHECKING:
    from frot.runtime.library import RawEvent
    from frot.runtime.program import Program

# The inputs of a program that stand for one over time: its coefficients, and when they begin.
COEFFICIENTS = 4


def coefficient_name(name: str, power: int) -> str:
    """The input that is the coefficient of the power of the time since `knot_name`."""
    return f"{name}@{power}"


def knot_name(name: str) -> str:
    """The input that is the time of the last knot."""
    return f"{name}@from"


class Refused(Exception):
    """A change at a knot that the motion cannot make: its `log`, and the `run` up to there."""

    def __init__(self, error: FrotError, run: Run) -> None:
        super().__init__(str(error))
        self.log, self.run = Log(list(error.diagnostics)), run


class Scheduled(Engine):
    """One instance of a compiled model, some of whose inputs are given over time."""

    def __init__(self, program: Program, tables: Sequence[Table]) -> None:
        """The inputs of `program` have the names of `coefficient_name`, or are held."""
        super().__init__(program)
        places = {one.name: k for k, one in enumerate(program.inputs)}
        changes: dict[float, dict[int, float]] = {}
        for table in tables:
            for knot, piece in zip(table.knots, table.pieces, strict=False):
                at = changes.setdefault(knot, {})
                if table.way == "held":
                    at[places[table.name]] = piece[0]
                    continue
                for power in range(COEFFICIENTS):
                    at[places[coefficient_name(table.name, power)]] = piece[power]
                at[places[knot_name(table.name)]] = knot
        self._knots = sorted(changes)
        self._changes = [changes[knot] for knot in self._knots]
        # what the run took: where each part of the record begins, in time and in the record
        self._begins: list[float] = []
        self._offsets: list[int] = []
        self._held: list[dict[int, float]] = []

    @property
    def taken(self) -> tuple[list[float], list[int], list[dict[int, float]]]:
        """Where the parts of the record begin, in time and in the record, and their inputs."""
        return self._begins, self._offsets, self._held

    @taken.setter
    def taken(self, parts: tuple[list[float], list[int], list[dict[int, float]]]) -> None:
        self._begins, self._offsets, self._held = parts

    def like(self, program: Program) -> Engine:
        """An instance of another program of the model over the same steps."""
        other = Scheduled(program, ())
        other.taken = self.taken
        return other

    def start(self, t: float, tolerance: float, on_indeterminate: str) -> int:
        """Solve the initial values, with the inputs that there are at t."""
        held: dict[int, float] = {}
        for change in self._changes[: bisect_right(self._knots, t)]:
            held |= change
        self._put(held)
        self._begins, self._offsets, self._held = [t], [0], [held]
        return super().start(t, tolerance, on_indeterminate)

    def _put(self, values: Mapping[int, float]) -> None:
        for index, value in values.items():
            self.set_input(index, value)

    def advance(self, t: float, watch: Callable[[float], bool] | None = None) -> Run:
        """Run to time t, from knot to knot; `Refused` where the motion cannot follow."""
        record: array[float] = array("d")
        events: list[RawEvent] = []
        last = self._begins[-1]
        inner = range(bisect_right(self._knots, last), bisect_left(self._knots, t))
        for k in (*inner, -1):
            try:
                # what was set at the last knot takes effect first
                run = super().advance(t if k < 0 else self._knots[k], watch)
            except FrotError as error:
                raise Refused(error, Run(OK, record, events, last)) from None
            record.extend(run.record)
            events += run.events
            last = run.last if run.record else last
            if 8 * len(record) > MOST_MEMORY and run.status == OK and k >= 0:
                return Run(FULL, record, events, last)
            if run.status != OK or run.interrupted or k < 0:
                return Run(run.status, record, events, last, run.interrupted)
            self._put(self._changes[k])
            self._begins.append(self._knots[k])
            self._offsets.append(len(record))
            self._held.append(self._held[-1] | self._changes[k])
        raise AssertionError("the last part returns")

    def values(
        self, record: array[float], times: array[float], step: int | None = None
    ) -> array[float]:
        """All variables at each of the times, with the inputs that there were then."""
        if step is not None:
            self._put(self._held[bisect_right(self._offsets, step) - 1])
            alone = super().values(record, times, step)
            self._put(self._held[-1])
            return alone
        found: array[float] = array("d")
        for k, begin in enumerate(self._begins):
            end = self._begins[k + 1] if k + 1 < len(self._begins) else float("inf")
            inside = slice(
                0 if k == 0 else bisect_left(times, begin),
                bisect_left(times, end) if k + 1 < len(self._begins) else len(times),
            )
            part = times[inside]
            if not len(part):
                continue
            stop = self._offsets[k + 1] if k + 1 < len(self._offsets) else len(record)
            own = record[self._offsets[k] : stop]
            if not len(own):
                continue
            self._put(self._held[k])
            found.extend(super().values(own, part))
        self._put(self._held[-1])
        return found
