"""Many runs of a model: a row for each combination of parameters, on all cores or on a cluster.

A row has the parameters, the values read at the end of its run, and `error`, empty where the run
was good. What has been done is in the file, so that a sweep that was stopped continues.
"""

from __future__ import annotations

import csv
import itertools
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import FrotError, fail

if TYPE_CHECKING:
    from frot.model import Model
    from frot.runtime.program import Program

FORMATS = (".csv", ".parquet")
MOST_RUNS = 10_000_000
BATCH = 64  # runs that a process is given at once
Row = dict[str, object]


def values_of(text: str) -> list[str]:
    """`0:0.5:0.01` as its values, both ends in it, or `1 kg,2 kg` as they are."""
    parts = text.split(":")
    if len(parts) != 3:
        from frot.options import names

        return names(text)
    try:
        first, last, step = (float(x) for x in parts)
        count = (last - first) / step
    except (ValueError, ZeroDivisionError):
        count = math.nan
    if not (math.isfinite(count) and count >= 0):
        raise fail("E0806", f"'{text}' is no range", help="write FIRST:LAST:STEP, as 0:0.5:0.01")
    if count > MOST_RUNS:
        raise fail("E0806", f"'{text}' has {count:.3g} values", help=f"at most {MOST_RUNS}")
    return [repr(first + k * step) for k in range(round(count * (1 + 1e-12)) + 1)]


def combinations(given: Mapping[str, Sequence[object]]) -> list[Row]:
    """A row of parameters for each combination; the last name changes fastest."""
    count = math.prod(len(values) for values in given.values())
    if count > MOST_RUNS:
        raise fail("E0806", f"a sweep of {count} runs is too long", help=f"at most {MOST_RUNS}")
    return [dict(zip(given, values, strict=True)) for values in itertools.product(*given.values())]


def run_rows(
    program: Program, rows: Iterable[Row], read: Sequence[str], options: Mapping[str, Any]
) -> list[Row]:
    """The rows with what was read at the end of each run; failures are rows too."""
    from frot.runtime.run import SimulationError, last_values

    found = []
    for row in rows:
        values: dict[str, object] = dict.fromkeys(read, math.nan)
        error = ""
        try:
            values |= last_values(program, read, parameters=row, **options)
        except SimulationError as told:
            error = told.diagnostics[0].message
        found.append({**row, **values, "error": error})
    return found


def sweep(
    model: Model,
    given: Mapping[str, Sequence[object]],
    read: Sequence[str],
    *,
    dask: str = "",
    processes: int | None = None,
    done: Sequence[Row] = (),
    watch: Callable[[int, int], None] | None = None,
    **options: Any,
) -> Iterator[Row]:
    """The rows of a sweep in their order, as they are done.

    Args:
        model: The model.
        given: Values of each parameter.
        read: Variables, whose values at the end of the run are read.
        dask: Address of a scheduler of Dask, which takes the place of this machine's cores.
        processes: How many work here; by default one for each core.
        done: Rows of a sweep that was stopped, which are not run again.
        watch: Called with the number of rows done, and that of all.
        options: Those of `simulate`.

    Raises:
        FrotError: E0805, E0806: unknown parameters and variables; E0820: Dask is not installed.
    """
    program = model.program()
    rows = combinations(given)
    _check(program, rows, read)
    rows = rows[len(done) :]
    whole, count = len(rows) + len(done), len(done)
    batches = [rows[k : k + BATCH] for k in range(0, len(rows), BATCH)]
    work = (
        _by_dask(dask, program, batches, read, options)
        if dask
        else _here(program, batches, read, options, processes)
    )
    for batch in work:
        yield from batch
        count += len(batch)
        if watch is not None:
            watch(count, whole)


def _check(program: Program, rows: Sequence[Row], read: Sequence[str]) -> None:
    """Names and values of the first row, before long work."""
    from frot.runtime.settings import read_settings
    from frot.runtime.showing import nearest

    for row in rows[:1]:
        read_settings(row, program.parameters, "parameter", program)
    known = [v.name for v in program.variables]
    for name in read:
        if name not in known and name != "time":
            raise fail(
                "E0805",
                f"the model '{program.name}' has no variable '{name}'",
                help=nearest(name, known),
            )


def _here(
    program: Program,
    batches: Sequence[list[Row]],
    read: Sequence[str],
    options: Mapping[str, Any],
    processes: int | None,
) -> Iterator[list[Row]]:
    """On the cores of this machine; a few rows need no other process."""
    workers = min(processes or os.cpu_count() or 1, len(batches))
    if workers <= 1:
        for batch in batches:
            yield run_rows(program, batch, read, options)
        return
    from concurrent.futures import ProcessPoolExecutor
    from dataclasses import replace
    from functools import partial

    # the lock that keeps the program's folder stays in this process
    sent = replace(program, hold=None)
    with ProcessPoolExecutor(workers) as pool:
        yield from pool.map(partial(_batch, sent, tuple(read), dict(options)), batches)


def _batch(
    program: Program, read: Sequence[str], options: Mapping[str, Any], rows: list[Row]
) -> list[Row]:
    return run_rows(program, rows, read, options)


def _by_dask(
    address: str,
    program: Program,
    batches: Sequence[list[Row]],
    read: Sequence[str],
    options: Mapping[str, Any],
) -> Iterator[list[Row]]:
    """On the workers of a cluster, which see the same files."""
    try:
        from distributed import Client
    except ImportError:
        raise fail(
            "E0820", "Dask is not installed", help="pip install 'dask[distributed]'"
        ) from None
    from dataclasses import replace
    from functools import partial

    sent = replace(program, hold=None)
    with Client(address) as client:
        work = client.map(partial(_batch, sent, tuple(read), dict(options)), batches, pure=False)
        for one in work:
            yield one.result()


def read_done(path: Path, names: Sequence[str]) -> list[Row]:
    """The rows of a sweep that is in the file already, if they are of the same columns."""
    if not path.is_file():
        return []
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        if reader.fieldnames is None or list(reader.fieldnames) != list(names):
            raise fail(
                "E0806",
                f"'{path}' has other columns than this sweep",
                help="name another file, or remove it",
            )
        return [dict(row) for row in reader if all(row.get(name) is not None for name in names)]


def write_rows(path: Path, rows: Sequence[Mapping[str, object]]) -> None:
    """All rows at once, as `.parquet` or `.csv`."""
    try:
        import pandas
    except ImportError:
        raise fail("E0820", "a .parquet needs pandas and pyarrow", help="write a .csv") from None
    frame = pandas.DataFrame(rows)
    try:
        frame.to_parquet(path)
    except ImportError:
        raise fail("E0820", "a .parquet needs pyarrow", help="pip install pyarrow") from None


__all__ = ["FORMATS", "FrotError", "combinations", "read_done", "sweep", "values_of", "write_rows"]
