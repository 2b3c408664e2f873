"""Islands: groups and states that depend on each other, each evaluated by functions of its own.

Groups share no matrix, yet the loads of one may read the states of another. Those that do are one
island: its functions read nothing of what moves in others, so that the kernel evaluates those that
move and lets the others sleep.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.groups import (
    Group,
    Grouping,
    Sets,
    pack_matrix,
    pack_rows,
    pack_spread,
    reorder_groups,
)
from frot.compiler.symbolic.columns import column


@dataclass(frozen=True, slots=True, eq=False)
class Island:
    """Places of its states, groups and conditions, and of what its functions take of u, p and d.

    `sleeps`: it depends neither on time nor on blocks of equations. The functions are those of the
    whole model, over what is its own: arguments t, q, v, u, p, d, y, of which y is whole.
    """

    q: tuple[int, ...]
    v: tuple[int, ...]
    groups: tuple[int, ...]
    conditions: tuple[int, ...]
    u: tuple[int, ...]
    p: tuple[int, ...]
    d: tuple[int, ...]
    sleeps: bool
    arguments: list[ca.SX]
    results: dict[str, list[ca.SX]]


@dataclass(frozen=True, slots=True)
class _Nodes:
    """Numbers of what is joined: states q and v, groups, conditions, the blocks, terms of power."""

    nq: int
    nv: int
    groups: int
    conditions: int
    terms: int

    @property
    def speeds(self) -> range:
        return range(self.nq, self.nq + self.nv)

    @property
    def of_groups(self) -> range:
        return range(self.speeds.stop, self.speeds.stop + self.groups)

    @property
    def of_conditions(self) -> range:
        return range(self.of_groups.stop, self.of_groups.stop + self.conditions)

    @property
    def blocks(self) -> int:
        return self.of_conditions.stop

    @property
    def of_terms(self) -> range:
        return range(self.blocks + 1, self.blocks + 1 + self.terms)


@dataclass(frozen=True, slots=True, eq=False)
class _Scene:
    """What is divided: the terms are those of the power."""

    system: Assembled
    grouping: Grouping
    conditions: ca.SX
    terms: tuple[ca.SX, ...]
    state: tuple[ca.SX, ...]

    @property
    def nodes(self) -> _Nodes:
        return _Nodes(
            int(self.system.q.numel()),
            self.system.nv,
            len(self.grouping.groups),
            int(self.conditions.numel()),
            len(self.terms),
        )


def divide(
    system: Assembled, grouping: Grouping, conditions: ca.SX, state: Sequence[ca.SX]
) -> tuple[Grouping, tuple[Island, ...]]:
    """The groups in the order of their islands, and these; none where all is one.

    `conditions`: all of the text, the located ones first; `state`: t, q, v, u, p, d, y.
    """
    if len(grouping.groups) < 2 or system.late or system.invariants.origins:
        return grouping, ()
    scene = _Scene(system, grouping, conditions, tuple(_terms(system.matrices.power)), tuple(state))
    nodes = scene.nodes
    sets = Sets(nodes.of_terms.stop)
    awake = {nodes.blocks, *_join(scene, sets)}
    members = _collect(sets, nodes)
    if len(members) < 2:
        return grouping, ()
    start = nodes.of_groups.start
    order = [k - start for items in members for k in items if k in nodes.of_groups]
    scene = replace(scene, grouping=reorder_groups(system, grouping, order))
    islands: list[Island] = []
    first = 0
    for items in members:
        end = first + sum(k in nodes.of_groups for k in items)
        islands.append(_make_island(scene, items, range(first, end), awake.isdisjoint(items)))
        first = end
    return scene.grouping, tuple(islands)


def _join(scene: _Scene, sets: Sets) -> set[int]:
    """Join what depends on each other; returns what depends on time in one mode."""
    system, nodes = scene.system, scene.nodes
    early = [x for b in system.blocks if not b.late for x in _split(b.residual)]
    values = [*_split(system.rates), *_split(scene.conditions), *early, *scene.terms]
    owners = [*range(nodes.nq), *nodes.of_conditions]
    owners += [nodes.blocks] * len(early) + [*nodes.of_terms]
    for k, group in zip(nodes.of_groups, scene.grouping.groups, strict=True):
        for z in group.unknowns[: group.n_speeds]:
            sets.join(k, nodes.nq + z)
        parts = [*dynamics_of(system, (group,)), system.matrices.force_size[list(group.unknowns)]]
        parts += pack_spread(system, (group,)) if group.general else ()
        own = [x for part in parts for x in _split(part)]
        values += own
        owners += [k] * len(own)
    function = ca.Function("f", [*scene.state, system.z, system.lam], [column(values)])
    for argument, first in ((1, 0), (2, nodes.nq), (6, -1)):
        rows, columns = function.jac_sparsity(0, argument).get_triplet()
        for row, place in zip(rows, columns, strict=True):
            sets.join(owners[row], nodes.blocks if first < 0 else first + place)
    unlocated = set(nodes.of_conditions[system.reduced.conditions.located :])
    rows, _ = function.jac_sparsity(0, 0).get_triplet()
    return {owners[row] for row in rows} - unlocated


def _collect(sets: Sets, nodes: _Nodes) -> list[list[int]]:
    """The nodes of each island, in the order of their first groups; what has no group is one."""
    members: dict[int, list[int]] = {}
    for node in range(nodes.of_terms.stop):
        members.setdefault(sets.find(node), []).append(node)
    of_groups: dict[int, list[int]] = {}
    rest: list[int] = []
    for items in members.values():
        first = min((k for k in items if k in nodes.of_groups), default=-1)
        if first >= 0:
            of_groups[first] = items
        else:
            rest += items
    found = [of_groups[k] for k in sorted(of_groups)]
    return [*found, rest] if rest not in ([], [nodes.blocks]) else found


def _make_island(scene: _Scene, items: list[int], groups: range, sleeps: bool) -> Island:
    """`groups`: its groups in the new order."""
    system, nodes, grouping = scene.system, scene.nodes, scene.grouping
    q = [k for k in items if k < nodes.nq]
    v = [k - nodes.nq for k in items if k in nodes.speeds]
    conditions = sorted(k - nodes.of_conditions.start for k in items if k in nodes.of_conditions)
    located = [k for k in conditions if k < system.reduced.conditions.located]
    terms = [scene.terms[k - nodes.of_terms.start] for k in items if k in nodes.of_terms]
    own = [grouping.groups[k] for k in groups]
    matrix, force, rows, bias, rate, gap, coefficients = dynamics_of(system, own)
    unknowns = [z for g in own for z in g.unknowns]
    results = {
        "kinematics": [gap, rows, rate, scene.conditions[conditions]],
        "dynamics": [
            *(system.rates[q], matrix, force, rows, bias, rate, gap),
            *(scene.conditions[located], coefficients, sum(terms, ca.SX(0))),
        ],
        "sizes": [system.matrices.force_size[unknowns]],
    }
    if any(g.general for g in own):
        results["spread"] = list(pack_spread(system, own))
    if any(g.composite for g in own):
        results["wide"] = [matrix, force, rows]
    t, _, _, u, p, d, y = scene.state
    read = {
        x.element_hash() for x in ca.symvar(ca.veccat(*(r for f in results.values() for r in f)))
    }
    own_u, own_p, own_d = (
        tuple(k for k, x in enumerate(_split(part)) if x.element_hash() in read)
        for part in (u, p, d)
    )
    return Island(
        q=tuple(q),
        v=tuple(v),
        groups=tuple(groups),
        conditions=tuple(conditions),
        u=own_u,
        p=own_p,
        d=own_d,
        sleeps=sleeps,
        arguments=[
            *(t, system.q[q], system.v[v]),
            *(u[list(own_u)], p[list(own_p)], d[list(own_d)], y),
        ],
        results=results,
    )


def dynamics_of(system: Assembled, groups: Sequence[Group]) -> list[ca.SX]:
    """A, h, J, c, rate, gap, coefficients of groups, in the order of their tables."""
    unknowns = [z for g in groups for z in g.unknowns]
    rows = [r for g in groups for r in g.rows]
    contacts = [c for g in groups for c in g.contacts]
    laws = [2 * e + k for g in groups for e in g.elements for k in (0, 1)]
    return [
        pack_matrix(system, groups),
        system.matrices.force[unknowns],
        pack_rows(system, groups),
        system.matrices.bias[rows],
        system.matrices.rate[rows],
        system.matrices.gap[contacts],
        system.matrices.coefficients[laws],
    ]


def _split(values: ca.SX) -> list[ca.SX]:
    return ca.vertsplit(ca.densify(ca.SX(values))) if values.numel() else []


def _terms(value: ca.SX) -> list[ca.SX]:
    """What a sum is made of, without zeros."""
    terms: list[ca.SX] = []
    waiting = [(value, 1)]
    while waiting:
        x, sign = waiting.pop()
        if x.is_zero():
            continue
        if not x.is_leaf() and x.op() in (ca.OP_ADD, ca.OP_SUB):
            waiting.append((x.dep(1), -sign if x.op() == ca.OP_SUB else sign))
            waiting.append((x.dep(0), sign))
        elif not x.is_leaf() and x.op() == ca.OP_NEG:
            waiting.append((x.dep(0), -sign))
        else:
            terms.append(sign * x)
    return terms
