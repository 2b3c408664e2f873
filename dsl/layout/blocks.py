"""Where each statement stands: its margin, and what has a line to itself."""

from __future__ import annotations

from dataclasses import dataclass, field

from frot.dsl.layout.pieces import COMMENT, Piece

INDENT = 2
_DEFINITIONS = frozenset(
    ["PLANAR", "PARTIAL", "MODEL", "CONNECTOR", "RECORD", "FUNCTION", "PACKAGE", "SHAPE"]
)
_WITH_FORMALS = frozenset(["LIAISON", "JOINT", "LAW", "LOI"])


@dataclass(slots=True)
class _Block:
    """An open definition, `when`, `if` or `for`.

    `breaks` are the tokens that begin a line if the block is `broken`: written on several lines.
    """

    margin: int
    broken: bool
    first: int
    breaks: list[int] = field(default_factory=list)


def set_margins(pieces: list[Piece]) -> None:
    """Set `indent` and `inside` of each piece, and the ends of line that the blocks need.

    A definition's header, `end` and sections stand on lines of their own; so do those of another
    block, unless all of it stands on one line. Other ends of line are the author's.
    """
    places = [k for k, piece in enumerate(pieces) if piece.kind != COMMENT]
    kinds = [pieces[k].kind for k in places]
    blocks: list[_Block] = []
    first = 0
    while first < len(kinds):
        last = _last(kinds, first)
        kind = kinds[first]
        contents = blocks[-1].margin + INDENT if blocks else 0
        margin = contents
        if kind in ("INITIAL", "EQUATION", "END", "ELSE", "ELSEIF", "ELSEWHEN") and blocks:
            margin = blocks[-1].margin
            blocks[-1].breaks += (first, last + 1)
        if _opens(kinds, first):
            definition = kind not in ("WHEN", "IF", "FOR")
            blocks.append(_Block(margin, definition, first, [first, last + 1]))
        elif kind == "END" and blocks:
            block = blocks.pop()
            inner = pieces[places[block.first] + 1 : places[last] + 1]
            if block.broken or any(piece.lines for piece in inner):
                for token in block.breaks:
                    _break_before(pieces, places, token)
        _place(pieces, places, first, last, margin, contents)
        first = last + 1


def _place(
    pieces: list[Piece], places: list[int], first: int, last: int, margin: int, contents: int
) -> None:
    """Set the margin of a statement and of the comments before it."""
    start = places[first]
    before = places[first - 1] + 1 if first else 0
    for comment in pieces[before:start]:
        comment.indent = margin if comment.column == pieces[start].column else contents
    for piece in pieces[start : places[last] + 1]:
        piece.indent = margin
        piece.inside = True
    pieces[start].inside = False
    for piece in pieces[start + 1 : places[last] + 1]:
        piece.lines = min(piece.lines, 1)


def _break_before(pieces: list[Piece], places: list[int], token: int) -> None:
    """Begin a line with a token, unless a comment before it does."""
    if 0 < token < len(places):
        between = pieces[places[token - 1] + 1 : places[token] + 1]
        if not any(piece.lines for piece in between):
            between[-1].lines = 1


def _opens(kinds: list[str], first: int) -> bool:
    """Whether a statement is the header of a block."""
    kind = kinds[first]
    if kind in _WITH_FORMALS:
        return kinds[first + 2] == "LPAR"
    return kind in _DEFINITIONS or kind in ("WHEN", "IF", "FOR")


def _last(kinds: list[str], first: int) -> int:
    """The last token of a statement, or of the header of a block."""
    kind = kinds[first]
    if kind in ("INITIAL", "EQUATION", "ELSE"):
        return first
    if kind in ("WHEN", "IF", "ELSEIF", "ELSEWHEN"):
        return _then(kinds, first)
    if kind == "FOR":
        return kinds.index("LOOP", first)
    if not _opens(kinds, first):
        return kinds.index("SEMICOLON", first)
    last = kinds.index("IDENT", first)
    if kinds[first] in _WITH_FORMALS or kinds[first] == "SHAPE":
        depth = 1
        last += 1
        while depth:
            last += 1
            depth += (kinds[last] == "LPAR") - (kinds[last] == "RPAR")
    return last + 1 if kinds[last + 1] == "STRING" else last


def _then(kinds: list[str], first: int) -> int:
    """The `then` of a header, whose condition may hold others."""
    last, inner = first + 1, 0
    while inner or kinds[last] != "THEN":
        inner += (kinds[last] == "IF") - (kinds[last] == "THEN")
        last += 1
    return last
