"""A command of `frot` in the process of the tests: the modules it needs are imported already."""

from __future__ import annotations

import contextlib
import io
from dataclasses import dataclass
from pathlib import Path

from frot.command_line import main


@dataclass(frozen=True)
class Done:
    """Exit status of a command, and what it printed."""

    returncode: int
    stdout: str
    stderr: str


def command(folder: Path, *words: str) -> Done:
    """Run a command in a folder; an exception that the command does not catch is raised here."""
    out, err = io.StringIO(), io.StringIO()
    streams = contextlib.redirect_stdout(out), contextlib.redirect_stderr(err)
    with contextlib.chdir(folder), streams[0], streams[1]:
        try:
            status = main(words)
        except SystemExit as stop:
            status = int(stop.code or 0)
    return Done(status, out.getvalue(), err.getvalue())
