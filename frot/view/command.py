"""The command `frot view`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from frot.options import add_file, add_model, add_run, add_settings, names, number, time

if TYPE_CHECKING:
    from frot.runtime.result import Result


def add_view(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    add_file(parser, saved=True)
    add_model(parser)
    add_settings(parser)
    add_run(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="a page .html (default: MODEL.html), a picture .png, .svg or .pdf, a film .gif or "
        ".mp4; a picture without --at shows the start, before any run",
    )
    parser.add_argument("--at", type=time, metavar="T", help="the moment of a picture in s")
    parser.add_argument(
        "--speed",
        type=number,
        default=1.0,
        metavar="X",
        help="of a film: s of the run in 1 s",
    )
    parser.add_argument(
        "--curves", type=names, metavar="NAME,...", help="variables beside the picture of a page"
    )
    parser.add_argument(
        "--no-run", action="store_true", help="show the start alone, before any run"
    )
    parser.add_argument(
        "--no-open", action="store_true", help="write the page, and do not open it in a browser"
    )


def view(options: argparse.Namespace) -> int:
    """Run the model, or read a saved run, and write the picture."""
    from frot.command_steps import compiled, run_as_far
    from frot.options import saved_run
    from frot.view.film import PAGE, STILL
    from frot.view.show import check_view, open_page, write_start

    target = None if options.output is None else check_view(options.output)
    result, failure = saved_run(options, options.file), None
    if result is None:
        model = compiled(options)
        target = target or check_view(f"{model.name}.html")
        if options.no_run or (target.suffix.lower() in STILL and options.at is None):
            write_start(
                model,
                target,
                start=options.start,
                parameters=dict(options.set),
                inputs=dict(options.input),
            )
        else:
            result, failure = run_as_far(model, options)
    target = target or check_view(f"{result.program.name}.html") if result else target
    assert target is not None
    if result is not None:
        _write(result, target, options)
    print(f"  written: {target}")
    if target.suffix.lower() in PAGE and not options.no_open and sys.stdout.isatty():
        open_page(target)
    if failure is not None:
        raise failure
    return 0


def _write(result: Result, target: Path, options: argparse.Namespace) -> None:
    from frot.progress import Busy
    from frot.view.show import write_view

    with Busy(f"drawing {target.name}") as busy:
        write_view(
            result,
            target,
            curves=options.curves,
            at=options.at,
            speed=options.speed,
            fault=result.fault,
            watch=lambda done, of: busy.tell(f"{done} of {of} pictures"),
        )
