"""The command `frot plot`."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import TYPE_CHECKING

from frot.options import add_model, add_run, add_settings, names, saved_run

if TYPE_CHECKING:
    from frot.runtime.result import Result


def add_plot(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    parser.add_argument(
        "files", metavar="FILE", nargs="+", help="a .frot file or a .frotrun; several: compared"
    )
    add_model(parser)
    add_settings(parser)
    add_run(parser)
    parser.add_argument(
        "--curves", type=names, metavar="NAME,...", help="variables over time, one unit an axis"
    )
    parser.add_argument(
        "--xy", type=names, metavar="X,Y,...", help="variables against each other, in pairs"
    )
    parser.add_argument(
        "--compare",
        metavar="NAME=VALUE,...",
        help="a run for each value of a parameter: --compare mu=0.1,0.2,0.3",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="the .png, .svg or .pdf (default: MODEL.png)"
    )


def plot(options: argparse.Namespace) -> int:
    """Run the models and draw the curves."""
    from frot.dsl.files.writing import PICTURES, check_target
    from frot.dsl.messages.errors import fail
    from frot.progress import Busy
    from frot.runtime.curves import plot_curves
    from frot.runtime.plotting import plot as plot_choice

    if options.curves and options.xy:
        raise fail("E0806", "--curves and --xy exclude each other", help="draw two pictures")
    if options.output is not None:
        check_target(options.output, PICTURES)
    runs, failure = _runs(options)
    first = next(iter(runs.values()))
    target = options.output or f"{first.program.name}.png"
    chosen = options.xy or options.curves
    with Busy(f"drawing {target}"):
        if chosen:
            plot_curves(runs if len(runs) > 1 else first, target, chosen, xy=bool(options.xy))
        elif len(runs) > 1:
            plot_curves(runs, target, _common(runs))
        else:
            plot_choice(first, target)
    print(f"  written: {target}")
    if failure is not None:
        raise failure
    return 0


def outputs_of(result: Result) -> list[str]:
    """The outputs of a model, or the positions and angles of its bodies."""
    variables = result.program.variables
    found = [v.name for v in variables if v.causality == "output"]
    if found:
        return found
    ends = (".position.x", ".position.y", ".position.z", ".angle")
    return [v.name for v in variables if v.name.endswith(ends)][:6]


def _common(runs: Mapping[str, Result]) -> list[str]:
    """What is drawn of several runs: what all of them have."""
    first = next(iter(runs.values()))
    found = [name for name in outputs_of(first) if all(name in run for run in runs.values())]
    if not found:
        from frot.dsl.messages.errors import fail

        raise fail(
            "E0806",
            "the runs have no variables of one name to compare",
            help="name some that all have: --curves NAME,...",
        )
    return found


def _runs(options: argparse.Namespace) -> tuple[dict[str, Result], BaseException | None]:
    """The runs by what tells them apart, and what ended the first that ended too early."""
    from frot.command_steps import compiled, run_as_far

    values = [("", "")]
    name = ""
    if options.compare:
        name, _, listed = options.compare.partition("=")
        values = [(f"{name} = {value}", value) for value in names(listed)]
    runs: dict[str, Result] = {}
    failure: BaseException | None = None
    for file in options.files:
        saved = saved_run(options, file)
        if saved is not None:
            runs[file] = saved
            continue
        options.file = file
        model = compiled(options)
        for label, value in values:
            settings = dict(options.set) | ({name: value} if label else {})
            many = len(options.files) > 1
            shown = ", ".join(x for x in (file if many else "", label) if x)
            runs[shown], ended = run_as_far(model, options, parameters=settings)
            failure = failure or ended
    return runs, failure
