"""Generalized forces of what the text applies: springs, couples, drags, flanges and drives."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.constraint_geometry import GivenFriction
from frot.compiler.mechanics.dynamics import Push, in_trees
from frot.compiler.mechanics.forces.force import Action, Given, Load
from frot.compiler.mechanics.forces.force_models import FORCE_MODELS
from frot.compiler.mechanics.laws.law_models import law_model
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.variables import Variables
from frot.compiler.translate.expressions import Lowering
from frot.dsl.checked import Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Loads:
    """Generalized applied forces, the sizes of their terms and of each, potential and power.

    `terms`: the sizes of the forces times those of the places they act at.

    `pushes` act on bodies of large trees, and are in none of the first two.
    """

    force: ca.SX
    size: ca.SX
    pushes: tuple[Push, ...]
    sizes: list[ca.SX]
    potential: ca.SX
    power: ca.SX
    terms: ca.SX


def applied_loads(
    mechanism: Mechanism,
    variables: Variables,
    moving: Lowering,
    frictions: dict[Liaison, GivenFriction],
) -> list[Load]:
    """The forces of the text, the efforts of its flanges and drives, the laws of its own.

    `frictions` collects what these laws give.
    """
    kinematics = variables.kinematics
    applied = [
        FORCE_MODELS[force.kind.name].load(
            Given(
                force.arguments, kinematics, moving, variables.effort, variables.strikes.get(force)
            )
        )
        for force in mechanism.forces
    ]
    for flange in mechanism.model.flanges:
        assert moving.variable is not None
        unit, size = variables.effort(flange.liaison, flange.coordinate), flange.effort
        action = Action(unit.rate, moving.variable(size), along=unit.along)
        applied.append(Load((action,), None))
    for liaison in mechanism.model.liaisons:
        for law in liaison.laws:
            model = law_model(law)
            acts = model and model.action(liaison, law, variables, moving, frictions)
            if acts:
                applied.append(acts)
    return applied


def sum_loads(
    mechanism: Mechanism, variables: Variables, applied: list[Load], large: frozenset[int]
) -> Loads:
    """What all of them do along each speed; those of large trees push their bodies."""
    kinematics, symbols = variables.kinematics, variables.symbols
    speeds = ca.vertcat(symbols.v, symbols.sw)
    force, size = ca.SX.zeros(speeds.numel()), ca.SX.zeros(speeds.numel())
    potential, power, terms = ca.SX(0), ca.SX(0), ca.SX(0)
    sizes: list[ca.SX] = []
    pushes: list[Push] = []
    inside = in_trees(kinematics.nodes, large)
    held = {body for body, k in kinematics.node_of.items() if k >= 0 and inside[k]}
    for result in applied:
        for action in result.actions:
            if action.push is not None and action.push.body in held:
                pushes.append(action.push)
            else:
                along = action.along
                if along is None:
                    along = ca.jacobian(action.velocity, speeds).T
                force += along @ action.force
                size += ca.fabs(along) @ ca.fabs(action.force)
            if action.place.nnz():
                terms += ca.dot(ca.fabs(action.force), ca.fabs(action.place))
        power += result.power
        sizes.append(sum((ca.sum1(ca.fabs(a.force)) for a in result.actions), ca.SX(0)))
        if result.potential is not None:
            potential += result.potential
    own = sizes[: len(mechanism.forces)]
    return Loads(force, size, tuple(pushes), own, potential, power, terms)
