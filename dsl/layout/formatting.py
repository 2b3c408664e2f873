"""The usual form of a text: its blanks and ends of line; words and comments are the author's."""

from __future__ import annotations

from frot.dsl.layout.blocks import set_margins
from frot.dsl.layout.columns import Line, set_columns
from frot.dsl.layout.pieces import Piece, read_pieces
from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.source import Source
from frot.dsl.text.parsing import Lexeme, parse


def format_text(text: str, log: Log | None = None, name: str = "<text>") -> str:
    """The text in its usual form, with the same tree, or as it is if its syntax has faults.

    The faults are reported to `log`, with `name` for the text. Formatting the outcome again
    changes nothing.
    """
    log = Log() if log is None else log
    found = Log()
    tokens: list[Lexeme] = []
    parse(Source(name, text), found, tokens)
    log.diagnostics += found.diagnostics
    if found.failed:
        return text
    pieces = read_pieces(text, tokens)
    if not pieces:
        return ""
    set_margins(pieces)
    return "\n".join(map(_written, set_columns(pieces))) + "\n"


def _written(line: Line) -> str:
    parts: list[str] = []
    column = 0
    for piece, start in zip(line.pieces, line.columns, strict=True):
        if not parts and piece.lines == 2:
            parts.append("\n")
        parts.append(" " * (start - column))
        parts.append(_moved(piece, start - piece.column))
        column = start + piece.width
    return "".join(parts)


def _moved(piece: Piece, shift: int) -> str:
    """The text of a piece; the further lines of a comment move with its first one."""
    first, *others = piece.text.split("\n")
    if not others:
        return first
    moved = [first]
    for line in others:
        blank = len(line) - len(line.lstrip(" "))
        moved.append(" " * shift + line if shift > 0 and line else line[min(blank, -shift) :])
    return "\n".join(moved)
