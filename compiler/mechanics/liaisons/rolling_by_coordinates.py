"""Which liaisons without slip coordinates can keep: of a figure on a plane of the ground.

What rolls so has its angular velocity and the rate of its height as its only speeds
(rolling_on_planes.py). Rows keep it where other figures touch, on bodies that move, where the body
is held by rows that keep places, which would move what rolls without its turning, and where time
moves anything.
"""

from __future__ import annotations

from frot.compiler.mechanics.constraint import JointParts
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.rolling_on_planes import Roll, RollingContactPoint
from frot.compiler.mechanics.liaisons.translations import Slide
from frot.compiler.mechanics.points import frames_of, point_body, turns


def can_roll(joint: JointParts) -> bool:
    """Whether its figures can: what is round on a plane of the ground.

    On a body that moves, a start that states the place of what rolls would move that body too.
    """
    if not joint.locks or [x.rolls for x in joint.locks[1:]] != [True, True]:
        return False
    if point_body(joint.a).shape is not None or not turns(point_body(joint.b)):
        return False
    found = joint.locks[0].rolls_on
    if found is None:
        return False
    return found[1].is_round or all(frame.angle is None for frame in frames_of(joint.b))


def rolling_motions(joint: JointParts) -> tuple[Motion, ...]:
    """The motions along the plane, away from it, and about the centre of the figure."""
    found = joint.locks[0].rolls_on
    assert found is not None
    axis, figure = found
    return RollingContactPoint(axis), Slide(axis, coordinates=("height",)), Roll(figure, axis)
