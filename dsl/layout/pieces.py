"""A text as pieces: its tokens and its comments, each with where its author put it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from frot.dsl.messages.rendering import columns
from frot.dsl.text.parsing import Lexeme

TAB = 4
COMMENT, UNIT = "COMMENT", "UNIT"
# Kinds of this file, in place of the grammar's: a sign, a colon of a range, and an operator whose
# blanks keep it apart from a unit (`3 m / s` is not `3 m/s`).
SIGN, RANGE, APART = "SIGN", "RANGE", "APART"
_OPERAND = frozenset(["IDENT", "NUMBER", UNIT, "STRING", "RPAR", "RSQB", "TRUE", "FALSE"])
_COMMENTS = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_WITH_UNIT = re.compile(r"(\S+)(\s+)(.+)", re.DOTALL)


@dataclass(slots=True)
class Piece:
    """A token or a comment.

    `lines` are the ends of line before it, 2 standing for a blank line; `column` is where it began
    in the text, from 0; `depth` counts the brackets around it; `width` is that of its last line.
    `indent` is the margin of its block; `inside` says that a statement began before it.
    """

    kind: str
    text: str
    lines: int
    column: int
    depth: int
    width: int = field(init=False)
    indent: int = 0
    inside: bool = False

    def __post_init__(self) -> None:
        self.width = columns(self.text.rpartition("\n")[2])


def read_pieces(text: str, lexemes: Iterable[Lexeme]) -> list[Piece]:
    """The pieces of a text without faults, in their order."""
    reader = _Reader()
    offset = 0
    for lexeme in lexemes:
        reader.between(text[offset : lexeme.start])
        reader.token(lexeme.type, text[lexeme.start : lexeme.end])
        offset = lexeme.end
    reader.between(text[offset:])
    return reader.pieces


@dataclass(slots=True)
class _Reader:
    pieces: list[Piece] = field(default_factory=list)
    brackets: list[str] = field(default_factory=list)
    previous: str = ""
    in_for: bool = False
    lines: int = 0
    column: int = 0

    def between(self, text: str) -> None:
        """Read blanks and comments."""
        offset = 0
        for found in _COMMENTS.finditer(text):
            self._blank(text[offset : found.start()])
            comment = found[0].replace("\r\n", "\n")
            self._add(COMMENT, "\n".join(line.rstrip() for line in comment.split("\n")))
            offset = found.end()
        self._blank(text[offset:])

    def token(self, kind: str, text: str) -> None:
        """Read a token; a number and its unit are two pieces."""
        if kind in ("QUANTITY", "CLOSE_UNIT"):
            parts = _WITH_UNIT.fullmatch(text)
            assert parts is not None
            self._token("NUMBER" if kind == "QUANTITY" else "RPAR", parts[1])
            self._blank(parts[2])
            self._token(UNIT, parts[3])
        else:
            self._token(kind, text)

    def _token(self, kind: str, text: str) -> None:
        if kind in ("PLUS", "MINUS") and self.previous not in _OPERAND:
            kind = SIGN
        elif kind in ("SLASH", "CIRCUMFLEX") and self.previous == UNIT:
            kind = APART
        elif kind == "COLON" and (self.in_for or self.brackets[-1:] == ["LSQB"]):
            kind = RANGE
        elif kind in ("FOR", "LOOP"):
            self.in_for = kind == "FOR" and self.previous != "END"
        elif kind in ("RPAR", "RSQB"):
            self.brackets.pop()
        last = self.pieces[-1] if self.pieces else None
        if kind == "NUMBER" and last is not None and last.kind == SIGN and not self.lines:
            # The sign is part of the number, so that numbers line up at their ends.
            text = last.text + text
            self.column = last.column
            self.lines = last.lines
            self.pieces.pop()
        self._add(kind, text)
        self.previous = kind
        if kind in ("LPAR", "LSQB"):
            self.brackets.append(kind)

    def _add(self, kind: str, text: str) -> None:
        self.pieces.append(Piece(kind, text, self.lines, self.column, len(self.brackets)))
        self.lines = 0
        _, end_of_line, tail = text.rpartition("\n")
        self.column = columns(tail) + (0 if end_of_line else self.column)

    def _blank(self, text: str) -> None:
        ended = text.replace("\r\n", "\n").replace("\r", "\n")
        before, end_of_line, tail = ended.rpartition("\n")
        if end_of_line:
            self.column = 0
            self.lines = min(self.lines + before.count("\n") + 1, 2) if self.pieces else 0
        for character in tail:
            self.column += TAB - self.column % TAB if character == "\t" else columns(character)
