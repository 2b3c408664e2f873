"""The result of a run: values on the output grid, values at any time, events, statistics."""

from __future__ import annotations

import io
import json
from array import array
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from frot.dsl.files.writing import DATA, check_target, write_whole
from frot.dsl.messages.errors import FrotError
from frot.runtime.engine import Engine
from frot.runtime.number_arrays import as_floats
from frot.runtime.program import IntegralInfo, Program
from frot.runtime.rounding_lines import rounding_lines
from frot.runtime.run_report import MODES, Balance, Drift, Event, Figures
from frot.runtime.run_values import Values
from frot.runtime.showing import Showing

# Loaded where values are read.
if TYPE_CHECKING:
    from frot.runtime.number_arrays import Floats

MOST_EVENTS = 40
MOST_KEPT = 8
# Rows of a table that are made at once.
_ROWS = 1000
# Relative residual of the energy balance from which a run is not to be trusted.
SUSPICIOUS = 1e-4


class Result(Showing):
    """A run. `result["hoop.position.x"]` and `result.time` are arrays on the output grid, in SI.

    `at(t)[name]` gives values at any time of the run, from the dense output of the steps.
    """

    def __init__(
        self,
        program: Program,
        engine: Engine,
        grid: array[float],
        record: array[float],
        events: tuple[Event, ...],
        figures: Figures,
    ) -> None:
        """Built by `simulate`; `record` is the kernel's, of the segments one after the other."""
        self.program = program
        self.events = events
        self.figures = figures
        self.balance = Balance(*(float(x) for x in engine.energy()))
        self.parameters = {
            p.name: engine.get_parameter(k) for k, p in enumerate(program.parameters)
        }
        self._engine = engine
        self._grid, self._record = grid, record
        self._sampled = engine.values(record, grid)

    @property
    def engine(self) -> Engine:
        """The instance of the kernel as the run left it."""
        return self._engine

    @property
    def grid(self) -> array[float]:
        """The output times."""
        return self._grid

    @property
    def record(self) -> array[float]:
        """The recorded steps, one after the other."""
        return self._record

    @cached_property
    def time(self) -> Floats:
        """The output grid, in s."""
        return as_floats(self._grid)

    @cached_property
    def _values(self) -> Values:
        shape = len(self._grid), len(self.program.variables)
        rows = as_floats(self._sampled).reshape(shape)
        return Values(self.program, rows)

    def __getitem__(self, name: str) -> Floats:
        if name == "time":
            return self.time
        if name in self._values or self.model is None:
            return self._values[name]
        try:
            return self.ask([name])[name]
        except FrotError as error:
            one = error.diagnostics[0]
            if one.code != "E0805":
                raise
            raise KeyError(f"{one.message}; {one.help}" if one.help else one.message) from None

    def __contains__(self, name: object) -> bool:
        """Whether the run lists the variable."""
        return name == "time" or name in self._values

    def __iter__(self) -> Iterator[str]:
        yield "time"
        yield from self._values

    def __len__(self) -> int:
        return len(self._values) + 1

    @property
    def first_integrals(self) -> dict[str, Drift]:
        """First integrals, by their names in the report, with its drift on the output grid.

        Integrals that are known for the default parameters only are left out where these differ.
        """
        return {one.text: self._drift(one) for one in self._kept()}

    def _kept(self) -> list[IntegralInfo]:
        """The first integrals that there are with the parameters of the run."""
        own = all(p.default == self.parameters[p.name] for p in self.program.parameters)
        return [one for one in self.program.first_integrals if one.always or own]

    def _drift(self, one: IntegralInfo) -> Drift:
        import numpy as np

        parts = [self[name] for name in one.variables]
        values = np.sum(parts, axis=0)
        largest = max(float(np.max(np.abs(part))) for part in parts)
        drift = float(np.max(np.abs(values - values[0])))
        return Drift(float(values[0]), drift, largest, one.unit.name)

    def at(self, t: float | Floats) -> Values:
        """Values at time t (s), or at each of an array of times; ValueError outside the run."""
        import numpy as np

        times = np.atleast_1d(np.asarray(t, dtype=np.float64))
        first, last = self.time[0], self.time[-1]
        if times.size and not (np.all(times >= first) and np.all(times <= last)):
            raise ValueError(f"the run goes from {first:.17g} s to {last:.17g} s")
        order = np.argsort(times, kind="stable")
        sampled = np.empty((len(times), len(self.program.variables)))
        sampled[order] = self._engine.rows(self._record, array("d", times[order]))
        return Values(self.program, sampled[0] if np.ndim(t) == 0 else sampled)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        from frot.runtime.kept import keep, revive

        return revive, (type(self), *keep(self))

    def save(self, path: str | Path, *, units: bool = False, explain: bool = False) -> None:
        """Write all variables on the grid to `.csv`, `.json` or `.npz`, whole or not at all.

        `.frotrun` keeps the whole run, which `frot.load_result`, `frot view` and `frot plot` read.
        With `units` the columns of a `.csv` are named as `hoop.position.x (m)`; with `explain` the
        events of a `.json` have what `explain()` adds.
        """
        path = check_target(path, DATA)
        kind = path.suffix.lower()
        writers = {
            ".csv": lambda: self._csv(units),
            ".json": lambda: self._json(explain),
            ".npz": self._npz,
        }
        write_whole(path, writers.get(kind, self._run_file)())

    def _run_file(self) -> Iterator[bytes]:
        from frot.runtime.run_archive import run_file

        yield run_file(self)

    def _csv(self, units: bool) -> Iterator[bytes]:
        modes = {v.name for v in self.program.variables if v.type == "mode"}
        named = {name: self.unit(name) if units and name not in modes else "1" for name in self}
        yield _csv_lines([[x if unit == "1" else f"{x} ({unit})" for x, unit in named.items()]])
        for first in range(0, len(self._grid), _ROWS):
            rows = slice(first, first + _ROWS)
            columns = [
                [MODES[int(x)] for x in self[name][rows]]
                if name in modes
                else [repr(x) for x in self[name][rows].tolist()]
                for name in self
            ]
            yield _csv_lines(zip(*columns, strict=True))

    def _json(self, explain: bool) -> Iterator[bytes]:
        told = self.explain() if explain else self.events
        units = {v.name: v.unit.name for v in self.program.variables}
        content = {
            "model": self.program.name,
            "parameters": self.parameters,
            "units": {"time": "s", **units},
            "modes": list(MODES),
            "variables": _Lists(self),
            "events": [event.as_data() for event in told],
        }
        encoder = json.JSONEncoder(ensure_ascii=False, indent=1)
        for piece in encoder.iterencode(content):
            yield piece.encode("utf-8")
        yield b"\n"

    def _npz(self) -> Iterator[bytes]:
        import numpy as np

        buffer = io.BytesIO()
        np.savez_compressed(buffer, **{name: self[name] for name in self})  # type: ignore[arg-type]
        yield buffer.getvalue()

    def summary(self, *, events: bool = True) -> str:
        """Events, steps, evaluations, wall time and energy balance, in a few lines.

        Of many events the first and the last are shown; `events` holds them all. Of many first
        integrals, the first; `first_integrals` holds them all.
        """
        figures, balance = self.figures, self.balance
        lines = [f"{self.program.name}: {self._grid[0]:.6g} s to {self._grid[-1]:.6g} s"]
        told = [f"  {event.text}" for event in self.events if events]
        if len(told) > MOST_EVENTS:
            half = MOST_EVENTS // 2
            told[half:-half] = [f"  ... {len(told) - 2 * half} more events ..."]
        lines += told
        if events and not self.events:
            lines.append("  no events")
        lines.append(
            f"  {_counted(figures.steps, 'step')} ({figures.rejected} rejected), "
            f"{_counted(figures.evaluations, 'evaluation')}, "
            f"{1e3 * figures.wall_time:.3g} ms in the kernel"
        )
        if figures.free == 0 and self.program.holders:
            held = ", ".join(f"'{name}'" for name in self.program.holders)
            lines.append(f"  nothing can move: the liaisons {held} hold all bodies")
        if figures.crossings:
            lines.append(
                f"  {_counted(figures.crossings, 'passage')} through postures in which the "
                "relations of a loop depend on each other: it goes straight on there"
            )
        if figures.springs:
            lines.append(
                f"  {_counted(figures.springs, 'step')} with redundant contacts that slide "
                f"('{figures.spring}'): their reactions are those of equal springs"
            )
        lines += rounding_lines(figures)
        if figures.unsearched:
            lines.append(
                f"  at {_counted(figures.unsearched, 'instant')} one motion was found; with so "
                "many contacts, others were not looked for"
            )
        kept = [
            f"  kept to {drift.drift:.1e} of {drift.largest:.6g} {drift.unit}: {one.text}"
            for one in self._kept()
            if one.text != "energy"
            for drift in [self._drift(one)]
        ]
        if len(kept) > MOST_KEPT:
            more = len(kept) - MOST_KEPT + 1
            kept[MOST_KEPT - 1 :] = [f"  ... {more} more first integrals in `first_integrals` ..."]
        if not self.program.balanced:
            lines += kept
            if balance.dissipated > 0:
                lines.append(f"  dissipated in friction {balance.dissipated:.6g} J")
            return "\n".join(lines)
        lines.append(
            f"  energy balance: {balance.residual:.2e} J, {balance.relative:.1e} of "
            f"{balance.scale:.6g} J (dissipated {balance.dissipated:.6g} J)"
        )
        lines += kept
        # Where nothing ever moves, all energies are rounding, and so is their balance.
        if balance.relative > SUSPICIOUS and self._moved():
            lines.append(
                "  warning: energy is not kept, do not trust this run; try a smaller tolerance"
            )
        return "\n".join(lines)

    def _moved(self) -> bool:
        kinetic = self.get("energy.kinetic")
        return kinetic is None or bool(kinetic.any())


class _Lists(dict[str, "list[float]"]):
    """The values of a result as lists of numbers, each made as it is read."""

    def __init__(self, result: Result) -> None:
        super().__init__({name: [] for name in result})
        self._result = result

    def items(self) -> Iterator[tuple[str, list[float]]]:  # type: ignore[override]
        return ((name, self._result[name].tolist()) for name in self)


def _csv_lines(rows: Iterable[Iterable[str]]) -> bytes:
    import csv

    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue().encode("utf-8")


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
