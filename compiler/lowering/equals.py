"""Functions that equal islands share, and the numbers in which those differ."""

from __future__ import annotations

import math
from collections.abc import Sequence

import casadi as ca
from frot.compiler.lowering.islands import Island
from frot.dsl.data.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """The functions of islands that are equal but for numbers, by their names in the contract.

    `varying`, of each function: the places of its finite constants, in the order of its operations,
    that are read from the island's table, and the place there.
    """

    functions: dict[str, ca.Function]
    varying: dict[str, dict[int, int]]


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """An island, its kind and its table of numbers."""

    island: Island
    kind: int
    numbers: tuple[float, ...]


def share_functions(islands: Sequence[Island]) -> tuple[tuple[Kind, ...], tuple[Member, ...]]:
    """The kinds of the islands, and these in their order."""
    classes: dict[tuple[object, ...], list[int]] = {}
    made: list[dict[str, ca.Function]] = []
    constants: list[list[tuple[str, int, float]]] = []
    for k, island in enumerate(islands):
        functions = {
            name: ca.Function(
                f"frot_{name}_of_{k}", island.arguments, [ca.densify(x) for x in ca.cse(results)]
            )
            for name, results in island.results.items()
        }
        shape: list[object] = []
        own: list[tuple[str, int, float]] = []
        for name, function in functions.items():
            operations, values = _read(function)
            shape += [name, *(function.size1_in(i) for i in range(function.n_in())), operations]
            own += [(name, i, value) for i, value in enumerate(values)]
        classes.setdefault(tuple(shape), []).append(k)
        made.append(functions)
        constants.append(own)
    kinds: list[Kind] = []
    members: dict[int, Member] = {}
    for number, equal in enumerate(classes.values()):
        rows = [[value for _, _, value in constants[k]] for k in equal]
        columns = [i for i, values in enumerate(zip(*rows, strict=True)) if len(set(values)) > 1]
        varying: dict[str, dict[int, int]] = {name: {} for name in made[equal[0]]}
        for place, i in enumerate(columns):
            name, at, _ = constants[equal[0]][i]
            varying[name][at] = place
        kinds.append(Kind(made[equal[0]], varying))
        for k, row in zip(equal, rows, strict=True):
            members[k] = Member(islands[k], number, tuple(row[i] for i in columns))
    return tuple(kinds), tuple(members[k] for k in range(len(islands)))


def _read(function: ca.Function) -> tuple[tuple[object, ...], list[float]]:
    """The operations of a function without its finite constants, and these."""
    operations: list[object] = []
    constants: list[float] = []
    for k in range(function.n_instructions()):
        operation = function.instruction_id(k)
        operations += [
            operation,
            *function.instruction_output(k),
            *function.instruction_input(k),
        ]
        if operation != ca.OP_CONST:
            continue
        value = function.instruction_constant(k)
        if math.isfinite(value):
            constants.append(value)
        else:
            operations.append(repr(value))
    return tuple(operations), constants
