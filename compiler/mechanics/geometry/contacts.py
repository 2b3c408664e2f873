"""Contacts of the plane as functions of coordinates: gap, slip and rolling rate, variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import casadi as ca
from frot.compiler.mechanics.geometry.paths import slope_at
from frot.compiler.mechanics.geometry.touches import is_closed, touch
from frot.compiler.mechanics.geometry.tracking import on_side, track
from frot.compiler.mechanics.kinematics import Kinematics, Line
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.link import Geometry, Reaction, point_body
from frot.compiler.mechanics.mechanism import is_thread
from frot.compiler.mechanics.spatial import X, Y, Z, cross, nowhere
from frot.compiler.mechanics.values import Lower
from frot.dsl.checked import World
from frot.dsl.data.classes import dataclass, field

if TYPE_CHECKING:
    from frot.compiler.mechanics.geometry.contact import Contact

STANDARD_GRAVITY = 9.81
DOWN = {"+x": X, "-x": -X, "+y": Y, "-y": -Y, "+z": Z, "-z": -Z}


@dataclass(frozen=True, slots=True, eq=False)
class ContactGeometry(Geometry):
    """A contact as functions of the coordinates.

    `line.normal` points to the left of the line's direction; `side`, chosen once, multiplies it by
    the side of the body. `gap` >= 0 while apart, `approach` its rate. `witness` are the three
    numbers the first of which that is not zero has the sign of the side: height of the point or of
    the rim's centre over the line, part of the normal that is against gravity, height of the body's
    G. `reach` is the size of
    the lengths that the gap is made of beside the coordinates, even where they cancel out. `slip`
    and `roll` are the velocity of the body's material point relative to the line's, along the
    line's direction, and the relative angular velocity. `lengths`: of a thread, by name.
    """

    contact: Contact
    line: Line
    side: ca.SX
    gap: ca.SX
    approach: ca.SX
    witness: ca.SX
    reach: ca.SX
    slip: ca.SX
    roll: ca.SX
    abscissa: ca.SX
    lengths: Mapping[str, ca.SX] = field(default_factory=dict)

    @property
    def words(self) -> dict[str, str]:
        """Along the normal, and along the line."""
        normal = {"normal_force": "reaction along the normal, on the body"}
        along = {
            "slip": "velocity of the body's point along the line",
            "tangential_force": "friction along the line, on the body",
        }
        return normal | (along if self.contact.slips else {})

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Along the normal, along the line, and of rolling."""
        at = kinematics.readings.get(self.contact.liaison)
        # what coordinates keep moves along its normal by its auxiliary speed alone
        normal = self.approach if at is None else kinematics.symbols.sw[at]
        frictions = self.contact.frictions
        return [normal, *(self.roll if x.rolling else self.slip for x in frictions)]

    def coordinate(self, index: int, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
        """The parameter of the curve."""
        return self.abscissa, self.effort("u", kinematics).rate

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """A force on the point along the curve."""
        pace = self._pace(kinematics)
        return Effort(self.slip / pace, self.line.direction / pace, nowhere())

    def _pace(self, kinematics: Kinematics) -> ca.SX:
        """The way along the curve for one unit of its parameter."""
        curve = self.contact.track.figure
        tangent = kinematics.tangents.get(self.contact.liaison)
        if tangent is None and curve.plane is not None:
            return ca.SX(1)
        if tangent is None:
            tangent = slope_at(curve, self.abscissa, kinematics.fixed.lower)
        return ca.norm_2(tangent)

    def place(self, kinematics: Kinematics) -> ca.SX:
        """On the line."""
        return self.line.through

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """A variable of a contact; the reaction is that of the first place on the second."""
        if name in self.lengths:
            return self.lengths[name]
        match name:
            case "gap":
                return self.gap
            case "slip":
                return self.slip
            case "u" | "abscissa":
                return self.abscissa
        rows, lam = reaction.rows, reaction.lam
        if rows is None:
            raise KeyError(name)
        normal = lam[rows.reaction[0]]
        tangent = ca.dot(reaction.drive[0], self.line.direction)
        friction = reaction.friction
        friction += lam[rows.tangent] if rows.tangent >= 0 else ca.SX(0)
        tangent += friction
        couple = lam[rows.rolling] if rows.rolling >= 0 else ca.SX(0)
        on_second = 1 if self.contact.track_first else -1
        match name:
            case "normal_force":
                return normal
            case "tangential_force":
                return tangent
            case "force":
                line = self.line
                push = self.side * normal * line.normal + tangent * line.direction
                return on_second * push[:2]
            case "torque":
                return on_second * couple
            case "power":
                return friction * self.slip + couple * self.roll
        raise KeyError(name)


def _witness(contact: Contact, line: Line, kinematics: Kinematics, world: World) -> ca.SX:
    """What chooses the side.

    |n . (c - o)| - r has a corner on the line, so the gap is s n . (c - o) - r, with the sign s
    that the product has where the run begins: s n points to the body, which never gets through. On
    the line itself up is the side, then that of G. The ground is below its own line, whatever the
    start says, and a point that cannot leave its line has its normal to the left.
    """
    if contact.floor or contact.keeps_left:
        return ca.SX.ones(3)
    centre = kinematics.position(contact.point)
    middle = kinematics.position(point_body(contact.point))
    vectors = (centre - line.through, _upward(world, kinematics), middle - line.through)
    return ca.vertcat(*(ca.dot(line.normal, vector) for vector in vectors))


def _reach(contact: Contact, line: Line, kinematics: Kinematics) -> ca.SX:
    """Size of the vectors from the bodies' coordinates to the point and to the line."""
    base = point_body(contact.track.point)
    sizes = kinematics.lengths_between(
        (base, None), (point_body(contact.point), kinematics.local_point(contact.point))
    )
    # along a line its given point counts for nothing, wherever its body turns
    turn = kinematics.pose(base).axes.T
    through = kinematics.local_point(contact.track.point)
    return ca.dot(ca.fabs(line.normal), sizes) + ca.dot(
        ca.fabs(turn @ line.normal), ca.fabs(through)
    )


def gravity(world: World, kinematics: Kinematics) -> ca.SX:
    """Acceleration of free fall (3)."""
    given = world.gravity
    size = ca.SX(STANDARD_GRAVITY) if given is None else kinematics.fixed.lower(given)
    return ca.sparsify(size * DOWN[world.down])


def _upward(world: World, kinematics: Kinematics) -> ca.SX:
    """Unit vector against gravity, zero without gravity."""
    fall = gravity(world, kinematics)
    size = ca.sqrt(ca.sumsqr(fall))
    return -fall / ca.if_else(size > 0, size, 1)


def contact_geometry(
    contact: Contact, kinematics: Kinematics, side: ca.SX, world: World
) -> ContactGeometry:
    """Geometry and relative velocities of a point or rim on a curve."""
    if contact.keeps_left:
        side = ca.SX(1)
    if contact.liaison in kinematics.tangents:
        return _carried(contact, kinematics)
    if contact.track.figure.plane is not None and is_closed(contact.track.figure, contact.figure):
        return _on_line(contact, kinematics, side, world)
    return _on_curve(contact, kinematics, side, world)


def _apart(
    contact: Contact, kinematics: Kinematics, place: ca.SX, at: ca.SX
) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Velocities of the body from the curve at two places, and the angular one."""
    body, base = kinematics.moving(contact.point), kinematics.moving(contact.track.point)
    apart, nearing = (body.velocity_of(x) - base.velocity_of(x) for x in (place, at))
    return apart, nearing, body.angular - base.angular


def _on_line(
    contact: Contact, kinematics: Kinematics, side: ca.SX, world: World
) -> ContactGeometry:
    """A round thing comes nearer as its centre does, for it has no slope.

    The gap is g = s n . (c - o) - r, and the normal turns with the line, n' = w x n: so its rate is
    s n . (v_c - v_o - w x (c - o)), by the velocity of the line's material point at c. What is not
    round touches at the point whose normal is n, and the rate is by the material points there; they
    slip along the line (P. Painlevé 1895, p. 39).
    """
    line = kinematics.line(contact.track)
    centre, lower = kinematics.position(contact.point), kinematics.fixed.lower
    height = ca.dot(line.normal, centre - line.through)
    figure = contact.figure
    radius, below = figure.below(kinematics.pose(contact.point), line.normal, lower)
    touching = centre - side * below
    at = centre if figure.is_round or figure.is_point else touching
    apart, nearing, turning = _apart(contact, kinematics, touching, at)
    return ContactGeometry(
        contact=contact,
        line=line,
        side=side,
        gap=side * height - radius,
        approach=side * ca.dot(line.normal, nearing),
        witness=_witness(contact, line, kinematics, world),
        reach=radius + _reach(contact, line, kinematics),
        slip=ca.dot(line.direction, apart),
        roll=ca.dot(Z, turning),
        abscissa=ca.dot(line.direction, centre - line.through),
    )


def _carried(contact: Contact, kinematics: Kinematics) -> ContactGeometry:
    """A point that its coordinate keeps on a curve; its slip is against the curve's elements."""
    line, liaison = kinematics.curve_at(contact), contact.liaison
    value, rate = kinematics.parameter(liaison)
    _, _, turning = _apart(contact, kinematics, line.through, line.through)
    return ContactGeometry(
        contact=contact,
        line=line,
        side=ca.SX(1),
        gap=ca.SX(0),
        approach=ca.SX(0),
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
        slip=ca.norm_2(kinematics.tangents[liaison]) * rate,
        roll=ca.dot(Z, turning),
        abscissa=value,
    )


def _on_curve(
    contact: Contact, kinematics: Kinematics, side: ca.SX, world: World
) -> ContactGeometry:
    """On a curve of any kind; the left of a circle is its inside.

    The gap is g = n . (p_b - p_a) of the nearest points, whose difference is along n. These go
    along their figures across n, and n' is across n: so the rate of g is n . (v_b - v_a) of the
    material points there, with what time alone makes of g. Their difference along the curve is the
    slip (P. Painlevé 1895, p. 39; of curves whose elements move, p. 64).
    """
    lower, a, b = kinematics.fixed.lower, contact.track.figure, contact.figure
    base, own = kinematics.pose(contact.track.point), kinematics.pose(contact.point)
    left = -1 if a.is_round else 1
    if is_closed(a, b):
        found = touch(a, b, (base, own), lower, left * side)
        angle = a.parameter(own.origin - base.origin, base, lower)
        abscissa = kinematics.counted(contact, 0, angle)
    else:
        followed = kinematics.track(
            contact.liaison, lambda: track(a, b, (base, own), lower, planar=True)
        )
        found = on_side(followed.touch, left * side)
        by_place = a.parameters < 0
        apart = found.place - base.origin
        abscissa = a.parameter(apart, base, lower) if by_place else followed.unknowns[0]
    normal, witness = side * found.normal, left * found.witness
    line = Line(found.place, cross(normal, Z), normal)
    apart, nearing, turning = _apart(contact, kinematics, found.place, found.place)
    up = ca.dot(normal, _upward(world, kinematics))
    sizes = kinematics.lengths_between(
        (point_body(contact.track.point), kinematics.local_point(contact.track.point)),
        (point_body(contact.point), kinematics.local_point(contact.point)),
    )
    kept = contact.keeps_left
    return ContactGeometry(
        contact=contact,
        line=line,
        side=side,
        gap=found.gap,
        approach=ca.dot(found.normal, nearing) + found.own,
        witness=ca.SX.ones(3) if kept else ca.vertcat(witness, up, witness),
        reach=found.size + ca.dot(ca.fabs(normal), sizes),
        slip=ca.dot(line.direction, apart + found.drift),
        roll=ca.dot(Z, turning),
        abscissa=abscissa,
        lengths=_lengths(contact, own.origin - base.origin, lower),
    )


def _lengths(contact: Contact, way: ca.SX, lower: Lower) -> Mapping[str, ca.SX]:
    """How long a thread is drawn out, and what is left of it."""
    if not is_thread(contact.liaison):
        return {}
    long = ca.norm_2(way)
    return {"length": long, "gap": lower(contact.liaison.options["length"]) - long}
