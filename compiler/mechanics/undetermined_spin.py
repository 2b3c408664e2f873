"""Rods whose spin nothing gives inertia to, though a liaison leaves it: reported by name.

A slender rod has no inertia about itself (P. Painlevé 1895, p. 32). Where a liaison sees its
orientation its spin is a speed all the same, to which bodies fixed to it must give inertia.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import casadi as ca
from frot.compiler.mechanics.mechanism import Mechanism, sees_turning, spins_in_vain
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.shapes import inertia_of
from frot.compiler.mechanics.variables import Variables
from frot.compiler.symbolic.columns import scalars_of
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.walk import as_number
from frot.dsl import Log, default_values, evaluate
from frot.dsl.checked import Body, BodyPoint, Frame, Liaison, Model

# Of a spin with an inertia of its own: rounding is what is left of that of other bodies.
_NONE = 1e-10
# Of more speeds the inertia is not looked at.
_MOST_SPEEDS = 60


def refuse_idle_spins(mechanism: Mechanism, variables: Variables, mass: ca.SX, log: Log) -> None:
    """Report the rods that a liaison leaves to turn about themselves without inertia.

    With s the row of the spin, J an inertia and K = M + J s s', the part J s' K^-1 s is one where
    M gives the spin no inertia, and less else.
    """
    model, symbols = mechanism.model, variables.symbols
    rods = [b for b in model.bodies if spins_in_vain(b, model)]
    count = symbols.v.numel()
    if not rods or not 0 < count <= _MOST_SPEEDS:
        return
    kinematics = variables.kinematics
    spins, sizes = [], []
    for rod in rods:
        along = ca.dot(kinematics.pose(rod).axes[:, 0], kinematics.angular_velocity(rod))
        spins.append(ca.jacobian(along, symbols.v).T)
        sizes.append(inertia_of(rod, False, kinematics.fixed.lower)[1, 1])
    own = ca.horzcat(*spins) @ ca.diag(ca.sqrt(ca.vertcat(*sizes)))
    looked = ca.veccat(variables.without_auxiliary(mass[:count, :count]), own)
    known = dict(_values(symbols, model))
    arguments = ca.symvar(looked)
    given = [known.get(x.element_hash(), _other(k)) for k, x in enumerate(arguments)]
    values = ca.Function("spins", [ca.vertcat(*arguments)], [looked])(ca.DM(given))
    whole = ca.reshape(values[: count * count], count, count)
    parts = ca.reshape(values[count * count :], count, len(rods))
    solved = ca.solve(whole + parts @ parts.T, parts)
    for k, rod in enumerate(rods):
        if 1 - float(ca.dot(parts[:, k], solved[:, k])) < _NONE:
            _tell(rod, model, log)


def _values(symbols: Symbols, model: Model) -> Iterator[tuple[int, float]]:
    """Parameters, and orientations of length one."""
    values = default_values(model, {})
    for parameter, symbol in zip(symbols.parameters, scalars_of(symbols.p), strict=True):
        yield symbol.element_hash(), as_number(evaluate(parameter.value, values))
    places = scalars_of(symbols.q)
    for turn in symbols.turns:
        for k, part in enumerate((0.8, 0.2, 0.4, 0.4)):
            yield places[turn.coordinate + k].element_hash(), part


def _other(k: int) -> float:
    """A coordinate in general position."""
    return 0.3 + math.sin(1 + k)


def _tell(rod: Body, model: Model, log: Log) -> None:
    leaves = next(x for x in model.liaisons if _is_on(x, rod) and sees_turning(x))
    log.report(
        "E0401",
        f"liaison '{leaves.name}' leaves the slender rod '{rod.name}' a turn about itself, in "
        "which nothing has inertia",
        leaves.span,
        help=f"give '{rod.name}' an `inertia = (..., ..., ...)`, or take a liaison of points "
        "without friction, as `spherique` and `tige`, for which it does not turn about itself",
    )


def _is_on(liaison: Liaison, rod: Body) -> bool:
    places = (liaison.a, liaison.b)
    return any(isinstance(x, BodyPoint | Frame) and point_body(x) is rod for x in places)
