"""Many runs of a model: a row for each combination of parameters, on all cores or on a cluster.

A row has the parameters, the values read at the end of its run, and `error`, empty where the run
was good. What has been done is in the file, so that a sweep that was stopped continues.
"""

from __future__ import annotations

import csv
import itertools
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import FrotError, fail

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel

FORMATS = (".csv", ".parquet")
MOST_RUNS = 10_000_000
Row = dict[str, object]


def values_of(text: str) -> list[str]:
    """`0:0.5:0.01` as its values, both ends in it, or `1 kg,2 kg` as they are."""
    parts = text.split(":")
    if len(parts) == 1:
        from frot.options import names

        return names(text)
    try:
        first, last, step = map(float, parts)
        count = (last - first) / step
    except (ValueError, ZeroDivisionError):
        count = math.nan
    if not (math.isfinite(count) and count >= 0):
        raise fail("E0806", f"'{text}' is no range", help="write FIRST:LAST:STEP, as 0:0.5:0.01")
    if count > MOST_RUNS:
        raise fail("E0806", f"'{text}' has {count:.3g} values", help=f"at most {MOST_RUNS}")
    return [repr(first + k * step) for k in range(round(count * (1 + 1e-12)) + 1)]


def count_of(given: Mapping[str, Sequence[object]]) -> int:
    """How many combinations there are; FrotError (E0806) for more than MOST_RUNS."""
    count = math.prod(len(values) for values in given.values())
    if count > MOST_RUNS:
        raise fail("E0806", f"a sweep of {count} runs is too long", help=f"at most {MOST_RUNS}")
    return count


def sweep(
    model: CompiledModel,
    given: Mapping[str, Sequence[object]],
    read: Sequence[str],
    *,
    dask: str = "",
    processes: int | None = None,
    done: Sequence[Row] = (),
    watch: Callable[[int, int], None] | None = None,
    **options: Any,
) -> Iterator[Row]:
    """The rows of a sweep in their order, as they are done; the last name changes fastest.

    Args:
        model: The model.
        given: Values of each parameter.
        read: Variables, whose values at the end of the run are read.
        dask: Address of a scheduler of Dask, which takes the place of this machine's cores.
        processes: How many work here; by default one for each core.
        done: Rows of a sweep that was stopped, which are not run again.
        watch: Called with the number of rows done, and that of all.
        options: Start, stop, tolerance and inputs, as those of `simulate`.

    Raises:
        FrotError: E0805, E0806: unknown parameters and variables, bad values; E0820: Dask is not
            installed.
    """
    from frot.ask import reading_program
    from frot.sweep_work import Work, by_dask, here

    whole, count = count_of(given), len(done)
    program, names = reading_program(model, read)
    work = Work(program, given, tuple(names), options)
    parts = by_dask(dask, work, count, whole) if dask else here(work, count, whole, processes)
    columns = (*given, *read, "error")
    rows = itertools.islice(itertools.product(*given.values()), count, None)
    for part in parts:
        for values, error in part:
            yield dict(zip(columns, (*next(rows), *values, error), strict=True))
        count += len(part)
        if watch is not None:
            watch(count, whole)


def read_done(path: Path, names: Sequence[str], given: Mapping[str, Sequence[object]]) -> list[Row]:
    """The rows of a sweep that is in the file already, if it is the same sweep."""
    if not path.is_file():
        return []
    content = path.read_bytes()
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        if reader.fieldnames is None:
            return []
        if list(reader.fieldnames) != list(names):
            raise _other(path, "columns")
        done: list[Row] = [dict(row) for row in reader]
    if not content.endswith(b"\n"):
        # part of a row, of a machine that stopped
        done = done[:-1]
        os.truncate(path, content.rfind(b"\n") + 1)
    every = itertools.product(*given.values())
    for row in done:
        values = next(every, None)
        if values is None or [str(x) for x in values] != [row[name] for name in given]:
            raise _other(path, "values of parameters")
    return done


def _other(path: Path, what: str) -> Exception:
    return fail(
        "E0806",
        f"'{path}' has other {what} than this sweep",
        help="name another file, or remove it",
    )


def check_table() -> None:
    """FrotError (E0820) where no `.parquet` can be written; called before long work."""
    from importlib.util import find_spec

    if not (find_spec("pandas") and find_spec("pyarrow")):
        raise fail(
            "E0820",
            "a .parquet needs pandas and pyarrow",
            help="pip install 'frot[sweep]', or write a .csv",
        )


def write_table(path: Path, rows: Path) -> None:
    """All rows of a `.csv` at once as a `.parquet`; what is a number in all of them is a number."""
    import pandas

    columns = {"error": str}
    frame = pandas.read_csv(rows, dtype=columns, keep_default_na=False, na_values=["nan"])
    frame.to_parquet(path)


__all__ = [
    "FORMATS",
    "FrotError",
    "check_table",
    "count_of",
    "read_done",
    "sweep",
    "values_of",
    "write_table",
]
