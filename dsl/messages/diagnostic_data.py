"""Diagnostics as plain data, for other programs."""

from __future__ import annotations

from frot.dsl.messages.diagnostics import Diagnostic, Log
from frot.dsl.messages.rendering import by_place
from frot.dsl.messages.source import Span


def log_data(log: Log, file: str) -> list[dict[str, object]]:
    """The diagnostics of a file in the order of their places, as dictionaries for JSON."""
    return [_diagnostic(diagnostic, file) for diagnostic in by_place(log)]


def _diagnostic(diagnostic: Diagnostic, file: str) -> dict[str, object]:
    return {
        "code": diagnostic.code,
        "severity": "error" if diagnostic.is_error else "warning",
        "message": diagnostic.message,
        **_place(diagnostic.span, file),
        "caret": diagnostic.caret,
        "labels": [{"text": x.text, **_place(x.span, file)} for x in diagnostic.labels],
        "notes": list(diagnostic.notes),
        "help": diagnostic.help,
    }


def _place(span: Span | None, file: str) -> dict[str, object]:
    """Lines and columns from 1; the end is the place after the last character."""
    if span is None:
        empty: dict[str, object] = dict.fromkeys(("line", "column", "end_line", "end_column"))
        return {"file": file, **empty}
    size = len(span.source.text)
    start = max(0, min(span.start, size))
    line, column = span.source.line_column(start)
    end_line, end_column = span.source.line_column(max(start, min(span.end, size)))
    return {
        "file": span.source.name,
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }
