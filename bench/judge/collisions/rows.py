"""Gaps of contacts, and rows of contacts and joints, of a scene with impacts in a state.

Each body has six coordinates: the velocity of G and the angular velocity, in axes of the ground.
A contact of A and B at the place x has the rows n.(v_B(x) - v_A(x)) and the same along tangents.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from judge.collisions.scene import Body, ImpactScene, Joint, Place, Touch, Wall
from judge.space.rows import State, axes, beside

Floats = NDArray[np.float64]
STILL = State(np.zeros(3), np.eye(3), np.zeros(3), np.zeros(3))
ROUND = ("disc", "ring", "sphere")
EX, EY, EZ = np.eye(3)


@dataclass(slots=True)
class Meeting:
    """Gap, rows of the normal and of the tangents, their rates by moving walls, coefficients."""

    touch: Touch
    gap: float
    rows: Floats
    drift: Floats
    mu: float
    mu_s: float
    e: float


def inertia_of(b: Body, v: Mapping[str, float], plane: bool) -> Floats:
    """Moments about G along the axes of a body; of a rod none about its own axis."""
    m = v[f"m_{b.name}"]
    match b.shape:
        case "particle":
            return np.zeros(3)
        case "rod":
            across = m * v[f"l_{b.name}"] ** 2 / 12
            return np.array([0.0, across, across])
        case "box":
            s = [v[f"s{k}_{b.name}"] for k in (1, 2)] + [0.0 if plane else v[f"s3_{b.name}"]]
            x, y, z = (k * k / 12 for k in s)
            return m * np.array([y + z, z + x, x + y])
        case "polygon":
            return np.full(3, m * v[f"l_{b.name}"] ** 2 * polygon(b.corners)[1])
        case "ring":
            return np.full(3, m * v[f"r_{b.name}"] ** 2)
        case "disc":
            return np.full(3, 0.5 * m * v[f"r_{b.name}"] ** 2)
    return np.full(3, 0.4 * m * v[f"r_{b.name}"] ** 2)


def polygon(corners: tuple[tuple[float, float], ...]) -> tuple[Floats, float]:
    """Centroid of a lamina, and its moment about that per mass: sums over triangles."""
    p = np.array(corners)
    q = np.roll(p, -1, axis=0)
    cross = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
    area = cross.sum() / 2
    centre = ((p + q) * cross[:, None]).sum(axis=0) / (6 * area)
    squares = (p * p).sum(axis=1) + (p * q).sum(axis=1) + (q * q).sum(axis=1)
    return centre, float((cross * squares).sum() / (12 * area) - centre @ centre)


class Bodies:
    """A scene in a state, with values of its parameters."""

    def __init__(
        self, scene: ImpactScene, values: Mapping[str, float], row: Mapping[str, float], t: float
    ) -> None:
        self.scene, self.values, self.row, self.t = scene, values, row, t
        self.n = 6 * len(scene.bodies)
        self.at = {b.name: 6 * k for k, b in enumerate(scene.bodies)}
        self.state = {b.name: state_of(scene, b, row) for b in scene.bodies}
        self.speed = np.concatenate(
            [x for b in scene.bodies for x in (self.of(b).velocity, self.of(b).spin)]
        )
        self.mass = np.zeros((self.n, self.n))
        self.load = np.zeros(self.n)
        for b in scene.bodies:
            k, s = self.at[b.name], self.of(b)
            tensor = s.axes @ np.diag(inertia_of(b, values, scene.plane)) @ s.axes.T
            self.mass[k : k + 3, k : k + 3] = values[f"m_{b.name}"] * np.eye(3)
            self.mass[k + 3 : k + 6, k + 3 : k + 6] = tensor
            self.load[k : k + 3] = -values[f"m_{b.name}"] * values["g"] * self.up
            self.load[k + 3 : k + 6] = -np.cross(s.spin, tensor @ s.spin)
        self.meetings = {c.name: self._meeting(c) for c in scene.touches}
        self.joints = {j.name: self._joint(j) for j in scene.joints}

    @property
    def up(self) -> Floats:
        """Against gravity."""
        return EY if self.scene.plane else EZ

    def of(self, b: Body | None) -> State:
        """The state of a body, or of the ground."""
        return STILL if b is None else self.state[b.name]

    def place(self, p: Place) -> Floats:
        """A place in axes of the ground."""
        s = self.of(p.body)
        return np.asarray(s.position + s.axes @ self.local(p))

    def local(self, p: Place) -> Floats:
        """A place in axes of its body, from G."""
        v, b = self.values, p.body
        if p.named:
            return np.array([v.get(f"{k}_{p.named}", 0.0) for k in "xyz"])
        if b is None or not any(p.parts):
            return np.zeros(3)
        if b.shape == "rod":
            return np.array([p.parts[0] * v[f"l_{b.name}"] / 2, 0, 0])
        if b.shape == "polygon":
            centre = polygon(b.corners)[0]
            return np.array([*(np.array(p.parts[:2]) - centre) * v[f"l_{b.name}"], 0.0])
        half = [v[f"s1_{b.name}"], v[f"s2_{b.name}"], v.get(f"s3_{b.name}", 0.0)]
        return np.array(p.parts) * half / 2

    def radius(self, p: Place) -> float:
        """Of the rim of a round body, else none."""
        b = p.body
        rim = b is not None and b.shape in ROUND and not p.named
        return self.values[f"r_{b.name}"] if rim and b is not None else 0.0

    def direction(self, w: Floats, at: Floats, b: Body | None, sign: float = 1.0) -> Floats:
        """The row of the speed of a body along w at a place."""
        found = np.zeros(self.n)
        if b is not None:
            k = self.at[b.name]
            found[k : k + 3] = sign * w
            found[k + 3 : k + 6] = sign * np.cross(at - self.of(b).position, w)
        return found

    def turning(self, w: Floats, b: Body | None, sign: float = 1.0) -> Floats:
        """The row of the angular velocity of a body about w."""
        found = np.zeros(self.n)
        if b is not None:
            k = self.at[b.name] + 3
            found[k : k + 3] = sign * w
        return found

    def wall(self, w: Wall) -> tuple[Floats, Floats, Floats]:
        """A place of a wall, its normal, and its velocity by its own motion."""
        v, s = self.values, self.of(w.body)
        none = np.zeros(3)
        if w.body is not None:
            return s.position, s.axes @ self.up, none
        at = np.array([v[f"{k}_{w.name}"] for k in self.scene.axes] + [0.0])[:3]
        a = v[f"a_{w.name}"]
        if self.scene.plane:
            normal = np.array([-math.sin(a), math.cos(a), 0.0])
        else:
            b = v[f"b_{w.name}"]
            across = math.sin(a)
            normal = np.array([across * math.cos(b), across * math.sin(b), math.cos(a)])
        if not w.moves:
            return at, normal, none
        h, rate = v[f"h_{w.name}"], v[f"w_{w.name}"]
        at = at + h * math.sin(rate * self.t) * self.up
        return at, normal, h * rate * math.cos(rate * self.t) * self.up

    def _meeting(self, c: Touch) -> Meeting:
        v = self.values
        e = v[f"e_{c.law}"]
        still = np.zeros(1)
        if c.of is not None:
            gap, row = self._bound(c)
            return Meeting(c, gap, row[None], still, 0.0, 0.0, e)
        assert c.a is not None
        drift = np.zeros(3)
        if c.kind == "cord":
            assert c.b is not None
            one, two = self.place(c.a), self.place(c.b)
            apart = two - one
            long = float(np.linalg.norm(apart))
            d = apart / long
            row = self.direction(d, one, c.a.body) - self.direction(d, two, c.b.body)
            return Meeting(c, v[f"l_{c.name}"] - long, row[None], still, 0.0, 0.0, e)
        if c.wall is not None:
            at, normal, drift = self.wall(c.wall)
            centre, radius, other = self.place(c.a), self.radius(c.a), c.wall.body
            gap = float(normal @ (centre - at)) - radius
            x = centre - radius * normal
        else:
            assert c.b is not None
            other = c.b.body
            apart = self.place(c.a) - self.place(c.b)
            normal = apart / np.linalg.norm(apart)
            radius = self.radius(c.a)
            gap = float(np.linalg.norm(apart)) - radius - self.radius(c.b)
            x = self.place(c.a) - radius * normal
        ways = [np.cross(EZ, normal)] if self.scene.plane else list(beside(normal))
        across = [normal, *ways]
        rows = [self.direction(w, x, c.a.body) - self.direction(w, x, other) for w in across]
        mu = v[f"mu_{c.law}"]
        away = np.array([-float(w @ drift) for w in across])
        return Meeting(c, gap, np.array(rows), away, mu, mu * v[f"more_{c.law}"], e)

    def _bound(self, c: Touch) -> tuple[float, Floats]:
        """A bound of the coordinate of a joint: what is left to it, and its row."""
        j = c.of
        assert j is not None
        way = self.of(j.a.body).axes @ (EZ if self.scene.plane else EY)
        if j.kind == "prismatique":
            way = self.of(j.a.body).axes @ EX
            at = self.place(j.b)
            row = self.direction(way, at, j.b.body) - self.direction(way, at, j.a.body)
            value = self.row[f"{j.name}.displacement"]
        else:
            row = self.turning(way, j.b.body) - self.turning(way, j.a.body)
            value = self.row[f"{j.name}.angle"]
        if c.kind == "min":
            return value - self.values[f"lo_{j.name}"], row
        return self.values[f"hi_{j.name}"] - value, -row

    def _joint(self, j: Joint) -> Floats:
        """The rows that a joint keeps."""
        at, base = self.place(j.b), self.of(j.a.body).axes
        ways = [EX, EY] if self.scene.plane else [EX, EY, EZ]
        turns: list[Floats] = []
        if j.kind == "prismatique":
            ways = [base @ EY] if self.scene.plane else [base @ EY, base @ EZ]
            turns = [EZ] if self.scene.plane else [EX, EY, EZ]
        elif j.kind == "rotoide" and not self.scene.plane:
            turns = [base @ EX, base @ EZ]
        rows = [self.direction(w, at, j.b.body) - self.direction(w, at, j.a.body) for w in ways]
        rows += [self.turning(w, j.b.body) - self.turning(w, j.a.body) for w in turns]
        return np.array(rows)

    def dry(self, j: Joint) -> Floats:
        """The row of the dry friction of a bearing."""
        way = self.of(j.a.body).axes @ (EZ if self.scene.plane else EY)
        return self.turning(way, j.b.body) - self.turning(way, j.a.body)

    def kept(self) -> Floats:
        """All rows of joints, and those of turns that a particle or a rod does not have."""
        return np.array([r for rows in self.joints.values() for r in rows]).reshape(-1, self.n)

    def mobility(self) -> Floats:
        """The pseudo-inverse of the mass, with the rows of joints kept: speeds by impulses."""
        scale = np.diag(self.mass)
        weight = np.where(scale > 1e-14 * np.max(scale), 1 / np.sqrt(np.maximum(scale, 1e-300)), 0)
        inner = np.linalg.pinv(self.mass * np.outer(weight, weight), rcond=1e-9, hermitian=True)
        inverse = inner * np.outer(weight, weight)
        rows = self.kept()
        if not len(rows):
            return inverse
        across = inverse @ rows.T
        inner = rows @ across
        unit = 1 / np.sqrt(np.maximum(np.diag(inner), 1e-300))
        solved = np.linalg.pinv(inner * np.outer(unit, unit), rcond=1e-10, hermitian=True)
        return inverse - across @ (solved * np.outer(unit, unit)) @ across.T

    def energy(self) -> tuple[float, float]:
        """Kinetic and potential energy."""
        kinetic = float(self.speed @ self.mass @ self.speed) / 2
        height = sum(
            self.values[f"m_{b.name}"] * float(self.of(b).position @ self.up)
            for b in self.scene.bodies
        )
        return kinetic, self.values["g"] * height


def state_of(scene: ImpactScene, b: Body, row: Mapping[str, float]) -> State:
    """The state of a body in a row of a result."""
    n, names = b.name, scene.axes
    position, velocity = (
        np.array([row[f"{n}.{w}.{k}"] for k in names] + [0.0])[:3] for w in ("position", "velocity")
    )
    if b.shape == "particle":
        return State(position, np.eye(3), velocity, np.zeros(3))
    if scene.plane:
        a = row[f"{n}.angle"]
        turn = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
        return State(position, turn, velocity, np.array([0, 0, row[f"{n}.angular_velocity"]]))
    q = np.array([row[f"{n}.orientation[{k}]"] for k in range(1, 5)])
    spin = np.array([row[f"{n}.angular_velocity.{k}"] for k in "xyz"])
    return State(position, axes(q / np.linalg.norm(q)), velocity, spin)
