"""Poses and velocities of bodies, frames, points and lines as functions of coordinates and speeds.

One pass along the spanning tree, from each body to those that hang on it. Velocities follow with
the poses, and so do the accelerations that are there while no speed changes: nothing is
differentiated.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import casadi as ca
from frot.compiler.mechanics.constants import Constants
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.mechanics.geometry.figure import Placed
from frot.compiler.mechanics.liaisons.moves import AlongCurve, Column, carried, turned_by_time
from frot.compiler.mechanics.points import Point, point_body, turns
from frot.compiler.mechanics.shapes import shape_of
from frot.compiler.mechanics.solve import solve_in_units
from frot.compiler.mechanics.spatial import (
    AT_REST,
    Moving,
    Pose,
    Z,
    counted,
    cross,
    nowhere,
    turn_about,
    whole,
)
from frot.compiler.mechanics.values import unit_vector
from frot.compiler.translate.conditions import NEVER, ConditionTable
from frot.compiler.translate.symbols import Symbols
from frot.dsl.checked import Body, BodyPoint, Frame, Liaison


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A line in ground axes: a point of it, its direction d and its left normal n."""

    through: ca.SX
    direction: ca.SX
    normal: ca.SX


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
class TakenAlong:
    """The rate of a coordinate that what rolls takes along, and the size of that."""

    rate: ca.SX
    size: ca.SX


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """How coordinates carry a body.

    `constraint` is the one built into them, None of a free body; `motions` are, in the order from
    the base, the first coordinate, the first speed and the names of the coordinates of each.
    `carries_b`: the body is that of the second place.
    """

    constraint: object
    liaison: Liaison | None
    motions: tuple[tuple[int, int, tuple[str, ...]], ...]
    carries_b: bool


class Kinematics:
    """Where everything is, with the auxiliary speeds sw still in.

    `nodes` are the steps of the tree, each after those above it, `node_of` the last of each body
    and `beyond` the vector (3) from its origin to the body's G.
    `still` are the bodies that cannot move.
    `along` are the places on the curves that carry bodies;
    `tracks` what is followed where figures touch, with the rates of the parameters; `spots` are
    the coordinates of what rolls along planes, `starts` where they and its height begin to be
    searched for; `symbols` have their rates too.
    `arms` are the bodies that one hangs on, itself last, each with the sizes in ground axes (3) of
    the vectors from the body before to its own G.
    """

    def __init__(
        self,
        symbols: Symbols,
        fixed: Constants,
        ground: Body,
        *,
        planar: bool,
        still: frozenset[Body],
        readings: dict[Liaison, int],
        counters: dict[tuple[Liaison, int], ca.SX],
        numbers: dict[Liaison, int],
        sides: dict[Liaison, ca.SX],
        conditions: ConditionTable | None = None,
    ) -> None:
        """`fixed` gives what no motion changes; into `conditions` go the ends of figures.

        `readings`: the first auxiliary speed of each liaison that has some. `numbers` and `sides`
        are those of the contacts.
        """
        self._conditions = conditions
        self._numbers = numbers
        self.symbols = symbols
        self.fixed = fixed
        self.planar = planar
        self.still = still
        self.bodies: dict[Body, Moving] = {ground: AT_REST}
        self.readings = readings
        self.nodes: list[Node] = []
        self.node_of: dict[Body, int] = {ground: -1}
        self.beyond: dict[Body, ca.SX] = {ground: nowhere()}
        self.arms: dict[Body, tuple[tuple[Body, ca.SX], ...]] = {ground: ()}
        self.carried: dict[Body, Carried] = {}
        self.along: dict[Liaison, AlongCurve] = {}
        self.counters = counters
        self.tracks: dict[Liaison, Track] = {}
        self.track_rates: dict[Liaison, ca.SX] = {}
        self.spots: dict[int, TakenAlong] = {}
        self.starts: dict[int, ca.SX] = {}
        # of points and frames, each beside the motion of the body that it is of
        self._moving: dict[Frame | BodyPoint, tuple[Moving, Moving]] = {}
        self.sides = sides

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
        axis = track.figure.plane
        assert axis is not None
        pose = self.pose(track.point)
        direction = pose.direction(axis.unit(self.fixed.lower))
        return Line(pose.origin, direction, cross(Z, direction))

    def curve_at(self, liaison: Liaison, point: Point) -> Line:
        """The tangent of the curve by which a liaison carries a point, there."""
        tangent = self.along[liaison].tangent
        direction = tangent / ca.norm_2(tangent)
        return Line(self.position(point), direction, cross(Z, direction))

    def normal(self, liaison: Liaison, track: Placed) -> ca.SX:
        """The left normal of the curve or line that carries a point, there."""
        if track.figure.plane is not None:
            return self.line(track).normal
        tangent = self.along[liaison].tangent
        return cross(Z, tangent / ca.norm_2(tangent))

    # ------------------------------------------------------------------ rates

    def rate(self, value: ca.SX) -> ca.SX:
        """Rate of a function of the coordinates and of time, without auxiliary speeds."""
        s = self.symbols
        count = s.q.numel() - len(self.counters)  # which turn it is changes no value
        q = s.q[:count, :] if self.counters else s.q  # of one alone [:0] is a row
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
                self.track_rates[liaison] = -ca.densify(solve_in_units(slope, known))
            return made
        return self.tracks[liaison]

    def passing(self, liaison: Liaison) -> Callable[[ca.SX], ca.SX]:
        """What makes flags that are 1 while a value, by which a figure ends there, is positive."""
        if self._conditions is None:
            return lambda value: value > 0
        number, text = self._numbers[liaison], f"{liaison.name}: beyond an end"
        return partial(
            self._conditions.add,
            strict=True, text=text, span=liaison.span, report_rule=NEVER, contact=number,
        )  # fmt: skip

    def angular_velocity(self, owner: Body | Frame | BodyPoint) -> ca.SX:
        """Angular velocity (3) of the axes."""
        return self.moving(owner).angular

    # ------------------------------------------------------------------ coordinates of liaisons

    def counted(self, liaison: Liaison, index: int, angle: ca.SX) -> ca.SX:
        """The angle of a motion with the turns that its counter has seen, if it has one."""
        counter = self.counters.get((liaison, index))
        return angle if counter is None else counted(angle, counter)

    def tangent(self, liaison: Liaison) -> ca.SX | None:
        """Of the curve by which a liaison carries a body, there; None of other liaisons."""
        along = self.along.get(liaison)
        return None if along is None else along.tangent

    def carried_by(self, constraint: object, places: tuple[Point, ...]) -> Carried | None:
        """How a constraint of these places carries the body of one of them, if it does."""
        for place in places:
            carried = self.carried.get(point_body(place))
            if carried is not None and carried.constraint is constraint:
                return carried
        return None
