"""A contact in space that may part, or have friction: two figures that touch at one place."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Self

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.constraint_geometry import Geometry, Reaction, Rows
from frot.compiler.mechanics.geometry.bounded_figures import ends
from frot.compiler.mechanics.geometry.closest_closed_form import Touch, is_closed, touch
from frot.compiler.mechanics.geometry.closest_solved import on_side, track
from frot.compiler.mechanics.geometry.crossing_edges import are_straight, distance_of_ends
from frot.compiler.mechanics.geometry.curves_with_ends import Ending
from frot.compiler.mechanics.geometry.figure import Figure, Placed
from frot.compiler.mechanics.geometry.nearest_with_ends import nearest_with_ends
from frot.compiler.mechanics.geometry.sides import gravity
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.points import Point, point_body
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.spatial import beside_moving, cross
from frot.compiler.mechanics.threads import Thread, thread_of
from frot.dsl.checked import BodyGeometry, Expression, Liaison, World

if TYPE_CHECKING:
    from frot.compiler.mechanics.kinematics import Kinematics


@dataclass(frozen=True, slots=True, eq=False)
class SpaceContact(Constraint):
    """Two figures in space that touch at one place, with the laws that bound their reaction.

    `first` is the figure whose normal counts, `second` the one that is on a side of it;
    `swapped`: the first figure is the second place of the liaison. `floor`: the first is the plane
    of the ground, which is below. Its rows are the normal, then those of each law: two of sliding,
    two of rolling, one of pivoting.
    """

    liaison: Liaison = field()
    a: Placed
    b: Placed
    floor: bool
    unilateral: Expression = field()
    exchanged: bool = False
    frictions: tuple[FrictionBlock, ...] = ()
    opens = True
    slip_components = 2

    @property
    def ends(self) -> tuple[Point, Point]:
        """The places of the first figure and of the second."""
        return self.a.point, self.b.point

    @property
    def swapped(self) -> bool:
        """Whether the first figure is the second place of the liaison."""
        return self.exchanged

    @property
    def pairs(self) -> tuple[tuple[Figure, Figure], ...]:
        """The two figures."""
        return ((self.a.figure, self.b.figure),)

    def kept(self, reduced: bool) -> Self:
        """The same: rows alone keep it."""
        return self

    def without_friction(self) -> Self:
        """The same without laws."""
        return replace(self, frictions=())

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> SpaceContactGeometry:
        """Where the figures are nearest, and how they move there."""
        return _geometry(self, kinematics, side, world)

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """Names of the rows: along the normal, then of each law."""
        name = self.liaison.name
        return (
            f"{name}.normal_force",
            *(f"{name}.{friction.name}[{k + 1}]" for friction in self.frictions
              for k in range(friction.components)),
        )  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class SpaceContactGeometry(Geometry):
    """A contact in space as functions of the coordinates.

    `found` is how the figures stand, its normal from the first to the second. `moves` is the
    velocity of the material point of the second from that of the first, `turning` the relative
    angular velocity, `tangents` two unit vectors beside the normal. `turned` is -1 where the first
    figure is the second place of the liaison. `remaining` is the gap that the
    text reads; `thread` is what a thread is drawn out.
    """

    contact: SpaceContact
    found: Touch
    approach: ca.SX
    moves: ca.SX
    turning: ca.SX
    tangents: tuple[ca.SX, ca.SX]
    turned: int
    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    remaining: ca.SX
    thread: Thread | None = None

    @property
    def words(self) -> dict[str, str]:
        """What its variables are."""
        normal = {"normal_force": "reaction along the normal, on the second figure"}
        along = {
            "slip": "relative velocity where they touch",
            "tangential_force": "friction, in the tangent plane",
        }
        return normal if self.thread is not None else normal | along

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Along the normal, then of each law."""
        found = [self.approach]
        for friction in self.contact.frictions:
            found += [ca.dot(way, self._motion(friction)) for way in self._ways(friction)]
        return found

    def _motion(self, friction: FrictionBlock) -> ca.SX:
        """The velocity that a law opposes: of the points, or angular."""
        return self.turning if friction.turns else self.moves

    def ways_of_law(self, law: int) -> tuple[ca.SX, ...]:
        """In the tangent plane, or along the normal."""
        return tuple(self.turned * way for way in self._ways(self.contact.frictions[law]))

    def _ways(self, friction: FrictionBlock) -> tuple[ca.SX, ...]:
        """The directions of its rows."""
        return (self.found.normal,) if friction.pivoting else self.tangents

    def place(self, kinematics: Kinematics) -> ca.SX:
        """Where the second figure touches."""
        return self.found.place

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """The rate of the gap, or of the length of a thread."""
        return self.effort(coordinate, kinematics).rate

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """A force along the normal, or along a thread."""
        if self.thread is not None:
            return self.thread.effort(coordinate)
        normal, body = self.found.normal, kinematics.position(self.contact.b.point)
        return Effort(self.approach, normal, cross(self.found.place - body, normal))

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """A variable of the contact; the reaction is that of the first place on the second."""
        if name == "gap":
            return self.remaining
        if name == "length" and self.thread is not None:
            return self.thread.length
        if name == "slip":
            normal = self.found.normal
            return self.turned * (self.moves - ca.dot(self.moves, normal) * normal)
        rows, lam = reaction.rows, reaction.lam
        if rows is None:
            raise KeyError(name)
        normal = lam[rows.reaction[0]] * self.found.normal
        friction, couple = ca.SX.zeros(3), ca.SX.zeros(3)
        for law, own in zip(self.contact.frictions, rows.of_laws, strict=True):
            total = sum((lam[row] * way for row, way in zip(own, self._ways(law), strict=True)),
                        ca.SX.zeros(3))  # fmt: skip
            if law.turns:
                couple += total
            else:
                friction += total
        given = reaction.friction
        match name:
            case "normal_force":
                return lam[rows.reaction[0]]
            case "tangential_force":
                return self.turned * friction + given.force
            case "force":
                return self.turned * (normal + friction + reaction.drive[0]) + given.force
            case "torque":
                return self.turned * couple + given.couple
            case "power":
                work = ca.dot(friction, self.moves) + ca.dot(couple, self.turning)
                return work + given.power
        raise KeyError(name)


def _geometry(
    contact: SpaceContact, kinematics: Kinematics, side: ca.SX, world: World
) -> SpaceContactGeometry:
    a, b, lower = contact.a, contact.b, kinematics.fixed.lower
    at = (kinematics.pose(a.point), kinematics.pose(b.point))
    if contact.floor:
        side = ca.SX(1)
    bounded = is_unilateral(contact.liaison) and (ends(a.figure) or ends(b.figure))
    if bounded:
        ending = Ending(side, kinematics.passing(contact.liaison))
        follow = partial(kinematics.track, contact.liaison)
        found = nearest_with_ends(a.figure, b.figure, at, lower, ending, follow)
    elif is_closed(a.figure, b.figure):
        found = touch(a.figure, b.figure, at, lower, side)
    else:
        make = partial(track, a.figure, b.figure, at, lower, False)
        found = on_side(kinematics.track(contact.liaison, make).touch, side)
    first, second = kinematics.moving(a.point), kinematics.moving(b.point)
    moves = second.velocity_of(found.place) - first.velocity_of(found.place)
    thread = thread_of(contact.liaison, kinematics, a.point, b.point)
    remaining = found.gap if thread is None else thread.rest
    if bounded and are_straight(a.figure, b.figure):
        remaining = ca.fmin(found.gap, distance_of_ends(a.figure, b.figure, at, lower))
    sizes = kinematics.lengths_between(
        (point_body(a.point), kinematics.local_point(a.point)),
        (point_body(b.point), kinematics.local_point(b.point)),
    )
    return SpaceContactGeometry(
        contact=contact,
        found=found,
        approach=ca.dot(found.normal, moves) + found.own,
        moves=moves + found.drift,
        turning=second.angular - first.angular,
        tangents=_tangents(contact, found, kinematics),
        turned=-1 if contact.exchanged else 1,
        gap=found.gap,
        remaining=remaining,
        thread=thread,
        witness=_witness(contact, found, side, kinematics, world),
        reach=found.size + ca.dot(ca.fabs(found.normal), sizes),
    )


def _tangents(contact: SpaceContact, found: Touch, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
    """Unit vectors beside the normal: those of a plane turn with it, others follow the normal."""
    for figure, point in ((contact.a.figure, contact.a.point), (contact.b.figure, contact.b.point)):
        if figure.plane is not None and not ends(figure):
            pose = kinematics.pose(point)
            one, other = (pose.direction(x) for x in figure.plane.beside(kinematics.fixed.lower))
            return one, other
    one, other = beside_moving(found.normal)
    return one, other


def _witness(
    contact: SpaceContact, found: Touch, side: ca.SX, kinematics: Kinematics, world: World
) -> ca.SX:
    """Three numbers, the first of which that is not zero has the sign of the side.

    The height of the second figure over the first; what of the normal of the first is against
    gravity; the height of the centre of the second body.
    """
    if contact.floor:
        return ca.SX.ones(3)
    outwards = side * found.normal  # whatever the side is
    fall = gravity(world, kinematics)
    # what rests on a body that cannot move is above it
    own, other = point_body(contact.b.point), point_body(contact.a.point)
    below = own in kinematics.still and other not in kinematics.still
    centre = kinematics.position(other if below else own)
    height = ca.dot(outwards, centre - found.place)
    outside = _outside(contact, kinematics)
    up = -ca.dot(outwards, fall) if outside.is_zero() else outside
    if below:
        up, height = -up if outside.is_zero() else up, -height
    return ca.vertcat(found.witness, up, height)


def _outside(contact: SpaceContact, kinematics: Kinematics) -> ca.SX:
    """The side of a face or an edge that its body leaves free: +1, or 0 where none is known."""
    place = contact.liaison.b if contact.exchanged else contact.liaison.a
    if not (ends(contact.a.figure) and isinstance(place, BodyGeometry)):
        return ca.SX(0)
    return shape_of(place.body).outside(place, kinematics.fixed.lower)
