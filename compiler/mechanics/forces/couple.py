"""A couple on a body, or in a liaison between its two bodies: `couple`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.dynamics import Push
from frot.compiler.mechanics.forces.force import Action, ForceModel, Given, Load, literal
from frot.compiler.mechanics.points import turns
from frot.compiler.mechanics.spatial import about_z, nowhere
from frot.dsl import Log
from frot.dsl.catalogue.forces import ANGLES
from frot.dsl.checked import BodyPoint, Force, Liaison

# The only angle that there is.
_ANY = "all"


class Couple(ForceModel):
    """The couple `value` on a body (in the plane about z), or along the angle of a liaison."""

    __slots__ = ()

    def check(self, force: Force, log: Log) -> None:
        """The holder has an angle, the one that is named, or turns."""
        holder, named = force.arguments["holder"], literal(force.arguments["coordinate"])
        if isinstance(holder, Liaison):
            angles = _angles(holder)
            several = len(angles) > 1 and named == _ANY
            if not angles or several or named not in (_ANY, *angles):
                no = (
                    "no angle that a couple could drive" if named == _ANY else f"no angle '{named}'"
                )
                log.report(
                    "E0205",
                    f"liaison '{holder.name}' has "
                    + (f"several angles that '{force.name}' could drive" if several else no),
                    force.span,
                    help=f"name one of its angles, as `coordinate = {angles[0]}`"
                    if angles
                    else "a couple acts in a liaison with an angle, or on a body",
                )
        elif named != _ANY:
            log.report(
                "E0205",
                f"'coordinate' of '{force.name}', a couple on a body",
                force.span,
                help="leave it out: it names an angle of a liaison",
            )
        elif isinstance(holder, BodyPoint) and not turns(holder.body):
            log.report(
                "E0205",
                f"a couple on '{holder.body.name}', which does not turn",
                force.span,
                help="name a body that turns, or a `rotoide`",
            )

    def load(self, given: Given) -> Load:
        """One couple; it has no potential."""
        holder, kinematics = given.arguments["holder"], given.kinematics
        value = given.value("value")
        if isinstance(holder, Liaison):
            named = literal(given.arguments["coordinate"])
            angle = _angles(holder)[0] if named == _ANY else str(named)
            return Load((Action(given.effort(holder, angle).rate, value),), None)
        assert isinstance(holder, BodyPoint)
        turning = kinematics.angular_velocity(holder.body)
        whole_couple = about_z(value) if kinematics.planar else ca.sparsify(value)
        push = Push(holder.body, nowhere(), nowhere(), whole_couple)
        turning = turning[2] if kinematics.planar else turning
        return Load((Action(turning, value, push=push),), None)


def _angles(liaison: Liaison) -> list[str]:
    return [name for name in liaison.kind.coordinates if name in ANGLES]
