"""Functions that equal islands or parts share, and the numbers in which those differ."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import casadi as ca
from frot.compiler.symbolic.columns import dense


class Owner(Protocol):
    """What has functions of its own: their arguments, and their results by their names."""

    @property
    def arguments(self) -> list[ca.SX]:
        """Of all of them."""

    @property
    def results(self) -> dict[str, list[ca.SX]]:
        """Of each."""


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """The functions of islands or parts that are equal but for numbers, by their names.

    `varying`, of each function: the places of its finite constants, in the order of its operations,
    that are read from the owner's table, and the place there.
    """

    functions: dict[str, ca.Function]
    varying: dict[str, dict[int, int]]


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """Of an island or a part its kind and its table of numbers."""

    kind: int
    numbers: tuple[float, ...]


def share_functions(owners: Sequence[Owner]) -> tuple[tuple[Kind, ...], tuple[Member, ...]]:
    """The kinds of the owners, and these in their order."""
    classes: dict[tuple[object, ...], list[int]] = {}
    made: list[dict[str, ca.Function]] = []
    constants: list[list[tuple[str, int, float]]] = []
    for k, owner in enumerate(owners):
        functions = {
            name: ca.Function(
                f"frot_{name}_of_{k}", owner.arguments, [dense(x) for x in ca.cse(results)]
            )
            for name, results in owner.results.items()
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
            members[k] = Member(number, tuple(row[i] for i in columns))
    return tuple(kinds), tuple(members[k] for k in range(len(owners)))


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
