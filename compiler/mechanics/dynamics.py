"""Mass matrix and inertial forces in two passes over the tree.

Every quantity of a step is taken about its own origin, in ground axes. Towards the ground, what is
beyond a step is one rigid body to the speeds before it (composite bodies: M. Walker, D. Orin, J.
Dyn. Syst. Meas. Control 104, 1982); where it keeps its orientation whatever carries it, only its
mass counts, at the place that carries it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.spatial import cross, nowhere, size_of_cross
from frot.dsl.checked import Body


@dataclass(frozen=True, slots=True, eq=False)
class Masses:
    """Mass matrix (nw x nw) and force (nw): weight less inertial bias; `size` of its terms."""

    mass: ca.SX
    force: ca.SX
    size: ca.SX


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
        self.force += other.force
        self.couple += cross(arm, other.force)
        self.force_size += other.force_size
        self.couple_size += size_of_cross(arm, other.force_size)
        if not as_point:
            self.moment += other.moment
            product = ca.skew(arm) @ ca.skew(other.moment)
            self.inertia += other.inertia - product - product.T
            self.couple += other.couple
            self.couple_size += other.couple_size
        for place, (linear, angular) in other.momenta.items():
            own = nowhere() if as_point else angular
            self.momenta[place] = (linear, own + cross(arm, linear))


def _square(arm: ca.SX) -> ca.SX:
    """[r]^2 of a vector."""
    return ca.sparsify(ca.skew(arm) @ ca.skew(arm))


def make_masses(
    kinematics: Kinematics,
    bodies: tuple[Body, ...],
    mass: dict[Body, ca.SX],
    inertia: dict[Body, ca.SX],
    fall: ca.SX,
) -> Masses:
    """All bodies; `inertia` (3 x 3) about G along ground axes, `fall` the acceleration of gravity.

    With auxiliary speeds after the others.
    """
    nodes = kinematics.nodes
    nw = kinematics.symbols.v.numel() + kinematics.symbols.sw.numel()
    matrix, force, size = ca.SX(nw, nw), ca.SX(nw, 1), ca.SX(nw, 1)
    carried = [_Carried() for _ in nodes]
    for body in bodies:
        moving, place = kinematics.bodies[body], kinematics.node_of[body]
        if place < 0:
            continue
        own = inertia[body]
        couple = own @ moving.angular_bias + cross(moving.angular, own @ moving.angular)
        arm = kinematics.beyond[body]
        carried[place].add_body(
            mass[body], own, arm, moving.linear_bias - fall, ca.sparsify(couple)
        )
    for k in reversed(range(len(nodes))):
        node, beyond = nodes[k], carried[k]
        for place, column in zip(node.places, node.columns, strict=True):
            linear = beyond.mass * column.linear + cross(column.angular, beyond.moment)
            angular = cross(beyond.moment, column.linear) + beyond.inertia @ column.angular
            beyond.momenta[place] = (ca.sparsify(linear), ca.sparsify(angular))
        for place, column in zip(node.places, node.columns, strict=True):
            for other, (linear, angular) in beyond.momenta.items():
                if other in node.places and other > place:
                    continue
                entry = ca.dot(column.linear, linear) + ca.dot(column.angular, angular)
                matrix[place, other] = matrix[other, place] = entry
            force[place] = -(
                ca.dot(column.linear, beyond.force) + ca.dot(column.angular, beyond.couple)
            )
            size[place] = ca.dot(ca.fabs(column.linear), beyond.force_size) + ca.dot(
                ca.fabs(column.angular), beyond.couple_size
            )
        if node.above >= 0:
            carried[node.above].add(beyond, node.arm, as_point=node.faces_ground)
    return Masses(matrix, force, size)
