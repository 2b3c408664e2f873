"""Writes rolled functions in C: one function for all stretches of statements of the same forms.

Where the operands of a stretch lie, and where what it makes goes, follows from the turn of its loop
or stands in a table. Values that outlive their turn lie in the work array, each where the generated
code has its variable, from the statement on that sets it: no two that are needed at once share one.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from frot.compiler.product.reroll import NAMED, CStatement, StraightCode

_MARK = re.compile(r"@|#\d+")
# Numbers of a table on a line of C.
_ROW = 1000


@dataclass(slots=True, eq=False)
class _Body:
    """Statements of the same forms, and all turns of them: a function and the first place of each.

    `places`: the number of stretches of turns. `inside` is the statement of a turn that makes an
    operand (statement, slot) of it in every turn, `kept` are those whose values outlive a turn.
    """

    forms: tuple[str, ...]
    turns: list[tuple[StraightCode, int]] = field(default_factory=list)
    places: int = 0
    inside: dict[tuple[int, int], int] = field(default_factory=dict)
    kept: set[int] = field(default_factory=set)

    def every(self, k: int) -> list[CStatement]:
        """The k-th statement in every repetition."""
        return [of.statements[first + k] for of, first in self.turns]


@dataclass(frozen=True, slots=True, eq=False)
class _Piece:
    """A body in C: its function's name, and what the table has for each turn; None without one."""

    name: str
    rows: Iterator[tuple[int, ...]] | None


def write_pieces(
    functions: Iterable[StraightCode], passed: str
) -> dict[str, tuple[list[str], ...]]:
    """For each function the C of the pieces that it is the first to need, and its calls of pieces.

    `passed` are the parameters of a piece in C.
    """
    bodies: dict[tuple[str, ...], _Body] = {}
    parts: dict[str, list[tuple[_Body, int]]] = {}
    for one in functions:
        own = parts[one.name] = []
        for places, period in one.parts:
            forms = tuple(x.form for x in one.statements[places.start : places.start + period])
            body = bodies.setdefault(forms, _Body(forms))
            body.turns += [(one, first) for first in places[::period]]
            body.places += 1
            own.append((body, len(places) // period))
    _find_kept(list(bodies.values()), parts)
    pieces: dict[int, _Piece] = {}
    return {name: _function(name, own, pieces, passed) for name, own in parts.items()}


def _function(
    name: str, parts: list[tuple[_Body, int]], pieces: dict[int, _Piece], passed: str
) -> tuple[list[str], list[str]]:
    """Pieces that are new with this function, and its calls; `pieces` learns them."""
    lines: list[str] = []
    calls: list[str] = []
    table: list[int] = []
    for body, turns in parts:
        piece = pieces.get(id(body))
        if piece is None:
            written = _Writer(body)
            piece = pieces[id(body)] = _Piece(f"{name}_{len(calls)}", written.rows())
            lines += written.function(piece.name, passed)
        if piece.rows is None:
            calls.append(f"  {piece.name}(arg, res, w);")
        else:
            own = list(itertools.chain.from_iterable(itertools.islice(piece.rows, turns)))
            # stretches that lie at the same places wherever they stand need no table
            where = f"{name}_t+{len(table)}" if own else "0"
            calls.append(f"  {piece.name}(arg, res, w, {where}, {turns});")
            table += own
    if table:
        rows = [table[k : k + _ROW] for k in range(0, len(table), _ROW)]
        text = ",\n".join(",".join(map(str, row)) for row in rows)
        lines = [f"static const int {name}_t[]={{{text}}};", *lines]
    return lines, calls


def _find_kept(bodies: list[_Body], functions: Iterable[str]) -> None:
    """Find out for every operand whether a value of its own turn is meant, in all turns."""
    kept: dict[str, set[int]] = {name: set() for name in functions}
    for body in bodies:
        for k, (of, first) in itertools.product(range(len(body.forms)), body.turns[:1]):
            for slot in range(len(of.statements[first + k].operands)):
                values = [(o, o.statements[f + k].operands[slot], f) for o, f in body.turns]
                ways = {value - f for _, value, f in values}
                way = ways.pop() if len(ways) == 1 else -1
                if 0 <= way < k:
                    body.inside[k, slot] = way
                    continue
                for o, value, _ in values:
                    if value >= 0:
                        kept[o.name].add(value)
    for body in bodies:
        for of, first in body.turns:
            outlives = kept[of.name]
            body.kept.update(k for k in range(len(body.forms)) if first + k in outlives)


class _Writer:
    """Writes the function of one body."""

    def __init__(self, body: _Body) -> None:
        """Go through its statements."""
        self._body, self._shared = body, body.places > 1
        self._columns: list[list[int]] = []
        self._known: dict[tuple[int, ...], tuple[int, int]] = {}
        self._lines: list[str] = []
        self._local: list[str] = []
        for k in range(len(body.forms)):
            self._statement(k)

    def rows(self) -> Iterator[tuple[int, ...]] | None:
        """Entries of the callers' table for each repetition; None where there is one caller."""
        if not self._shared:
            return None
        count = len(self._body.turns)
        return iter(list(zip(*self._columns, strict=True)) if self._columns else [()] * count)

    def function(self, name: str, passed: str) -> list[str]:
        """The function in C, a loop where it has several turns."""
        local, turns = self._local, len(self._body.turns)
        rows = [local[k : k + 12] for k in range(0, len(local), 12)]
        inside = [*(f"    casadi_real {', '.join(row)};" for row in rows), *self._lines]
        width = len(self._columns)
        if self._shared:
            head = f"  for (int r=0; r<n; r++{f', t+={width}' if width else ''}) {{"
            return [
                f"static void {name}({passed}, const int* t, int n) {{",
                *(head, *inside, "  }", "}", ""),
            ]
        table: list[str] = []
        if width:
            values = ",".join(str(x) for row in zip(*self._columns, strict=True) for x in row)
            table = [f"static const int {name}_t[]={{{values}}};"]
            inside.insert(0, f"    const int* t={name}_t+{width}*r;")
        if turns > 1:
            inside = [f"  for (casadi_int r=0; r<{turns}; r++) {{", *inside, "  }"]
        return [*table, f"static void {name}({passed}) {{", *inside, "}", ""]

    def _statement(self, k: int) -> None:
        every = self._body.every(k)
        form, kept = every[0].form, k in self._body.kept
        if not every[0].result and NAMED.match(form) and not kept:
            return
        marks = enumerate(_MARK.findall(form))
        operands = iter([self._operand(k, slot, mark, every) for slot, mark in marks])
        text = _MARK.sub(lambda _: next(operands), form)
        if every[0].result:
            target, value = text.split("=", 1)
            self._lines.append(f"    {target}[{self._item([x.own for x in every])}]={value};")
            return
        self._local.append(f"b{k}")
        self._lines.append(f"    b{k}={text};")
        if kept:
            self._lines.append(f"    w[{self._item([x.own for x in every])}]=b{k};")

    def _operand(self, k: int, slot: int, mark: str, every: list[CStatement]) -> str:
        way = self._body.inside.get((k, slot))
        if way is not None:
            return f"b{way}"
        values = [one.operands[slot] for one in every]
        if mark != "@":
            return f"arg[{mark[1:]}][{self._item([-1 - value for value in values])}]"
        makers = zip(self._body.turns, values, strict=True)
        return f"w[{self._item([of.statements[value].own for (of, _), value in makers])}]"

    def _item(self, values: list[int]) -> str:
        """An item that depends on the turn: by a formula, or from the table."""
        first = values[0]
        ways = tuple(value - first for value in values)
        if not any(ways):
            return str(first)
        if not self._shared and all(way == ways[1] * r for r, way in enumerate(ways)):
            return f"{first}+{ways[1]}*r"
        if ways not in self._known:
            self._known[ways] = len(self._columns), first
            self._columns.append(values)
        place, begin = self._known[ways]
        beside = f"{first - begin:+d}" if first != begin else ""
        return f"t[{place}]{beside}"
