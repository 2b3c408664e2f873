"""Joints as functions of coordinates and speeds: what they lock, their coordinates, variables."""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca
from frot.compiler.mechanics.constraint import JointParts
from frot.compiler.mechanics.constraint_geometry import Geometry, Reaction, Rows, Rubbing, Uncounted
from frot.compiler.mechanics.geometry.closest_closed_form import Touch
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.liaisons.actions import Action, Effort
from frot.compiler.mechanics.liaisons.joint_places import between_places, joint_coordinate
from frot.compiler.mechanics.liaisons.orientations import ANGULAR_VELOCITY
from frot.compiler.mechanics.liaisons.rubbing import rubbings, uncounted
from frot.compiler.mechanics.spatial import GROUND, Pose, Z, conjugate, cross, nowhere, product


@dataclass(frozen=True, slots=True, eq=False)
class JointGeometry(Geometry):
    """A joint between its places.

    `actions` of its locks, `drives` tells those that drive coordinates; `turned` is -1 where its a
    is the liaison's second place; `touch` of figures that touch at one place, with the relative
    velocity `moves` there; `way` (3) along which a slide of the plane goes; `coordinates` and their
    rates by name; `relative` angular velocity (3) of b from a, its `attitude` a quaternion; `apart`
    the velocities along the locks where coordinates keep them, of auxiliary speeds alone (empty
    where no reaction is computed); `radius` of the pin or None, `rubs` what its friction opposes,
    law after law; `left` what no coordinate counts.
    """

    joint: JointParts
    actions: tuple[Action, ...]
    turned: int
    touch: Touch | None
    moves: ca.SX
    way: ca.SX | None
    drives: tuple[bool, ...]
    coordinates: dict[str, ca.SX]
    rates_of: dict[str, ca.SX]
    relative: ca.SX
    attitude: ca.SX
    apart: ca.SX
    radius: ca.SX | None
    rubs: tuple[tuple[Rubbing, ...], ...]
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    left: Uncounted = field(default_factory=Uncounted)

    @property
    def speed(self) -> ca.SX:
        """The rate of its first coordinate."""
        return next(iter(self.rates_of.values()))

    @property
    def is_free(self) -> bool:
        """Where it has no locks."""
        return not self.actions

    @property
    def words(self) -> dict[str, str]:
        """At the surface of a pin, or where figures touch."""
        found = {"normal_force": "size of the reaction"}
        if self.radius is not None:
            found["slip"] = "relative velocity at the surface of the pin"
            found["tangential_force"] = "friction at the surface of the pin"
        elif self._slides:
            found["slip"] = "relative velocity along the liaison"
            found["tangential_force"] = "friction along the liaison"
        elif self.touch is not None:
            found["slip"] = "relative velocity where they touch"
            found["tangential_force"] = "reaction along the contact"
        return found

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """A variable of a joint.

        The force, at the place b, and the couple are those of a on b, in ground axes. With the
        radius of a pin, `slip` and `tangential_force` are those at its surface; where nothing
        touches, `tangential_force` is what drives the liaison along its ways.
        """
        rows, lam, planar = reaction.rows, reaction.lam, reaction.planar
        if name in self.coordinates:
            return self.coordinates[name]
        match name:
            case "speed":
                return self.rates_of.get("displacement", self.speed)
            case "speed_angle":
                return self.rates_of["angle"]
            case "angular_velocity":
                return ca.densify(self.relative)
            case "orientation":
                return ca.densify(self.attitude)
            case "gap":
                return self.gap
            case "slip" if self.radius is not None:
                if planar and self.rates_of:
                    return self.radius * self.speed
                return self.radius * (self._turning[2] if planar else self._turning)
            case "slip" if self._slides:
                return self._along([x.rate for x in self._slides], planar)
            case "slip":
                return self._beside(self.moves * (1 if planar else self.turned), planar)
        if rows is None:
            if self.actions:
                raise KeyError(name)
            rows = Rows(())  # nothing is locked
        force, couple = (ca.densify(x) for x in reaction.drive)
        along = force
        for row, action, drives in zip(rows.reaction, self.actions, self.drives, strict=True):
            force += lam[row] * action.force
            couple += lam[row] * action.couple
            along += drives * lam[row] * action.force
        force, couple = self.turned * force, self.turned * couple
        match name:
            case "force":
                force += self.turned * (self._rubbed("force", rows, lam) + reaction.friction.force)
                return force[:2] if planar else force
            case "torque":
                given = reaction.friction.couple
                couple += self.turned * (self._rubbed("couple", rows, lam) + given)
                return couple[2] if planar else couple
            case "normal_force" if self.touch is not None:
                return self.turned * ca.dot(force, self.touch.normal)
            case "normal_force":
                for one in self.left.slides:
                    force -= ca.dot(force, one.force) * one.force
                return ca.sqrt(ca.sumsqr(force[:2] if planar else force))
            case "tangential_force" if self.radius is not None:
                rubbed = self._rubbed("couple", rows, lam) / self.radius
                return rubbed[2] if planar else rubbed
            case "tangential_force" if self._slides:
                return self._along(self._frictions(rows, lam), planar)
            case "tangential_force" if self.touch is not None:
                return self._beside(self.turned * force if planar else force, planar)
            case "tangential_force":
                return self._beside(self.turned * along, planar)
            case "power":
                own = zip(self._all_rubs, _law_rows(rows), strict=True)
                given = reaction.friction.power
                return sum((lam[row] * one.rate for one, row in own), given)
        raise KeyError(name)

    @property
    def _all_rubs(self) -> tuple[Rubbing, ...]:
        return tuple(one for law in self.rubs for one in law)

    @property
    def _slides(self) -> tuple[Rubbing, ...]:
        """What sliding friction opposes that has a direction: the slip of the places."""
        if self.left.slides:
            return self.left.slides
        laws = zip(self.joint.frictions, self.rubs, strict=True)
        found = next((own for law, own in laws if not law.turns and law.arm is None), ())
        return found if any(one.force.nnz() for one in found) else ()

    def _frictions(self, rows: Rows, lam: ca.SX) -> list[ca.SX]:
        """What dry friction does along the slides; none where laws oppose turnings alone."""
        laws = zip(self.joint.frictions, rows.of_laws, strict=True)
        own = next((own for law, own in laws if not law.turns), None)
        return [ca.SX(0)] * len(self._slides) if own is None else [lam[row] for row in own]

    @property
    def _turning(self) -> ca.SX:
        """The angular velocity (3) of a pin: about its axis, or about any."""
        return sum((one.rate * one.couple for one in self.rubs[0]), ca.SX.zeros(3))

    def _rubbed(self, kind: str, rows: Rows, lam: ca.SX) -> ca.SX:
        """Force or couple (3) of friction on b."""
        own = zip(self._all_rubs, _law_rows(rows), strict=True)
        return sum((lam[row] * getattr(one, kind) for one, row in own), ca.SX.zeros(3))

    def _along(self, values: list[ca.SX], planar: bool) -> ca.SX:
        """Values along what slides: a vector, of a pin that turns too its parts along and around.

        In the plane there is one.
        """
        if planar:
            return values[0]
        if any(not one.force.nnz() for one in self._slides):
            return ca.vertcat(*values, ca.SX(0))
        ways = zip(values, self._slides, strict=True)
        return self.turned * sum((value * one.force for value, one in ways), ca.SX.zeros(3))

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Along the locks that are read, then those that friction opposes."""
        return [self.apart, *self.rubbed_rates]

    def ways_of_law(self, law: int) -> tuple[ca.SX, ...]:
        """Along the slips, or the axes of the turnings; none of the ends of a massless rod."""
        rubs, slides = self.rubs[law], [bool(x.force.nnz()) for x in self.rubs[law]]
        if self.joint.frictions[law].end is not None or any(slides) != all(slides):
            return ()
        ways = [one.force if slides[0] else one.couple for one in rubs]
        return tuple(self.turned * way / ca.norm_2(way) for way in ways)

    @property
    def rubbed_rates(self) -> tuple[ca.SX, ...]:
        """Those of its laws."""
        return tuple(one.rate for one in self._all_rubs)

    def coordinate(self, index: int, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
        """As the bodies show it."""
        return joint_coordinate(self.joint, index, kinematics)

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """As the bodies move; of what is in touch the gap stays."""
        a, b = kinematics.moving(self.joint.a), kinematics.moving(self.joint.b)
        match coordinate:
            case "orientation":
                turning = ca.vertcat(0, a.pose.axes.T @ self.relative)
                return product(turning, ca.densify(self.attitude)) / 2
            case "length":
                return next(x.rate(a, b) for x in self.actions if x.measure is not None)
            case "gap" if "gap" not in self.rates_of:
                return ca.SX(0)
        return self.effort(coordinate, kinematics).rate

    def place(self, kinematics: Kinematics) -> ca.SX:
        """Where figures touch, else b."""
        return kinematics.position(self.joint.b) if self.touch is None else self.touch.place

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """Of a gap a force along the normal, else as the motion says.

        Auxiliary speeds add to the rate what makes the power of that force.
        """
        joint = self.joint
        if coordinate == "gap":
            assert self.touch is not None
            normal, place = self.touch.normal, self.touch.place
            couple = cross(place - kinematics.position(joint.b), normal)
            return Effort(self.rates_of["gap"], normal, couple)
        if coordinate in ANGULAR_VELOCITY:
            axis = ANGULAR_VELOCITY.index(coordinate)
            return Effort(self.relative[axis], nowhere(), GROUND.axes[:, axis])
        index = [motion.name for motion in joint.motions].index(coordinate)
        between = between_places(joint, kinematics, ca.SX(1))
        force, couple = joint.motions[index].bare.wrench(between)
        rate, auxiliary = joint_coordinate(joint, index, kinematics)[1], kinematics.symbols.sw
        if auxiliary.numel():
            a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
            power = ca.dot(force, b.linear - a.velocity_of(b.pose.origin))
            power += ca.dot(couple, self.relative)
            rate = ca.substitute(rate, auxiliary, ca.SX.zeros(auxiliary.shape))
            rate += ca.jtimes(power, auxiliary, auxiliary)
        return Effort(rate, force, couple)

    def _beside(self, vector: ca.SX, planar: bool) -> ca.SX:
        """The part of a vector along a contact, or along the ways that a liaison leaves.

        In the plane it is a signed scalar: along a contact, or along the way of a slide.
        """
        found = self.touch
        if not planar:
            return ca.densify(vector - _part(vector, None if found is None else found.normal))
        if found is not None:
            return ca.dot(vector, cross(found.normal, Z))
        return ca.SX(0) if self.way is None else ca.dot(vector, self.way)


def joint_geometry(joint: JointParts, kinematics: Kinematics, side: ca.SX) -> JointGeometry:
    """A joint, whether coordinates keep it or not."""
    a, b = kinematics.moving(joint.a), kinematics.moving(joint.b)
    between = between_places(joint, kinematics, side)
    coordinates: dict[str, ca.SX] = {}
    rates: dict[str, ca.SX] = {}
    touch: Touch | None = None
    for k, motion in enumerate(joint.motions):
        near = motion.near(between)
        if near is not None:
            touch = near.touch
            coordinates[motion.name], rates[motion.name] = near.gap, near.rate(a, b)
        elif motion.name:
            coordinates[motion.name], rates[motion.name] = joint_coordinate(joint, k, kinematics)
    actions = tuple(lock.of_joint(joint, kinematics, side) for lock in joint.locks)
    measured = [x.measure for x in actions if x.measure is not None]
    if measured:
        coordinates["length"] = measured[0]
    touch = next((x.touch for x in actions if x.touch is not None), touch)
    if sum(lock.touches for lock in joint.locks) > 1:
        touch = None  # a curve that is where two surfaces meet has no one normal
    place = b.pose.origin if touch is None else touch.place
    moves = b.velocity_of(place) - a.velocity_of(place)
    sw, at = kinematics.symbols.sw, kinematics.readings.get(joint.liaison)
    relative = b.angular - a.angular
    left = uncounted(joint, actions, relative, kinematics)
    return JointGeometry(
        joint=joint,
        actions=actions,
        turned=-1 if joint.swapped else 1,
        touch=touch,
        moves=moves,
        way=_way(joint, a.pose, kinematics),
        drives=tuple(lock.drives for lock in joint.locks),
        coordinates=coordinates,
        rates_of=rates,
        relative=relative,
        attitude=product(conjugate(a.pose.quaternion), b.pose.quaternion),
        apart=ca.SX.zeros(0) if at is None else sw[at : at + joint.readings],
        radius=_radius(joint, kinematics),
        rubs=rubbings(joint, rates, relative, touch, left, kinematics),
        left=left,
        gap=ca.SX(0) if touch is None else touch.gap,
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
    )


def _radius(joint: JointParts, kinematics: Kinematics) -> ca.SX | None:
    """Of one pin: a universal joint and a rod have two, each with an angle of its own."""
    arms = [x.arm for x in joint.frictions if x.arm is not None and x.end is None]
    return kinematics.fixed.lower(arms[0]) if len(arms) == 1 else None


def _law_rows(rows: Rows) -> tuple[int, ...]:
    return tuple(row for law in rows.of_laws for row in law)


def _way(joint: JointParts, a: Pose, kinematics: Kinematics) -> ca.SX | None:
    ways = (motion.bare.way(kinematics.fixed.lower) for motion in joint.motions)
    found = [way for way in ways if way is not None]
    return a.direction(found[0]) if kinematics.planar and len(found) == 1 else None


def _part(vector: ca.SX, normal: ca.SX | None) -> ca.SX:
    return nowhere() if normal is None else ca.dot(vector, normal) * normal
