"""An instance of a compiled model in the C kernel: its state, its runs, its values."""

from __future__ import annotations

import contextlib
import ctypes as ct
import math
import signal
import threading
from array import array
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.errors import FrotError, fail
from frot.runtime.library import (
    Drain,
    Fault,
    Monitor,
    MotionsFound,
    Options,
    RawEvent,
    Recorder,
    Statistics,
    load,
)
from frot.runtime.number_arrays import address, as_floats, joined, zeros
from frot.runtime.program import Program

if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

OK, FULL, STOPPED, TERMINATED = 0, 1, 2, 3
NAN, ALGEBRAIC, VANISHED, INDEX = 17, 22, 32, 33
# A change of parameters or inputs that was taken back, and the message that tells it.
REFUSALS = {10: "E0401", 24: "E0908"}
INDETERMINATE = {"rest": 0, "continue": 1, "stop": 2, "impact": 3}
IMPASSE = {"impact": 0, "stop": 1}
_TEXT = 1024
# Doubles of the first and of the longest chunk of recorded steps: pages that the system must give
# first cost more than a short run; in a recorded step, the place of the time at which it begins.
_CHUNK, _LARGEST_CHUNK = 2**13, 2**24
_BEGIN = 3
# Events that the first chunk has room for.
_EVENTS = 2**8
# Bytes of recorded steps after which a run is reported as too long.
MOST_MEMORY = 2**30
# Events of a run.
MOST_EVENTS = 1_000_000


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """The result of a call of `Engine.advance`.

    The kernel's status, the segments one after the other as the kernel records them, the events,
    and the time at which the last segment begins. Status FULL: the steps take more than
    MOST_MEMORY, there are more than MOST_EVENTS, or Ctrl-C came as those of a call had no more
    room; the run has not come to its end. Status STOPPED: by `watch`, or by Ctrl-C. After Ctrl-C
    `interrupted`.
    """

    status: int
    record: array[float]
    events: list[RawEvent]
    last: float
    interrupted: bool = False

    @property
    def segments(self) -> Floats:
        """The record as an array of numpy."""
        return as_floats(self.record)


@contextlib.contextmanager
def interrupts_noted(noted: list[BaseException]) -> Iterator[None]:
    """Ctrl-C is noted instead of raised, for an exception cannot pass through C."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, lambda *_: noted.append(KeyboardInterrupt()))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


class NoValues(FrotError):
    """Variables of a run have no value at a given time: `time`, in s."""

    def __init__(self, log: Log, time: float) -> None:
        super().__init__(log)
        self.time = time


class Engine:
    """One instance of a compiled model."""

    def __init__(self, program: Program) -> None:
        """Load the library and clear a new state."""
        self.program = program
        self._library = load(str(program.library))
        self._model = ct.addressof(ct.c_char.in_dll(self._library, "frot_the_model"))
        self._state = zeros(-(-self._library.frot_state_size(self._model) // 8))
        self._work = zeros(-(-self._library.frot_work_size(self._model) // 8) + 1)
        self.segment_size = int(self._library.frot_segment_size(self._model))
        self._library.frot_state_clear(self._model, self._s)

    @property
    def _s(self) -> int:
        return address(self._state)

    @property
    def _w(self) -> int:
        return address(self._work)

    def save(self) -> bytes:
        """A copy of the whole instance."""
        return self._state.tobytes()

    def restore(self, saved: bytes) -> None:
        """Put a copy made by `save` back."""
        memoryview(self._state).cast("B")[:] = saved

    def like(self, program: Program) -> Engine:
        """An instance of another program of the model, for the same steps."""
        return Engine(program)

    def is_like(self, other: Engine) -> bool:
        """Whether the states and recorded steps of both have the same places for the same things.

        Their programs list other variables, and are of one model.
        """
        own, its = self.program, other.program
        return (
            len(self._state) == len(other._state)
            and self.segment_size == other.segment_size
            and own.contacts == its.contacts
            and own.conditions == its.conditions
        )

    def set_parameter(self, index: int, value: float) -> None:
        """Set a parameter, in SI; takes effect at the next start or settle."""
        self._library.frot_set_parameter(self._model, self._s, index, value)

    def get_parameter(self, index: int) -> float:
        """Value of a parameter, in SI."""
        return float(self._library.frot_get_parameter(self._model, self._s, index))

    def set_input(self, index: int, value: float) -> None:
        """Set an input, in SI."""
        self._library.frot_set_input(self._model, self._s, index, value)

    def settle_parameters(self) -> tuple[int, array[float]]:
        """Status, and start, stop, tolerance, interval of the experiment (NaN where silent)."""
        experiment = array("d", [math.nan]) * 4
        status = self._library.frot_settle_parameters(
            self._model, self._s, self._w, address(experiment)
        )
        return int(status), experiment

    def start(self, t: float, tolerance: float, on_indeterminate: str) -> int:
        """Solve the initial values; `tolerance` 0 takes the model's own."""
        impasse = IMPASSE[self.program.experiment.on_impasse]
        options = Options(tolerance, INDETERMINATE[on_indeterminate], impasse)
        return int(self._library.frot_start(self._model, self._s, self._w, t, ct.byref(options)))

    def settle(self) -> int:
        """Let changed parameters and inputs take effect at the time reached.

        Raises:
            FrotError: The change cannot be made (E0401, E0908); the old values stay.
        """
        return self._unless_refused(int(self._library.frot_settle(self._model, self._s, self._w)))

    def _unless_refused(self, status: int) -> int:
        """The status of a call in a run, unless a change was taken back."""
        if status in REFUSALS:
            raise fail(
                REFUSALS[status],
                self.fault_text,
                notes=tuple(f"at {place}" for place in self.fault_places),
                help="the run can go on with the old values; make the change before the start",
            )
        return status

    def advance(self, t: float, watch: Callable[[float], bool] | None = None) -> Run:
        """Run to time t. `watch(time)` is called now and then; True stops the run.

        Ctrl-C stops it too, and what `watch` raises is raised.
        """
        events: list[RawEvent] = []
        chunks: list[array[float]] = []
        interrupted: list[BaseException] = []

        def monitor(_: int, time: float) -> int:
            try:
                return int(bool(interrupted) or (watch is not None and watch(time)))
            except BaseException as error:  # nothing may pass through C
                interrupted.append(error)
                return 1

        callback = Monitor(monitor)
        with interrupts_noted(interrupted):
            return self._advance(t, callback, chunks, events, interrupted)

    def _advance(
        self,
        t: float,
        callback: object,
        chunks: list[array[float]],
        events: list[RawEvent],
        interrupted: list[BaseException],
    ) -> Run:
        capacity, room, last = _CHUNK, _EVENTS, 0.0

        def take(full: Recorder) -> None:
            held = (full.events[i] for i in range(full.event_count))
            events.extend(RawEvent.from_buffer_copy(event) for event in held)
            full.event_count = 0

        drain = Drain(lambda full, _: take(full.contents))
        while True:
            buffer = zeros(max(capacity, self.segment_size))
            raw = (RawEvent * (room + self._library.frot_events_at_once(self._model)))()
            recorder = Recorder(address(buffer), len(buffer), 0, raw, len(raw), 0)
            recorder.drain = ct.cast(drain, ct.c_void_p)
            status = self._unless_refused(
                int(
                    self._library.frot_advance(
                        self._model, self._s, self._w, t, ct.byref(recorder), callback, None
                    )
                )
            )
            if recorder.segment_used:
                last = buffer[recorder.last + _BEGIN]
                del buffer[recorder.segment_used :]
                chunks.append(buffer)
            drained = recorder.event_count > room
            take(recorder)
            if any(not isinstance(error, KeyboardInterrupt) for error in interrupted):
                raise interrupted[0]
            if interrupted:
                # where there was no more room too, the run is told up to its last segment
                told = FULL if status == FULL else STOPPED
                return Run(told, joined(chunks), events, last, True)
            taken = 8 * sum(len(chunk) for chunk in chunks)
            if status != FULL or taken > MOST_MEMORY or len(events) > MOST_EVENTS:
                return Run(status, joined(chunks), events, last)
            # only what was short is given more: zeros that nobody fills take time too
            if drained:
                room *= 2
            else:
                capacity = min(2 * capacity, _LARGEST_CHUNK)

    def finish(self, t: float, callback: object) -> int:
        """Run to time t and record nothing: the status. `callback` is a `Monitor`."""
        status = self._library.frot_advance(self._model, self._s, self._w, t, None, callback, None)
        return int(status)

    def values(
        self, record: array[float], times: array[float], step: int | None = None
    ) -> array[float]:
        """All variables at each of the times, over segments in order; times in ascending order.

        With `step` in the segment alone that begins at this place of the record: where it ends
        these are the values before the events there.

        Raises:
            FrotError: A variable has no finite value (E0904).
        """
        found = array("d", [math.nan]) * (len(times) * len(self.program.variables))
        status = self._library.frot_sample(
            self._model,
            self._s,
            self._w,
            address(record) + record.itemsize * (step or 0),
            len(record) if step is None else int(record[step]),
            address(times),
            len(times),
            address(found),
        )
        if status != OK:
            raise self._no_value(found, times, status)
        return found

    def sample(self, segments: array[float] | Floats, times: Iterable[float]) -> Floats:
        """The same of segments that are held otherwise, and copied."""
        record: array[float] = array("d", segments.tobytes())
        return self.rows(record, array("d", times))

    def rows(self, record: array[float], times: array[float]) -> Floats:
        """The values as an array of numpy, times x variables."""
        found = as_floats(self.values(record, times))
        return found.reshape(len(times), len(self.program.variables))

    def _no_value(self, values: array[float], times: array[float], status: int) -> Exception:
        """The error of a sample that gave no numbers: the first variable without one is named."""
        log = Log()
        width = len(self.program.variables)
        lost = next((k for k, value in enumerate(values) if not math.isfinite(value)), 0)
        row, column = divmod(lost, width)
        places = tuple(f"at {place}" for place in self.fault_places)
        if status == VANISHED:
            log.report("E0911", self.fault_text, None, notes=places)
            return NoValues(log, times[row])
        codes = {NAN: "E0904", ALGEBRAIC: "E0907", INDEX: "E0912"}
        code = codes.get(self.fault.status)
        if places and code is not None and self.fault.t == times[row]:
            remedy = "correct the expression, or keep the motion away from there"
            log.report(code, self.fault_text, None, notes=places, help=remedy)
            return NoValues(log, times[row])
        what = f"variable '{self.program.variables[column].name}' has no finite value"
        if all(math.isnan(value) for value in values[row * width : (row + 1) * width]):
            what = "a force, a coefficient or an equation gives no finite number"
        what += f" at t = {times[row]:.17g}"
        remedy = "look for a division by zero, a root or a logarithm of a negative value"
        log.report("E0904", what, None, help=remedy)
        return NoValues(log, times[row])

    def now(self) -> array[float]:
        """All variables at the time reached; NaN where they have no value."""
        found = array("d", [math.nan]) * len(self.program.variables)
        self._library.frot_values(self._model, self._s, self._w, address(found))
        return found

    def motions(self, nodes: int) -> tuple[int, MotionsFound, array[float]]:
        """Status, the motions at the time reached, and the memory that they lie in."""
        memory = zeros(-(-self._library.frot_motions_size(self._model) // 8) + 2)
        found = MotionsFound()
        status = self._library.frot_motions(
            self._model, self._s, self._w, address(memory), nodes, ct.byref(found)
        )
        return int(status), found, memory

    def laws(self) -> tuple[tuple[str, int, int, int], ...]:
        """Of each element of friction its liaison, kind (frot_law_kind), part, and of how many."""
        found = []
        for k in range(self._library.frot_element_count(self._model)):
            contact, part, parts = ct.c_int(), ct.c_int(), ct.c_int()
            places = (ct.byref(x) for x in (contact, part, parts))
            kind = self._library.frot_law_of_element(self._model, k, *places)
            found.append((self.program.contacts[contact.value], int(kind), part.value, parts.value))
        return tuple(found)

    def energy(self) -> array[float]:
        """Residual of the balance, energy scale, mechanical energy, dissipated, work."""
        balance = zeros(5)
        self._library.frot_energy(self._model, self._s, self._w, address(balance))
        return balance

    @property
    def time(self) -> float:
        """The time reached."""
        return float(self._library.frot_time(self._s))

    @property
    def fault(self) -> Fault:
        """The last fault."""
        return Fault.from_buffer_copy(self._library.frot_last_fault(self._s).contents)

    @property
    def fault_text(self) -> str:
        """The last fault in a sentence."""
        return self._words(self._library.frot_fault_text)

    @property
    def fault_places(self) -> tuple[str, ...]:
        """`file:line:column` of what the last fault is about."""
        told = self._words(self._library.frot_fault_places).split("\n")
        return tuple(self.program.place(place) for place in told if place)

    def _words(self, function: Callable[..., None]) -> str:
        text = ct.create_string_buffer(_TEXT)
        function(self._model, self._s, text, _TEXT)
        return text.value.decode("utf-8", "replace")

    def event_text(self, event: RawEvent) -> str:
        """An event in words."""
        text = ct.create_string_buffer(_TEXT)
        self._library.frot_event_text(self._model, ct.byref(event), text, _TEXT)
        return text.value.decode("utf-8", "replace")

    @property
    def statistics(self) -> Statistics:
        """Counts of the run so far."""
        return Statistics.from_buffer_copy(self._library.frot_run_statistics(self._s).contents)

    def state_name(self, state: int) -> str:
        """Name of a state; "" where it is not known."""
        return str(self._library.frot_state_name(self._model, state).decode("utf-8"))
