"""Newton-Euler of a scene: three coordinates (x, y, angle) of every body, in plain numpy.

Rows are the relations and the directions of friction; each row r has a relative velocity `J v` and
a relative acceleration `J a + c`, and its reaction z pushes the bodies by `J' z`. Nothing here is
taken from the compiler: contacts and forces are derived from their meaning in docs/language.md.

With d the direction of a line, n to its left, w its angular velocity: d' = w n, n' = -w d.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from judge.scene import Body, Contact, Force, Pin, Point, Scene

Floats = NDArray[np.float64]

# Differences of places and of velocities are known to 1e-14 of their terms, where forces are held
# to `check.EXACT` of theirs: so much of the terms counts as theirs.
KNOWN = 1e-6


AXES = {"+x": (1.0, 0.0), "-x": (-1.0, 0.0), "+y": (0.0, 1.0), "-y": (0.0, -1.0)}


def left(v: Floats) -> Floats:
    """The vector turned by a right angle, counter-clockwise."""
    return np.array([-v[1], v[0]])


@dataclass(slots=True)
class Row:
    """`J`, `c`, the relative velocity, and the sizes of the terms of velocity and acceleration.

    `reach` is what a unit of reaction can do to each body: 1, and the length of its arm.
    """

    jacobian: Floats
    reach: Floats
    bias: float
    rate: float
    rate_size: float
    bias_size: float


@dataclass(slots=True)
class Joint:
    """A liaison at an instant. `rows`: n, t, r of a contact; x, y, couple of a pin.

    `gap` of a contact, distance of the points of a pin; `lever` turns a couple of the third row of
    a pin or a contact into its bound: mu, mu_s (times radius of a pin), delta.
    """

    liaison: Contact | Pin
    rows: dict[str, Row]
    gap: float
    size: float
    direction: Floats
    normal: Floats
    touching: Floats
    mu: float
    mu_s: float
    delta: float


class Mechanics:
    """A scene at an instant: masses, loads, joints. `look` gives parameters and result values."""

    def __init__(
        self,
        scene: Scene,
        look: Callable[[str], float],
        state: Mapping[str, tuple[float, ...]],
        sides: Mapping[str, int],
    ) -> None:
        """`state`: x, y, angle, vx, vy, w of each body; `sides` of contacts, in the line's axes."""
        self.scene, self.look, self.sides = scene, look, sides
        self.n = 3 * len(scene.bodies)
        self.at = {b.name: 3 * k for k, b in enumerate(scene.bodies)}
        self.place = np.array([x for b in scene.bodies for x in state[b.name][:3]])
        self.speed = np.array([x for b in scene.bodies for x in state[b.name][3:]])
        self.mass = np.ones(self.n)
        for b in scene.bodies:
            k = self.at[b.name]
            m = b.mass.at(look)
            self.mass[k : k + 3] = m, m, inertia(b, look)
        self.load, self.load_size = np.zeros(self.n), np.zeros(self.n)
        self._weigh()
        for f in scene.forces:
            self._apply(f)
        self.joints = {c.name: self._contact(c) for c in scene.contacts}
        self.joints |= {p.name: self._pin(p) for p in scene.pins}
        # what `motions` finds of this instant once
        self.quick: Floats | None = None
        self.parts: list[tuple[NDArray[np.intp], list[Joint]]] | None = None

    # points

    def offset(self, p: Point) -> Floats:
        """The point as seen from the origin of its body, in ground axes."""
        local = np.array([x.at(self.look) for x in p.at])
        if p.body is None:
            return local
        angle = self.place[self.at[p.body.name] + 2] if p.body.turns else 0.0
        return local[0] * np.array([np.cos(angle), np.sin(angle)]) + local[1] * np.array(
            [-np.sin(angle), np.cos(angle)]
        )

    def position(self, p: Point) -> Floats:
        """The point in ground axes."""
        return self.offset(p) + self.origin(p.body)

    def origin(self, body: Body | None) -> Floats:
        """G of a body, or the origin of the ground."""
        if body is None:
            return np.zeros(2)
        k = self.at[body.name]
        return self.place[k : k + 2]

    def angle(self, body: Body | None) -> float:
        """Angle of the axes of a body."""
        return 0.0 if body is None or not body.turns else float(self.place[self.at[body.name] + 2])

    def spin(self, body: Body | None) -> float:
        """Angular velocity of a body."""
        return 0.0 if body is None or not body.turns else float(self.speed[self.at[body.name] + 2])

    def along(self, body: Body | None, at: Floats, way: Floats) -> Row:
        """The velocity, along `way`, of the material point of `body` that is at `at`.

        The bias is that of the material point; `way` is held.
        """
        jacobian = np.zeros(self.n)
        if body is None:
            return Row(jacobian, jacobian, 0.0, 0.0, 0.0, 0.0)
        k, arm = self.at[body.name], at - self.origin(body)
        jacobian[k : k + 2] = way
        if body.turns:
            jacobian[k + 2] = left(arm) @ way
        reach = np.zeros(self.n)
        reach[k : k + 3] = 1.0, 1.0, norm(arm) if body.turns else 0.0
        w = self.spin(body)
        bias = -w * w * (arm @ way)
        rate, size = float(jacobian @ self.speed), float(reach @ np.abs(self.speed))
        return Row(jacobian, reach, bias, rate, size, w * w * norm(arm))

    # loads

    def push(self, body: Body | None, at: Floats, force: Floats, terms: float = 0.0) -> None:
        """Add a force that acts at a place of a body, of this size and so large in its terms."""
        if body is None:
            return
        k, arm = self.at[body.name], at - self.origin(body)
        size = norm(force) + KNOWN * terms
        self.load[k : k + 2] += force
        self.load_size[k : k + 2] += size
        if body.turns:
            self.load[k + 2] += left(arm) @ force
            self.load_size[k + 2] += norm(arm) * size

    def turn(self, body: Body | None, couple: float) -> None:
        """Add a couple."""
        if body is not None and body.turns:
            k = self.at[body.name] + 2
            self.load[k] += couple
            self.load_size[k] += abs(couple)

    def _weigh(self) -> None:
        g = 9.81 if self.scene.gravity is None else self.scene.gravity.at(self.look)
        for b in self.scene.bodies:
            self.push(b, self.origin(b), g * b.mass.at(self.look) * self.down())

    def down(self) -> Floats:
        """The direction of gravity."""
        return np.array(AXES[self.scene.down])

    def _velocity(self, p: Point) -> tuple[Floats, float]:
        """The velocity of a point, and the size of its terms."""
        rows = [self.along(p.body, self.position(p), way) for way in np.eye(2)]
        return np.array([r.rate for r in rows]), rows[0].rate_size

    def _apply(self, f: Force) -> None:
        v = [x.at(self.look) for x in f.values]
        at = [self.position(p) for p in f.points]
        if f.kind == "on":
            self.push(f.points[0].body, at[0], np.array(v))
        elif f.kind == "couple" and isinstance(f.holder, Pin):
            self.turn(f.holder.b.body, v[0])
            self.turn(f.holder.a.body, -v[0])
        elif f.kind == "couple":
            self.turn(f.holder, v[0])
        elif f.kind == "drag":
            velocity, terms = self._velocity(f.points[0])
            by = v[0] * (norm(velocity) if f.exponent == 2 else 1.0)
            self.push(f.points[0].body, at[0], -by * velocity, by * terms)
        else:
            self._pull(f, v, at)

    def _pull(self, f: Force, v: list[float], at: list[Floats]) -> None:
        """A force between two points, on the first along the way to the second."""
        apart = at[1] - at[0]
        length = norm(apart)
        way = apart / length if length > 0 else np.zeros(2)
        terms = norm(at[0]) + norm(at[1])
        if f.kind == "spring":
            pull, size = v[0] * (length - v[1]), v[0] * (length + v[1])
        elif f.kind == "attraction":
            pull = size = v[0] * length
        else:
            (one, more), (other, others) = (self._velocity(p) for p in f.points)
            pull, size = v[0] * ((other - one) @ way), v[0] * (norm(one) + norm(other))
            terms = more + others
        size += KNOWN * v[0] * terms
        for p, where, sign in zip(f.points, at, (1, -1), strict=True):
            self.push(p.body, where, sign * pull * way)
            if p.body is not None:
                k = self.at[p.body.name]
                self.load_size[k : k + 2] += size
                self.load_size[k + 2] += size * norm(where - self.origin(p.body))

    # joints

    def _contact(self, c: Contact) -> Joint:
        line, body, owner = c.line, c.body, c.line.owner
        turned = line.angle.at(self.look) + self.angle(owner)
        d = np.array([np.cos(turned), np.sin(turned)])
        if line.through is None:
            start = np.zeros(2)
        else:
            start = self.position(Point(owner, line.through, line.name))
        if c.rim is not None:
            assert c.rim.size is not None
            radius, centre = c.rim.size.at(self.look), self.origin(c.rim)
        else:
            assert c.point is not None
            radius, centre = 0.0, self.position(c.point)
        side = self.sides[c.name]
        n = side * left(d)
        height = n @ (centre - start)
        touching = centre - radius * n
        rows = {}
        ours, theirs = self.along(body, centre, n), self.along(owner, centre, n)
        # height' = n (v_P - v_Q) - side w d (P - Q); once more with d' and n'
        w, w_b = self.spin(owner), self.spin(body)
        slide = self.along(body, centre, d).rate - self.along(owner, centre, d).rate
        coriolis = -2 * side * w * slide
        rows["n"] = _less(ours, theirs, coriolis)
        ours, theirs = self.along(body, touching, d), self.along(owner, touching, d)
        # slip = d (v_P - v_Q) + side radius w_b + side w (height - radius)
        ways = self.along(body, centre, n).rate - self.along(owner, start, n).rate
        climb = ways - side * w * (d @ (centre - start))
        middle, base = self.along(body, centre, d), self.along(owner, start, d)
        bias = middle.bias - base.bias + side * w * ways + side * w * climb
        rows["t"] = _less(ours, theirs, 0.0)
        rows["t"].bias = bias
        rows["t"].bias_size = (
            middle.bias_size
            + base.bias_size
            + 2 * abs(w) * (ours.rate_size + theirs.rate_size + abs(w) * norm(centre - start))
        )
        spin = np.zeros(self.n)
        if body is not None and body.turns:
            spin[self.at[body.name] + 2] += 1
        if owner is not None and owner.turns:
            spin[self.at[owner.name] + 2] -= 1
        rows["r"] = Row(spin, np.abs(spin), 0.0, w_b - w, abs(w_b) + abs(w), 0.0)
        mu = 0.0 if c.mu is None else c.mu.at(self.look)
        mu_s = mu if c.mu_s is None else c.mu_s.at(self.look)
        delta = 0.0 if c.delta is None else c.delta.at(self.look)
        size = norm(centre) + norm(start) + radius
        return Joint(
            c,
            rows,
            gap=height - radius,
            size=size,
            direction=d,
            normal=n,
            touching=touching,
            mu=mu,
            mu_s=mu_s,
            delta=delta,
        )

    def _pin(self, p: Pin) -> Joint:
        a, b = self.position(p.a), self.position(p.b)
        rows = {}
        for way, word in ((np.array([1.0, 0.0]), "x"), (np.array([0.0, 1.0]), "y")):
            rows[word] = _less(self.along(p.b.body, b, way), self.along(p.a.body, a, way), 0.0)
        spin = np.zeros(self.n)
        for body, sign in ((p.b.body, 1), (p.a.body, -1)):
            if body is not None and body.turns:
                spin[self.at[body.name] + 2] += sign
        w = [self.spin(p.b.body), self.spin(p.a.body)]
        rows["c"] = Row(spin, np.abs(spin), 0.0, w[0] - w[1], abs(w[0]) + abs(w[1]), 0.0)
        radius = 0.0 if p.radius is None else p.radius.at(self.look)
        mu = 0.0 if p.mu is None else p.mu.at(self.look) * radius
        mu_s = mu if p.mu_s is None else p.mu_s.at(self.look) * radius
        size = norm(a) + norm(b)
        return Joint(
            p,
            rows,
            gap=norm(b - a),
            size=size,
            direction=np.zeros(2),
            normal=np.zeros(2),
            touching=b,
            mu=mu,
            mu_s=mu_s,
            delta=0.0,
        )


def _less(one: Row, other: Row, bias: float) -> Row:
    return Row(
        one.jacobian - other.jacobian,
        one.reach + other.reach,
        one.bias - other.bias + bias,
        one.rate - other.rate,
        one.rate_size + other.rate_size,
        one.bias_size + other.bias_size + abs(bias),
    )


def inertia(b: Body, look: Callable[[str], float]) -> float:
    """Moment of inertia about G; 1 for a particle, which does not turn."""
    if b.inertia is not None:
        return b.inertia.at(look)
    if b.size is None:
        return 1.0
    m, size = b.mass.at(look), b.size.at(look)
    return m * size * size * {"rod": 1 / 12, "disc": 1 / 2, "ring": 1.0}[b.shape]


def norm(v: Floats) -> float:
    return float(np.hypot(v[0], v[1]))
