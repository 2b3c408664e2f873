"""The islands of a model in C: their tables, and the functions that equal ones share."""

from __future__ import annotations

import re
from collections.abc import Iterator

import casadi as ca
from frot.compiler.lowering.equals import Kind
from frot.compiler.lowering.lower import Lowered
from frot.compiler.product.c_tables import array, callable_record, number, record

# The functions of an island in the order of frot_island.
_FUNCTIONS = ("kinematics", "dynamics", "spread", "sizes")
# The argument of a shared function that is the island's table of numbers.
_NUMBERS = 7
_CONSTANT = re.compile(r"^(  a\d+=)-?[\d.]+(?:e[-+]?\d+)?;$")


def shared_functions(lowered: Lowered) -> Iterator[ca.Function]:
    """The functions of all kinds."""
    for kind in lowered.kinds:
        yield from kind.functions.values()


def read_numbers(text: str, lowered: Lowered) -> str:
    """The C text of the functions, with the constants in which equal islands differ read."""
    lines = text.split("\n")
    heads = {line.split(":", 1)[0]: k for k, line in enumerate(lines) if line.startswith("/* ")}
    for kind in lowered.kinds:
        for name, function in kind.functions.items():
            if kind.varying[name]:
                _read_in_function(lines, heads[f"/* {function.name()}"], kind, name)
    return "\n".join(lines)


def _read_in_function(lines: list[str], at: int, kind: Kind, name: str) -> None:
    """In place; `at`: the comment before the function."""
    places = kind.varying[name]
    count = 0
    for k in range(at, lines.index("}", at)):
        found = _CONSTANT.match(lines[k])
        if found is None:
            continue
        if count in places:
            lines[k] = f"{found[1]}arg[{_NUMBERS}][{places[count]}];"
        count += 1
    if count <= max(places):
        raise RuntimeError(f"CasADi wrote the constants of {name} in a way that is not known")


def island_arrays(lowered: Lowered) -> list[str]:
    """The tables of frot_island."""
    arrays: list[str] = []
    records: list[str] = []
    for k, member in enumerate(lowered.islands):
        island = member.island
        lists = (island.q, island.v, island.u, island.p, island.d, island.conditions)
        names = [f"island_{k}_{name}" for name in ("q", "v", "u", "p", "d", "conditions")]
        arrays += [
            array("int", name, [str(i) for i in items])
            for name, items in zip(names, lists, strict=True)
        ]
        arrays.append(array("double", f"island_{k}_numbers", [number(x) for x in member.numbers]))
        located = sum(i < lowered.reduced.conditions.located for i in island.conditions)
        functions = lowered.kinds[member.kind].functions
        records.append(
            record(
                *(int(island.sleeps), min(island.groups, default=0), len(island.groups)),
                *(*map(len, lists), located),
                *names,
                f"island_{k}_numbers",
                *(callable_record(functions.get(name)) for name in _FUNCTIONS),
            )
        )
    return [*arrays, array("frot_island", "islands", records)]
