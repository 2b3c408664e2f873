"""A liaison of the plane that may part, or have friction: a point, a rim, a curve on a curve."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.mechanics.geometry.contact_parts import ContactParts
from frot.compiler.mechanics.geometry.contacts import ContactGeometry, contact_geometry
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.curves import PointOnCurve
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.translations import Slide
from frot.compiler.mechanics.spatial import Pose, nowhere
from frot.dsl.checked import World


@dataclass(frozen=True, slots=True, eq=False)
class Contact(ContactParts):
    """A contact with the motions by which it carries a body, and its geometry."""

    def carrying(self) -> tuple[Motion, ...]:
        """Along the curve."""
        curve = self.track.figure
        if curve.plane is None:
            return (PointOnCurve(curve),)
        return (Slide(curve.plane, coordinates=("u",)),)

    def columns(self, kinematics: Kinematics, a: Pose, b: Pose) -> list[Column]:
        """Along the normal."""
        return [Column(nowhere(), kinematics.normal(self.liaison, self.track))]

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> ContactGeometry:
        """Where it touches."""
        return contact_geometry(self, kinematics, side, world)
