"""The tables and the numbers of large trees, as the kernel goes along them (articulated.h).

Of each step: the columns of its speeds, the vector from the step before, mass, moment and inertia
of its own bodies, the force and couple that keep their motion. In the plane vectors have two
components, and what turns has one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.dynamics import Step

# Components of a twist: in the plane (about z, x, y), in space (about x y z, x y z).
PLANE, SPACE = 3, 6


@dataclass(frozen=True, slots=True)
class TreeStep:
    """A step among those of its group: the one before it or -1, its speeds among the unknowns.

    `faces_ground`: what is beyond keeps its orientation whatever carries it. `auxiliary`: its
    speeds are zero in the motion. `data` and `factor` are where its parts of the group's begin.
    """

    above: int
    first: int
    count: int
    auxiliary: bool
    faces_ground: bool
    data: int
    factor: int


@dataclass(frozen=True, slots=True, eq=False)
class TreeTable:
    """The steps of one group; sizes of its data and of its factor; the data (column)."""

    width: int
    steps: tuple[TreeStep, ...]
    factor: int
    data: ca.SX


def make_tree(steps: Sequence[Step], unknowns: Sequence[int], nv: int, planar: bool) -> TreeTable:
    """Of the steps whose speeds are among the unknowns of a group, and of what leads to them."""
    width, triangle = (PLANE, 6) if planar else (SPACE, 21)
    local = {z: k for k, z in enumerate(unknowns)}
    number: dict[int, int] = {}
    table: list[TreeStep] = []
    data: list[ca.SX] = []
    at, factor = 0, 0
    for k, step in enumerate(steps):
        node = step.node
        own = any(p in local for p in node.places)
        if not own and not (not node.places and node.above in number):
            continue
        number[k] = len(table)
        count = len(node.places)
        table.append(
            TreeStep(
                number.get(node.above, -1),
                local[node.places[0]] if count else 0,
                count,
                bool(count) and node.places[0] >= nv,
                node.faces_ground,
                at,
                factor,
            )
        )
        parts = [_twist(c.angular, c.linear, planar) for c in node.columns]
        parts += [_vector(step.node.arm, planar), ca.SX(step.mass), _vector(step.moment, planar)]
        parts += [_inertia(step.inertia, planar), _twist(step.couple, step.force, planar)]
        data += parts
        at += sum(int(p.numel()) for p in parts)
        kept = width + triangle  # of what an auxiliary step reads (articulated.h)
        factor += kept if table[-1].auxiliary else count * (width + 1) + count * count
    return TreeTable(width, tuple(table), factor, ca.vertcat(*map(ca.densify, data)))


def _vector(value: ca.SX, planar: bool) -> ca.SX:
    return ca.densify(value[:2] if planar else value)


def _twist(angular: ca.SX, linear: ca.SX, planar: bool) -> ca.SX:
    turning = ca.densify(angular[2] if planar else angular)
    return ca.vertcat(turning, _vector(linear, planar))


def _inertia(value: ca.SX, planar: bool) -> ca.SX:
    """That about z; in space xx, xy, xz, yy, yz, zz."""
    if planar:
        return ca.densify(value[2, 2])
    return ca.vertcat(*(ca.densify(value[i, j]) for i in range(3) for j in range(i, 3)))
