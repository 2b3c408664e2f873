"""A couple on a body, or in a liaison between its two bodies: `couple`."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.dynamics import Push
from frot.compiler.mechanics.forces.force import Action, ForceModel, Given, Load
from frot.compiler.mechanics.points import turns
from frot.compiler.mechanics.spatial import about_z, nowhere
from frot.dsl import Log
from frot.dsl.checked import BodyPoint, Force, Liaison


class Couple(ForceModel):
    """The couple `value` on a body (in the plane about z), or along the angle of a liaison."""

    __slots__ = ()

    def check(self, force: Force, log: Log) -> None:
        """The holder has an angle, or turns."""
        holder = force.arguments["holder"]
        if isinstance(holder, Liaison):
            if "angle" not in holder.kind.coordinates:
                log.report(
                    "E0205",
                    f"liaison '{holder.name}' has no angle that a couple could drive",
                    force.span,
                    help="a couple acts in a liaison with an angle, or on a body",
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
            return Load((Action(given.effort(holder, "angle").rate, value),), None)
        assert isinstance(holder, BodyPoint)
        turning = kinematics.angular_velocity(holder.body)
        whole_couple = about_z(value) if kinematics.planar else ca.sparsify(value)
        push = Push(holder.body, nowhere(), nowhere(), whole_couple)
        turning = turning[2] if kinematics.planar else turning
        return Load((Action(turning, value, push=push),), None)
