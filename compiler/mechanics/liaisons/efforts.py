"""Efforts along the coordinates of liaisons: of flanges, of drives, of couples in a pin."""

from __future__ import annotations

import casadi as ca
from frot.compiler.mechanics.geometry.contacts import Geometry
from frot.compiler.mechanics.geometry.paths import slope_at
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Between, Effort
from frot.compiler.mechanics.liaisons.joint_geometry import JointGeometry
from frot.compiler.mechanics.mechanism import Contact, Joint
from frot.compiler.mechanics.spatial import cross, nowhere


def effort_along(
    link: Contact | Joint,
    coordinate: str,
    geometry: Geometry | JointGeometry,
    kinematics: Kinematics,
) -> Effort:
    """One unit along a coordinate, whether coordinates keep the liaison or not."""
    lower = kinematics.fixed.lower
    if isinstance(link, Contact):
        assert isinstance(geometry, Geometry)
        pace = _pace(link, geometry, kinematics)
        return Effort(geometry.slip / pace, geometry.line.direction / pace, nowhere())
    if coordinate == "gap":
        assert isinstance(geometry, JointGeometry) and geometry.touch is not None
        normal, place = geometry.touch.normal, geometry.touch.place
        couple = cross(place - kinematics.position(link.b), normal)
        return Effort(geometry.rates["gap"], normal, couple)
    index = [m.name for m in link.motions].index(coordinate)
    rate = kinematics.coordinate(link, index)[1]
    a, b = kinematics.pose(link.a), kinematics.pose(link.b)
    between = Between(a, b, lower, tangent=kinematics.tangents.get(link.liaison))
    return Effort(rate, *link.motions[index].bare.wrench(between))


def _pace(contact: Contact, geometry: Geometry, kinematics: Kinematics) -> ca.SX:
    """The way along a curve for one unit of its parameter."""
    tangent = kinematics.tangents.get(contact.liaison)
    if tangent is None and contact.track.figure.plane is not None:
        return ca.SX(1)
    if tangent is None:
        tangent = slope_at(contact.track.figure, geometry.abscissa, kinematics.fixed.lower)
    return ca.norm_2(tangent)
