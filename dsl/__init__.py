"""The language room: text to a checked model, with every fault of the text in a log.

The folders in the order in which they know of each other: `messages`, `files`, `text` (bytes to
tree), `layout` (the formatter); `quantities`, `catalogue`, `checked` (the model that comes out);
`names`, `expressions`, `declarations`, `statements`. `checking` has the order of the passes, `warn`
the warnings of a sound model.

Parts are loaded when they are first used: the passes at the first text, lark at the first parse.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from frot.dsl.messages.diagnostics import Diagnostic, Label, Log
from frot.dsl.messages.source import Source, Span

if TYPE_CHECKING:
    from pathlib import Path

    from frot.dsl import checked
    from frot.dsl.checked.dumping import dump
    from frot.dsl.checked.evaluation import NotConstant, evaluate
    from frot.dsl.checked.values import default_values, parse_value
    from frot.dsl.checking import check
    from frot.dsl.layout.formatting import format_text
    from frot.dsl.messages.codes import CODES
    from frot.dsl.messages.rendering import render, render_log
    from frot.dsl.text.parsing import parse

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
    "format_text",
    "load",
    "parse",
    "parse_value",
    "render",
    "render_log",
]


_HOMES = {
    "CODES": "messages.codes",
    "NotConstant": "checked.evaluation",
    "check": "checking",
    "default_values": "checked.values",
    "dump": "checked.dumping",
    "evaluate": "checked.evaluation",
    "format_text": "layout.formatting",
    "parse": "text.parsing",
    "parse_value": "checked.values",
    "render": "messages.rendering",
    "render_log": "messages.rendering",
}


def __getattr__(name: str) -> object:
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    found: object = getattr(import_module(f"{__name__}.{home}"), name)
    globals()[name] = found
    return found


def load(path: str | Path, log: Log, model: str | None = None) -> checked.Model | None:
    """The checked model of a `.frot` file; None if an error was reported to `log`."""
    from frot.dsl.files.reading import read_text

    text = read_text(path, log)
    return None if text is None else compile_text(text, log, str(path), model)


def compile_text(
    text: str, log: Log, name: str = "<text>", model: str | None = None
) -> checked.Model | None:
    """The checked model of a text; None if an error was reported to `log`.

    `name` stands for the text in messages; `model` chooses where the text holds several.
    """
    from frot.dsl.checking import check
    from frot.dsl.text.parsing import parse

    return check(parse(Source(name, text), log), log, model)
