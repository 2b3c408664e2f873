"""The command `frot sweep`."""

from __future__ import annotations

import argparse
import csv
import itertools
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from frot.options import add_file, add_model, add_run, assignment, names

KEPT = 0.2  # s after which rows are in the file


def add_sweep(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    add_file(parser)
    add_model(parser)
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        type=assignment,
        metavar="NAME=VALUES",
        help="values of a parameter: --set mu=0:0.5:0.01 --set 'm=1 kg,2 kg' (repeatable)",
    )
    add_run(parser)
    parser.add_argument(
        "--read", type=names, required=True, metavar="NAME,...", help="variables at the end"
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="a .csv or .parquet (default: MODEL.csv)"
    )
    parser.add_argument("--dask", default="", metavar="ADDRESS", help="a scheduler of Dask")
    parser.add_argument(
        "--resume", action="store_true", help="go on where the rows of the file end"
    )


def sweep(options: argparse.Namespace) -> int:
    """Run all combinations and write their rows."""
    from frot.ask import reading_program
    from frot.command_steps import compiled
    from frot.dsl.files.writing import check_target
    from frot.progress import Busy
    from frot.sweep import FORMATS, check_table, count_of, read_done, sweep, values_of, write_table

    target = None if options.output is None else check_target(options.output, FORMATS)
    given = {name: values_of(text) for name, text in options.set}
    if target is not None and target.suffix.lower() != ".csv":
        check_table()
    model = compiled(options)
    target = target or Path(f"{model.name}.csv")
    # a .parquet is written whole: until then its rows are kept beside it
    whole = target.suffix.lower() != ".csv"
    kept = target.with_name(f"{target.name}.csv") if whole else target
    columns = [*given, *options.read, "error"]
    done = read_done(kept, columns, given) if options.resume else []
    run = {"start": options.start, "stop": options.stop, "tolerance": options.tolerance}
    with Busy(f"compiling {model.name}"):
        reading_program(model, options.read)
    with Busy(f"{count_of(given)} runs of {model.name}") as busy:
        rows = sweep(
            model,
            given,
            options.read,
            dask=options.dask,
            done=done,
            watch=lambda count, of: busy.tell(f"{count} of {of}"),
            **run,
        )
        counts = _write(kept, columns, rows, done)
    if whole:
        with Busy(f"writing {target}"):
            write_table(target, kept)
        kept.unlink()
    print(f"  {counts[0]} runs, {counts[1]} ended in an error")
    print(f"  written: {target}")
    return 0


def _write(
    path: Path,
    columns: Sequence[str],
    rows: Iterator[Mapping[str, object]],
    done: Sequence[Mapping[str, object]],
) -> tuple[int, int]:
    """Write the rows as they come; how many there are, and how many of them have errors."""
    count, failures = len(done), sum(bool(row["error"]) for row in done)
    first = next(rows, None)  # names and values are checked before the file is touched
    written = time.monotonic()
    with open(path, "a" if done else "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns)
        if not done:
            writer.writeheader()
        for row in itertools.chain([] if first is None else [first], rows):
            writer.writerow(row)
            count += 1
            failures += bool(row["error"])
            if time.monotonic() > written + KEPT:
                file.flush()
                written = time.monotonic()
    return count, failures
