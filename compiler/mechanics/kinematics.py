"""Poses and velocities of bodies, frames, points and lines as functions of coordinates and speeds.

One pass along the spanning tree, from each body to those that hang on it. Velocities follow with
the poses, and so do the accelerations that are there while no speed changes: nothing is
differentiated.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
from frot.compiler.lowering.symbols import Symbols, counters_of, reading_places
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.geometry.figures import Flat, Placed
from frot.compiler.mechanics.geometry.touches import reach_of
from frot.compiler.mechanics.geometry.tracking import Track
from frot.compiler.mechanics.liaisons.motions import Follow, Roll, count_speeds
from frot.compiler.mechanics.liaisons.moves import (
    Column,
    Moved,
    carried,
    counted,
    move,
    seen,
    turned_by_time,
)
from frot.compiler.mechanics.liaisons.roll import roll
from frot.compiler.mechanics.liaisons.wrenches import act
from frot.compiler.mechanics.mechanism import (
    Contact,
    Hanging,
    Joint,
    Mechanism,
    Point,
    Relation,
    frames_of,
    point_body,
    turns,
)
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.spatial import (
    AT_REST,
    Moving,
    Pose,
    Z,
    cross,
    nowhere,
    turn_about,
    whole,
)
from frot.compiler.mechanics.values import beside_given, unit_vector
from frot.dsl.checked import Body, BodyPoint, Frame, Liaison
from frot.dsl.data.classes import dataclass, replace


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A step of the tree: what the speeds `places` (of v, then auxiliary) move beyond it.

    `arm` (3) goes from the origin of the node before to its own. `columns` are velocities of the
    axes and of their origin there. `faces_ground`: what is
    beyond keeps its orientation whatever carries it, and only its places follow. `above`: the node
    before, -1 for the ground.
    """

    above: int
    arm: ca.SX
    faces_ground: bool
    places: tuple[int, ...]
    columns: tuple[Column, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A line in ground axes: a point of it, its direction d and its left normal n."""

    through: ca.SX
    direction: ca.SX
    normal: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Spotted:
    """The rate of a coordinate that what rolls takes along, and the size of that."""

    rate: ca.SX
    size: ca.SX


class Kinematics:
    """Where everything is, with the auxiliary speeds sw still in.

    `nodes` are the steps of the tree, each after those above it, `node_of` the last of each body
    and `beyond` the vector (3) from its origin to the body's G.
    `tangents` are those of the curves that carry bodies, by the length of their parameter;
    `tracks` what is followed where figures touch, with the rates of the parameters; `spots` are
    the coordinates of what rolls along planes, `starts` where they and its height begin to be
    searched for; `symbols` have their rates too.
    `arms` are the bodies that one hangs on, itself last, each with the sizes in ground axes (3) of
    the vectors from the body before to its own G.
    """

    def __init__(self, mechanism: Mechanism, symbols: Symbols, fixed: Constants) -> None:
        """`fixed` gives what no motion changes."""
        self.symbols = symbols
        self.fixed = fixed
        self.planar = mechanism.model.planar
        self.bodies: dict[Body, Moving] = {mechanism.model.ground: AT_REST}
        self.readings, _ = reading_places(mechanism)
        self.nodes: list[Node] = []
        self.node_of: dict[Body, int] = {mechanism.model.ground: -1}
        self.beyond: dict[Body, ca.SX] = {mechanism.model.ground: nowhere()}
        self.arms: dict[Body, tuple[tuple[Body, ca.SX], ...]] = {mechanism.model.ground: ()}
        self.hangs: dict[Body, Hanging] = {}
        self.places: dict[Body, tuple[int, int]] = {}
        self.tangents: dict[Liaison, ca.SX] = {}
        self.counters = counters_of(mechanism, symbols.q)
        self.tracks: dict[Liaison, Track] = {}
        self.track_rates: dict[Liaison, ca.SX] = {}
        self.spots: dict[int, Spotted] = {}
        self.starts: dict[int, ca.SX] = {}
        # of points and frames, each beside the motion of the body that it is of
        self._moving: dict[Frame | BodyPoint, tuple[Moving, Moving]] = {}
        self.sides = {
            link.liaison: symbols.sides[k]
            for k, link in enumerate(mechanism.contacts)
            if isinstance(link, Relation) and link.first
        }
        nq = nv = 0
        for hanging in mechanism.coordinates:
            self.hangs[hanging.body] = hanging
            self.places[hanging.body] = (nq, nv)
            self._hang(hanging, nq, nv, mechanism.model.ground)
            nq, nv = nq + len(hanging.names), nv + len(hanging.speeds)
        if self.spots:
            own = ca.SX(symbols.rates)
            for place, spot in self.spots.items():
                own[place] = spot.rate
            self.symbols = replace(symbols, rates=own)

    def _hang(self, hanging: Hanging, nq: int, nv: int, ground: Body) -> None:
        """Go from the place that carries a body to its G."""
        symbols, body = self.symbols, hanging.body
        base, at, out = self._base(hanging, ground)
        node = self.node_of[base]
        moving, arm = at, self.beyond[base] + out
        for motion in hanging.motions:
            m, n = len(motion.coordinates), count_speeds(motion)
            q = symbols.q[nq : nq + m]
            v, lower = symbols.v[nv : nv + n], self.fixed.lower
            if isinstance(motion, Roll):
                moved = self._roll(motion, hanging, moving, q, v)
            else:
                moved = move(motion, moving, q, v, lower)
            moving = moved.moving
            if moved.tangent is not None and hanging.link is not None:
                self.tangents[hanging.link.liaison] = moved.tangent
            if moved.columns or motion.faces_ground:
                places = tuple(range(nv, nv + n))
                arm = arm + moved.back
                self.nodes.append(Node(node, arm, motion.faces_ground, places, moved.columns))
                node, arm = len(self.nodes) - 1, nowhere()
            arm = arm + moved.way
            if motion.faces_ground and motion is not hanging.motions[-1] and hanging.own:
                moving = self._to_axes_of_place(hanging.own, moving)
            nq, nv = nq + m, nv + n
        moving, node, arm = self._read(hanging, at, moving, node, arm)
        self.bodies[body], back = self._to_centre(hanging, moving)
        self.node_of[body], self.beyond[body] = node, arm + back
        self._measure(hanging, base)

    def _roll(self, motion: Roll, hanging: Hanging, plane: Moving, q: ca.SX, v: ca.SX) -> Moved:
        """What rolls takes the first of its coordinates along."""
        assert hanging.link is not None
        side = self.sides[hanging.link.liaison]
        moved, rates = roll(motion, plane, q, v, self.fixed.lower, side)
        first, _ = self.places[hanging.body]
        for k, rate in enumerate(ca.vertsplit(rates)):
            self.spots[first + k] = Spotted(rate, reach_of(motion.figure, self.fixed.lower))
        assert hanging.base is not None  # without a guess a body is at the origin of the ground
        base = self.pose(hanging.base)
        along = unit_vector(motion.axis.given, self.fixed.lower)
        for k, way in enumerate((*beside_given(motion.axis.given, self.fixed.lower), along)):
            self.starts[first + k] = -ca.dot(base.direction(way), base.origin)
        return moved

    def _base(self, hanging: Hanging, ground: Body) -> tuple[Body, Moving, ca.SX]:
        """The body that carries, the axes at its place, and the vector there from its G."""
        if hanging.base is None:
            return ground, AT_REST, nowhere()
        body = point_body(hanging.base)
        out = self.bodies[body].pose.direction(self.local_point(hanging.base))
        return body, self.moving(hanging.base), out

    def _read(
        self, hanging: Hanging, at: Moving, moving: Moving, node: int, arm: ca.SX
    ) -> tuple[Moving, int, ca.SX]:
        """Auxiliary speeds along what the liaison locks, where its reaction is read."""
        link = hanging.link
        first = None if link is None else self.readings.get(link.liaison)
        if first is None or link is None:
            return moving, node, arm
        sign = 1
        if isinstance(link, Joint):
            sign = 1 if hanging.carries_b else -1
            a, b = (at.pose, moving.pose) if hanging.carries_b else (moving.pose, at.pose)
            tangent, lower = self.tangents.get(link.liaison), self.fixed.lower
            columns = [act(x, a, b, lower, tangent=tangent).column for x in link.held]
        else:
            columns = [Column(nowhere(), self._normal(link))]
        nv, back = self.symbols.v.numel(), nowhere()
        if sign < 0:  # a reaction acts at the place b
            back = ca.sparsify(moving.pose.origin - at.pose.origin)
        moving = moving.shifted(-back)
        for k, column in enumerate(columns):
            speed = sign * self.symbols.sw[first + k]
            moving = replace(
                moving,
                angular=moving.angular + column.angular * speed,
                linear=moving.linear + column.linear * speed,
            )
        places = tuple(range(nv + first, nv + first + len(columns)))
        signed = tuple(Column(sign * c.angular, sign * c.linear) for c in columns)
        self.nodes.append(Node(node, arm - back, False, places, signed))
        return moving.shifted(back), len(self.nodes) - 1, back

    def _to_centre(self, hanging: Hanging, moving: Moving) -> tuple[Moving, ca.SX]:
        """From the place of the body that is carried to the axes at its G, and the way there.

        What faces the ground places the body's own axes.
        """
        if hanging.own is None:
            return moving, nowhere()
        if not hanging.motions or not hanging.motions[-1].faces_ground:
            moving = self._to_axes_of_body(hanging.own, moving)
        back = -self.local_point(hanging.own)
        return carried(back, moving, self.fixed.lower), moving.pose.direction(back)

    def _to_axes_of_body(self, own: Point, moving: Moving) -> Moving:
        """The axes of a body whose axes at a point are known; time may turn the frames between."""
        for frame in frames_of(own):
            if frame.angle is not None:
                back = -self.fixed.lower(frame.angle)
                moving = turned_by_time(frame.axis, back, moving, self.fixed.lower)
        return moving

    def _to_axes_of_place(self, own: Point, moving: Moving) -> Moving:
        """The axes at a point of a body whose own axes are known."""
        for frame in reversed(list(frames_of(own))):
            if frame.angle is not None:
                angle = self.fixed.lower(frame.angle)
                moving = turned_by_time(frame.axis, angle, moving, self.fixed.lower)
        return moving

    def _measure(self, hanging: Hanging, base: Body) -> None:
        body = hanging.body
        if hanging.base is None or hanging.own is None:
            self.arms[body] = ((body, ca.SX.zeros(3)),)
            return
        there = self.local_point(hanging.base)
        arm = self.arm(base, there) + self.arm(body, self.local_point(hanging.own))
        self.arms[body] = (*self.arms[base], (body, arm))

    # ------------------------------------------------------------------ axes and points

    def moving(self, owner: Body | Frame | BodyPoint) -> Moving:
        """Axes of a body (at G), of a frame, or of a body at one of its points."""
        if isinstance(owner, Body):
            return self.bodies[owner]
        own = self.bodies[point_body(owner)]
        known, made = self._moving.get(owner, (None, own))
        if known is not own:
            made = self._moved(owner)
            self._moving[owner] = own, made
        return made

    def _moved(self, owner: Frame | BodyPoint) -> Moving:
        if isinstance(owner, BodyPoint):
            return self._shifted(self.bodies[owner.body], self.local_point(owner))
        base = self.moving(owner.owner)
        if isinstance(owner.owner, Body):
            base = self._shifted(base, self._home(owner.owner))
        if owner.origin is not None:
            base = carried(whole(self.fixed.lower(owner.origin)), base, self.fixed.lower)
        if owner.angle is None:
            return base
        angle = self.fixed.lower(owner.angle)
        return turned_by_time(owner.axis, angle, base, self.fixed.lower)

    def _shifted(self, at: Moving, local: ca.SX) -> Moving:
        """The same axes at a place given in them."""
        return at.shifted(at.pose.direction(local)) if local.nnz() else at

    def _home(self, body: Body) -> ca.SX:
        """From where places on a body are given (3), in its axes at G."""
        if body.shape is None or body.shape.home == "G":
            return nowhere()
        return shape_of(body).point(body, body.shape.home, self.fixed.lower)

    def pose(self, owner: Body | Frame | BodyPoint) -> Pose:
        """Pose of a body (at G), frame or point."""
        return self.moving(owner).pose

    def local_point(self, point: Point) -> ca.SX:
        """A point of a body in the body's own axes at G."""
        if isinstance(point, Frame):
            return self._in_body(point, nowhere())
        if point.body.shape is None:
            return nowhere()
        return shape_of(point.body).point(point.body, point.name, self.fixed.lower)

    def _in_body(self, frame: Body | Frame, local: ca.SX) -> ca.SX:
        """What is given in the axes of a frame, in those of its body at G."""
        while isinstance(frame, Frame):
            if frame.angle is not None:
                axis = unit_vector(frame.axis, self.fixed.lower)
                local = turn_about(axis, self.fixed.lower(frame.angle)) @ local
            if frame.origin is not None:
                local = local + whole(self.fixed.lower(frame.origin))
            frame = frame.owner
        return local + self._home(frame)

    def arm(self, body: Body, local: ca.SX) -> ca.SX:
        """Sizes in ground axes (3) of a vector given in a body's axes, however the body turns."""
        if not turns(body):
            return ca.fabs(local)
        return ca.sqrt(ca.sumsqr(local)) * ca.SX.ones(3)

    def lengths_between(
        self, first: tuple[Body, ca.SX | None], second: tuple[Body, ca.SX | None]
    ) -> ca.SX:
        """Sizes (3) of the vectors from the bodies' coordinates to points given in their axes.

        What both hang on is left out: it cancels out before any rounding.
        """
        own, other = self.arms[first[0]], self.arms[second[0]]
        while own and other and own[0][0] is other[0][0]:
            own, other = own[1:], other[1:]
        total = sum((size for _, size in (*own, *other)), ca.SX.zeros(3))
        for body, local in (first, second):
            if local is not None:
                total += self.arm(body, local)
        return total

    def position(self, point: Point | Body) -> ca.SX:
        """Ground coordinates (3)."""
        return self.pose(point).origin

    def angle(self, owner: Body | Frame | BodyPoint) -> ca.SX:
        """Angle of the axes in a planar model."""
        return self.pose(owner).angle

    def line(self, track: Placed) -> Line:
        """A line of a planar model in ground axes."""
        assert isinstance(track.figure, Flat)
        pose = self.pose(track.point)
        direction = pose.direction(unit_vector(track.figure.axis.given, self.fixed.lower))
        return Line(pose.origin, direction, cross(Z, direction))

    def curve_at(self, contact: Contact) -> Line:
        """The tangent of the curve that carries a point, there."""
        tangent = self.tangents[contact.liaison]
        direction = tangent / ca.norm_2(tangent)
        return Line(self.position(contact.point), direction, cross(Z, direction))

    def _normal(self, contact: Contact) -> ca.SX:
        if isinstance(contact.track.figure, Flat):
            return self.line(contact.track).normal
        tangent = self.tangents[contact.liaison]
        return cross(Z, tangent / ca.norm_2(tangent))

    # ------------------------------------------------------------------ rates

    def rate(self, value: ca.SX) -> ca.SX:
        """Rate of a function of the coordinates and of time, without auxiliary speeds."""
        s = self.symbols
        count = s.q.numel() - len(self.counters)  # which turn it is changes no value
        q = s.q[:count] if self.counters else s.q
        states = ca.vertcat(s.t, q, *(track.unknowns for track in self.tracks.values()))
        rates = ca.vertcat(1, s.rates, *self.track_rates.values())
        return ca.jtimes(value, states, rates)

    def track(self, liaison: Liaison, make: Callable[[], Track]) -> Track:
        """What is followed where the figures of a liaison touch, made once.

        Its conditions hold on and on: R_s s' = -(R_q q' + R_t).
        """
        if liaison not in self.tracks:
            made = make()
            if made.unknowns.numel():
                known = self.rate(made.residual)
                slope = ca.jacobian(made.residual, made.unknowns)
                self.tracks[liaison] = made
                self.track_rates[liaison] = -ca.densify(ca.solve(ca.densify(slope), known))
            return made
        return self.tracks[liaison]

    def velocity_at(self, body: Body, place: ca.SX) -> ca.SX:
        """Velocity (3) of the material point of a body that is at `place`."""
        return self.bodies[body].velocity_of(place)

    def angular_velocity(self, owner: Body | Frame | BodyPoint) -> ca.SX:
        """Angular velocity (3) of the axes."""
        return self.moving(owner).angular

    # ------------------------------------------------------------------ coordinates of joints

    def coordinate(self, joint: Joint, index: int) -> tuple[ca.SX, ca.SX]:
        """A coordinate of a joint that can be counted, of b relative to a, and its rate."""
        motion = joint.motions[index]
        hanging = self._hanging_by(joint)
        if hanging is not None and len(hanging.motions) == len(joint.motions):
            k = index if hanging.carries_b else len(joint.motions) - 1 - index
            nq, nv = self.places[hanging.body]
            nq += sum(len(m.coordinates) for m in hanging.motions[:k])
            nv += sum(count_speeds(m) for m in hanging.motions[:k])
            if motion.coordinates and hanging.motions[k].coordinates == motion.coordinates:
                return self.symbols.q[nq], self.symbols.v[nv]
        if isinstance(motion, Follow) and joint.liaison in self.tracks:
            return self.tracks[joint.liaison].unknowns[0], self.track_rates[joint.liaison][0]
        a, b = self.moving(joint.a), self.moving(joint.b)
        value, rate = seen(motion, a, b, self.fixed.lower)
        return self.counted(joint, index, value), rate

    def counted(self, link: Joint | Contact, index: int, angle: ca.SX) -> ca.SX:
        """The angle of a motion with the turns that its counter has seen, if it has one."""
        counter = self.counters.get((link.liaison, index))
        return angle if counter is None else counted(angle, counter)

    def parameter(self, liaison: Liaison) -> tuple[ca.SX, ca.SX]:
        """The parameter of the curve by which a liaison carries a body, and its rate."""
        hanging = next(h for h in self.hangs.values() if h.link and h.link.liaison is liaison)
        nq, nv = self.places[hanging.body]
        return self.symbols.q[nq], self.symbols.v[nv]

    def _hanging_by(self, joint: Joint) -> Hanging | None:
        for place in (joint.a, joint.b):
            hanging = self.hangs.get(point_body(place))
            if hanging is not None and hanging.link is joint:
                return hanging
        return None
