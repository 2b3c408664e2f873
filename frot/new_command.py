"""The commands `frot new` and `frot watch`."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from frot.options import add_model, add_run, add_settings

TEXT = """// {name}: say here what it is, and where its values come from.
planar model {name} "A pendulum with a dry pin"
  parameter Length l  = 0.5 m "length of the rod";
  parameter Real   mu = 0.1   "coefficient of friction of the pin";

  body rod: rod(mass = 1 kg, length = l);
  liaison pin: rotoide(ground, rod.start) with coulomb(mu, radius = 10 mm);

  output Length height = rod.tip.position.y;

initial
  pin.angle = 0;

  experiment(stop = 5 s);
end {name};
"""
POLL = 0.25  # s between two looks at the files


def add_new(parser: argparse.ArgumentParser) -> None:
    """The options of `frot new`."""
    parser.add_argument("file", metavar="FILE", help="the .frot file to write; it must not exist")


def new(options: argparse.Namespace) -> int:
    """Write a small model to begin with."""
    from frot.dsl.files.writing import check_target, write_whole
    from frot.dsl.messages.errors import fail

    path = Path(options.file)
    if not path.suffix:
        path = path.with_suffix(".frot")
    check_target(path, (".frot",))
    if path.exists():
        raise fail("E0803", f"'{path}' exists already", help="name another file")
    words = "".join(x if x.isalnum() else " " for x in path.stem).split()
    name = "".join(word[:1].upper() + word[1:] for word in words)
    if not name or name[0].isdigit():
        name = f"Model{name}"
    write_whole(path, TEXT.format(name=name).encode("utf-8"))
    print(f"  written: {path}")
    print(f"  run it: frot simulate {path}, see it: frot view {path}")
    return 0


def add_watch(parser: argparse.ArgumentParser) -> None:
    """The options of `frot watch`."""
    parser.add_argument("file", metavar="FILE", help="a .frot file")
    add_model(parser)
    add_settings(parser)
    add_run(parser)
    parser.add_argument("--plot", metavar="FILE", help="draw the motion at each save")
    parser.add_argument("--times", type=int, default=0, help=argparse.SUPPRESS)


def watch(options: argparse.Namespace) -> int:
    """Check and run the model now and at each save, until Ctrl-C."""
    from frot.command_steps import complain
    from frot.dsl.messages.errors import FrotError

    seen: object = None
    count = 0
    while True:
        stamp = _stamp(options.file)
        if stamp != seen:
            seen = stamp
            print(f"-- {time.strftime('%H:%M:%S')}  {options.file}")
            try:
                _run(options)
            except FrotError as error:
                complain(error)
            sys.stdout.flush()
            count += 1
            if options.times and count >= options.times:
                return 0
        time.sleep(POLL)


def _stamp(file: str) -> tuple[object, ...]:
    """When the file and what it imports were saved; None for one that is not there."""
    from frot.dsl.files.import_scan import imported_files
    from frot.dsl.files.reading import read_text
    from frot.dsl.messages.diagnostics import Log

    text = read_text(file, Log()) or ""
    paths = [Path(file), *(Path(x) for x in imported_files(text, file))]
    return tuple(_saved(path) for path in paths)


def _saved(path: Path) -> int | None:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return None


def _run(options: argparse.Namespace) -> None:
    """One run: its summary and its picture, up to the error where it ends in one."""
    from frot.command_steps import compiled, run_as_far
    from frot.progress import Busy

    result, failure = run_as_far(compiled(options), options)
    print(result.summary())
    if options.plot is not None:
        with Busy(f"drawing {options.plot}"):
            result.plot(options.plot)
        print(f"  written: {options.plot}")
    if failure is not None:
        raise failure
