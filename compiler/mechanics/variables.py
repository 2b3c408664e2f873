"""Variables of bodies, points and liaisons as CasADi expressions."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.chains import Chains
from frot.compiler.lowering.symbols import Rows, Symbols
from frot.compiler.mechanics.contacts import Geometry
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.mechanism import Joint, Pin, point_body
from frot.compiler.mechanics.pins import PinGeometry, pin_variable
from frot.dsl.checked import Body, BodyPoint, Frame, Liaison, Quantity


@dataclass(frozen=True, slots=True, eq=False)
class Variables:
    """Gives the value of a variable by its owner and name.

    `geometry` holds every liaison, `reactions` the rows of those whose reaction is computed.
    """

    symbols: Symbols
    chains: Chains
    kinematics: Kinematics
    geometry: dict[Liaison, Geometry | PinGeometry]
    contacts: dict[Liaison, Joint]
    reactions: dict[Liaison, Rows]

    def quantity(self, node: Quantity) -> ca.SX:
        """Value of a variable named in the text."""
        if isinstance(node.owner, Liaison):
            return self.of_liaison(node.owner, node.name)
        return self.of_body(node.owner, node.name)

    def rate(self, value: ca.SX) -> ca.SX:
        """d/dt of a function of time, coordinates, speeds and variables of the text."""
        return self.chains.rate(self.settled(value))

    def settled(self, value: ca.SX) -> ca.SX:
        """The value with auxiliary coordinates and speeds at zero."""
        if not self.symbols.w.numel():
            return value
        auxiliary = self.symbols.auxiliary
        return ca.substitute(value, auxiliary, ca.SX.zeros(auxiliary.shape))

    def of_body(self, owner: Body | Frame | BodyPoint, name: str) -> ca.SX:
        """A variable of a body, of a named point or of a frame (ground axes, SI)."""
        kinematics = self.kinematics
        body = owner if isinstance(owner, Body) else point_body(owner)
        match name:
            case "position":
                return kinematics.position(owner)
            case "velocity":
                return kinematics.velocity(kinematics.position(owner))
            case "acceleration":
                return self.rate(self.of_body(owner, "velocity"))
            case "angle":
                return kinematics.angle(owner)
            case "angular_velocity":
                return kinematics.velocity(kinematics.angle(owner))
            case "angular_acceleration":
                return self.rate(self.of_body(owner, "angular_velocity"))
            case "ex" | "ey":
                angle = kinematics.angle(owner)
                c, s = ca.cos(angle), ca.sin(angle)
                return ca.vertcat(c, s) if name == "ex" else ca.vertcat(-s, c)
            case "kinetic_energy":
                m, inertia = self.mass(body), self.inertia(body)
                turning = inertia * self.of_body(body, "angular_velocity") ** 2
                return (m * ca.sumsqr(self.of_body(body, "velocity")) + turning) / 2
            case "momentum":
                return self.mass(body) * self.of_body(body, "velocity")
            case "angular_momentum":
                return self.inertia(body) * self.of_body(body, "angular_velocity")
        raise KeyError(name)

    def mass(self, body: Body) -> ca.SX:
        """Mass of a body, zero for the ground."""
        return self.kinematics.fixed.lower(body.arguments["mass"]) if body.shape else ca.SX(0)

    def inertia(self, body: Body) -> ca.SX:
        """Moment of inertia about G, zero for a particle."""
        lower = self.kinematics.fixed.lower
        if body.shape is None or not body.shape.turns:
            return ca.SX(0)
        if "inertia" in body.arguments:
            return lower(body.arguments["inertia"])
        if body.shape.name == "rod":
            return self.mass(body) * lower(body.arguments["length"]) ** 2 / 12
        factor = {"ring": 1.0, "disc": 0.5}[body.shape.name]
        return factor * self.mass(body) * lower(body.arguments["radius"]) ** 2

    def of_liaison(self, liaison: Liaison, name: str) -> ca.SX:
        """A variable of a liaison; its reaction is that of its first place on its second."""
        geometry = self.geometry[liaison]
        if isinstance(geometry, PinGeometry):
            return pin_variable(geometry, name, self.reactions.get(liaison), self.symbols.lam)
        match name:
            case "gap":
                return geometry.gap
            case "slip":
                return geometry.slip
            case "u" | "abscissa":
                return geometry.abscissa
        rows, contact = self.reactions[liaison], self.contacts[liaison]
        lam = self.symbols.lam
        normal = lam[rows.normal]
        tangent = lam[rows.tangent] if rows.tangent >= 0 else ca.SX(0)
        couple = lam[rows.rolling] if rows.rolling >= 0 else ca.SX(0)
        assert not isinstance(contact, Pin)
        on_second = 1 if contact.line_first else -1
        match name:
            case "normal_force":
                return normal
            case "tangential_force":
                return tangent
            case "force":
                line = geometry.line
                return on_second * (geometry.side * normal * line.normal + tangent * line.direction)
            case "torque":
                return on_second * couple
            case "power":
                return tangent * geometry.slip + couple * geometry.roll
        raise KeyError(name)
