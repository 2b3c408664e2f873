"""Which liaisons without slip coordinates can keep: of a figure on a plane of the ground.

What rolls so has its angular velocity and the rate of its height as its only speeds (liaisons/
roll.py). Elsewhere rows keep it: where other figures touch, on bodies that move, where the body is
held by rows that keep places, which would move what rolls without its turning, and where time moves
anything; and where the implicit method may be taken, which finds its stages sooner with rows.
"""

from __future__ import annotations

from frot.compiler.mechanics.liaisons.locks import NoSlip, Touching
from frot.compiler.mechanics.liaisons.motions import Motion, Roll, Slide, Spot
from frot.compiler.mechanics.mechanism import Joint, frames_of, point_body, turns


def can_roll(joint: Joint) -> bool:
    """Whether its figures can: what is round on a plane of the ground.

    On a body that moves, a start that states the place of what rolls would move that body too.
    """
    touching, *others = joint.locks or (None,)
    if len(others) != 2 or not all(isinstance(x, NoSlip) for x in others):
        return False
    if point_body(joint.a).shape is not None or not turns(point_body(joint.b)):
        return False
    match touching:
        case Touching(a=plane, b=figure, followed=False, apart=None) if plane.plane is not None:
            straight = all(frame.angle is None for frame in frames_of(joint.b))
            return figure.rolls and (figure.is_round or straight)
    return False


def rolling_motions(joint: Joint) -> tuple[Motion, ...]:
    """The motions along the plane, away from it, and about the centre of the figure."""
    touching = joint.locks[0]
    assert isinstance(touching, Touching)
    axis = touching.a.plane
    assert axis is not None
    return Spot(axis), Slide(axis, coordinates=("height",)), Roll(touching.b, axis)
