"""The command `frot sweep`."""

from __future__ import annotations

import argparse
import csv
import itertools
import time
from collections.abc import Mapping, Sequence
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
        "--resume", action="store_true", help="go on where the rows of the .csv end"
    )


def sweep(options: argparse.Namespace) -> int:
    """Run all combinations and write their rows."""
    from frot.commands import compiled
    from frot.dsl.files.writing import check_target
    from frot.progress import Busy
    from frot.sweep import FORMATS, count_of, read_done, sweep, values_of, write_rows

    target = None if options.output is None else check_target(options.output, FORMATS)
    given = {name: values_of(text) for name, text in options.set}
    model = compiled(options)
    target = target or Path(f"{model.name}.csv")
    columns = [*given, *options.read, "error"]
    by_row = target.suffix.lower() == ".csv"
    done = read_done(target, columns) if options.resume and by_row else []
    run = {"start": options.start, "stop": options.stop, "tolerance": options.tolerance}
    kept = []
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
        if not by_row:
            kept = list(rows)
            write_rows(target, kept)
            return _tell(target, kept)
        first = next(rows, None)  # names and values are checked before the file is touched
        with open(target, "a" if done else "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, columns)
            written = time.monotonic()
            if not done:
                writer.writeheader()
            for row in itertools.chain([] if first is None else [first], rows):
                writer.writerow(row)
                kept.append(row)
                if time.monotonic() > written + KEPT:
                    file.flush()
                    written = time.monotonic()
    return _tell(target, [*done, *kept])


def _tell(target: Path, rows: Sequence[Mapping[str, object]]) -> int:
    failures = sum(bool(row["error"]) for row in rows)
    print(f"  {len(rows)} runs, {failures} ended in an error")
    print(f"  written: {target}")
    return 0
