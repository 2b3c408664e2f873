"""Variables of bodies, points and liaisons as CasADi expressions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry, GivenFriction, Reaction, Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.liaisons.kinematic_relations import numbered
from frot.compiler.mechanics.liaisons.user_liaisons import Reader, unit_of
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.shapes import inertia_of
from frot.compiler.mechanics.spatial import is_round, nowhere
from frot.compiler.mechanics.values import rate_by_time
from frot.compiler.translate.derivative_chains import Chains
from frot.compiler.translate.symbols import Symbols
from frot.compiler.translate.text_symbols import FrictionElement
from frot.dsl.catalogue import MODES
from frot.dsl.checked import Body, BodyPoint, Force, Frame, Liaison, Literal, Quantity, Variable
from frot.dsl.checked.liaison_variables import arc_of_unit

# The motions that friction may hold, and the mode in which it does: the literals count from 1.
HELD = ("slip", "speed", "speed_angle")
STICK = MODES.index("stick") + 1
# The sense of a contact that is open or has no friction.
FREE = 2


@dataclass(frozen=True, slots=True)
class Sense:
    """Whether a contact slips forwards (1) or backwards (-1), or sticks (0); FREE of any other."""

    contact: int


@dataclass(frozen=True, slots=True)
class Closed:
    """Whether a liaison that can part is closed (1) or open (0)."""

    liaison: Liaison


ModeOwner = Liaison | FrictionElement | Sense | Closed


@dataclass(frozen=True, slots=True, eq=False)
class Modes:
    """The modes that are read: of each owner the number of its contact, and a symbol.

    Changes of the first `located` are events; outputs alone read the others.
    """

    of: Mapping[ModeOwner, tuple[int, ca.SX]]
    located: int


@dataclass(frozen=True, slots=True, eq=False)
class Variables:
    """Gives the value of a variable by its owner and name.

    `geometry` and `links` hold every liaison, `reactions` the rows of those whose reaction is
    computed, `drives` the efforts that keep prescribed coordinates, by their names; `corners` the
    liaisons that one of faces stands for, `values` are those of the text, `frictions` is what
    laws give that are no dry friction, `modes` are those that are read. `strikes` are 1 while the
    kernel asks what a percussion does, else 0.
    """

    symbols: Symbols
    chains: Chains
    kinematics: Kinematics
    geometry: dict[Liaison, Geometry]
    links: dict[Liaison, Constraint]
    reactions: dict[Liaison, Rows]
    drives: dict[Liaison, list[tuple[str, ca.SX]]]
    corners: Mapping[Liaison, tuple[Liaison, ...]]
    values: Mapping[Variable, ca.SX]
    frictions: Mapping[Liaison, GivenFriction]
    modes: Modes
    strikes: Mapping[Force, ca.SX]
    _inertias: dict[Body, ca.SX] = field(default_factory=dict, repr=False)

    def quantity(self, node: Quantity) -> ca.SX:
        """Value of a variable named in the text."""
        if isinstance(node.owner, Liaison):
            return self.of_liaison(node.owner, node.name)
        assert isinstance(node.owner, Body | BodyPoint | Frame)
        return self.of_body(node.owner, node.name)

    def holds(self, node: Quantity) -> ca.SX:
        """1 where the variable is a motion that friction holds, else 0."""
        if not may_be_held(node):
            return ca.SX(0)
        assert isinstance(node.owner, Liaison)
        owner = self.corners.get(node.owner, (node.owner,))[0]
        return self.of_liaison(owner, "mode") == STICK if owner in self.modes.of else ca.SX(0)

    def at_rest(self, node: Quantity) -> ca.SX:
        """As `quantity`, but a motion that friction holds is zero to the last bit."""
        held, value = self.holds(node), self.quantity(node)
        return value if held.is_zero() else ca.if_else(held, 0, value)

    def share(self, liaison: Liaison) -> ca.SX:
        """The part of a force of a whole liaison that acts in one of its closed parts; 0 if open.

        All of it where the liaison has no parts. What cannot part is closed.
        """
        parts = next((own for own in self.corners.values() if liaison in own), (liaison,))
        is_closed = {one: self.modes.of.get(Closed(one), (-1, ca.SX(1)))[1] for one in parts}
        return is_closed[liaison] / ca.fmax(sum(is_closed.values(), ca.SX(0)), 1)

    def rate(self, value: ca.SX) -> ca.SX:
        """d/dt of a function of time, coordinates, speeds and variables of the text."""
        return self.chains.rate(self.without_auxiliary(value))

    def without_auxiliary(self, value: ca.SX) -> ca.SX:
        """The value with auxiliary speeds at zero."""
        auxiliary = self.symbols.sw
        if not auxiliary.numel():
            return value
        return ca.substitute(value, auxiliary, ca.SX.zeros(auxiliary.shape))

    def of_body(self, owner: Body | Frame | BodyPoint, name: str) -> ca.SX:
        """A variable of a body, of a named point or of a frame (ground axes, SI).

        In planar models vectors have two components, and what turns has one, that about z.
        """
        kinematics = self.kinematics
        body = owner if isinstance(owner, Body) else point_body(owner)
        match name:
            case "position":
                return self._vector(kinematics.position(owner))
            case "velocity":
                return self._vector(kinematics.moving(owner).linear)
            case "acceleration":
                return self.rate(self.of_body(owner, "velocity"))
            case "angle":
                return kinematics.angle(owner)
            case "orientation":
                return kinematics.pose(owner).quaternion
            case "angular_velocity":
                return self._turning(kinematics.angular_velocity(owner))
            case "angular_acceleration":
                return self.rate(self.of_body(owner, "angular_velocity"))
            case "ex" | "ey" | "ez":
                return self._vector(kinematics.pose(owner).axes[:, "xyz".index(name[1])])
            case "kinetic_energy":
                moving = kinematics.bodies[body]
                turning = ca.dot(moving.angular, self._spin(body))
                return (self.mass(body) * ca.sumsqr(moving.linear) + turning) / 2
            case "momentum":
                return self.mass(body) * self.of_body(body, "velocity")
            case "angular_momentum":
                return self._turning(self._spin(body))
        raise KeyError(name)

    def _vector(self, value: ca.SX) -> ca.SX:
        return ca.densify(value[:2] if self.kinematics.planar else value)

    def _turning(self, value: ca.SX) -> ca.SX:
        return ca.densify(value[2] if self.kinematics.planar else value)

    def _spin(self, body: Body) -> ca.SX:
        """Angular momentum (3) about G."""
        return self.inertia_in_ground(body) @ self.kinematics.bodies[body].angular

    def mass(self, body: Body) -> ca.SX:
        """Mass of a body, zero for the ground."""
        return self.kinematics.fixed.lower(body.arguments["mass"]) if body.shape else ca.SX(0)

    def inertia_in_ground(self, body: Body) -> ca.SX:
        """Inertia (3 x 3) about G along ground axes; in a planar model only that about z."""
        if body not in self._inertias:
            own = inertia_of(body, self.kinematics.planar, self.kinematics.fixed.lower)
            if not is_round(own):  # one that is does not see by how much axes are off length 1
                axes = self.kinematics.pose(body).axes
                own = ca.sparsify(axes @ own @ axes.T)
            self._inertias[body] = own
        return self._inertias[body]

    def effort(self, liaison: Liaison, coordinate: str) -> Effort:
        """One unit along a coordinate of a liaison, or of what keeps a relation of the user's."""
        link, geometry = self.links[liaison], self.geometry[liaison]
        relation = numbered(liaison, coordinate)
        if relation is not None:
            assert link.joint is not None
            reader = Reader(self.kinematics, self.values.__getitem__, self.of_liaison, self.rate_of)
            return unit_of(relation, link.joint, reader)
        return geometry.effort(coordinate, self.kinematics)

    def coordinate(self, liaison: Liaison, index: int) -> tuple[ca.SX, ca.SX]:
        """A coordinate of a liaison, by the place of its motion, and its rate."""
        return self.geometry[liaison].coordinate(index, self.kinematics)

    def rate_of(self, liaison: Liaison, coordinate: str) -> ca.SX:
        """The rate of a coordinate, with what auxiliary speeds add to it."""
        if coordinate == "abscissa":
            arc, u = self._arc(liaison), self.of_liaison(liaison, "u")
            changes = rate_by_time(arc, self.kinematics.fixed.lower)
            return arc * self.rate_of(liaison, "u") + changes * u
        if liaison not in self.corners:
            return self.geometry[liaison].rate_of(coordinate, self.kinematics)
        least = self.of_liaison(liaison, "gap")
        rate = ca.SX(0)
        for corner in self.corners[liaison]:
            is_it = self.of_liaison(corner, "gap") <= least
            rate = ca.if_else(is_it, self.rate_of(corner, "gap"), rate)
        return rate

    def _arc(self, liaison: Liaison) -> ca.SX:
        """The arc length of its curve (m) for one unit of the parameter."""
        arc = arc_of_unit(liaison.b)
        if arc is None:
            raise KeyError("abscissa")
        if isinstance(arc, Literal):
            return ca.SX(float(arc.value))
        return self.kinematics.fixed.lower(arc)

    def _drive(self, liaison: Liaison) -> tuple[ca.SX, ca.SX]:
        """Force and couple of the drives of a liaison."""
        force, couple = nowhere(), nowhere()
        for coordinate, size in self.drives.get(liaison, ()):
            unit = self.effort(liaison, coordinate)
            force, couple = force + size * unit.force, couple + size * unit.couple
        return force, couple

    def of_liaison(self, liaison: Liaison, name: str) -> ca.SX:
        """A variable of a liaison; its reaction is that of its first place on its second."""
        if liaison in self.corners:
            parts = [self.of_liaison(corner, name) for corner in self.corners[liaison]]
            if name == "gap":
                return ca.mmin(ca.vertcat(*parts))
            if name == "mode":  # a face slides where a corner does, and rests where one stays
                return ca.mmax(ca.vertcat(*parts))
            return parts[0] if name == "slip" else sum(parts[1:], parts[0])
        if name == "abscissa":
            return self._arc(liaison) * self.of_liaison(liaison, "u")
        if name == "mode":
            return self.modes.of.get(liaison, (-1, ca.SX(0)))[1] + 1  # literals count from 1
        return self.geometry[liaison].variable(name, self._reaction(liaison))

    def _reaction(self, liaison: Liaison) -> Reaction:
        return Reaction(
            self.reactions.get(liaison),
            self.symbols.lam,
            self._drive(liaison),
            self.frictions.get(liaison, GivenFriction()),
            self.kinematics.planar,
        )


def may_be_held(node: Quantity) -> bool:
    """Whether a variable is a motion that friction may hold, or the power of friction on it."""
    liaison = node.owner
    if not isinstance(liaison, Liaison) or not liaison.laws:
        return False
    rolls = any(law.kind.name == "rolling_resistance" for law in liaison.laws)
    return node.name in HELD or (node.name == "power" and not rolls)
