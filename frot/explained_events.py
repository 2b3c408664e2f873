"""Events of a run with their reasons, and how they are printed."""

from __future__ import annotations

import re
import textwrap
from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import FrotError, fail
from frot.runtime.event_reasons import motion_of, reason_of
from frot.runtime.event_values import (
    FAINT,
    ContactValues,
    Instant,
    LawValues,
    Quantity,
    Side,
    direction_of,
)
from frot.runtime.listed_motions import KINDS as LAW_KINDS
from frot.runtime.run_report import Event

if TYPE_CHECKING:
    from frot.runtime.program import VariableInfo
    from frot.runtime.result import Result
    from frot.runtime.run_values import RunValues

# Parts of a time by which instants may differ and be one.
_SAME = 1e-12
# In a recorded step, the places of its length and of the time at which it begins.
_LENGTH, _BEGIN = 0, 3
# The farthest step before an event that is read, by doubling distances.
_FARTHEST = 512
_FORMULA = re.compile(r"(mu|delta)(_s)?( r)? (N|\|R\||\([^)]*\)) = ")
_INDENT, _NO_BREAK = 6 * " ", "\u00a0"


@dataclass(frozen=True, slots=True)
class ExplainedEvent(Event):
    """An event with the `direction` of its slip and its `reason` in words.

    `direction` of the slip that begins, ends or continues: in space a unit vector in ground axes,
    in the plane (+1,) or (-1,); of two components without an axis of space (along a `verrou` and
    around it) a unit vector of these; () where nothing slips. `motion` is `slip`, or `rolling`,
    `pivoting`, `turning`, whose direction is that of the relative angular velocity.
    """

    direction: tuple[float, ...] = ()
    motion: str = ""
    reason: str = ""

    def as_data(self) -> dict[str, Any]:
        """For JSON."""
        own = {"direction": list(self.direction), "motion": self.motion, "reason": self.reason}
        return {**Event.as_data(self), **own}

    @property
    def words(self) -> str:
        """The reason after the direction, as "slip along (0.6, 0.8, 0): the slip reaches zero"."""
        if not self.direction:
            return self.reason
        if len(self.direction) == 1:
            way = "+" if self.direction[0] > 0 else "-"
        elif len(self.direction) == 2:
            way = "({:.4g} along, {:.4g} around)".format(*(round(x, 4) for x in self.direction))
        else:
            parts = ", ".join(f"{round(x, 4) + 0.0:g}" for x in self.direction)
            way = f"{'along' if self.motion == 'slip' else 'about'} ({parts})"
        return f"{self.motion} {way}: {self.reason}"


def explain_events(result: RunValues, events: Sequence[Event]) -> tuple[ExplainedEvent, ...]:
    """The events, some of those of the result, with directions and reasons.

    Their numbers are those of the recorded steps before and after the instant. FrotError (E0805)
    where the model of the result is not known.
    """
    if not events:
        return ()
    reader = _Reader(result)
    return tuple(_explained(reader, event) for event in events)


def _explained(reader: _Reader, event: Event) -> ExplainedEvent:
    instant = reader.instant(event)
    kept = {one.name: getattr(event, one.name) for one in fields(Event)}
    direction = direction_of(instant)
    motion = motion_of(instant) if direction else ""
    return ExplainedEvent(**kept, direction=direction, motion=motion, reason=reason_of(instant))


class _Reader:
    """Reads what decides events off the recorded steps of a run, by a second program."""

    def __init__(self, result: RunValues) -> None:
        from frot.compiler.lowering.event_variables import PREFIX, event_variables
        from frot.second import Second, second_program

        if result.model is None:
            raise fail(
                "E0805",
                f"the text of the model '{result.program.name}' is not known",
                help="explain results of `model.simulate(...)`, which know their model",
            )
        program = second_program(result.model, "explain", event_variables, result.moving)
        self._second = Second(result, program)
        self._result, self._laws = result, result.engine.laws()
        # of each law and contact its quantities, each with the columns of its parts
        self._columns: dict[tuple[str, int], dict[str, list[tuple[int, VariableInfo]]]] = {}
        for k, v in enumerate(program.variables):
            if v.name.startswith(PREFIX):
                what, place, name = v.name[len(PREFIX) :].split(":")
                own = self._columns.setdefault((what, int(place)), {})
                own.setdefault(re.split(r"[.[]", name)[0], []).append((k, v))
        self._listed = {v.name: (k, v.unit.name) for k, v in enumerate(program.variables)}
        self._steps = _steps_of(result.record)
        self._times = [result.record[at + _BEGIN] for at in self._steps]
        self._events = sorted(result.events, key=lambda x: x.time)
        self._event_times = [x.time for x in self._events]
        self._limits = [(x, x.until) for x in self._events if x.until is not None]

    def instant(self, event: Event) -> Instant:
        """The event with its values."""
        t = event.time
        near = _SAME * max(abs(t), 1e-300)
        k, law = bisect_left(self._times, t - near), self._law_of(event)
        last = bisect_right(self._times, t + near) - 1
        read = partial(self._side, law, event.liaison)
        after = self._values(last, t) if last >= k else None
        earlier = [read(self._values(i, self._times[i])) for i in _back_from(k)]
        first, end = (find(self._event_times, x) for find, x in (
            (bisect_left, t - near), (bisect_right, t + near)))  # fmt: skip
        return Instant(
            event,
            before=read(self._values(k - 1, t)) if k else None,
            after=read(after),
            earlier=tuple(x for x in earlier if x is not None),
            approach=self._approach(read, k, [x for x in earlier if x is not None]),
            others=tuple(x for x in self._events[first:end] if x is not event),
            ended=tuple(
                x
                for x, until in self._limits
                if x.liaison == event.liaison and abs(until - t) <= near
            ),
            variables={} if after is None else self._variables(after),
            on_indeterminate=self._result.program.experiment.on_indeterminate,
        )

    def _approach(
        self, read: Callable[[array[float] | None], Side | None], k: int, earlier: Sequence[Side]
    ) -> Side | None:
        """The last begin of a step before the k-th at which the slip is more than rounding."""
        largest = max((x.law.slip.size for x in earlier if x.law is not None), default=0.0)
        if largest == 0.0:
            return None
        for i in range(k - 1, max(k - _FARTHEST, 0) - 1, -1):
            side = read(self._values(i, self._times[i]))
            if side is not None and side.law and side.law.slip.size >= FAINT * largest:
                return side
        return None

    def _values(self, step: int, time: float) -> array[float] | None:
        """The variables in a step; None where they have no values, as in a jam."""
        try:
            return self._second.in_step(self._steps[step], time)
        except FrotError:
            return None

    def _variables(self, values: array[float]) -> Mapping[str, Quantity]:
        return {x: Quantity((values[k],), unit) for x, (k, unit) in self._listed.items()}

    def _law_of(self, event: Event) -> int:
        """The place of the law that changes, else of the first that opposes a slip there."""
        if event.element >= 0:
            return event.element
        own = (
            k
            for k, (liaison, kind, part, _) in enumerate(self._laws)
            if liaison == event.liaison and part == 0 and LAW_KINDS[kind] in ("slide", "turn")
        )
        return next(own, -1)

    def _side(self, law: int, liaison: str, values: array[float] | None) -> Side | None:
        """The law and the contact of an event, as values say."""
        if values is None:
            return None
        names = self._result.program.contacts
        contact = names.index(liaison) if liaison in names else -1
        found = {}
        for what, place in (("law", law), ("contact", contact)):
            for name, columns in self._columns.get((what, place), {}).items():
                first = columns[0]
                parts = tuple(values[k] for k, _ in columns)
                found[what, name] = Quantity(parts, first[1].unit.name, first[1].doc)
        of_law = [found.get(("law", x)) for x in ("slip", "friction", "limit", "limit_s")]
        of_contact = [found.get(("contact", x)) for x in ("speed", "reaction")]
        return Side(
            LawValues(LAW_KINDS[self._laws[law][1]], *of_law) if all(of_law) else None,  # type: ignore[arg-type]
            ContactValues(*of_contact) if all(of_contact) else None,  # type: ignore[arg-type]
        )


def _back_from(k: int) -> Iterator[int]:
    """Steps before the k-th: the last one, then ever farther ones."""
    distance = 1
    while distance <= min(k, _FARTHEST):
        yield k - distance
        distance *= 2


def _steps_of(record: array[float]) -> list[int]:
    """Where the recorded steps begin."""
    found, at = [], 0
    while at < len(record):
        found.append(at)
        at += int(record[at + _LENGTH])
    return found


def explain_run(result: Result) -> None:
    """Print the events of a run with their reasons, those that its summary shows."""
    from frot.progress import Busy
    from frot.runtime.result import MOST_EVENTS

    events, half = result.events, MOST_EVENTS // 2
    shown = events if len(events) <= MOST_EVENTS else (*events[:half], *events[-half:])
    with Busy("explaining the events"):
        explained = result.explain(shown)
    print_events(explained, len(events) - len(shown))


def print_events(events: Sequence[ExplainedEvent], left_out: int = 0) -> None:
    """Print events with their reasons as wide as the terminal.

    `left_out`: of the run, between the first and the second half of these.
    """
    from rich.console import Console
    from rich.text import Text

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
    if not events:
        console.print("  no events to explain")
    for k, event in enumerate(events):
        if left_out and 2 * k == len(events):
            console.print(f"  ... {left_out} more events ...")
        console.print(Text(f"  {event.text}", style="bold"))
        for line in _wrapped(event.words, console.width):
            console.print(line)


def _wrapped(words: str, width: int) -> list[str]:
    """Indented lines; a number and its unit are not parted, nor a formula and its value."""
    joined = re.sub(r"(?<=\d) (?=[^\W\d])", _NO_BREAK, words)
    joined = _FORMULA.sub(lambda found: found.group().replace(" ", _NO_BREAK), joined)
    lines = textwrap.wrap(
        joined,
        width,
        initial_indent=_INDENT,
        subsequent_indent=_INDENT,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line.replace(_NO_BREAK, " ") for line in lines]
