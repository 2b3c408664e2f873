"""Accelerations and reactions as formulas of the state, where nothing can switch them.

With ideal liaisons alone every row always holds, so that the core system and its rows

    A z - E lam = h,    J z = -c

give z and lam by elimination. What reads a reaction can then be differentiated, or be a condition.
Where friction or a contact that parts takes part, they depend on the modes, and there is no such
formula.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.solve import solve_in_units
from frot.dsl.checked import Literal

# Unknowns of the core and rows together; elimination takes their third power in operations.
_LARGEST = 40


def make_explicit(system: Assembled) -> Callable[[ca.SX], ca.SX]:
    """A function that puts the formulas into an expression of z and lam; else leaves it."""
    joints = system.reduced.mechanism.contacts
    both = ca.vertcat(system.z, system.lam)
    solvable = 0 < both.numel() <= _LARGEST
    if not solvable or system.elements or not all(map(_always_holds, joints)):
        return lambda value: value
    solved: list[ca.SX] = []

    def put(value: ca.SX) -> ca.SX:
        if not value.numel() or not ca.depends_on(value, both):
            return value
        if not solved:
            solved.append(_solution(system))
        return ca.substitute(value, both, solved[0])

    return put


def _always_holds(joint: Constraint) -> bool:
    unilateral = joint.unilateral
    bilateral = isinstance(unilateral, Literal) and unilateral.value is False
    return bilateral and not joint.frictions


def _solution(system: Assembled) -> ca.SX:
    rows = system.lam.numel()
    core, force = system.in_full()
    matrix = ca.blockcat(
        [[core, -system.matrices.spread], [system.matrices.rows, ca.SX(rows, rows)]]
    )
    matrix, right = ca.sparsify(matrix), ca.vertcat(force, -system.matrices.bias)
    solution = ca.SX.zeros(right.shape)
    for part in _apart(matrix.sparsity()):
        solution[part] = solve_in_units(matrix[part, part], right[part])
    return solution


def _apart(pattern: ca.Sparsity) -> list[list[int]]:
    """Unknowns in parts that do not act on each other: a formula of one reads no other."""
    part = list(range(pattern.size1()))

    def root(k: int) -> int:
        while part[k] != k:
            k = part[k]
        return k

    for i, j in zip(*pattern.get_triplet(), strict=True):
        part[root(i)] = root(j)
    found: dict[int, list[int]] = {}
    for k in range(len(part)):
        found.setdefault(root(k), []).append(k)
    return list(found.values())
