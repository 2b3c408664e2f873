"""Inertia and inertial forces of the tree.

Every quantity of a step is taken about its own origin, in ground axes. Towards the ground, what is
beyond a step is one rigid body to the speeds before it (composite bodies: M. Walker, D. Orin, J.
Dyn. Syst. Meas. Control 104, 1982); where it keeps its orientation whatever carries it, only its
mass counts, at the place that carries it.

A small tree has its mass matrix written out. Of a large one, whose matrix would cost the square of
its speeds and its factor the cube, what each step adds by itself is given to the kernel, which goes
from step to step (runtime/kernel/inertia/articulated.h).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.kinematics import Kinematics, Node
from frot.compiler.mechanics.spatial import cross, is_round, nowhere, size_of_cross
from frot.compiler.symbolic.columns import column as stacked
from frot.dsl.checked import Body

# Speeds of a tree from which on the recursion costs less than the mass matrix, measured: of one
# whose reactions nobody reads, and of one with readings, each of which is one more way along it.
LARGE, LARGE_READ = 10, 20


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What a step of the tree has by itself, before what is beyond it.

    `mass`, `moment` (mass times arm) and `inertia` of its bodies about its origin; `force` and
    `couple` there that keep their motion while no speed changes, less their weight, with the sizes
    of their terms.
    """

    node: Node
    mass: ca.SX
    moment: ca.SX
    inertia: ca.SX
    force: ca.SX
    couple: ca.SX
    force_size: ca.SX
    couple_size: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Masses:
    """Mass matrix (nw x nw) and force (nw): weight less inertial bias; `size` of its terms."""

    mass: ca.SX
    force: ca.SX
    size: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Push:
    """A force (3) and a couple (3) on a body at the vector `arm` from its G, in ground axes."""

    body: Body
    arm: ca.SX
    force: ca.SX
    couple: ca.SX


@dataclass(slots=True, eq=False)
class _Carried:
    """What is beyond a step, about its origin.

    `mass`, `moment` (mass times arm), `inertia`; `force` and `couple` that keep its motion while no
    speed changes, less the weight, with the sizes of their terms; momenta of what moves with a unit
    of each speed beyond: linear, angular.
    """

    mass: ca.SX = field(default_factory=lambda: ca.SX(0))
    moment: ca.SX = field(default_factory=nowhere)
    inertia: ca.SX = field(default_factory=lambda: ca.SX(3, 3))
    force: ca.SX = field(default_factory=nowhere)
    couple: ca.SX = field(default_factory=nowhere)
    force_size: ca.SX = field(default_factory=nowhere)
    couple_size: ca.SX = field(default_factory=nowhere)
    momenta: dict[int, tuple[ca.SX, ca.SX]] = field(default_factory=dict)

    @staticmethod
    def of(step: Step) -> _Carried:
        """What a step has by itself."""
        return _Carried(
            step.mass,
            step.moment,
            step.inertia,
            step.force,
            step.couple,
            step.force_size,
            step.couple_size,
        )

    def add_push(self, push: Push, arm: ca.SX) -> None:
        """A force that acts on the bodies of the step at `arm`."""
        self.force -= push.force
        self.couple -= push.couple + cross(arm, push.force)
        self.force_size += ca.fabs(push.force)
        self.couple_size += ca.fabs(push.couple) + size_of_cross(arm, push.force)

    def add_body(
        self, mass: ca.SX, inertia: ca.SX, arm: ca.SX, acceleration: ca.SX, couple: ca.SX
    ) -> None:
        """A body whose G is at `arm`, with the couple that its turning takes."""
        push = mass * acceleration
        self.mass += mass
        self.moment += mass * arm
        self.inertia += inertia - mass * _square(arm)
        self.force += push
        self.couple += couple + cross(arm, push)
        self.force_size += ca.fabs(push)
        self.couple_size += ca.fabs(couple) + size_of_cross(arm, push)

    def add(self, other: _Carried, arm: ca.SX, *, as_point: bool) -> None:
        """What is beyond a step whose origin is at `arm`; `as_point`: it keeps its orientation."""
        self.mass += other.mass
        self.moment += other.mass * arm
        self.inertia -= other.mass * _square(arm)
        self.add_force(other, arm, as_point=as_point)
        if not as_point:
            self.moment += other.moment
            product = ca.skew(arm) @ ca.skew(other.moment)
            self.inertia += other.inertia - product - product.T
        for place, (linear, angular) in other.momenta.items():
            own = nowhere() if as_point else angular
            self.momenta[place] = (linear, own + cross(arm, linear))

    def add_force(self, other: _Carried, arm: ca.SX, *, as_point: bool) -> None:
        """The forces alone."""
        self.force += other.force
        self.couple += cross(arm, other.force)
        self.force_size += other.force_size
        self.couple_size += size_of_cross(arm, other.force_size)
        if not as_point:
            self.couple += other.couple
            self.couple_size += other.couple_size


def _square(arm: ca.SX) -> ca.SX:
    """[r]^2 of a vector."""
    return ca.sparsify(ca.skew(arm) @ ca.skew(arm))


def trees_of(nodes: Sequence[Node]) -> list[int]:
    """For each node the first of its tree."""
    first: list[int] = []
    for k, node in enumerate(nodes):
        first.append(k if node.above < 0 else first[node.above])
    return first


def speeds_by_tree(nodes: Sequence[Node]) -> list[list[int]]:
    """The places of the speeds of each tree."""
    speeds: dict[int, list[int]] = {}
    for node, tree in zip(nodes, trees_of(nodes), strict=True):
        speeds.setdefault(tree, []).extend(node.places)
    return list(speeds.values())


def large_speeds(nodes: Sequence[Node], nv: int) -> frozenset[int]:
    """The speeds of trees that have at least so many, auxiliary ones not counted."""

    def is_large(own: list[int]) -> bool:
        true = sum(k < nv for k in own)
        return true >= (LARGE if true == len(own) else LARGE_READ)

    return frozenset(p for own in speeds_by_tree(nodes) if is_large(own) for p in own)


def heaviest_loads(steps: Sequence[Step], nv: int) -> ca.SX:
    """Of each of `nv` speeds the most that a step of its tree carries, over its own mass (nv x 1).

    Where that is large, inertias of light bodies are lost beside those of heavy ones.
    """
    carried = [ca.SX(0)] * len(steps)
    loads: dict[int, ca.SX] = {}
    trees = trees_of([step.node for step in steps])
    for k in reversed(range(len(steps))):
        own, above = steps[k].mass, steps[k].node.above
        if above >= 0:
            carried[above] += carried[k] + own
        if not (own.is_zero() or carried[k].is_zero()):
            load = carried[k] / own
            loads[trees[k]] = ca.fmax(loads[trees[k]], load) if trees[k] in loads else load
    of_speeds = ca.SX.zeros(nv)
    for step, tree in zip(steps, trees, strict=True):
        for place in step.node.places:
            if place < nv and tree in loads:
                of_speeds[place] = loads[tree]
    return of_speeds


def in_trees(nodes: Sequence[Node], speeds: frozenset[int]) -> list[bool]:
    """Whether the tree of each node has one of the speeds."""
    trees = trees_of(nodes)
    found = {t for n, t in zip(nodes, trees, strict=True) if not speeds.isdisjoint(n.places)}
    return [tree in found for tree in trees]


def make_steps(
    kinematics: Kinematics,
    bodies: tuple[Body, ...],
    mass: Mapping[Body, ca.SX],
    inertia: Mapping[Body, ca.SX],
    fall: ca.SX,
    pushes: Iterable[Push],
) -> tuple[Step, ...]:
    """One for each node; `inertia` (3 x 3) about G along ground axes, `fall` that of gravity."""
    carried = [_Carried() for _ in kinematics.nodes]
    for body in bodies:
        moving, place = kinematics.bodies[body], kinematics.node_of[body]
        if place < 0:
            continue
        own = inertia[body]
        couple = own @ moving.angular_bias
        if not is_round(own):  # else w x (c w) is rounding
            couple += cross(moving.angular, own @ moving.angular)
        arm = kinematics.beyond[body]
        carried[place].add_body(
            mass[body], own, arm, moving.linear_bias - fall, ca.sparsify(couple)
        )
    for push in pushes:
        place = kinematics.node_of[push.body]
        if place >= 0:
            carried[place].add_push(push, kinematics.beyond[push.body] + push.arm)
    return tuple(
        Step(n, c.mass, c.moment, c.inertia, c.force, c.couple, c.force_size, c.couple_size)
        for n, c in zip(kinematics.nodes, carried, strict=True)
    )


def write_out(
    steps: Sequence[Step], nv: int, nw: int, left_out: frozenset[int] = frozenset()
) -> Masses:
    """The masses of `nv` speeds, and auxiliary speeds up to `nw`.

    What is left out has no entries, and of the force only those of auxiliary speeds.
    """
    force, size = [ca.SX(0)] * nw, [ca.SX(0)] * nw
    entries: dict[tuple[int, int], ca.SX] = {}
    carried = [_Carried.of(step) for step in steps]
    nodes = [step.node for step in steps]
    without = in_trees(nodes, left_out)
    for k in reversed(range(len(steps))):
        node, beyond = nodes[k], carried[k]
        inside = not without[k]
        for place, column in zip(node.places, node.columns, strict=True):
            if not inside:
                break
            linear = beyond.mass * column.linear + cross(column.angular, beyond.moment)
            angular = cross(beyond.moment, column.linear) + beyond.inertia @ column.angular
            beyond.momenta[place] = (ca.sparsify(linear), ca.sparsify(angular))
        for place, column in zip(node.places, node.columns, strict=True):
            for other, (linear, angular) in beyond.momenta.items():
                if other in node.places and other > place:
                    continue
                entry = ca.dot(column.linear, linear) + ca.dot(column.angular, angular)
                entries[place, other] = entries[other, place] = entry
            if inside or place >= nv:
                force[place] = -(
                    ca.dot(column.linear, beyond.force) + ca.dot(column.angular, beyond.couple)
                )
            size[place] = ca.dot(ca.fabs(column.linear), beyond.force_size) + ca.dot(
                ca.fabs(column.angular), beyond.couple_size
            )
        if node.above >= 0:
            beside = carried[node.above]
            add = beside.add if inside else beside.add_force
            add(beyond, node.arm, as_point=node.faces_ground)
    return Masses(_matrix(entries, nw), stacked(force), stacked(size))


def _matrix(entries: Mapping[tuple[int, int], ca.SX], n: int) -> ca.SX:
    """The sparse matrix (n x n) of its entries, made at once."""
    found = sorted((j, i, x) for (i, j), x in entries.items() if x.nnz())
    pattern = ca.Sparsity.triplet(n, n, [i for _, i, _ in found], [j for j, _, _ in found])
    return ca.SX(pattern, ca.vertcat(*(x for _, _, x in found)) if found else ca.SX(0, 1))
