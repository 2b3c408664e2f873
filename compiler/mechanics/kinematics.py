"""Positions and velocities of bodies, frames, points and lines as functions of the coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from frot.compiler.lowering.expressions import Lowering
from frot.compiler.lowering.symbols import Symbols, auxiliary_places
from frot.compiler.mechanics.mechanism import (
    LineCoordinates,
    Mechanism,
    PinCoordinates,
    Point,
    owner_body,
    point_body,
    turns,
)
from frot.compiler.mechanics.names import coordinate_names
from frot.dsl.checked import Body, BodyPoint, Curve, Frame, Liaison


def rotation(angle: ca.SX) -> ca.SX:
    """R (2 x 2): axes turned counter-clockwise by `angle`."""
    c, s = ca.cos(angle), ca.sin(angle)
    return ca.vertcat(ca.horzcat(c, -s), ca.horzcat(s, c))


def turned(vector: ca.SX) -> ca.SX:
    """The vector turned by a right angle counter-clockwise."""
    return ca.vertcat(-vector[1], vector[0])


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Origin (2) in ground axes and angle of a body's (at G) or frame's axes."""

    origin: ca.SX
    angle: ca.SX

    def point(self, local: ca.SX) -> ca.SX:
        """Ground coordinates of a point given in these axes."""
        return self.origin + self.direction(local)

    def direction(self, local: ca.SX) -> ca.SX:
        """Ground components of a vector given in these axes."""
        return local if self.angle.is_zero() else rotation(self.angle) @ local


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A line in ground axes: a point of it, its direction d and its left normal n."""

    through: ca.SX
    direction: ca.SX
    normal: ca.SX


class Kinematics:
    """Where everything is, with the auxiliary coordinates w and speeds sw still in.

    `auxiliary` gives the first auxiliary coordinate of a liaison, `pin_angles` the coordinate that
    is the angle of a pin. `arms` are the bodies that one hangs on, itself last, each with the sizes
    in ground axes (2) of the vectors from the body before to its own G.
    """

    def __init__(self, mechanism: Mechanism, symbols: Symbols, fixed: Lowering) -> None:
        """`fixed` lowers expressions of parameters."""
        self.symbols = symbols
        self.fixed = fixed
        ground = Pose(ca.SX.zeros(2), ca.SX(0))
        self.poses: dict[Body, Pose] = {mechanism.model.ground: ground}
        self.auxiliary, _ = auxiliary_places(mechanism)
        self.pin_angles: dict[Liaison, int] = {}
        self.arms: dict[Body, tuple[tuple[Body, ca.SX], ...]] = {mechanism.model.ground: ()}
        at = 0
        for coordinates in mechanism.coordinates:
            body = coordinates.body
            count = len(coordinate_names(coordinates))
            q = symbols.q[at : at + count]
            at += count
            if isinstance(coordinates, PinCoordinates):
                if count:
                    self.pin_angles[coordinates.pin.liaison] = at - 1
                self.poses[body] = self._pinned(coordinates, q)
                continue
            angle = q[count - 1] if turns(body) else ca.SX(0)
            if isinstance(coordinates, LineCoordinates):
                line = self.line(coordinates.line)
                place = line.through + q[0] * line.direction
                index = self.auxiliary.get(coordinates.liaison)
                if index is not None:
                    place += symbols.w[index] * line.normal
                local = self.local_point(coordinates.point)
                offset = Pose(ca.SX.zeros(2), angle).direction(local)
                self.poses[body] = Pose(place - offset, angle)
                base, through = owner_body(coordinates.line.owner), self.local_through
                arm = self.arm(base, through(coordinates.line)) + self.arm(body, local)
                self.arms[body] = (*self.arms[base], (body, arm))
            else:
                self.poses[body] = Pose(q[:2], angle)
                self.arms[body] = ((body, ca.SX.zeros(2)),)

    def _pinned(self, coordinates: PinCoordinates, q: ca.SX) -> Pose:
        """Pose of a body that hangs on another; q is empty for one that does not turn."""
        pin, sign = coordinates.pin, 1 if coordinates.carries_b else -1
        own, base = (pin.b, pin.a) if coordinates.carries_b else (pin.a, pin.b)
        place, angle = self.position(base), ca.SX(0)
        at = self.auxiliary.get(pin.liaison)
        if at is not None:
            place += sign * self.symbols.w[at : at + 2]
        if q.numel():
            angle = self.angle(base) + sign * q - self.local_angle(own)
        body, carrier = point_body(own), point_body(base)
        arm = self.arm(carrier, self.local_point(base)) + self.arm(body, self.local_point(own))
        self.arms[body] = (*self.arms[carrier], (body, arm))
        return Pose(place - Pose(ca.SX.zeros(2), angle).direction(self.local_point(own)), angle)

    def frame(self, owner: Body | Frame) -> Pose:
        """Pose of a body or frame."""
        if isinstance(owner, Body):
            return self.poses[owner]
        base = self.frame(owner.owner)
        origin = base.origin if owner.origin is None else base.point(self.fixed.lower(owner.origin))
        angle = base.angle if owner.angle is None else base.angle + self.fixed.lower(owner.angle)
        return Pose(origin, angle)

    def local_point(self, point: Point) -> ca.SX:
        """A point of a body in the body's own axes at G."""
        if isinstance(point, Frame):
            return self._in_body(point, ca.SX.zeros(2))
        if point.name in ("start", "tip"):
            half = self.fixed.lower(point.body.arguments["length"]) / 2
            return ca.vertcat(-half if point.name == "start" else half, 0)
        return ca.SX.zeros(2)

    def local_through(self, curve: Curve) -> ca.SX:
        """The given point of a line in the body's own axes at G."""
        return self._in_body(curve.owner, self.fixed.lower(curve.arguments["through"]))

    def _in_body(self, frame: Body | Frame, local: ca.SX) -> ca.SX:
        """What is given in the axes of a frame, in those of its body."""
        while isinstance(frame, Frame):
            if frame.angle is not None:
                local = rotation(self.fixed.lower(frame.angle)) @ local
            if frame.origin is not None:
                local = local + self.fixed.lower(frame.origin)
            frame = frame.owner
        return local

    def arm(self, body: Body, local: ca.SX) -> ca.SX:
        """Sizes in ground axes (2) of a vector given in a body's axes, however the body turns."""
        if not turns(body):
            return ca.fabs(local)
        return ca.sqrt(ca.sumsqr(local)) * ca.SX.ones(2)

    def local_angle(self, point: Point) -> ca.SX:
        """Angle of the axes at a point of a body, from those of the body."""
        angle = ca.SX(0)
        frame: Body | Frame = point.body if isinstance(point, BodyPoint) else point
        while isinstance(frame, Frame):
            if frame.angle is not None:
                angle += self.fixed.lower(frame.angle)
            frame = frame.owner
        return angle

    def position(self, point: Point | Body) -> ca.SX:
        """Ground coordinates (2)."""
        if isinstance(point, BodyPoint):
            return self.poses[point.body].point(self.local_point(point))
        return self.frame(point).origin

    def angle(self, owner: Body | Frame | BodyPoint) -> ca.SX:
        """Angle of the axes."""
        return self.frame(owner.body if isinstance(owner, BodyPoint) else owner).angle

    def line(self, curve: Curve) -> Line:
        """A line in ground axes."""
        pose = self.frame(curve.owner)
        along = self.fixed.lower(curve.arguments["direction"])
        direction = pose.direction(along / ca.sqrt(ca.sumsqr(along)))
        through = pose.point(self.fixed.lower(curve.arguments["through"]))
        return Line(through, direction, turned(direction))

    def velocity(self, value: ca.SX) -> ca.SX:
        """Rate of a function of the coordinates, auxiliary ones included."""
        s = self.symbols
        return ca.jtimes(value, ca.vertcat(s.q, s.w), ca.vertcat(s.v, s.sw))

    def velocity_at(self, body: Body, place: ca.SX) -> ca.SX:
        """Velocity of the material point of a body that is at `place`."""
        pose = self.poses[body]
        return self.velocity(pose.origin) + self.velocity(pose.angle) * turned(place - pose.origin)
