"""The commands: `frot check | simulate | fmu | fmt | explain | cache`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from frot.command_steps import compiled, complain
from frot.options import add_file, add_model

if TYPE_CHECKING:
    from frot.model import Model

EXIT_ERROR = 1
ABOUT = ("author", "version", "licence", "copyright", "date")  # of an FMU
STAGES = ("tree", "instance", "mechanism", "reduced", "equations", "cost", "c")


def run(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status is 0, 1 after an error message, 2 after wrong usage."""
    try:
        parser = _parser()
        options = parser.parse_args(arguments)
        if options.command is None:
            parser.print_help()
            return 0
        status = int(options.run(options))
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        # The reader of our output has gone (`frot ... | head`): nobody reads the message.
        sys.stderr.close()
        return 0
    except OSError as error:
        # Files tell their own faults: this is the standard output (a full disk behind it).
        print(f"error[E0803]: the output cannot be written: {error.strerror}", file=sys.stderr)
        print("  = help: free some space, or send the output elsewhere", file=sys.stderr)
        _discard_output()
        return EXIT_ERROR
    except MemoryError:
        complain(_out_of_memory())
        return EXIT_ERROR
    except Exception as error:
        from frot.dsl.messages.errors import FrotError

        if not isinstance(error, FrotError):
            raise
        complain(error)
        return EXIT_ERROR


def _out_of_memory() -> Exception:
    from frot.dsl.messages.errors import fail

    return fail("E0808", "the computer has not enough memory for this")


def _discard_output() -> None:
    """Keep the interpreter from writing what is left once more when it ends."""
    import os

    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _parser() -> argparse.ArgumentParser:
    from frot.motions_command import add_motions, motions
    from frot.new_command import add_new, add_watch, new, watch
    from frot.plot_command import add_plot, plot
    from frot.simulate_command import add_simulate, simulate
    from frot.sweep_command import add_sweep, sweep
    from frot.view.command import add_view, view

    parser = argparse.ArgumentParser(
        prog="frot",
        description="Models of rigid bodies with liaisons and dry friction: check them, run them "
        "exactly, export them as FMUs.",
        epilog="`frot COMMAND --help` tells more. Exit status: 0 done, 1 an error was reported, "
        "2 wrong usage.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")

    check = _command(commands, "check", "check models; print their mobility and liaisons", _check)
    _files(check)
    add_model(check)
    instead = check.add_mutually_exclusive_group()
    instead.add_argument(
        "--json", action="store_true", help="print all messages and reports as one JSON document"
    )
    instead.add_argument(
        "--emit",
        choices=STAGES,
        help="print what one stage of the compiler makes instead of the report",
    )

    add_simulate(_command(commands, "simulate", "run a model", simulate))

    fmu = _command(commands, "fmu", "export a model as an FMU", _fmu)
    add_file(fmu)
    add_model(fmu)
    fmu.add_argument("-o", "--output", metavar="FILE", help="the .fmu (default: MODEL.fmu)")
    fmu.add_argument("--fmi", choices=("2.0", "3.0"), default="2.0", help="version (default: 2.0)")
    fmu.add_argument(
        "--platforms",
        metavar="P,...",
        type=lambda names: names.split(","),
        help="as x86_64-windows,native, which is this machine's (default: all that can be made)",
    )
    fmu.add_argument("--arrays", action="store_true", help="vectors as single variables (FMI 3.0)")
    for name in ABOUT:
        fmu.add_argument(f"--{name}", metavar="TEXT", default="", help=f"{name} that it names")
    fmu.add_argument(
        "--check", metavar="FMU", help="make none: hold this one against FMPy's rules and a run"
    )

    fmt = _command(commands, "fmt", "bring files into their usual form", _fmt)
    _files(fmt, "a .frot file, or - for standard input to standard output")
    fmt.add_argument(
        "--check", action="store_true", help="write nothing; status 1 and the names of what changes"
    )
    fmt.add_argument("--diff", action="store_true", help="write nothing; print what would change")

    add_plot(_command(commands, "plot", "draw chosen curves of runs", plot))
    add_motions(_command(commands, "motions", "list the admissible motions of a state", motions))
    add_new(_command(commands, "new", "write a small model to begin with", new))
    add_watch(_command(commands, "watch", "check and run a model at each save", watch))
    add_sweep(_command(commands, "sweep", "run all combinations of parameters", sweep))
    add_view(_command(commands, "view", "show a run as a page, a picture or a film", view))

    explain = _command(commands, "explain", "tell what a message's code means", _explain)
    explain.add_argument("code", metavar="CODE", nargs="?", help="as E0203; without: all codes")

    cache = _command(commands, "cache", "where compiled models are kept, and how large", _cache)
    cache.add_argument("--clear", action="store_true", help="remove all that is not in use")
    cache.add_argument(
        "--limit", metavar="SIZE", help="keep at most so much from now on, as 200MB or 1.5GB"
    )
    return parser


def _command(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    summary: str,
    run: object,
) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=summary, description=f"frot {name}: {summary}.")
    parser.set_defaults(run=run)
    return parser


def _files(parser: argparse.ArgumentParser, text: str = "a .frot file") -> None:
    parser.add_argument("files", metavar="FILE", nargs="+", help=text)


class _Version(argparse.Action):
    """Prints the version, which is looked up only then."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        print(f"frot {version('frot')}")
        parser.exit()


def _check(options: argparse.Namespace) -> int:
    from frot.check_command import check_data, emit_stage, report_file

    if options.json:
        import json

        checked = [check_data(file, options.model) for file in options.files]
        print(json.dumps({"files": checked}, indent=2))
        return EXIT_ERROR if any(c["report"] is None for c in checked) else 0

    def check(file: str) -> int:
        if options.emit:
            print(emit_stage(file, options.model, options.emit))
        else:
            print(report_file(file, options.model))
        return 0

    return _each(options.files, check)


def _fmt(options: argparse.Namespace) -> int:
    from frot.format_command import format_file

    def form(file: str) -> int:
        changes = format_file(file, options.check, options.diff)
        return EXIT_ERROR if changes and options.check else 0

    return _each(options.files, form)


def _explain(options: argparse.Namespace) -> int:
    from frot.dsl.messages.explaining import explain, list_codes

    print(explain(options.code) if options.code else list_codes())
    return 0


def _cache(options: argparse.Namespace) -> int:
    from frot.cache_command import tell_cache

    print(tell_cache(options.limit, options.clear))
    return 0


def _each(files: Sequence[str], run: Callable[[str], int]) -> int:
    """Run a command on each file; the error of one does not keep it from the others."""
    from frot.dsl.messages.errors import FrotError

    status = 0
    for file in files:
        try:
            status = max(status, run(file))
        except FrotError as error:
            complain(error)
            status = EXIT_ERROR
    return status


def _fmu(options: argparse.Namespace) -> int:
    model = compiled(options)
    if options.check is not None:
        return _check_fmu(model, options.check)
    target = options.output or f"{model.program().name}.fmu"
    about = {name: getattr(options, name) for name in ABOUT}
    model.export_fmu(target, options.fmi, options.platforms, options.arrays, **about)
    print(f"{target}: FMI {options.fmi}, checked by FMPy")
    return 0


def _check_fmu(model: Model, path: str) -> int:
    checked = model.check_fmu(path)
    for problem in checked.problems:
        print(f"{path}: {problem}")
    if not checked.same:
        print(f"{path}: made from another text, or by another version of Frot")
    elif checked.apart == 0.0 and not checked.problems:
        print(f"{path}: all values are those of simulate, to the last bit")
    elif not checked.problems:
        print(
            f"{path}: values differ from those of simulate by up to {checked.apart:.2g} of the "
            f"largest, '{checked.variable}' the most"
        )
    if checked.exchanged is not None:
        print(
            f"{path}: in model exchange, by CVODE, the largest error is {checked.exchanged:.2g}"
            + ("" if checked.good else f", that of '{checked.variable}'")
        )
    return 0 if checked.good else 1
