"""The blanks between two pieces on one line, and which of them can line up with other lines."""

from __future__ import annotations

from frot.dsl.layout.pieces import COMMENT, RANGE, SIGN, UNIT, Piece

_OPENING = frozenset(["LPAR", "LSQB"])
_CLOSING = frozenset(["RPAR", "RSQB", "COMMA", "SEMICOLON", "COLON", RANGE])
_TIGHT = frozenset(["STAR", "SLASH", "CIRCUMFLEX", "DOT", RANGE])
_CALLED = frozenset(["IDENT", "RPAR", "RSQB", "ROTATED", "DRIVEN"])
_OPERATORS = frozenset(["+", "-", "<", ">", "<=", ">=", "==", "<>", "and", "or", "/", "^"])


def blanks(before: Piece, piece: Piece) -> int:
    """How many blanks stand between two pieces that line up with nothing: 0 or 1."""
    last, kind = before.kind, piece.kind
    if COMMENT in (last, kind):
        # A slash and a comment glued together would be another comment.
        tight = piece.text[:2] == "/*" if last in _OPENING else kind in _CLOSING
        return 0 if tight else 1
    if last in _OPENING or kind in _CLOSING or last in _TIGHT or kind in _TIGHT or last == SIGN:
        return 0
    if kind in _OPENING:
        return 0 if last in _CALLED else 1
    # After a blank a name would be the unit of what is in the parentheses.
    return 0 if kind == "DOT_STAR" or (last == "RPAR" and kind == "IDENT") else 1


def column_kind(before: Piece, piece: Piece, is_last: bool) -> str:
    """The kind of column that aligns here with other lines; empty where none does."""
    last, kind = before.kind, piece.kind
    if kind == COMMENT:
        return "comment" if is_last else ""
    if last == COMMENT or not blanks(before, piece):
        return ""
    if kind in ("EQUAL", "STRING", UNIT):
        return kind
    if last in ("EQUAL", "COLON", "COMMA", "SEMICOLON"):
        return f"after {last}"
    if before.text in _OPERATORS or piece.text in _OPERATORS:
        return "operator" if piece.text in _OPERATORS else "operand"
    return "name" if kind == "IDENT" else "word"
