"""Finds where long straight functions of generated C do the same again and again.

A model of many parts of few kinds gives straight lines of statements that repeat, with other
operands, for each part. Such a stretch becomes one function over the statements of a period,
called in a loop; what is the same at several places, of one function or of many, becomes one
function too (`pieces.py`). So C and the time to compile it grow with the kinds of parts. The same
operations are done in the same order: not a bit of the results changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from frot.compiler.product.casadi_text import ASSIGNMENT, OPERAND, RESULT

# Statements of a function from which on it is worth looking: straight lines run faster than loops
# over tables, and a C compiler takes so many in half a second. The longest period looked for, and
# the fewest turns of a loop.
LEAST, PERIOD, TURNS = 4000, 700, 6
# Statements of all functions from which on shorter ones are examined too, and what repeats less.
MANY, SHORT, FEW = 20_000, 250, 2
# Statements of a stretch that is worth a function, and of what is looked for at other places.
_WORTH = 8

NAMED = re.compile(r"(#\d+|-?[\d.]+(e[-+]?\d+)?)$")


@dataclass(frozen=True, slots=True)
class CStatement:
    """One statement: `form` has a mark for each operand and for the item of a result it sets.

    `operands`: the statement that made the value, or -1 - item for an item of an argument; `own`:
    the variable set, or the item of the result.
    """

    form: str
    operands: tuple[int, ...]
    own: int
    result: bool


# Statements with the period of what repeats in them: their number where nothing does.
Part = tuple[range, int]


@dataclass(frozen=True, slots=True, eq=False)
class StraightCode:
    """A function as statements in single assignment, and the parts that it is made of."""

    name: str
    statements: tuple[CStatement, ...]
    parts: tuple[Part, ...]


def roll(functions: Iterable[tuple[str, Sequence[str]]], longest: int) -> dict[str, StraightCode]:
    """The functions that repeat much, by their names; parts that do not are at most `longest`.

    A function is its name and the lines of its statements.
    """
    texts = dict(functions)
    many = sum(map(len, texts.values())) >= MANY
    least, turns = (SHORT, FEW) if many else (LEAST, TURNS)
    rolled: dict[str, tuple[list[CStatement], list[Part]]] = {}
    for name, lines in texts.items():
        if len(lines) < least:
            continue
        statements = _parse(lines)
        found = _stretches([one.form for one in statements], turns)
        if 2 * sum(len(places) for places, _ in found) >= len(statements):
            rolled[name] = statements, found
    known = _bodies(rolled.values())
    return {
        name: StraightCode(name, tuple(own), tuple(_parts(own, found, known, longest)))
        for name, (own, found) in rolled.items()
    }


def _bodies(
    rolled: Iterable[tuple[list[CStatement], list[Part]]],
) -> dict[str, list[tuple[str, ...]]]:
    """The forms of what repeats, by their first, the longest first."""
    found = {
        tuple(one.form for one in own[places.start : places.start + period])
        for own, stretches in rolled
        for places, period in stretches
        if period >= _WORTH
    }
    by_first: dict[str, list[tuple[str, ...]]] = {}
    for body in sorted(found, key=lambda body: (-len(body), body)):
        by_first.setdefault(body[0], []).append(body)
    return by_first


def _parts(
    own: Sequence[CStatement],
    found: Sequence[Part],
    known: dict[str, list[tuple[str, ...]]],
    longest: int,
) -> Iterator[Part]:
    """The function's parts in order, those between what repeats looked through too."""
    at = 0
    for places, period in (*found, (range(len(own), len(own)), 0)):
        yield from _between(own, range(at, places.start), known, longest)
        if period:
            yield places, period
        at = places.stop


def _between(
    own: Sequence[CStatement],
    places: range,
    known: dict[str, list[tuple[str, ...]]],
    longest: int,
) -> Iterator[Part]:
    """Parts of a stretch that does not repeat: what repeats elsewhere, and what is between."""
    first = at = places.start

    def plain(stop: int) -> Iterator[Part]:
        for k in range(first, stop, longest):
            whole = range(k, min(k + longest, stop))
            yield whole, len(whole)

    while at < places.stop:
        body = next((b for b in known.get(own[at].form, ()) if _is_at(own, at, b, places)), None)
        if body is None:
            at += 1
            continue
        yield from plain(at)
        first = at
        while _is_at(own, at, body, places):
            at += len(body)
        yield range(first, at), len(body)
        first = at
    yield from plain(places.stop)


def _is_at(own: Sequence[CStatement], at: int, body: tuple[str, ...], places: range) -> bool:
    return at + len(body) <= places.stop and all(
        own[at + k].form == form for k, form in enumerate(body)
    )


def _parse(statements: Sequence[str]) -> list[CStatement]:
    """In single assignment: operands are the statements that made them.

    An argument or a number that was only named is put in where it is used.
    """
    made: dict[str, int] = {}
    given: dict[str, tuple[str, int | None]] = {}
    parsed: list[CStatement] = []
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
        found = ASSIGNMENT.match(line)
        result = None if found else RESULT.match(line)
        operands.clear()
        if found:
            form = OPERAND.sub(mark, found[2])
            made[found[1]] = k
            given.pop(found[1], None)
            if NAMED.match(form):
                named = f"({form})" if form.startswith("-") else form
                given[found[1]] = named, operands[0] if operands else None
            parsed.append(CStatement(form, tuple(operands), int(found[1]), False))
        else:
            assert result is not None
            form = f"res[{result[1]}]={OPERAND.sub(mark, result[3])}"
            parsed.append(CStatement(form, tuple(operands), int(result[2]), True))
    return parsed


def _stretches(forms: Sequence[str], turns: int) -> list[Part]:
    """Stretches that repeat with a period, whole turns only, the longest first taken."""
    kinds = {form: k for k, form in enumerate(dict.fromkeys(forms))}
    line = np.array([kinds[form] for form in forms], dtype=np.int32)
    candidates: list[tuple[int, int, int]] = []
    for period in range(1, min(PERIOD, len(line) // turns) + 1):
        same = np.concatenate(([False], line[:-period] == line[period:], [False]))
        edges = np.flatnonzero(same[1:] != same[:-1])
        first, last = edges[::2], edges[1::2]
        long = np.flatnonzero(last - first >= max((turns - 1) * period, _WORTH - period))
        candidates += [(int(first[k]), int(last[k]) + period, period) for k in long]
    candidates.sort(key=lambda c: (c[0] - c[1], c[2]))
    free = np.ones(len(line), dtype=bool)
    taken: list[Part] = []
    for start, stop, period in candidates:
        inside = np.flatnonzero(free[start:stop])
        if not len(inside):
            continue
        # the first piece of it that is free
        begin = start + int(inside[0])
        covered = np.flatnonzero(~free[begin:stop])
        end = begin + int(covered[0]) if len(covered) else stop
        end = begin + (end - begin) // period * period
        if end - begin >= max(turns * period, _WORTH):
            taken.append((range(begin, end), period))
            free[begin:end] = False
    return sorted(taken, key=lambda part: part[0].start)
