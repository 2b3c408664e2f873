"""Masses and inertias of the bodies, and the steps of the tree that they make."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence

import casadi as ca
from frot.compiler.mechanics.dynamics import Push, Step, make_steps, trees_of
from frot.compiler.mechanics.geometry.sides import gravity
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.variables import Variables
from frot.dsl.checked import Body

# Ratio of masses beyond which inertias are found in wide numbers: FROT_HEAVY of the kernel.
HEAVY = 1e5


def make_masses(
    mechanism: Mechanism, variables: Variables, pushes: Iterable[Push]
) -> tuple[tuple[Step, ...], ca.SX, ca.SX]:
    """The tree's masses with what pushes its bodies; the weights' energy, and its terms' size."""
    kinematics, own = variables.kinematics, mechanism.model.bodies
    fall = gravity(mechanism.model.world, kinematics)
    bodies = (*own, *mechanism.halves)
    whole = {body: mechanism.halves.get(body, body) for body in bodies}
    count = Counter(whole.values())
    share = {body: 1.0 / count[whole[body]] for body in bodies}
    unfolded = _unfolded(variables, bodies)
    masses = {body: unfolded(body, share[body] * variables.mass(body)) for body in bodies}
    inertias = {
        body: unfolded(body, share[body] * variables.inertia_in_ground(body)) for body in bodies
    }
    weights = [(variables.mass(b) * fall, kinematics.position(b)) for b in own]
    potential = -sum((ca.dot(weight, place) for weight, place in weights), ca.SX(0))
    terms = sum((ca.dot(ca.fabs(w), ca.fabs(place)) for w, place in weights), ca.SX(0))
    return make_steps(kinematics, bodies, masses, inertias, fall, pushes), potential, terms


def _unfolded(variables: Variables, bodies: Sequence[Body]) -> Callable[[Body, ca.SX], ca.SX]:
    """What keeps CasADi from adding numbers of light bodies to those of heavy ones.

    Their sum would be rounded before the kernel can take it in wide numbers (extended_inertia.h).
    A number is the least of itself and of what nobody knows to be infinite, by a speed of the
    body's tree.
    """
    masses = [variables.mass(body) for body in bodies]
    known = [float(m) for m in masses if m.is_constant() and float(m) > 0]
    if not known or max(known) <= HEAVY * min(known):
        return lambda _, value: value
    kinematics, v = variables.kinematics, variables.symbols.v
    trees, nodes = trees_of(kinematics.nodes), kinematics.nodes
    speeds = {
        tree: v[place]
        for node, tree in zip(nodes, trees, strict=True)
        for place in node.places
        if place < v.numel()
    }

    def unfolded(body: Body, value: ca.SX) -> ca.SX:
        tree = trees[kinematics.node_of[body]] if kinematics.node_of[body] >= 0 else -1
        if not value.is_constant() or tree not in speeds:
            return value
        unknown = ca.SX.inf() + ca.sign(speeds[tree])
        return ca.SX(value.sparsity(), ca.fmin(value.nz[:], unknown))

    return unfolded
