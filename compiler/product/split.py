"""Cuts long functions of generated C into pieces that a C compiler takes in its stride.

CasADi writes a function of scalars as one straight line of statements over local variables; what C
compilers do with such a line takes more than proportional time and memory. A piece is a function
of its own over the same statements. Values that pass from one to a later one lie in the work
array, which CasADi makes as long as it has variables. The same operations are done in the same
order, so that not a bit of the results changes.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from frot.compiler.product.casadi_text import (
    ASSIGNED,
    DECLARATION,
    FUNCTION_HEAD,
    GIVEN,
    RESULT,
    STRAIGHT,
    VARIABLE,
)
from frot.compiler.product.outline import write_pieces
from frot.compiler.product.reroll import roll

# Statements of a piece. GCC takes least for some hundreds; a call costs nothing beside them.
LONGEST = 500
# Items of a result with one value that are written as a loop.
RUN = 4

_PASSED = "const casadi_real** arg, casadi_real** res, casadi_real* w"


def split_functions(text: str) -> str:
    """The same C with every long function of straight code in pieces."""
    lines = text.split("\n")
    found = list(_functions(lines))
    rolled = roll(((one.name, one.statements) for one in found), LONGEST)
    pieces = write_pieces(rolled.values(), _PASSED)
    made: list[str] = []
    at = 0
    for one in found:
        made += lines[at : one.places.start]
        if one.name in pieces:
            before, calls = pieces[one.name]
            made += [*before, lines[one.places.start], *calls, "  return 0;", "}"]
        else:
            made += _in_pieces(one.name, lines[one.places.start], one.statements)
        at = one.places.stop
    return "\n".join([*made, *lines[at:]])


@dataclass(frozen=True, slots=True)
class _Function:
    """A function of straight code: its lines, from its head to its closing brace."""

    name: str
    places: range
    statements: list[str]


def _functions(lines: Sequence[str]) -> Iterator[_Function]:
    at = 0
    while at < len(lines):
        head = FUNCTION_HEAD.match(lines[at])
        if head is not None:
            end = lines.index("}", at)
            statements = list(itertools.dropwhile(DECLARATION.match, lines[at + 1 : end - 1]))
            if lines[end - 1] == "  return 0;" and STRAIGHT.fullmatch("\n".join(statements)):
                yield _Function(head.group(1), range(at, end + 1), statements)
            at = end
        at += 1


def _in_pieces(name: str, head: str, statements: list[str]) -> list[str]:
    """A function that does not repeat itself."""
    short = list(_with_loops(statements))
    end = ["  return 0;", "}"]
    if len(short) <= LONGEST:
        return [head, *_declared(_names(short)), *short, *end]
    pieces = [short[k : k + LONGEST] for k in range(0, len(short), LONGEST)]
    made = []
    for k, piece in enumerate(_with_passed(pieces)):
        made += [f"static void {name}_{k}({_PASSED}) {{", *piece, "}", ""]
    calls = [f"  {name}_{k}(arg, res, w);" for k in range(len(pieces))]
    return [*made, head, *calls, *end]


def _with_loops(statements: list[str]) -> Iterator[str]:
    """The statements, runs of one value in consecutive items of a result as loops."""
    run: list[str] = []
    first, result, value = 0, "", ""

    def told() -> Iterator[str]:
        if len(run) < RUN:
            yield from run
            return
        each = f"res[{result}][k]={value};"
        yield f"  for (casadi_int k={first}; k<{first + len(run)}; k++) {each}"

    for line in statements:
        found = RESULT.match(line) if line.startswith("  res") else None
        if found is None and not run:
            yield line
            continue
        if found is None or (found[1], int(found[2]), found[3]) != (
            result,
            first + len(run),
            value,
        ):
            yield from told()
            run = []
        if found is None:
            yield line
            result = ""
        else:
            if not run:
                result, first, value = found[1], int(found[2]), found[3]
            run.append(line)
    yield from told()


def _with_passed(pieces: list[list[str]]) -> Iterator[list[str]]:
    """The pieces with what they take at the start, and leave in the work array at the end.

    An argument or a number is read again.
    """
    own = [_reads_and_sets(piece) for piece in pieces]
    later: set[str] = set()
    wanted: list[set[str]] = []
    for reads, sets in reversed(own):
        wanted.append(later)
        later = (later - sets) | reads
    known: dict[str, str] = {}
    for piece, (reads, sets), after in zip(pieces, own, reversed(wanted), strict=True):
        taken = [f"  a{x}={known.get(x, f'w[{int(x)}]')};" for x in sorted(reads)]
        for name, value in ASSIGNED.findall("\n".join(piece)):
            known.pop(name, None)
            if GIVEN.match(value):
                known[name] = value
        left = [f"  w[{int(x)}]=a{x};" for x in sorted(sets & after) if x not in known]
        yield [*_declared(_names([*piece, *taken])), *taken, *piece, *left]


def _reads_and_sets(piece: list[str]) -> tuple[set[str], set[str]]:
    """The variables that a piece reads before it sets them, and those that it sets."""
    reads: set[str] = set()
    sets: set[str] = set()
    for line in piece:
        names = VARIABLE.findall(line)
        # the first is the one that is set
        own = [names.pop(0)] if line.startswith("  a") else []
        reads.update(x for x in names if x not in sets)
        sets.update(own)
    return reads, sets


def _names(statements: Iterable[str]) -> list[str]:
    return sorted(set(VARIABLE.findall("\n".join(statements))))


def _declared(names: list[str]) -> list[str]:
    rows = [names[k : k + 12] for k in range(0, len(names), 12)]
    return [f"  casadi_real {', '.join(f'a{x}' for x in row)};" for row in rows]
