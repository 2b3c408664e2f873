"""Diagnostics as text: the message, the place, the source line with carets, notes and help."""

from __future__ import annotations

import unicodedata

from frot.dsl.messages.codes import CODES
from frot.dsl.messages.diagnostics import LIMIT, Diagnostic, Log
from frot.dsl.messages.source import Span, escaped

_TAB = 4
_LONGEST, _LONGEST_SENTENCE = 160, 2000
_COLOURS = {"error": "\033[1;31m", "warning": "\033[1;33m", "rule": "\033[1;34m", "bold": "\033[1m"}
_RESET = "\033[0m"


def render(diagnostic: Diagnostic, colour: bool = False) -> str:
    """One diagnostic as lines of text, without a last end of line."""
    severity = "error" if diagnostic.is_error else "warning"

    def paint(text: str, style: str) -> str:
        return f"{_COLOURS[style]}{text}{_RESET}" if colour and text else text

    head = paint(f"{severity}[{diagnostic.code}]", severity)
    lines = [f"{head}: {paint(_sentence(diagnostic.message), 'bold')}"]
    width = 1
    if diagnostic.span is not None:
        places = [diagnostic.span, *(label.span for label in diagnostic.labels)]
        width = max(len(str(_line_of(p))) for p in places)
        rule = paint("|", "rule")
        lines.append(f"{' ' * width}{paint('-->', 'rule')} {escaped(diagnostic.span.place)}")
        lines.append(f"{' ' * width} {rule}")
        carets = [(diagnostic.span, diagnostic.caret, "^", severity)]
        carets += [(label.span, label.text, "-", "rule") for label in diagnostic.labels]
        for span, text, mark, style in carets:
            for number, shown, under in _excerpt(span, text, mark):
                side = paint(f"{number:>{width}}", "rule")
                lines.append(f"{side} {rule} {shown}".rstrip())
                lines.append(f"{' ' * width} {rule} {paint(under.rstrip(), style)}")
    equals = f"{' ' * width} {paint('=', 'rule')}"
    lines.extend(f"{equals} note: {_sentence(note)}" for note in diagnostic.notes)
    # Every message has a remedy: its own, or that of its code.
    remedy = diagnostic.help or CODES[diagnostic.code].remedy
    lines.append(f"{equals} help: {_sentence(remedy)}")
    return "\n".join(lines)


def render_log(log: Log, colour: bool = False) -> str:
    """All diagnostics of a log, at most 20, in the order of their places."""
    every = by_place(log)
    parts = [render(d, colour) for d in every[:LIMIT]]
    if len(every) > LIMIT:
        parts.append(f"... and {len(every) - LIMIT} more")
    return "\n\n".join(parts)


def by_place(log: Log) -> list[Diagnostic]:
    """The diagnostics in the order of their places."""
    return sorted(log.diagnostics, key=_place)


def _place(diagnostic: Diagnostic) -> tuple[bool, str, int]:
    span = diagnostic.span
    return (False, "", 0) if span is None else (True, span.source.name, span.start)


def _line_of(span: Span) -> int:
    return span.source.line_column(_start(span))[0]


def _start(span: Span) -> int:
    return max(0, min(span.start, len(span.source.text)))


def _excerpt(span: Span, text: str, mark: str) -> list[tuple[int, str, str]]:
    """Number, shown text and underline of the first line of a span; its last if it has several."""
    source = span.source
    start = _start(span)
    end = max(start, min(span.end, len(source.text)))
    first, column = source.line_column(start)
    last, end_column = source.line_column(max(start, end - 1)) if end > start else (first, column)
    line = source.line(first)
    if first == last:
        return [(first, *_underlined(line, column - 1, end_column, mark, text))]
    tail = source.line(last)
    indent = len(tail) - len(tail.lstrip())
    return [
        (first, *_underlined(line, column - 1, len(line), mark, "")),
        (last, *_underlined(tail, min(indent, end_column - 1), end_column, mark, text)),
    ]


def _underlined(line: str, start: int, end: int, mark: str, text: str) -> tuple[str, str]:
    """The line as it is shown, and the marks below its characters [start, end)."""
    # Of a line of any length what lies around the marks is enough.
    far = max(start - _LONGEST, 0)
    line, start, end = line[far : far + 4 * _LONGEST], start - far, end - far
    cells = [_shown(c) for c in line]
    shift = 0
    if sum(map(_width, cells)) > _LONGEST and start > _LONGEST // 2:
        shift = start - _LONGEST // 2
    before = sum(_width(c) for c in cells[shift:start])
    under = sum(_width(c) for c in cells[start : max(end, start + 1)])
    shown = "".join(cells[shift : shift + _LONGEST])
    under = max(1, min(under, _LONGEST - before))
    return shown, f"{' ' * before}{mark * under} {text}".rstrip()


def _shown(character: str) -> str:
    if character == "\t":
        return " " * _TAB
    if unicodedata.combining(character) or character.isprintable():
        return character
    return escaped(character)


def _sentence(text: str) -> str:
    """A message on one line, cut where it repeats more of a text than anybody reads."""
    return escaped(text if len(text) <= _LONGEST_SENTENCE else f"{text[:_LONGEST_SENTENCE]} ...")


def columns(text: str) -> int:
    """The number of columns of a terminal a text takes."""
    return len(text) if text.isascii() else sum(map(_width, text))


def _width(cell: str) -> int:
    """The number of columns of a terminal a cell takes."""
    if len(cell) > 1:
        return len(cell)
    if unicodedata.combining(cell):
        return 0
    return 2 if unicodedata.east_asian_width(cell) in "WF" else 1
