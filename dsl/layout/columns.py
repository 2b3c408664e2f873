"""Columns: what an author lined up with other lines stays so, all else has its usual blanks.

Between blank lines, pieces of one kind that begin in one column (numbers: or end in one) are lined
up if the blanks before them differ. Such a column is laid out anew,
with as many blanks as its narrowest place had. As laying out can bring columns together, it is
repeated until nothing moves.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from frot.dsl.layout.blocks import INDENT
from frot.dsl.layout.pieces import Piece
from frot.dsl.layout.spacing import blanks, column_kind

_ROUNDS = 8
_CLOSING = ("RPAR", "RSQB")


@dataclass(slots=True)
class Line:
    """One line: its pieces and their columns.

    `usual` and `kinds` are the blanks before each piece and what it can line up as. A line inside
    of a statement stands `INDENT` after line `under` (below it, if it closes its bracket), or where
    one of `anchors` (line and piece) stands, if its author put it there. From piece `tail` on it
    stands behind the last line of a comment of several lines, where columns mean nothing.
    """

    pieces: list[Piece]
    columns: list[int]
    usual: list[int] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)
    under: int = -1
    tail: int = 0
    anchors: list[tuple[int, int]] = field(default_factory=list)

    def gap(self, k: int) -> int:
        """The blanks before piece `k`, which is not the first."""
        return self.columns[k] - self.columns[k - 1] - self.pieces[k - 1].width

    def move(self, k: int, column: int) -> None:
        """Put piece `k` there, and all that follow as far behind it as they are."""
        shift = column - self.columns[k]
        if shift:
            for place in range(k, len(self.columns)):
                self.columns[place] += shift


@dataclass(slots=True)
class _Column:
    """Places (line and piece) that are lined up, at their ends or their beginnings."""

    places: list[tuple[int, int]]
    at_end: bool
    blanks: int


def set_columns(pieces: list[Piece]) -> list[Line]:
    """The lines of a text, each piece in its column."""
    lines: list[Line] = []
    paragraph: list[Line] = []
    for piece in pieces:
        if piece.lines or not paragraph:
            if piece.lines == 2 and paragraph:
                lines += _settle(paragraph)
                paragraph = []
            paragraph.append(Line([], []))
        paragraph[-1].pieces.append(piece)
    return lines + _settle(paragraph)


def _settle(lines: list[Line]) -> list[Line]:
    brackets: list[tuple[int, int]] = []
    for number, line in enumerate(lines):
        _prepare(lines, number, brackets)
        line.columns = [piece.column for piece in line.pieces]
    for _ in range(_ROUNDS):
        before = [line.columns for line in lines]
        _lay_out(lines, keep=True)
        if before == [line.columns for line in lines]:
            return lines
    _lay_out(lines, keep=False)
    return lines


def _prepare(lines: list[Line], number: int, brackets: list[tuple[int, int]]) -> None:
    """Find what a line can line up with; `brackets` are those open before it, then after it."""
    line = lines[number]
    first = line.pieces[0]
    if first.inside:
        closes = first.kind in _CLOSING
        if brackets:
            line.under = brackets[-1][0]
            anchors = [brackets[-1]] if closes else _anchors(lines, number, brackets[-1])
        else:
            anchors = _anchors(lines, number, None)
        line.anchors = [(row, k) for row, k in anchors if k < lines[row].tail]
    line.tail = next((k for k, p in enumerate(line.pieces, 1) if "\n" in p.text), len(line.pieces))
    for k, piece in enumerate(line.pieces):
        if k:
            before = line.pieces[k - 1]
            line.usual.append(blanks(before, piece))
            kind = column_kind(before, piece, k + 1 == len(line.pieces))
            line.kinds.append(kind if k < line.tail else "")
        else:
            line.usual.append(0)
            line.kinds.append("")
        if piece.kind in ("LPAR", "LSQB"):
            brackets.append((number, k))
        elif piece.kind in _CLOSING and brackets:
            brackets.pop()


def _anchors(
    lines: list[Line], number: int, bracket: tuple[int, int] | None
) -> list[tuple[int, int]]:
    """The first pieces after the bracket that is open, or after an `=` or `:` at this depth."""
    found = []
    depth = lines[number].pieces[0].depth
    start = bracket[0] if bracket is not None else number - 1
    while bracket is None and start > 0 and lines[start].pieces[0].inside:
        start -= 1
    for row in range(start, number):
        pieces = lines[row].pieces
        for k in range(1, len(pieces)):
            before = pieces[k - 1]
            opened = bracket == (row, k - 1)
            declared = depth == 0 and before.kind == pieces[k].kind == "IDENT"
            named = before.depth == depth and before.kind in ("EQUAL", "COLON")
            if opened or named or declared:
                found.append((row, k))
    return found


def _lay_out(lines: list[Line], keep: bool) -> None:
    """One pass: new columns for all pieces, lined up as they are now if `keep`."""
    marks = [_mark(lines, number) if keep else None for number in range(len(lines))]
    columns = _columns(lines) if keep else []
    gaps: dict[tuple[int, int], int] = {}
    for number, line in enumerate(lines):
        for k in range(1, len(line.pieces)):
            usual = line.usual[k]
            if keep and line.kinds[k] == "comment":
                usual = max(usual, line.gap(k))
            gaps[number, k] = usual
    for column in columns:
        gaps.update(dict.fromkeys(column.places, column.blanks))
    for number, line in enumerate(lines):
        line.columns = [0] * len(line.pieces)
        for k in range(1, len(line.pieces)):
            piece = line.pieces[k - 1]
            line.columns[k] = line.columns[k - 1] + piece.width + gaps[number, k]
    for _ in range(_ROUNDS):
        before = [list(line.columns) for line in lines]
        for number in range(len(lines)):
            _set_margin(lines, number, marks[number])
        for column in columns:
            _line_up(lines, column, gaps)
        if before == [line.columns for line in lines]:
            break


def _mark(lines: list[Line], number: int) -> tuple[int, int] | None:
    """The anchor a line stands below."""
    line = lines[number]
    for row, k in reversed(line.anchors):
        if lines[row].columns[k] == line.columns[0]:
            return row, k
    return None


def _set_margin(lines: list[Line], number: int, mark: tuple[int, int] | None) -> None:
    line = lines[number]
    first = line.pieces[0]
    if mark is not None:
        margin = lines[mark[0]].columns[mark[1]]
    elif line.under >= 0:
        margin = lines[line.under].columns[0]
        margin += 0 if first.kind in _CLOSING else INDENT
    else:
        margin = first.indent + (INDENT if first.inside else 0)
    line.move(0, margin)


def _columns(lines: list[Line]) -> list[_Column]:
    """The columns there are, from left to right; of two that share places the larger one."""
    groups: dict[tuple[bool, str, int, int], list[tuple[int, int]]] = defaultdict(list)
    for number, line in enumerate(lines):
        for k, kind in enumerate(line.kinds):
            if kind:
                piece, at = line.pieces[k], line.columns[k]
                groups[False, kind, piece.depth, at].append((number, k))
                if piece.kind == "NUMBER":
                    groups[True, kind, piece.depth, at + piece.width].append((number, k))
    found: list[tuple[int, _Column]] = []
    taken: set[tuple[int, int]] = set()
    for (at_end, kind, _, _), group in sorted(groups.items(), key=lambda g: (-len(g[1]), g[0])):
        places = [place for place in group if place not in taken]
        gaps = {lines[row].gap(k) for row, k in places}
        # Blanks that are the same on all lines line nothing up.
        if len(places) > 1 and (len(gaps) > 1 or kind == "comment"):
            taken.update(places)
            first = min(lines[row].columns[k] for row, k in places)
            found.append((first, _Column(places, at_end, max(1, min(gaps)))))
    found.sort(key=lambda item: item[0])
    return [column for _, column in found]


def _line_up(lines: list[Line], column: _Column, gaps: dict[tuple[int, int], int]) -> None:
    """Move the places of a column to the leftmost one where all have their blanks."""

    def nearest(row: int, k: int) -> int:
        line = lines[row]
        return line.columns[k - 1] + line.pieces[k - 1].width + gaps[row, k]

    def width(row: int, k: int) -> int:
        return lines[row].pieces[k].width if column.at_end else 0

    target = max(nearest(*place) + width(*place) for place in column.places)
    for row, k in column.places:
        lines[row].move(k, target - width(row, k))
