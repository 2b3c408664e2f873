"""Contacts of the plane: a point, a rim, a curve on a curve, as functions of coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.mechanics.constraint_geometry import Geometry, Reaction
from frot.compiler.mechanics.geometry.closest_closed_form import is_closed, touch
from frot.compiler.mechanics.geometry.closest_solved import Track, on_side, track
from frot.compiler.mechanics.geometry.contact_parts import ContactParts
from frot.compiler.mechanics.geometry.curves_with_ends import (
    AT_END,
    Ending,
    away,
    bounded,
    track_to_ends,
)
from frot.compiler.mechanics.geometry.parametric_figures import slope_at
from frot.compiler.mechanics.geometry.sides import sides_of
from frot.compiler.mechanics.kinematics import Kinematics, Line
from frot.compiler.mechanics.liaisons.actions import Effort
from frot.compiler.mechanics.liaisons.curves import PointOnCurve
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.moves import Column
from frot.compiler.mechanics.liaisons.translations import Slide
from frot.compiler.mechanics.mechanism import is_unilateral
from frot.compiler.mechanics.points import point_body
from frot.compiler.mechanics.spatial import Pose, Z, cross, nowhere
from frot.compiler.mechanics.threads import Thread, thread_of
from frot.dsl.checked import World


@dataclass(frozen=True, slots=True, eq=False)
class ContactGeometry(Geometry):
    """A contact as functions of the coordinates.

    `line.normal` points to the left of the line's direction; `side`, chosen once, multiplies it by
    the side of the body. `gap` >= 0 while apart, `approach` its rate. `witness`: see sides.py.
    `reach` is the size of
    the lengths that the gap is made of beside the coordinates, even where they cancel out. `slip`
    and `roll` are the velocity of the body's material point relative to the line's, along the
    line's direction, and the relative angular velocity. `thread`: what a thread is drawn out.
    """

    contact: ContactParts
    line: Line
    side: ca.SX
    gap: ca.SX
    approach: ca.SX
    witness: ca.SX
    reach: ca.SX
    slip: ca.SX
    roll: ca.SX
    abscissa: ca.SX
    thread: Thread | None = None

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

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """Of a gap, of a thread's length, else along the curve."""
        return self.effort(coordinate, kinematics).rate

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """A force on the point along the curve, of a gap or a length along the normal."""
        if self.thread is not None:
            return self.thread.effort(coordinate)
        if coordinate == "gap":
            return Effort(self.approach, self.side * self.line.normal, nowhere())
        pace = self._pace(kinematics)
        return Effort(self.slip / pace, self.line.direction / pace, nowhere())

    def _pace(self, kinematics: Kinematics) -> ca.SX:
        """The way along the curve for one unit of its parameter."""
        curve = self.contact.track.figure
        tangent = kinematics.tangent(self.contact.liaison)
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
        match name:
            case "length" if self.thread is not None:
                return self.thread.length
            case "gap" if self.thread is not None:
                return self.thread.rest
            case "gap":
                return self.gap
            case "slip":
                return self.slip
            case "u":
                return self.abscissa
        rows, lam = reaction.rows, reaction.lam
        if rows is None:
            raise KeyError(name)
        tangent = ca.dot(reaction.drive[0], self.line.direction)
        normal = lam[rows.reaction[0]]
        normal += self.side * ca.dot(reaction.drive[0], self.line.normal)
        friction = reaction.friction.along
        friction += lam[rows.tangent[0]] if rows.tangent else ca.SX(0)
        tangent += friction
        couple = lam[rows.rolling[0]] if rows.rolling else ca.SX(0)
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


def _reach(contact: ContactParts, line: Line, kinematics: Kinematics) -> ca.SX:
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


def contact_geometry(
    contact: ContactParts, kinematics: Kinematics, side: ca.SX, world: World
) -> ContactGeometry:
    """Geometry and relative velocities of a point or rim on a curve."""
    if contact.keeps_left:
        side = ca.SX(1)
    if contact.liaison in kinematics.along:
        return _carried(contact, kinematics)
    if contact.track.figure.plane is not None and is_closed(contact.track.figure, contact.figure):
        ends = contact.track.figure.has_ends and is_unilateral(contact.liaison)
        return (_on_segment if ends else _on_line)(contact, kinematics, side, world)
    return _on_curve(contact, kinematics, side, world)


def _apart(
    contact: ContactParts, kinematics: Kinematics, place: ca.SX, at: ca.SX
) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Velocities of the body from the curve at two places, and the angular one."""
    body, base = kinematics.moving(contact.point), kinematics.moving(contact.track.point)
    apart, nearing = (body.velocity_of(x) - base.velocity_of(x) for x in (place, at))
    return apart, nearing, body.angular - base.angular


def _on_line(
    contact: ContactParts, kinematics: Kinematics, side: ca.SX, world: World
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
    abscissa = ca.dot(line.direction, centre - line.through)
    return ContactGeometry(
        contact=contact,
        line=replace(line, through=line.through + abscissa * line.direction),
        side=side,
        gap=side * height - radius,
        approach=side * ca.dot(line.normal, nearing),
        witness=sides_of(contact, line, height, kinematics, world),
        reach=radius + _reach(contact, line, kinematics),
        slip=ca.dot(line.direction, apart),
        roll=ca.dot(Z, turning),
        abscissa=abscissa,
    )


def _on_segment(
    contact: ContactParts, kinematics: Kinematics, side: ca.SX, world: World
) -> ContactGeometry:
    """A point or a rim on a line with ends, or on one of these: its nearest point is known."""
    line, lower = kinematics.line(contact.track), kinematics.fixed.lower
    centre = kinematics.position(contact.point)
    apart = centre - line.through
    figure, ended = contact.track.figure, Ending(side, kinematics.passing(contact.liaison))
    one = bounded(figure, ca.dot(line.direction, apart), lower, ended)
    least, largest = figure.ends(lower)
    at_end = ca.if_else(one.out > 0, largest, least)
    place = line.through + at_end * line.direction
    way, outwards = away(centre - place, AT_END * (largest - least), one.out * line.direction)
    normal = ca.if_else(one.ended, outwards, side * line.normal)
    radius = contact.figure.radius_in(lower)
    touching = centre - radius * normal
    body, base = kinematics.moving(contact.point), kinematics.moving(contact.track.point)
    on_base = base.velocity_of(ca.if_else(one.ended, place, centre))
    slip = body.velocity_of(touching) - base.velocity_of(touching)
    here = Line(ca.if_else(one.ended, place, line.through), cross(side * normal, Z), side * normal)
    return ContactGeometry(
        contact=contact,
        line=here,
        side=side,
        gap=ca.if_else(one.ended, way, side * ca.dot(line.normal, apart)) - radius,
        approach=ca.dot(normal, body.velocity_of(centre) - on_base),
        witness=sides_of(contact, line, ca.dot(line.normal, apart), kinematics, world),
        reach=radius + largest - least + _reach(contact, line, kinematics),
        slip=ca.dot(here.direction, slip),
        roll=ca.dot(Z, body.angular - base.angular),
        abscissa=one.inside,
    )


def _carried(contact: ContactParts, kinematics: Kinematics) -> ContactGeometry:
    """A point that its coordinate keeps on a curve; its slip is against the curve's elements."""
    line, liaison = kinematics.curve_at(contact.liaison, contact.point), contact.liaison
    along = kinematics.along[liaison]
    _, _, turning = _apart(contact, kinematics, line.through, line.through)
    return ContactGeometry(
        contact=contact,
        line=line,
        side=ca.SX(1),
        gap=ca.SX(0),
        approach=ca.SX(0),
        witness=ca.SX.ones(3),
        reach=ca.SX(0),
        slip=ca.norm_2(along.tangent) * along.rate,
        roll=ca.dot(Z, turning),
        abscissa=along.parameter,
    )


def _on_curve(
    contact: ContactParts, kinematics: Kinematics, side: ca.SX, world: World
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
        abscissa = kinematics.counted(contact.liaison, 0, angle)
    else:
        followed = kinematics.track(
            contact.liaison, lambda: _follow(contact, kinematics, (base, own), left * side)
        )
        found = followed.touch if followed.sided else on_side(followed.touch, left * side)
        by_place = a.parameters < 0
        apart = found.place - base.origin
        abscissa = a.parameter(apart, base, lower) if by_place else followed.unknowns[0]
        if a.has_ends:
            least, largest = a.ends(lower)
            abscissa = ca.fmin(ca.fmax(abscissa, least), largest)
    normal = side * found.normal
    line = Line(found.place, cross(normal, Z), normal)
    apart, nearing, turning = _apart(contact, kinematics, found.place, found.place)
    sizes = kinematics.lengths_between(
        (point_body(contact.track.point), kinematics.local_point(contact.track.point)),
        (point_body(contact.point), kinematics.local_point(contact.point)),
    )
    return ContactGeometry(
        contact=contact,
        line=line,
        side=side,
        gap=found.gap,
        approach=ca.dot(found.normal, nearing) + found.own,
        witness=sides_of(contact, line, left * found.witness, kinematics, world),
        reach=found.size + ca.dot(ca.fabs(normal), sizes),
        slip=ca.dot(line.direction, apart + found.drift),
        roll=ca.dot(Z, turning),
        abscissa=abscissa,
        thread=thread_of(contact.liaison, kinematics, contact.track.point, contact.point),
    )


def _follow(
    contact: ContactParts, kinematics: Kinematics, at: tuple[Pose, Pose], side: ca.SX
) -> Track:
    """Where figures are nearest; what can part from a curve with ends may be nearest to an end."""
    a, b, lower = contact.track.figure, contact.figure, kinematics.fixed.lower
    if (a.has_ends or b.has_ends) and is_unilateral(contact.liaison):
        return track_to_ends(a, b, at, lower, Ending(side, kinematics.passing(contact.liaison)))
    return track(a, b, at, lower, planar=True)


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
