"""A run of a compiled program."""

from __future__ import annotations

import math
import time as clock
from array import array
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence

from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.errors import FrotError, fail
from frot.runtime.engine import (
    FULL,
    MOST_EVENTS,
    MOST_MEMORY,
    OK,
    STOPPED,
    TERMINATED,
    VANISHED,
    Engine,
    NoValues,
)
from frot.runtime.library import Fault, RawEvent
from frot.runtime.program import (
    DEFAULT_POINTS,
    DEFAULT_SPAN,
    DEFAULT_TOLERANCE,
    Program,
)
from frot.runtime.result import Result
from frot.runtime.run_report import KINDS, MODES, ROLLING, Event, Figures
from frot.runtime.scheduled import Refused, Scheduled
from frot.runtime.settings import read_option, read_settings
from frot.runtime.tables import Table

# Output times, and the values of all variables at them: 1 GiB.
MOST_POINTS, MOST_VALUES = 10_000_000, 2**27
TOLERANCES = (1e-14, 1e-1)
_NOTED = ("unsearched", "crossings", "blurred", "free", "masked", "lost", "springs")
GOOD = (OK, STOPPED, TERMINATED)
IMPACT, NO_NUMBER, POSTURE, INDEX, NO_NORMAL = 13, 17, 31, 33, 34

CODES = {
    10: "E0401",
    11: "E0601",
    13: "E0905",
    14: "E0902",
    15: "E0902",
    16: "E0903",
    17: "E0904",
    22: "E0907",
    23: "E0906",
    24: "E0908",
    25: "E0908",
    30: "E0909",
    POSTURE: "E0910",
    VANISHED: "E0911",
    INDEX: "E0912",
    NO_NORMAL: "E0911",
}


class SimulationError(FrotError):
    """A run that could not go on. `result` holds the motion up to there, None if there is none."""

    def __init__(self, log: Log, result: Result | None) -> None:
        super().__init__(log)
        self.result = result


class Interrupted(KeyboardInterrupt):
    """Ctrl-C in a run. `result` holds the motion up to there, None if there is none."""

    def __init__(self, reached: float, result: Result | None) -> None:
        super().__init__(f"interrupted at t = {reached:.6g} s")
        self.result = result


def simulate(
    program: Program,
    *,
    stop: float | str | None = None,
    start: float | str | None = None,
    tolerance: float | str | None = None,
    interval: float | str | None = None,
    parameters: Mapping[str, object] | None = None,
    inputs: Mapping[str, object] | None = None,
    watch: Callable[[float], bool] | None = None,
    tables: Sequence[Table] = (),
) -> Result:
    """Run from `start` to `stop` (s); what is None comes from the model's experiment.

    Args:
        program: The compiled model.
        stop: End of the run, in s or as a text with its unit, "2 min".
        start: Begin of the run, likewise.
        tolerance: Local error relative to each state's scale, from 1e-14 to 0.1.
        interval: Distance of the output times, likewise; by default a 500th of the run.
        parameters: Values by name: numbers in SI, or texts with a unit such as "20 deg"; of an
            array all items, `"mu": [0.1, 0.2]`, or single ones, `"mu[2]": 0.2`.
        inputs: Constant values of the inputs, as for `parameters`.
        watch: Called now and then with the time reached; True ends the run there.
        tables: Inputs over time, of a program that has the inputs for them.

    Raises:
        FrotError: Unknown names and bad values (E0805, E0806).
        SimulationError: Values the model cannot have, contradictory initial values, and faults of
            the motion; it holds the result up to the fault.
        Interrupted: Ctrl-C; it holds the result up to there.
    """
    engine, times, begun = _begin(
        program, (stop, start, interval, tolerance), parameters, inputs, tables
    )
    end = times[-1]
    refused: Refused | None = None
    try:
        run = engine.advance(end, watch)
    except Refused as error:
        refused, run, end = error, error.run, engine.time
    wall = clock.perf_counter() - begun
    if run.status == FULL:
        end = run.last
    elif run.status not in GOOD:
        end = min(engine.fault.t, engine.time)
    elif run.status != OK:
        end = engine.time
    reached = end if run.status != OK else max(end, engine.time)
    kept = times[: bisect_left(times, end)]
    whole = run.status == OK and refused is None
    grid = times if whole else kept + array("d", [end])
    counts = engine.statistics
    figures = Figures(
        counts.steps,
        counts.rejected,
        counts.evaluations,
        wall,
        **{name: getattr(counts, name) for name in _NOTED},
        lost_state=engine.state_name(counts.lost_state) if counts.lost > 0 else "",
        spring=engine.program.contacts[counts.spring] if counts.springs else "",
    )
    events = tuple(_event(engine, raw) for raw in run.events if raw.t <= reached)
    result = None
    if run.record:
        try:
            result = Result(program, engine, grid, run.record, events, figures)
        except NoValues as error:
            # Where a run ends in a fault, reactions may have no value, as in a jam.
            before = grid[: bisect_left(grid, error.time)]
            if not len(before):
                raise
            last = _last_value(engine, run.record, before[-1], error.time)
            before += array("d", [last] if last > before[-1] else [])
            result = Result(program, engine, before, run.record, events, figures)
            if run.status in GOOD:
                raise SimulationError(Log(list(error.diagnostics)), result) from None
    if run.interrupted:
        raise Interrupted(end, result)
    if refused is not None:
        raise SimulationError(refused.log, result)
    if run.status == FULL:
        raise _too_long(result, end, len(run.events))
    if run.status not in GOOD or result is None:
        raise fault_of(engine, result)
    return result


def begin(
    program: Program,
    *,
    start: float | str | None = None,
    parameters: Mapping[str, object] | None = None,
    inputs: Mapping[str, object] | None = None,
    tables: Sequence[Table] = (),
    tolerance: float | str | None = None,
    tolerated: Sequence[int] = (),
) -> Engine:
    """An instance at the start of its run, before the first step; raises as `simulate`.

    Not where the start ends in a status that is `tolerated`.
    """
    options = (None, start, None, tolerance)
    return _begin(program, options, parameters, inputs, tables, False, tolerated)[0]


def _begin(
    program: Program,
    options: tuple[float | str | None, ...],
    parameters: Mapping[str, object] | None,
    inputs: Mapping[str, object] | None,
    tables: Sequence[Table],
    whole: bool = True,
    tolerated: Sequence[int] = (),
) -> tuple[Engine, array[float], float]:
    """An instance at its start, the output times, and when the kernel's work began.

    `options` are stop, start, interval and tolerance; `whole` where the tables are to last.
    A start that ends in a status of `tolerated` is none that raises.
    """
    stop, start = (read_option(name, options[k], "s") for k, name in enumerate(("stop", "start")))
    interval = read_option("interval", options[2], "s")
    tolerance = read_option("tolerance", options[3], "1")
    engine = Scheduled(program, tables) if tables else Engine(program)
    for name, value in read_settings(parameters, program.parameters, "parameter", program):
        engine.set_parameter(name, value)
    for name, value in read_settings(inputs, program.inputs, "input", program):
        engine.set_input(name, value)
    status, experiment = engine.settle_parameters()
    if status != OK:
        raise fault_of(engine, None)
    begin, end, asked = span_of(start, stop, tolerance, experiment)
    for table in tables:
        table.check(begin, end if whole else begin)
    distance = _choose(interval, experiment[3], (end - begin) / DEFAULT_POINTS)
    times = _grid(begin, end, distance, len(program.variables))
    begun = clock.perf_counter()
    started = engine.start(begin, asked, program.experiment.on_indeterminate)
    if started != OK and started not in tolerated:
        raise fault_of(engine, None)
    return engine, times, begun


def span_of(
    start: float | None, stop: float | None, tolerance: float | None, experiment: Sequence[float]
) -> tuple[float, float, float]:
    """Begin, end and tolerance of a run; FrotError (E0806) for those that cannot be.

    `experiment` has start, stop and tolerance of the text, NaN where it is silent.
    """
    begin = _choose(start, experiment[0], 0.0)
    end = _choose(stop, experiment[1], begin + DEFAULT_SPAN)
    asked = _choose(tolerance, experiment[2], DEFAULT_TOLERANCE)
    if not (math.isfinite(begin) and math.isfinite(end) and end > begin):
        raise fail(
            "E0806",
            f"the run cannot go from {begin:g} s to {end:g} s",
            help="choose a stop time after the start time",
        )
    if not TOLERANCES[0] <= asked <= TOLERANCES[1]:
        raise fail(
            "E0806",
            f"the tolerance {asked:g} is out of range",
            help=f"choose one from {TOLERANCES[0]:g} to {TOLERANCES[1]:g}",
        )
    return begin, end, asked


def _last_value(engine: Engine, record: array[float], there: float, lost: float) -> float:
    """The last instant found to have values, between one that has them and one that has none."""
    middle = there + (lost - there) / 2
    while there < middle < lost:
        try:
            engine.values(record, array("d", [middle]))
            there = middle
        except NoValues:
            lost = middle
        middle = there + (lost - there) / 2
    return there


def _too_long(result: Result | None, reached: float, events: int) -> SimulationError:
    log = Log()
    if events > MOST_EVENTS:
        text = f"the run has more than {MOST_EVENTS} events up to t = {reached:.6g} s"
        remedy = "choose an earlier stop time, sample less often, or let the text end the run"
    else:
        text = f"the steps up to t = {reached:.6g} s take more than {MOST_MEMORY / 2**30:g} GiB"
        remedy = "choose an earlier stop time or a larger tolerance"
    log.report("E0901", text, None, help=remedy)
    return SimulationError(log, result)


def _choose(given: float | None, modelled: float, default: float) -> float:
    if given is not None:
        return float(given)
    return default if math.isnan(modelled) else float(modelled)


def _grid(begin: float, end: float, interval: float, variables: int) -> array[float]:
    """Times begin + k interval below `end`, and `end`; the default interval is always taken."""
    if not (math.isfinite(interval) and interval > 0):
        raise fail(
            "E0806",
            f"the interval {interval:g} s is not positive",
            help="leave it out, or choose the distance of the output times in s",
        )
    count = (end - begin) / interval
    most = max(min(MOST_POINTS, MOST_VALUES // max(variables, 1)), DEFAULT_POINTS)
    if count * (1 - 1e-12) > most:
        least = _rounded_up((end - begin) / most)
        raise fail(
            "E0806",
            f"an interval of {interval:g} s gives {count:.3g} output times of {variables} "
            f"variables; at most {most} can be kept",
            help=f"choose an interval of {least} s or more; `result.at` of Python gives values "
            "between output times",
        )
    times = array("d", (begin + k * interval for k in range(round(count * (1 + 1e-12)) + 1)))
    near = 1e-9 * interval
    return times[: bisect_left(times, end - near)] + array("d", [end])


def _rounded_up(value: float) -> str:
    """A positive number of two digits, no smaller than the value."""
    shown = f"{value:.1e}"
    if float(shown) < value:
        unit = 10.0 ** (int(shown.partition("e")[2]) - 1)
        shown = f"{value + unit:.1e}"
    return f"{float(shown):g}"


def _event(engine: Engine, raw: RawEvent) -> Event:
    kind = KINDS[raw.kind]
    names: tuple[str, ...]
    if kind in ("warning", "terminate"):
        return Event(raw.t, kind, "", "", "", engine.event_text(raw))
    if kind == "percussion":
        text, vector = (
            engine.event_text(raw),
            tuple(raw.vector)[: 2 if engine.program.planar else 3],
        )
        name = text.split("'")[1]  # percussion 'kick' at t = ...
        return Event(raw.t, kind, name, "", "", text, raw.impulse, raw.lost, vector=vector)
    if kind == "condition":
        names = ("false", "true")
        liaison = engine.program.conditions[raw.contact]
    else:
        names = ROLLING if kind.startswith("roll_") else MODES
        liaison = engine.program.contacts[raw.contact]
    changed = raw.t, kind, liaison, names[raw.before], names[raw.after], engine.event_text(raw)
    if not kind.endswith("impact"):
        return Event(*changed, element=raw.element - 1)
    until = raw.until if kind == "last_impact" else None
    return Event(*changed, raw.impulse, raw.lost, raw.together, raw.solutions, until)


def fault_of(engine: Engine, result: Result | None) -> SimulationError:
    """The last fault of an instance, with the motion up to it."""
    log = Log()
    places = engine.fault_places
    log.report(
        CODES.get(engine.fault.status, "E0901"),
        engine.fault_text,
        None,
        notes=tuple(f"at {place}" for place in places),
        help=_help(engine.fault),
    )
    return SimulationError(log, result)


def _help(fault: Fault) -> str:
    """The remedy: where no step has been taken, to say which way, or to begin elsewhere."""
    if fault.status == IMPACT and fault.item >= 0:
        return _SECOND
    if fault.status == NO_NUMBER and fault.other >= 0:
        return _NO_SLOPE
    if fault.status != POSTURE or fault.value != 0:
        return _HELP.get(fault.status, "")
    return _SAY_WHICH if fault.other >= 0 else _BEGIN_BESIDE


# Unknowns without a `start` are looked for from 0 on, where a root has no slope.
_NO_SLOPE = (
    "give the unknown a start where the equation and its slope have numbers, as "
    "`Real x(start = 1)`, correct the expression, or keep the motion away from there"
)

# Nobody looks for a second place of what cannot part: that is no remedy.
_SECOND = "stop before that time, or let the bodies touch there by a liaison of its own"

_BEGIN_BESIDE = (
    "begin beside that posture: state a place a little before it, or beyond it on the way that "
    "the loop is to go"
)

_SAY_WHICH = (
    "state that speed, or guess it: the motion that misses the guesses by far less is taken; "
    "or begin beside that posture"
)

_HELP = {
    10: "give the parameter it comes from another value",
    11: "make statements, lengths and places agree, or leave a statement out",
    IMPACT: "change a coefficient of friction or restitution, or stop before that time",
    14: "choose a smaller coefficient of friction, or leave `on_impasse = stop` out where it is "
    "written; the result holds the motion up to there",
    15: "write `on_indeterminate = rest`, `continue` or `impact` to go on with one of them",
    16: "look at what switches at that time; change a coefficient or the starting values a little",
    NO_NUMBER: "correct the expression, or keep the motion away from there",
    18: "look at what is named: at a denominator, a root or a logarithm that comes to zero, at "
    "growth without limit, at a load that jams a liaison, or at drives that contradict each other",
    22: "give start values near the solution, or keep the motion away from there",
    23: "look at what leads there, or weaken the assertion",
    30: "write the event so that it says one thing",
    POSTURE: "give it more speed there, or keep it away from there by a stop or by other lengths",
    VANISHED: "state or guess another place, keep the motion away from there, or give the figure "
    "another form; what touches along a line is a `lineaire_rectiligne`, a `roulement` of parallel "
    "cylinders, or a model of the plane",
    NO_NORMAL: "write `appui_faces` of faces, a `cylinder` with a small radius in the place of a "
    "rod, a `contact_ponctuel` of both rims, or let them meet at an angle",
    INDEX: "write in that branch the derivative of what it says, as `der(y) = der(x)` in the place "
    "of `y = x`, and let the values agree where it is entered",
    19: "give every body a mass and an inertia of a usual size",
    20: "leave friction out of some of the liaisons that act on each other",
}
