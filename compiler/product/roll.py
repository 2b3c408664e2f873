"""Rolls long straight functions of generated C into loops where they do the same again and again.

A model of many parts of few kinds gives one straight line of statements that repeats, with other
arguments, for each part. Such a stretch becomes one function over the statements of a period,
called in a loop; where its operands lie, and where what it makes goes, follows from the turn of the
loop or stands in a table. So C and the time to compile it grow with the kinds of parts. The same
operations are done in the same order: not a bit of the results changes.

Values that outlive their turn lie in the work array, each where the generated code has its
variable: no two that are needed at once share one.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from frot.dsl.data.classes import dataclass

# Statements of a function from which on it is worth looking, the longest period looked for, and the
# fewest turns of a loop.
LEAST, PERIOD, TURNS = 1000, 700, 6

_OPERAND = re.compile(r"\ba(\d+)\b|\barg\[(\d+)\]\[(\d+)\]")
_SET = re.compile(r"^  a(\d+)=(.*);$")
_RESULT = re.compile(r"^  res\[(\d+)\]\[(\d+)\]=(a\d+);$")
_NAMED = re.compile(r"(#\d+|-?[\d.]+(e[-+]?\d+)?)$")


@dataclass(frozen=True, slots=True)
class _Statement:
    """One statement: `form` has a mark for each operand and for the item of a result it sets.

    `operands`: the statement that made the value, or -1 - item for an item of an argument; `own`:
    the variable set, or the item of the result.
    """

    form: str
    operands: tuple[int, ...]
    own: int
    result: bool


def roll(name: str, statements: Sequence[str], passed: str) -> Roller | None:
    """What writes the functions of a function `name` whose statements repeat; None if few do.

    `passed` are the parameters of a piece in C.
    """
    if len(statements) < LEAST:
        return None
    parsed = _parse(statements)
    found = _stretches([statement.form for statement in parsed])
    if sum(len(places) for places, _ in found) < len(statements) // 2:
        return None
    return Roller(name, parsed, passed, _parts(found, len(statements)))


def _parts(found: Sequence[tuple[range, int]], count: int) -> list[range | tuple[range, int]]:
    """Stretches of the statements in order: with a period where they repeat."""
    parts: list[range | tuple[range, int]] = []
    at = 0
    for places, period in found:
        if places.start > at:
            parts.append(range(at, places.start))
        parts.append((places, period))
        at = places.stop
    if at < count:
        parts.append(range(at, count))
    return parts


def _parse(statements: Sequence[str]) -> list[_Statement]:
    """In single assignment: operands are the statements that made them.

    An argument or a number that was only named is put in where it is used.
    """
    made: dict[str, int] = {}
    given: dict[str, tuple[str, int | None]] = {}
    parsed: list[_Statement] = []
    operands: list[int] = []

    def mark(x: re.Match[str]) -> str:
        if x[1] is None:
            operands.append(-1 - int(x[3]))
            return f"#{x[2]}"
        if x[1] not in given:
            operands.append(made[x[1]])
            return "@"
        form, operand = given[x[1]]
        if operand is not None:
            operands.append(operand)
        return form

    for k, line in enumerate(statements):
        found = _SET.match(line)
        result = None if found else _RESULT.match(line)
        operands.clear()
        if found:
            form = _OPERAND.sub(mark, found[2])
            made[found[1]] = k
            given.pop(found[1], None)
            if _NAMED.match(form):
                named = f"({form})" if form.startswith("-") else form
                given[found[1]] = named, operands[0] if operands else None
            parsed.append(_Statement(form, tuple(operands), int(found[1]), False))
        else:
            assert result is not None
            form = f"res[{result[1]}]={_OPERAND.sub(mark, result[3])}"
            parsed.append(_Statement(form, tuple(operands), int(result[2]), True))
    return parsed


def _stretches(forms: Sequence[str]) -> list[tuple[range, int]]:
    """Stretches that repeat with a period, whole turns only, the longest first taken."""
    kinds = {form: k for k, form in enumerate(dict.fromkeys(forms))}
    line = np.array([kinds[form] for form in forms], dtype=np.int32)
    candidates: list[tuple[int, int, int]] = []
    for period in range(1, min(PERIOD, len(line) // TURNS) + 1):
        same = np.concatenate(([False], line[:-period] == line[period:], [False]))
        edges = np.flatnonzero(same[1:] != same[:-1])
        first, last = edges[::2], edges[1::2]
        long = np.flatnonzero(last - first >= (TURNS - 1) * period)
        candidates += [(int(first[k]), int(last[k]) + period, period) for k in long]
    candidates.sort(key=lambda c: (c[0] - c[1], c[2]))
    free = np.ones(len(line), dtype=bool)
    taken: list[tuple[range, int]] = []
    for start, stop, period in candidates:
        inside = np.flatnonzero(free[start:stop])
        if not len(inside):
            continue
        # the first piece of it that is free
        begin = start + int(inside[0])
        covered = np.flatnonzero(~free[begin:stop])
        end = begin + int(covered[0]) if len(covered) else stop
        end = begin + (end - begin) // period * period
        if end - begin >= TURNS * period:
            taken.append((range(begin, end), period))
            free[begin:end] = False
    return sorted(taken, key=lambda part: part[0].start)


class Roller:
    """Writes the functions of one straight function that is rolled."""

    def __init__(
        self,
        name: str,
        statements: Sequence[_Statement],
        passed: str,
        parts: Sequence[range | tuple[range, int]],
    ) -> None:
        """Made by `roll`; `parts` are stretches in order, with a period where they repeat."""
        self._name, self._passed = name, passed
        self._all, self._parts = statements, parts

    def write(self, longest: int) -> tuple[list[str], list[str]]:
        """C of the pieces, and the names of their functions in the order of the calls."""
        pieces: list[tuple[range, int]] = []
        for part in self._parts:
            if isinstance(part, tuple):
                pieces.append(part)
                continue
            for k in range(part.start, part.stop, longest):
                whole = range(k, min(k + longest, part.stop))
                pieces.append((whole, len(whole)))
        self._kept = self._outliving(pieces)
        made: list[str] = []
        names: list[str] = []
        for places, period in pieces:
            names.append(f"{self._name}_{len(names)}")
            made += self._piece(names[-1], places, period)
        return made, names

    def _outliving(self, pieces: Sequence[tuple[range, int]]) -> set[int]:
        """The statements whose values are read outside the turn that makes them."""
        kept: set[int] = set()
        for places, period in pieces:
            for k in range(period):
                for slot in range(len(self._all[places.start + k].operands)):
                    if self._inside(places, period, k, slot) is None:
                        column = (self._all[i].operands[slot] for i in places[k::period])
                        kept.update(value for value in column if value >= 0)
        return kept

    def _inside(self, places: range, period: int, k: int, slot: int) -> int | None:
        """The statement of the period that makes an operand of its k-th, in every turn."""
        offsets = {
            self._all[places.start + first + k].operands[slot] - places.start - first
            for first in range(0, len(places), period)
        }
        if len(offsets) != 1:
            return None
        offset = offsets.pop()
        return offset if 0 <= offset < k else None

    def _piece(self, name: str, places: range, period: int) -> list[str]:
        """A function of one stretch: a loop where it has several turns."""
        turns = len(places) // period
        columns: list[list[int]] = []

        def where(values: list[int]) -> str:
            """An item that depends on the turn: by a formula, or from the table."""
            steps = {b - a for a, b in itertools.pairwise(values)}
            if len(steps) <= 1:
                step = steps.pop() if steps else 0
                return str(values[0]) if step == 0 else f"{values[0]}+{step}*r"
            if values not in columns:
                columns.append(values)
            return f"t[{columns.index(values)}]"

        body: list[str] = []
        local: list[str] = []
        for k in range(period):
            own = self._all[places.start + k]
            text = self._text(places, period, k, where)
            items = where([self._all[i].own for i in places[k::period]])
            if own.result:
                target, value = text.split("=", 1)
                body.append(f"    {target}[{items}]={value};")
                continue
            if _NAMED.match(own.form) and not self._is_kept(places, period, k):
                continue
            local.append(f"b{k}")
            body.append(f"    b{k}={text};")
            if self._is_kept(places, period, k):
                body.append(f"    w[{items}]=b{k};")
        rows = [local[k : k + 12] for k in range(0, len(local), 12)]
        table: list[str] = []
        if columns:
            values = ",".join(str(column[r]) for r in range(turns) for column in columns)
            table = [f"static const int {name}_t[]={{{values}}};"]
            body.insert(0, f"    const int* t={name}_t+{len(columns)}*r;")
        inside = [*(f"    casadi_real {', '.join(row)};" for row in rows), *body]
        if turns > 1:
            inside = [f"  for (casadi_int r=0; r<{turns}; r++) {{", *inside, "  }"]
        return [*table, f"static void {name}({self._passed}) {{", *inside, "}", ""]

    def _is_kept(self, places: range, period: int, k: int) -> bool:
        return any(i in self._kept for i in places[k::period])

    def _text(self, places: range, period: int, k: int, where: Callable[[list[int]], str]) -> str:
        """What the k-th statement of a period computes in C."""
        operands = self._operands(places, period, k, where)
        return re.sub(r"@|#\d+", lambda _: next(operands), self._all[places.start + k].form)

    def _operands(
        self, places: range, period: int, k: int, where: Callable[[list[int]], str]
    ) -> Iterator[str]:
        """The operands of the k-th statement of a period in C."""
        own = self._all[places.start + k]
        for slot, mark in enumerate(re.findall(r"@|#\d+", own.form)):
            values = [self._all[i].operands[slot] for i in places[k::period]]
            if mark != "@":
                yield f"arg[{mark[1:]}][{where([-1 - v for v in values])}]"
                continue
            inside = self._inside(places, period, k, slot)
            if inside is not None:
                yield f"b{inside}"
            else:
                yield f"w[{where([self._all[v].own for v in values])}]"
