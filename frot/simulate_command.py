"""`frot simulate`: a run of a model, its summary, files and picture."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from frot.command_steps import compiled, run_watched
from frot.options import add_file, add_model, add_run, add_settings, time

if TYPE_CHECKING:
    from frot.runtime.result import Result


def add_simulate(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    add_file(parser)
    add_model(parser)
    add_settings(parser)
    add_run(parser)
    parser.add_argument(
        "--interval", type=time, metavar="T", help="distance of the output times in s"
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="write all variables to .csv, .json or .npz, or the whole run to .frotrun",
    )
    parser.add_argument(
        "--units", action="store_true", help="name the columns of a .csv with their units"
    )
    parser.add_argument("--plot", metavar="FILE", help="draw the motion to .png, .svg or .pdf")
    parser.add_argument(
        "--explain", action="store_true", help="say of each event why it happens, with numbers"
    )
    parser.add_argument("--quiet", action="store_true", help="print no summary")


def simulate(options: argparse.Namespace) -> int:
    """Run the model; what ended the run early is raised after all has been written."""
    from frot.dsl.files.writing import DATA, PICTURES, check_target
    from frot.progress import Busy
    from frot.runtime import Interrupted, SimulationError

    for target, formats in ((options.output, DATA), (options.plot, PICTURES)):
        if target is not None:
            check_target(target, formats)
    model = compiled(options)
    result: Result | None
    failure: SimulationError | Interrupted | None = None
    try:
        result = run_watched(model, options, interval=options.interval)
    except (SimulationError, Interrupted) as error:
        result, failure = error.result, error
    if result is not None:
        if options.output is not None:
            with Busy(f"writing {options.output}"):
                result.save(options.output, units=options.units, explain=options.explain)
        # a picture takes longer than one waits after Ctrl-C
        drawn = options.plot is not None and not isinstance(failure, KeyboardInterrupt)
        if drawn:
            with Busy(f"drawing {options.plot}"):
                result.plot(options.plot)
        if not options.quiet:
            print(result.summary(events=not options.explain))
            for target in filter(None, (options.output, options.plot if drawn else None)):
                print(f"  written: {target}")
        if options.explain:
            from frot.explained_events import explain_run

            explain_run(result)
    if failure is not None:
        raise failure
    return 0
