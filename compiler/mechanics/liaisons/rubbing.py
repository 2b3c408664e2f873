"""What dry friction opposes in a joint: along which coordinates, by which forces and couples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import casadi as ca
from frot.compiler.mechanics.constraint import FrictionBlock, JointParts, Way
from frot.compiler.mechanics.constraint_geometry import Rubbing, Uncounted
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action
from frot.compiler.mechanics.liaisons.joint_places import between_places
from frot.compiler.mechanics.spatial import X, Y, Z, beside_moving, cross, nowhere, orthonormal


def rubbings(
    joint: JointParts,
    rates: Mapping[str, ca.SX],
    relative: ca.SX,
    touch: Touch | None,
    left: Uncounted,
    kinematics: Kinematics,
) -> tuple[tuple[Rubbing, ...], ...]:
    """The rows of each law of a joint.

    `rates` of its coordinates, `relative` its angular velocity, `touch` how its figures stand,
    `left` what no coordinate counts.
    """
    found = []
    for law in joint.frictions:
        if law.end is not None:
            found.append(left.ends[law.end])
            continue
        if any(joint.uncounted) and not law.turns:
            found.append(left.slides or left.turns)
            continue
        if law.ways:
            found.append(tuple(_along(joint, way, rates, kinematics) for way in law.ways))
            continue
        normal = left.normal if touch is None else touch.normal
        axes = (X, Y, Z) if normal is None else _turns(law, normal, kinematics.planar)
        found.append(tuple(Rubbing(ca.dot(axis, relative), nowhere(), axis) for axis in axes))
    return tuple(found)


def uncounted(
    joint: JointParts, actions: Sequence[Action], relative: ca.SX, kinematics: Kinematics
) -> Uncounted:
    """Slips of the material points beside the forces of the locks that press, or turnings.

    These forces are orthonormal. A joint whose forces leave no slip leaves the turnings beside the
    couples of its other locks.
    """
    slides, turns = joint.uncounted
    planar = kinematics.planar
    if joint.pinned:
        return Uncounted(ends=tuple(_ends_of_rod(joint, actions[0], kinematics)))
    if not slides and not turns:
        return Uncounted()
    pairs = list(zip(joint.locks, actions, strict=True))
    pushing = [action for lock, action in pairs if lock.presses is not None]
    if slides:
        a, b, main = kinematics.moving(joint.a), kinematics.moving(joint.b), pushing[0]
        moves = main.moves(a, b) + main.drift
        ways = _beside([x.force for x in pushing], planar)
        found = tuple(Rubbing(ca.dot(e, moves), e, nowhere()) for e in ways)
        return Uncounted(slides=found, normal=main.normal)
    twists = [action.couple for lock, action in pairs if lock.presses is None]
    axes = (Z,) if planar else _beside(orthonormal(twists), False)
    return Uncounted(turns=tuple(Rubbing(ca.dot(e, relative), nowhere(), e) for e in axes))


def _ends_of_rod(
    joint: JointParts, action: Action, kinematics: Kinematics
) -> Iterator[tuple[Rubbing, ...]]:
    """The turning of a rod without mass from the body at each of its ends.

    The rod from a to b, along e and of length L, turns by e x (v_b - v_a)/L; its spin about e,
    which nothing determines, is not opposed. A couple C on the body at its end comes with the force
    C x e/L on b, so that the moments on the rod cancel.
    """
    a, b, planar = kinematics.moving(joint.a), kinematics.moving(joint.b), kinematics.planar
    assert action.measure is not None
    e, length = action.force, action.measure
    turns = cross(e, action.moves(a, b) + cross(a.angular, length * e)) / length
    axes = (Z,) if planar else beside_moving(e)
    for own, couple in ((a.angular, ca.SX(0)), (b.angular, ca.SX(-1))):
        yield tuple(
            Rubbing(ca.dot(axis, turns - own), cross(axis, e) / length, couple * axis)
            for axis in axes
        )


def _beside(units: Sequence[ca.SX], planar: bool) -> tuple[ca.SX, ...]:
    """Unit vectors that complete orthonormal ones to a frame."""
    if planar:
        return tuple(cross(unit, Z) for unit in units[:1])
    if not units:
        return X, Y, Z
    if len(units) == 1:
        return beside_moving(units[0])
    return (cross(*units),)


def _turns(law: FrictionBlock, normal: ca.SX, planar: bool) -> tuple[ca.SX, ...]:
    """The axes of what rolls, or pivots about the normal."""
    if planar:
        return (Z,)
    return (normal,) if law.pivoting else beside_moving(normal)


def _along(
    joint: JointParts, way: Way, rates: Mapping[str, ca.SX], kinematics: Kinematics
) -> Rubbing:
    """Along a coordinate: on a curve by its length, of a turn beside a slide at the radius."""
    names = [motion.name for motion in joint.motions]
    motion = joint.motions[names.index(way.name)].bare
    between = between_places(joint, kinematics, ca.SX(1))
    force, couple = motion.wrench(between)
    scale = ca.SX(1) if way.arm is None else kinematics.fixed.lower(way.arm)
    if motion.curve is not None:
        scale = 1 / ca.norm_2(force)
    return Rubbing(scale * rates[way.name], force * scale, couple * scale)
