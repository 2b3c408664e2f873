"""The pass along the spanning tree: in each step from the place that carries a body to its G.

Velocities follow with the poses, and so do the accelerations that are there while no speed changes.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.kinematics import Carried, Kinematics, Node
from frot.compiler.mechanics.liaisons.motion import Carrier
from frot.compiler.mechanics.liaisons.moves import Column, carried, turned_by_time
from frot.compiler.mechanics.make_symbols import counters_of, reading_places
from frot.compiler.mechanics.mechanism import Hanging, Mechanism
from frot.compiler.mechanics.points import Point, frames_of, point_body
from frot.compiler.mechanics.spatial import AT_REST, Moving, nowhere
from frot.compiler.translate.conditions import ConditionTable
from frot.compiler.translate.symbols import Symbols
from frot.dsl.checked import Body


def place_bodies(
    mechanism: Mechanism,
    symbols: Symbols,
    fixed: Constants,
    conditions: ConditionTable | None = None,
) -> Kinematics:
    """The kinematics of a mechanism: one pass along its tree."""
    ground, contacts = mechanism.model.ground, mechanism.contacts
    kinematics = Kinematics(
        symbols,
        fixed,
        ground,
        planar=mechanism.model.planar,
        still=mechanism.fixed,
        readings=reading_places(mechanism)[0],
        counters=counters_of(mechanism, symbols.q),
        numbers={link.liaison: k for k, link in enumerate(contacts)},
        sides={link.liaison: symbols.sides[k] for k, link in enumerate(contacts) if link.first},
        conditions=conditions,
    )
    nq = nv = 0
    for hanging in mechanism.coordinates:
        kinematics.carried[hanging.body] = _carried_by(hanging, nq, nv)
        hang(kinematics, hanging, nq, nv, ground)
        nq, nv = nq + len(hanging.names), nv + len(hanging.speeds)
    if kinematics.spots:
        own = ca.SX(symbols.rates)
        for place, spot in kinematics.spots.items():
            own[place] = spot.rate
        kinematics.symbols = replace(symbols, rates=own)
    return kinematics


def _carried_by(hanging: Hanging, nq: int, nv: int) -> Carried:
    motions: list[tuple[int, int, tuple[str, ...]]] = []
    for motion in hanging.motions:
        motions.append((nq, nv, motion.coordinates))
        nq, nv = nq + len(motion.coordinates), nv + motion.speed_count
    liaison = None if hanging.link is None else hanging.link.liaison
    return Carried(hanging.link, liaison, tuple(motions), hanging.carries_b)


def hang(kinematics: Kinematics, hanging: Hanging, nq: int, nv: int, ground: Body) -> None:
    """Go from the place that carries a body to its G."""
    symbols, body = kinematics.symbols, hanging.body
    base, at, out = _base(kinematics, hanging, ground)
    node = kinematics.node_of[base]
    moving, arm = at, kinematics.beyond[base] + out
    first, liaison = nq, None if hanging.link is None else hanging.link.liaison
    for motion in hanging.motions:
        m, n = len(motion.coordinates), motion.speed_count
        q, v = symbols.q[nq : nq + m], symbols.v[nv : nv + n]
        carrier = Carrier(liaison, hanging.base, first, nq)
        moved = motion.carry(kinematics, carrier, moving, q, v)
        moving = moved.moving
        if moved.along is not None and hanging.link is not None:
            kinematics.along[hanging.link.liaison] = moved.along
        if moved.columns or motion.faces_ground:
            places = tuple(range(nv, nv + n))
            arm = arm + moved.back
            kinematics.nodes.append(Node(node, arm, motion.faces_ground, places, moved.columns))
            node, arm = len(kinematics.nodes) - 1, nowhere()
        arm = arm + moved.way
        if motion.faces_ground and motion is not hanging.motions[-1] and hanging.own:
            moving = _to_axes_of_place(kinematics, hanging.own, moving)
        nq, nv = nq + m, nv + n
    moving, node, arm = _read(kinematics, hanging, at, moving, node, arm)
    kinematics.bodies[body], back = _to_centre(kinematics, hanging, moving)
    kinematics.node_of[body], kinematics.beyond[body] = node, arm + back
    _measure(kinematics, hanging, base)


def _base(kinematics: Kinematics, hanging: Hanging, ground: Body) -> tuple[Body, Moving, ca.SX]:
    """The body that carries, the axes at its place, and the vector there from its G."""
    if hanging.base is None:
        return ground, AT_REST, nowhere()
    body = point_body(hanging.base)
    out = kinematics.bodies[body].pose.direction(kinematics.local_point(hanging.base))
    return body, kinematics.moving(hanging.base), out


def _read(
    kinematics: Kinematics, hanging: Hanging, at: Moving, moving: Moving, node: int, arm: ca.SX
) -> tuple[Moving, int, ca.SX]:
    """Auxiliary speeds along what the liaison locks, where its reaction is read."""
    link = hanging.link
    first = None if link is None else kinematics.readings.get(link.liaison)
    if first is None or link is None:
        return moving, node, arm
    sign = 1 if hanging.carries_b else -1
    a, b = (at.pose, moving.pose) if hanging.carries_b else (moving.pose, at.pose)
    columns = link.columns(kinematics, a, b)
    nv, back = kinematics.symbols.v.numel(), nowhere()
    if sign < 0:  # a reaction acts at the place b
        back = ca.sparsify(moving.pose.origin - at.pose.origin)
    moving = moving.shifted(-back)
    for k, column in enumerate(columns):
        speed = sign * kinematics.symbols.sw[first + k]
        moving = replace(
            moving,
            angular=moving.angular + column.angular * speed,
            linear=moving.linear + column.linear * speed,
        )
    places = tuple(range(nv + first, nv + first + len(columns)))
    signed = tuple(Column(sign * c.angular, sign * c.linear) for c in columns)
    kinematics.nodes.append(Node(node, arm - back, False, places, signed))
    return moving.shifted(back), len(kinematics.nodes) - 1, back


def _to_centre(kinematics: Kinematics, hanging: Hanging, moving: Moving) -> tuple[Moving, ca.SX]:
    """From the place of the body that is carried to the axes at its G, and the way there.

    What faces the ground places the body's own axes.
    """
    if hanging.own is None:
        return moving, nowhere()
    if not hanging.motions or not hanging.motions[-1].faces_ground:
        moving = _to_axes_of_body(kinematics, hanging.own, moving)
    back = -kinematics.local_point(hanging.own)
    return carried(back, moving, kinematics.fixed.lower), moving.pose.direction(back)


def _to_axes_of_body(kinematics: Kinematics, own: Point, moving: Moving) -> Moving:
    """The axes of a body whose axes at a point are known; time may turn the frames between."""
    for frame in frames_of(own):
        if frame.angle is not None:
            back = -kinematics.fixed.lower(frame.angle)
            moving = turned_by_time(frame.axis, back, moving, kinematics.fixed.lower)
    return moving


def _to_axes_of_place(kinematics: Kinematics, own: Point, moving: Moving) -> Moving:
    """The axes at a point of a body whose own axes are known."""
    for frame in reversed(list(frames_of(own))):
        if frame.angle is not None:
            angle = kinematics.fixed.lower(frame.angle)
            moving = turned_by_time(frame.axis, angle, moving, kinematics.fixed.lower)
    return moving


def _measure(kinematics: Kinematics, hanging: Hanging, base: Body) -> None:
    body = hanging.body
    if hanging.base is None or hanging.own is None:
        kinematics.arms[body] = ((body, ca.SX.zeros(3)),)
        return
    there = kinematics.local_point(hanging.base)
    arm = kinematics.arm(base, there) + kinematics.arm(body, kinematics.local_point(hanging.own))
    kinematics.arms[body] = (*kinematics.arms[base], (body, arm))
