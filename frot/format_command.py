"""`frot fmt`: each file in its usual form, or the changes that would bring it there."""

from __future__ import annotations

import difflib
import re
import sys
from pathlib import Path

from frot.dsl import Log, format_text
from frot.dsl.files.reading import decode, read_text
from frot.dsl.messages.errors import FrotError
from frot.dsl.messages.source import escaped

STANDARD_INPUT = "-"


def format_file(path: str, check: bool, diff: bool) -> bool:
    """Format a file in its place, or standard input to standard output; True if it changes.

    With `check` or `diff` nothing is written: the name of a file that would change, or what would
    change, is printed.

    Raises:
        FrotError: The file cannot be read or written, or has faults of syntax; it is left alone.
    """
    log = Log()
    piped = path == STANDARD_INPUT
    name = "<stdin>" if piped else path
    text = decode(sys.stdin.buffer.read(), name, log) if piped else read_text(path, log)
    form = format_text(text, log, name) if text is not None else ""
    if text is None or log.failed:
        raise FrotError(log)
    changes = form != text
    if diff:
        shown = _difference(text, form, name)
        _put("\n".join(map(escaped, shown.split("\n"))) if sys.stdout.isatty() else shown)
    elif check:
        if changes:
            print(name)
    elif piped:
        _put(form)
    elif changes:
        from frot.dsl.files.writing import write_whole

        write_whole(Path(path), form.encode("utf-8"))
        print(f"formatted {path}")
    return changes


def _put(text: str) -> None:
    """Print a text as it is, in the encoding of the language."""
    sys.stdout.flush()
    sys.stdout.buffer.write(text.encode("utf-8"))
    sys.stdout.buffer.flush()


def _difference(text: str, form: str, name: str) -> str:
    """The unified difference, as `patch` reads it."""
    lines = difflib.unified_diff(_lines(text), _lines(form), name, name)
    return "".join(x if x.endswith("\n") else f"{x}\n\\ No newline at end of file\n" for x in lines)


def _lines(text: str) -> list[str]:
    return re.findall(r"[^\n]*\n|[^\n]+", text)
