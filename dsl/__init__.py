"""The language room: text to a checked model, with every fault of the text in a log.

Lark is loaded when a text is first parsed, not here.
"""

from __future__ import annotations

from pathlib import Path

from frot.dsl import checked
from frot.dsl.check import check
from frot.dsl.codes import CODES
from frot.dsl.diagnostics import Diagnostic, Label, Log
from frot.dsl.dump import dump
from frot.dsl.evaluate import NotConstant, evaluate
from frot.dsl.parse import parse
from frot.dsl.render import render, render_log
from frot.dsl.source import Source, Span
from frot.dsl.values import default_values, parse_value

__all__ = [
    "CODES",
    "Diagnostic",
    "Label",
    "Log",
    "NotConstant",
    "Source",
    "Span",
    "check",
    "compile_text",
    "default_values",
    "dump",
    "evaluate",
    "load",
    "parse",
    "parse_value",
    "render",
    "render_log",
]


def load(path: str | Path, log: Log, model: str | None = None) -> checked.Model | None:
    """The checked model of a `.frot` file; None if an error was reported to `log`."""
    name = str(path)
    try:
        # A leading byte order mark is legal in UTF-8; line ends are kept as they are.
        text = Path(path).read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        message = f"cannot read {name!r}: it is not UTF-8 (line {line})"
        log.report("E0804", message, None, help="save the file with the encoding UTF-8")
        return None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        log.report("E0804", f"cannot read {name!r}: {reason}", None)
        return None
    return compile_text(text, log, name, model)


def compile_text(
    text: str, log: Log, name: str = "<text>", model: str | None = None
) -> checked.Model | None:
    """The checked model of a text; None if an error was reported to `log`.

    `name` stands for the text in messages; `model` chooses where the text holds several.
    """
    return check(parse(Source(name, text), log), log, model)
