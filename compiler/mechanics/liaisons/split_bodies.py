"""Bodies in two halves, so that a loop with friction in every joint needs no joint that closes it.

The couple in a pin follows from its reaction, which is read where coordinates keep the pin. Where a
loop would have to be closed by such a pin, a body beside it is taken as two bodies of half its mass
and inertia in the same place, welded together: the pin carries the second one, and what closes the
loop is the weld, which has no friction. The motion and every reaction are those of the one body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from frot.compiler.mechanics.constraint import Constraint, JointParts
from frot.compiler.mechanics.liaisons.joint import Joint
from frot.compiler.mechanics.liaisons.joints import JOINTS, make_joint
from frot.compiler.mechanics.points import Point, point_body, turns
from frot.compiler.mechanics.spanning import Groups, in_order
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import Body, BodyPoint, Frame, Liaison, Literal, Model
from frot.dsl.quantities.dimensions import BOOLEAN


@dataclass(frozen=True, slots=True, eq=False)
class Halved:
    """The links with their welds, and for each added half the body it is a part of."""

    links: tuple[Constraint, ...]
    halves: dict[Body, Body]


def halve(model: Model, links: Sequence[Constraint]) -> Halved:
    """Part a body at each joint with friction that would close a loop of such joints."""
    groups = Groups((model.ground, *model.bodies))
    halves: dict[Body, Body] = {}
    moved: dict[Liaison, JointParts] = {}
    welds: list[Joint] = []
    for joint in in_order(links):
        if not joint.frictions or groups.join(point_body(joint.a), point_body(joint.b)):
            continue
        at_b = turns(point_body(joint.b)) or point_body(joint.a).shape is None
        body = point_body(joint.b if at_b else joint.a)
        if body.shape is None:  # the ground on itself
            continue
        half = replace(body, name=f"{body.name}'")
        halves[half] = body
        place = _on(joint.b if at_b else joint.a, half)
        moved[joint.liaison] = replace(joint, b=place) if at_b else replace(joint, a=place)
        welds.append(_weld(body, half, joint.liaison, model.planar))
    own = tuple(moved.get(x.liaison, x) for x in links)
    return Halved((*own, *welds), halves)


def _on(place: Point, half: Body) -> Point:
    """The same place on the other half."""
    return replace(place, body=half) if isinstance(place, BodyPoint) else _frame_on(place, half)


def _frame_on(frame: Frame, half: Body) -> Frame:
    owner = frame.owner
    return replace(frame, owner=_frame_on(owner, half) if isinstance(owner, Frame) else half)


def _weld(body: Body, half: Body, closing: Liaison, planar: bool) -> Joint:
    """What cannot hold here is reported of the liaison that closes the loop."""
    span = closing.span
    kind = LIAISONS["encastrement"]
    a, b = (BodyPoint(one, "G", span) for one in (body, half))
    options = {"unilateral": Literal(False, BOOLEAN, span)}
    weld = Liaison(closing.name, kind, a, b, options, (), span)
    return make_joint(weld, a, b, JOINTS[kind.name](options, planar), {})
