"""Newton-Euler of a mechanism in space: relations as rows, their rates, loads; plain numpy.

A row of bodies A, B has a relative velocity J v and a relative acceleration J a + c; v has the
velocity of G and the angular velocity of each body, in axes of the ground. With r from the place on
A to that on B, d fixed in A: (r.d)'' = r''.d + 2 r'.d' + r.d''.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from judge.space.scene import DOWN, Frame, Link, Push, Solid, SpaceScene

Floats = NDArray[np.float64]
POINT = ("spherique", "cardan", "rotoide", "encastrement")


def axes(q: Floats) -> Floats:
    """Axes of a body as columns, from a unit quaternion w, x, y, z."""
    w, v = q[0], q[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.asarray(np.eye(3) + 2 * w * cross + 2 * cross @ cross)


def about(axis: Floats, angle: float) -> Floats:
    """A rotation about an axis."""
    u = axis / np.linalg.norm(axis)
    return axes(np.array([math.cos(angle / 2), *(math.sin(angle / 2) * u)]))


@dataclass(slots=True)
class State:
    """Position of G, axes, velocity and angular velocity of a body."""

    position: Floats
    axes: Floats
    velocity: Floats
    spin: Floats


STILL = State(np.zeros(3), np.eye(3), np.zeros(3), np.zeros(3))


@dataclass(slots=True)
class Row:
    """`value` of the relation (a length or a cosine), J, c, and the rate that is prescribed."""

    value: float
    jacobian: Floats
    bias: float
    rate: float = 0.0
    length: bool = True


class Mechanism:
    """A scene in a state, with values of its parameters."""

    def __init__(
        self, scene: SpaceScene, values: Mapping[str, float], state: Mapping[str, State], t: float
    ) -> None:
        self.scene, self.values, self.state, self.t = scene, values, state, t
        self.n = 6 * len(scene.bodies)
        self.at = {b.name: 6 * k for k, b in enumerate(scene.bodies)}
        self.speed = np.concatenate(
            [x for b in scene.bodies for x in (state[b.name].velocity, state[b.name].spin)]
        )
        self.mass = np.zeros((self.n, self.n))
        self.load = np.zeros(self.n)
        self.size = np.zeros(self.n)
        for b in scene.bodies:
            self._inertia(b)
        for p in scene.pushes:
            self._apply(p)
        self.rows = {c.name: self._rows(c) for c in scene.links}

    def of(self, b: Solid | None) -> State:
        """The state of a body, or of the ground."""
        return STILL if b is None else self.state[b.name]

    def place(self, f: Frame) -> Floats:
        """The place of a frame."""
        local = np.array([self.values[f"{k}_{f.name}"] for k in "xyz"])
        return self.of(f.body).position + self.of(f.body).axes @ local

    def axes(self, f: Frame) -> Floats:
        """The axes of a frame."""
        axis = np.array([self.values[f"{k}_{f.name}"] for k in ("e1", "e2", "e3")])
        return np.asarray(self.of(f.body).axes @ about(axis, self.values[f"a_{f.name}"]))

    def velocity(self, f: Frame) -> Floats:
        """The velocity of the place of a frame."""
        s = self.of(f.body)
        return np.asarray(s.velocity + np.cross(s.spin, self.place(f) - s.position))

    def _inertia(self, b: Solid) -> None:
        k, v, s = self.at[b.name], self.values, self.state[b.name]
        m = v[f"m_{b.name}"]
        tensor = s.axes @ np.diag(moments(b, v)) @ s.axes.T
        self.mass[k : k + 3, k : k + 3] = m * np.eye(3)
        self.mass[k + 3 : k + 6, k + 3 : k + 6] = tensor
        weight = m * v["g"] * np.array(DOWN[self.scene.down])
        self.load[k : k + 3] += weight
        turning = np.cross(s.spin, tensor @ s.spin)
        self.load[k + 3 : k + 6] -= turning
        self.size[k : k + 3] += np.linalg.norm(weight)
        self.size[k + 3 : k + 6] += np.linalg.norm(turning)

    def push(self, b: Solid | None, at: Floats, force: Floats) -> None:
        """Add a force at a place."""
        if b is None:
            return
        k, arm = self.at[b.name], at - self.state[b.name].position
        self.load[k : k + 3] += force
        self.load[k + 3 : k + 6] += np.cross(arm, force)
        self.size[k : k + 3] += np.linalg.norm(force)
        self.size[k + 3 : k + 6] += np.linalg.norm(arm) * np.linalg.norm(force)

    def _apply(self, p: Push) -> None:
        v, n = self.values, p.name
        if p.kind in ("on", "couple"):
            wave = math.sin(v[f"w_{n}"] * self.t)
            words = ("fx", "fy", "fz") if p.kind == "on" else ("cx", "cy", "cz")
            value = wave * np.array([v[f"{w}_{n}"] for w in words])
            if p.kind == "on":
                self.push(p.frames[0].body, self.place(p.frames[0]), value)
            else:
                assert p.body is not None
                k = self.at[p.body.name] + 3
                self.load[k : k + 3] += value
                self.size[k : k + 3] += np.linalg.norm(value)
            return
        a, b = p.frames
        apart = self.place(b) - self.place(a)
        length = float(np.linalg.norm(apart))
        way = apart / length
        if p.kind == "spring":
            pull = v[f"k_{n}"] * (length - v[f"l_{n}"])
        else:
            pull = v[f"c_{n}"] * float((self.velocity(b) - self.velocity(a)) @ way)
        self.push(a.body, self.place(a), pull * way)
        self.push(b.body, self.place(b), -pull * way)

    # relations

    def _row(
        self, c: Link, value: float, bias: float, parts: tuple[Floats, Floats, Floats, Floats]
    ) -> Row:
        """A row by its parts: velocity and spin of A, velocity and spin of B."""
        jacobian = np.zeros(self.n)
        for body, k in ((c.a.body, 0), (c.b.body, 2)):
            if body is not None:
                at = self.at[body.name]
                jacobian[at : at + 3] += parts[k]
                jacobian[at + 3 : at + 6] += parts[k + 1]
        return Row(value, jacobian, bias)

    def along(self, c: Link, way: Floats, offset: float = 0.0) -> Row:
        """r.d less an offset, of a direction d that is fixed in A."""
        one, two = self.of(c.a.body), self.of(c.b.body)
        pa = self.place(c.a)
        pb = two.position if c.kind == "ball" else self.place(c.b)
        ra, rb, r = pa - one.position, pb - two.position, pb - pa
        wa, wb = one.spin, two.spin
        rate = two.velocity + np.cross(wb, rb) - one.velocity - np.cross(wa, ra)
        turning = np.cross(wb, np.cross(wb, rb)) - np.cross(wa, np.cross(wa, ra))
        swept = np.cross(wa, way)
        bias = turning @ way + 2 * rate @ swept + r @ np.cross(wa, swept)
        arm = np.cross(ra + r, way)
        return self._row(
            c, float(r @ way - offset), float(bias), (-way, -arm, way, np.cross(rb, way))
        )

    def across(self, c: Link, u: Floats, v: Floats) -> Row:
        """u.v of a direction of A and one of B."""
        wa, wb = self.of(c.a.body).spin, self.of(c.b.body).spin
        bias = (
            np.cross(wa, np.cross(wa, u)) @ v
            + 2 * np.cross(wa, u) @ np.cross(wb, v)
            + u @ np.cross(wb, np.cross(wb, v))
        )
        turn, none = np.cross(u, v), np.zeros(3)
        row = self._row(c, float(u @ v), float(bias), (none, turn, none, -turn))
        row.length = False
        return row

    def apart(self, c: Link, length: float) -> Row:
        """Half the excess of the square of a distance, over the distance."""
        one, two = self.of(c.a.body), self.of(c.b.body)
        pa, pb = self.place(c.a), self.place(c.b)
        ra, rb, r = pa - one.position, pb - two.position, pb - pa
        rate = two.velocity + np.cross(two.spin, rb) - one.velocity - np.cross(one.spin, ra)
        turning = np.cross(two.spin, np.cross(two.spin, rb)) - np.cross(
            one.spin, np.cross(one.spin, ra)
        )
        d = r / length
        bias = (r @ turning + rate @ rate) / length
        value = float(r @ r - length**2) / (2 * length)
        return self._row(c, value, float(bias), (-d, -np.cross(ra, d), d, np.cross(rb, d)))

    def _rows(self, c: Link) -> list[Row]:
        fa, fb = self.axes(c.a), self.axes(c.b)
        if c.kind == "tige":
            return [self.apart(c, self.values[f"l_{c.name}"])]
        if c.kind == "ball":
            assert c.b.body is not None
            return [self.along(c, fa[:, 2], self.values[f"r_{c.b.body.name}"])]
        if c.kind in ("point_surface", "contact"):
            return [self.along(c, fa[:, 2])]
        axis = unit(c.axis)
        e1, e2 = beside(axis)
        u, s, t = fa @ axis, fa @ e1, fa @ e2
        u2, t2 = fb @ axis, fb @ e2
        found: list[Row] = []
        if c.kind in POINT:
            found += [self.along(c, x) for x in (u, s, t)]
        elif c.kind == "appui_plan":
            found.append(self.along(c, u))
        else:
            found += [self.along(c, s), self.along(c, t)]
        if c.kind == "cardan":
            other = unit(c.axis_b)
            row = self.across(c, u, fb @ other)
            row.value -= float(axis @ other)
            found.append(row)
        elif c.kind not in ("spherique", "lineaire_annulaire"):
            found += [self.across(c, s, u2), self.across(c, t, u2)]
        if c.kind in ("prismatique", "encastrement"):
            found.append(self.across(c, s, t2))
        if c.kind == "helicoidale":
            found.append(self._screw(c, u, s, t, fb @ e1))
        if c.drive:
            found.append(self._drive(c, u, s, t, fb @ e1))
        return found

    def turned(self, c: Link, u: Floats) -> Row:
        """The angle of B about the axis u of A, whose other directions are kept."""
        wa, wb = self.of(c.a.body).spin, self.of(c.b.body).spin
        none = np.zeros(3)
        row = self._row(c, 0.0, float((wb - wa) @ np.cross(wa, u)), (none, -u, none, u))
        row.length = False
        return row

    def _screw(self, c: Link, u: Floats, s: Floats, t: Floats, s2: Floats) -> Row:
        way, turn = self.along(c, u), self.turned(c, u)
        part = self.values[f"p_{c.name}"] / (2 * math.pi)
        angle = math.atan2(float(s2 @ t), float(s2 @ s))
        whole = self.values[f"p_{c.name}"]
        value = math.remainder(way.value - part * angle, whole)
        return Row(value, way.jacobian - part * turn.jacobian, way.bias - part * turn.bias)

    def _drive(self, c: Link, u: Floats, s: Floats, t: Floats, s2: Floats) -> Row:
        wanted = self.values[f"d0_{c.name}"] + self.values[f"w_{c.name}"] * self.t
        if c.drive == "angle":
            row = self.turned(c, u)
            angle = math.atan2(float(s2 @ t), float(s2 @ s))
            row.value = math.remainder(angle - wanted, 2 * math.pi)
        else:
            row = self.along(c, u, wanted)
        row.rate = self.values[f"w_{c.name}"]
        return row

    def touching(self, c: Link) -> Floats:
        """The place at which the reaction of a liaison acts."""
        if c.kind != "ball":
            return self.place(c.b)
        assert c.b.body is not None
        radius = self.values[f"r_{c.b.body.name}"]
        return np.asarray(self.of(c.b.body).position - radius * self.axes(c.a)[:, 2])

    def matrix(self, *, free: bool = False) -> Floats:
        """All rows; with `free` without those of drives."""
        found = []
        for c in self.scene.links:
            rows = self.rows[c.name]
            found += [r.jacobian for r in (rows[:-1] if free and c.drive else rows)]
        return np.array(found).reshape(-1, self.n)


def unit(v: tuple[float, float, float]) -> Floats:
    """The direction of a vector."""
    return np.array(v) / np.linalg.norm(v)


def beside(axis: Floats) -> tuple[Floats, Floats]:
    """Two directions that complete a right-handed basis with the axis as its third."""
    other = np.eye(3)[int(np.argmin(np.abs(axis)))]
    e1 = np.cross(other, axis)
    e1 = e1 / np.linalg.norm(e1)
    return e1, np.cross(axis, e1)


def moments(b: Solid, v: Mapping[str, float]) -> Floats:
    """Principal moments about G along the axes of a body."""
    m = v[f"m_{b.name}"]
    if b.shape == "solid":
        return np.array([v[f"{k}_{b.name}"] for k in ("i1", "i2", "i3")])
    if b.shape == "box":
        x, y, z = (v[f"{k}_{b.name}"] ** 2 / 12 for k in ("s1", "s2", "s3"))
        return m * np.array([y + z, z + x, x + y])
    r = v[f"r_{b.name}"]
    if b.shape == "sphere":
        return np.full(3, 0.4 * m * r * r)
    across = m * (3 * r * r + v[f"l_{b.name}"] ** 2) / 12
    return np.array([across, across, m * r * r / 2])
