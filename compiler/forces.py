"""Applied forces: where they act, and their potential where they have one."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.expressions import Lowering
from frot.compiler.kinematics import Kinematics
from frot.compiler.mechanism import Point
from frot.compiler.mechanize import point_body
from frot.compiler.walk import is_fixed
from frot.dsl.checked import Body, BodyPoint, Expression, Force, Frame, Liaison, Literal, Place

Argument = Expression | Place | Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Action:
    """A force (2) on a body at a place (2, ground axes)."""

    body: Body
    place: ca.SX
    force: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """What a force does: its actions, and its potential energy or None if it has none."""

    actions: tuple[Action, ...]
    potential: ca.SX | None


def _point(
    argument: Argument, kinematics: Kinematics, lowering: Lowering, ground: Body
) -> tuple[Body, ca.SX]:
    if isinstance(argument, (BodyPoint, Frame)):
        point: Point = argument
        return point_body(point), kinematics.position(point)
    return ground, lowering.lower(_value(argument))


def load(force: Force, kinematics: Kinematics, lowering: Lowering, ground: Body) -> Load:
    """Lower one force. `lowering` is that of the motion, so that its switches are located."""
    arguments = force.arguments
    if force.kind.name == "on":
        body, place = _point(arguments["frame"], kinematics, lowering, ground)
        return Load((Action(body, place, lowering.lower(_value(arguments["value"]))),), None)
    ends = ("a", "b") if force.kind.name == "spring" else ("centre", "point")
    first, start = _point(arguments[ends[0]], kinematics, lowering, ground)
    second, end = _point(arguments[ends[1]], kinematics, lowering, ground)
    stiffness = lowering.lower(_value(arguments["k"]))
    apart = end - start
    if force.kind.name == "attraction":
        pull, energy = -stiffness * apart, stiffness * ca.sumsqr(apart) / 2
    else:
        rest = lowering.lower(_value(arguments["length"]))
        length = ca.sqrt(ca.sumsqr(apart))
        # Where the ends meet a spring has no direction: the limit of the part without one is taken.
        slack = (
            ca.SX(0)
            if _is_zero(arguments["length"])
            else ca.if_else(length > 0, rest / length, ca.SX(0))
        )
        pull, energy = -stiffness * (1 - slack) * apart, stiffness * (length - rest) ** 2 / 2
    actions = (Action(second, end, pull), Action(first, start, -pull))
    constant = all(is_fixed(a) for a in arguments.values() if isinstance(a, Expression))
    return Load(actions, energy if constant else None)


def _value(argument: Argument) -> Expression:
    assert isinstance(argument, Expression)
    return argument


def _is_zero(argument: Argument) -> bool:
    return isinstance(argument, Literal) and argument.value == 0
