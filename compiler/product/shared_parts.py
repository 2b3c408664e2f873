"""The islands and parts of a model in C: their tables, and the functions that equal ones share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import casadi as ca
from frot.compiler.lowering.lower import Lowered
from frot.compiler.product.c_tables import array, callable_record, number, record
from frot.compiler.product.casadi_text import CONSTANT
from frot.compiler.product.extended_precision import WIDE, wide_record
from frot.compiler.symbolic.shared_functions import Kind

# The functions of an island in the order of frot_island.
_FUNCTIONS = ("kinematics", "dynamics", "spread", "sizes")
# Those of a part in the order of frot_part, and its lists.
_OF_PARTS = ("stating", "guessing", "sides", "slopes")
_LISTS = ("turns", "groups", "islands", "contacts", "stated", "guessed", "vectors", "blocks", "y")
# The places that frot_reads gives.
_READS = ("q", "v", "u", "p", "d")
# The argument of a shared function that is the owner's table of numbers.
_NUMBERS = 7


def shared_functions(lowered: Lowered) -> Iterator[tuple[str, ca.Function]]:
    """The functions of all kinds, by their names."""
    for kind in lowered.shared.kinds:
        yield from kind.functions.items()


def read_numbers(text: str, lowered: Lowered) -> str:
    """The C text of some functions, with the constants in which equal ones differ read."""
    lines = text.split("\n")
    heads = {line.split(":", 1)[0]: k for k, line in enumerate(lines) if line.startswith("/* ")}
    for kind in lowered.shared.kinds:
        for name, function in kind.functions.items():
            at = heads.get(f"/* {function.name()}")
            if kind.varying[name] and at is not None:
                _read_in_function(lines, at, kind, name)
    return "\n".join(lines)


def _read_in_function(lines: list[str], at: int, kind: Kind, name: str) -> None:
    """In place; `at`: the comment before the function."""
    places = kind.varying[name]
    count = 0
    for k in range(at, lines.index("}", at)):
        found = CONSTANT.match(lines[k])
        if found is None:
            continue
        if count in places:
            lines[k] = f"{found[1]}arg[{_NUMBERS}][{places[count]}];"
        count += 1
    if count <= max(places):
        raise RuntimeError(f"CasADi wrote the constants of {name} in a way that is not known")


def _reads(lists: Mapping[str, Sequence[int]], names: Mapping[str, str], numbers: str) -> str:
    """A frot_reads: the lists of these names, and the table of numbers."""
    counts, places = (len(lists[x]) for x in _READS), (names[x] for x in _READS)
    return record(*counts, *places, numbers)


def _callables(functions: Mapping[str, ca.Function], wide: Mapping[str, str]) -> list[str]:
    """Callables of an island; `wide`: names in C of the functions in wide numbers."""
    plain = [callable_record(functions.get(name)) for name in _FUNCTIONS]
    return [*plain, wide_record(functions.get(WIDE), wide)]


def island_arrays(lowered: Lowered, wide: Mapping[str, str]) -> list[str]:
    """The tables of frot_island; `wide`: names in C of the functions in wide numbers."""
    arrays: list[str] = []
    records: list[str] = []
    for k, (island, member) in enumerate(lowered.shared.islands):
        lists = {x: getattr(island, x) for x in (*_READS, "conditions")}
        names = {x: f"island_{k}_{x}" for x in lists}
        arrays += [array("int", names[x], [str(i) for i in own]) for x, own in lists.items()]
        numbers = f"island_{k}_numbers"
        arrays.append(array("double", numbers, [number(x) for x in member.numbers]))
        located = sum(i < lowered.reduced.conditions.located for i in island.conditions)
        functions = lowered.shared.kinds[member.kind].functions
        records.append(
            record(
                *(int(island.sleeps), min(island.groups, default=0), len(island.groups)),
                *(len(island.conditions), located, names["conditions"]),
                _reads(lists, names, numbers),
                *_callables(functions, wide),
            )
        )
    return [*arrays, array("frot_island", "islands", records)]


def part_arrays(lowered: Lowered) -> list[str]:
    """The tables of frot_part: of places, of speeds."""
    arrays = [array("int", "of_no_part", [])]
    for name, prefix, parts in (
        ("parts", "place", lowered.shared.parts),
        ("speed_parts", "speed", lowered.shared.speed_parts),
    ):
        records: list[str] = []
        for k, (part, member) in enumerate(parts):
            lists = {x: getattr(part, x) for x in (*_LISTS, *_READS)}
            names = {x: f"{prefix}_{k}_{x}" if own else "of_no_part" for x, own in lists.items()}
            for x, own in lists.items():
                arrays += [array("int", names[x], [str(i) for i in own])] if own else []
            numbers = f"{prefix}_{k}_numbers" if member.numbers else "0"
            if member.numbers:
                arrays.append(array("double", numbers, [number(x) for x in member.numbers]))
            functions = lowered.shared.kinds[member.kind].functions
            records.append(
                record(
                    *(
                        part.n_unknowns,
                        *(len(lists[x]) for x in _LISTS if x not in ("vectors", "y")),
                    ),
                    *(part.n_own, len(part.y)),
                    *(names[x] for x in _LISTS),
                    _reads(lists, names, numbers),
                    *(callable_record(functions.get(f"{prefix}_{x}")) for x in _OF_PARTS),
                )
            )
        arrays.append(array("frot_part", name, records))
    return arrays
