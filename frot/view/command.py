"""The command `frot view`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from frot.options import add_file, add_model, add_run, add_settings, names, number, time

if TYPE_CHECKING:
    from frot.model import Model
    from frot.runtime.result import Result


def add_view(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    add_file(parser)
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
        "--no-open", action="store_true", help="write the page, and do not open it in a browser"
    )


def view(options: argparse.Namespace) -> int:
    """Run the model and write the picture."""
    from frot.commands import compiled
    from frot.view.film import PAGE, STILL
    from frot.view.show import check_view, write_start

    target = None if options.output is None else check_view(options.output)
    model = compiled(options)
    if target is None:
        target = check_view(f"{model.name}.html")
    kind = target.suffix.lower()
    if kind in STILL and options.at is None:
        write_start(
            model,
            target,
            start=options.start,
            parameters=dict(options.set),
            inputs=dict(options.input),
        )
        print(f"  written: {target}")
        return 0
    result, failure = _run(model, options)
    _write(result, target, options)
    print(f"  written: {target}")
    if kind in PAGE and not options.no_open and sys.stdout.isatty():
        import webbrowser

        webbrowser.open(target.resolve().as_uri())
    if failure is not None:
        raise failure
    return 0


def _run(model: Model, options: argparse.Namespace) -> tuple[Result, BaseException | None]:
    """The run, as far as it went, and what ended it."""
    from frot.progress import Progress
    from frot.runtime import Interrupted, SimulationError

    stop = options.stop
    program = model.program()
    with Progress(f"simulating {program.name}") as progress:
        try:
            result = model.simulate(
                start=options.start,
                stop=stop,
                tolerance=options.tolerance,
                parameters=dict(options.set),
                inputs=dict(options.input),
                watch=progress.watch(stop or program.experiment.stop),
            )
        except (SimulationError, Interrupted) as error:
            if error.result is None:
                raise
            return error.result, error
    return result, None


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
