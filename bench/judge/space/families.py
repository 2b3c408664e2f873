"""Mechanisms in space: joints of the table in trees and loops, drives, smooth contacts that stay.

Bodies are put anywhere first; frames are then laid so that every relation holds. Speeds are those
that all relations and drives leave, so that the start is the one that the guesses say.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from judge.family import Family, Random, Setting, Structure
from judge.space.rows import Floats, Mechanism, State, about, axes, unit
from judge.space.scene import DOWN, SIZES, Frame, Link, Push, SpaceScene, Triple, X, Y, Z

TREE = {
    "rotoide": 6,
    "spherique": 3,
    "prismatique": 2,
    "verrou": 2,
    "helicoidale": 2,
    "cardan": 2,
    "appui_plan": 1,
    "lineaire_annulaire": 1,
    "encastrement": 1,
    "tige": 1,
    "point_surface": 1,
    "contact": 1,
    "ball": 1,
}
LOOP = {
    "tige": 3,
    "spherique": 2,
    "lineaire_annulaire": 2,
    "point_surface": 2,
    "contact": 2,
    "cardan": 1,
    "rotoide": 1,
    "verrou": 1,
}
DRIVES = {"rotoide": "angle", "prismatique": "displacement"}
# Singular values of the rows, over the largest: below the first none, above the second clear.
NONE, CLEAR = 1e-9, 1e-2


class Maker:
    """Draws the structure of a mechanism."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.s = SpaceScene("Mechanism", str(rng.choice(list(DOWN))))
        self.count = 0

    def word(self, of: str) -> str:
        """A name nobody has yet."""
        self.count += 1
        return f"{of}{self.count}"

    def chosen(self, kinds: Mapping[str, int]) -> str:
        """One of the kinds, by their parts."""
        parts = np.array(list(kinds.values()))
        return str(self.rng.choice(list(kinds), p=parts / np.sum(parts)))

    def direction(self) -> Triple:
        """An axis of the frame, or any."""
        if self.rng.random() < 0.6:
            return (X, Y, Z)[int(self.rng.integers(3))]
        x, y, z = (float(round(v, 3)) for v in self.rng.normal(size=3))
        return (x, y, z)

    def make(self, most: int, loops: int) -> SpaceScene:
        """A tree of bodies, closed by some more links, with forces."""
        rng, s = self.rng, self.s
        for i in range(int(rng.integers(1, most + 1))):
            s.body(f"b{i}", str(rng.choice(list(SIZES))))
            if rng.random() > 0.05:
                self.link(i, self.chosen(TREE))
        for _ in range(loops):
            self.link(int(rng.integers(len(s.bodies))), self.chosen(LOOP))
        for _ in range(int(rng.integers(0, 3))):
            self.push()
        return s

    def link(self, of: int, kind: str) -> None:
        """Join a body to the ground or to an earlier one."""
        rng, s = self.rng, self.s
        own = s.bodies[of]
        other = None if of == 0 or rng.random() < 0.5 else s.bodies[int(rng.integers(of))]
        if kind == "ball" and own.shape != "sphere":
            kind = "contact"
        many = int(rng.integers(2, 5)) if kind == "contact" and rng.random() < 0.4 else 1
        plane = self.word("plane") if many > 1 else ""
        axis = self.direction()
        axis_b = self.direction()
        while np.linalg.norm(np.cross(unit(axis), unit(axis_b))) < 0.3:
            axis_b = self.direction()
        drive = DRIVES.get(kind, "") if rng.random() < 0.15 else ""
        for _ in range(many):
            name = self.word("J")
            a, b = s.frame(self.word("f"), other), s.frame(self.word("f"), own)
            s.links.append(Link(name, kind, a, b, axis, axis_b, drive, plane))
            if kind == "tige":
                s.add(name, {"l": "Length"})
            if kind == "helicoidale":
                s.add(name, {"p": "Length"})
            if drive == "angle":
                s.add(name, {"d0": "Angle", "w": "AngularVelocity"})
            elif drive:
                s.add(name, {"d0": "Length", "w": "Velocity"})

    def push(self) -> None:
        """A force off the centre of mass, a couple, a spring or a damper."""
        rng, s = self.rng, self.s
        kind = str(rng.choice(["on", "couple", "spring", "damper"], p=[0.5, 0.2, 0.2, 0.1]))
        body, word = s.bodies[int(rng.integers(len(s.bodies)))], self.word("p")
        if kind == "on":
            s.add(word, {"fx": "Force", "fy": "Force", "fz": "Force", "w": "AngularVelocity"})
            s.pushes.append(Push(word, kind, (s.frame(self.word("f"), body),)))
        elif kind == "couple":
            s.add(word, {"cx": "Torque", "cy": "Torque", "cz": "Torque", "w": "AngularVelocity"})
            s.pushes.append(Push(word, kind, (), body))
        else:
            others = [b for b in [None, *s.bodies] if b is not body]
            ends = (
                s.frame(self.word("f"), body),
                s.frame(self.word("f"), others[int(rng.integers(len(others)))]),
            )
            s.add(word, {"k": "Stiffness", "l": "Length"} if kind == "spring" else {"c": "Damping"})
            s.pushes.append(Push(word, kind, ends))


USUAL = {
    "Length": (-0.8, 0.8),
    "Force": (-10, 10),
    "Torque": (-3, 3),
    "Stiffness": (5, 80),
    "Damping": (0, 2),
    "AngularVelocity": (-4, 4),
    "Velocity": (-1, 1),
    "Angle": (-3, 3),
}


def draw(s: SpaceScene, rng: Random) -> Setting:
    """Values of all parameters that fit together."""
    values: dict[str, float] = {"g": float(rng.choice([9.81, 0.0], p=[0.8, 0.2]))}
    spread = 3.0 if rng.random() < 0.15 else 0.6
    for word, kind in s.parameters.items():
        if kind == "Mass":
            values[word] = float(10 ** rng.uniform(-spread, spread))
        elif kind in USUAL:
            low, high = USUAL[kind]
            values[word] = float(rng.uniform(low, high))
        elif kind == "Real":
            values[word] = float(rng.normal())
    for word, kind in s.parameters.items():
        if word.split("_")[0] in ("r", "l", "s1", "s2", "s3") and kind == "Length":
            values[word] = float(rng.uniform(0.1, 0.6))
        if word.startswith("p_"):
            values[word] = float(rng.choice([-1, 1]) * rng.uniform(0.05, 0.6))
    for b in s.bodies:
        if b.shape == "solid":
            x, y, z = (float(v) ** 2 * values[f"m_{b.name}"] for v in rng.uniform(0.1, 0.5, 3))
            values |= {f"i1_{b.name}": y + z, f"i2_{b.name}": z + x, f"i3_{b.name}": x + y}
    state = {b.name: _pose(values, b.name, rng) for b in s.bodies}
    planes: dict[str, Floats] = {}
    for c in s.links:
        _lay(c, values, state, rng, planes)
    speeds(s, values, state, rng)
    for b in s.bodies:
        now = state[b.name]
        for keys, v in (("u0 v0 w0", now.velocity), ("o1 o2 o3", now.spin)):
            values |= {f"{k}_{b.name}": float(x) for k, x in zip(keys.split(), v, strict=True)}
    tolerance = float(10.0 ** np.round(rng.uniform(-11.5, -4.5)))
    return Setting(values, float(rng.uniform(0.1, 1.2)), tolerance)


def _pose(values: dict[str, float], b: str, rng: Random) -> State:
    """Any place and orientation of a body."""
    place, q = rng.uniform(-1, 1, 3), rng.normal(size=4)
    q /= np.linalg.norm(q)
    values |= {f"{k}0_{b}": float(x) for k, x in zip("xyz", place, strict=True)}
    values |= {f"q{k + 1}_{b}": float(x) for k, x in enumerate(q)}
    return State(place, axes(q), np.zeros(3), np.zeros(3))


def _put(
    f: Frame, place: Floats, turned: Floats, values: dict[str, float], state: dict[str, State]
) -> None:
    """Lay a frame at a place of the ground, with these axes."""
    local, own = place, turned
    if f.body is not None:
        now = state[f.body.name]
        local, own = now.axes.T @ (place - now.position), now.axes.T @ turned
    values |= {f"{k}_{f.name}": float(x) for k, x in zip("xyz", local, strict=True)}
    vector = Rotation.from_matrix(own).as_rotvec()
    angle = float(np.linalg.norm(vector))
    axis = vector / angle if angle > 0 else np.array(Z)
    values |= {f"e{k + 1}_{f.name}": float(x) for k, x in enumerate(axis)}
    values[f"a_{f.name}"] = angle


def _lay(
    c: Link,
    values: dict[str, float],
    state: dict[str, State],
    rng: Random,
    planes: dict[str, Floats],
) -> None:
    """Frames of both places so that the relations of a link hold."""
    assert c.b.body is not None
    body = state[c.b.body.name]
    turned = axes(unit4(rng))
    axis, angle = unit(c.axis), float(rng.uniform(-2.5, 2.5))
    place = body.position + body.axes @ rng.uniform(-0.5, 0.5, 3)
    along, across = float(rng.uniform(-0.5, 0.5)), rng.uniform(-0.5, 0.5, 3)
    if c.drive == "angle":
        angle = values[f"d0_{c.name}"]
    elif c.drive:
        along = values[f"d0_{c.name}"]
    if c.kind == "helicoidale":
        along = values[f"p_{c.name}"] * angle / (2 * math.pi)
    if c.kind in ("point_surface", "contact", "ball"):
        if c.plane:
            turned = planes.setdefault(c.plane, turned)
            first = planes.setdefault(c.plane + "at", place)
            place = place - turned[:, 2] * float((place - first) @ turned[:, 2])
        gap = values[f"r_{c.b.body.name}"] if c.kind == "ball" else 0.0
        place = body.position if c.kind == "ball" else place
        shift = np.array([across[0], across[1], -gap])
        _put(c.a, place + turned @ shift, turned, values, state)
        _put(c.b, place, axes(unit4(rng)), values, state)
        return
    if c.kind == "tige":
        way = rng.normal(size=3)
        values[f"l_{c.name}"] = length = float(rng.uniform(0.3, 1.0))
        _put(c.a, place + length * way / np.linalg.norm(way), turned, values, state)
        _put(c.b, place, axes(unit4(rng)), values, state)
        return
    other = turned
    shift = np.zeros(3)
    if c.kind in ("rotoide", "verrou", "helicoidale", "appui_plan"):
        other = turned @ about(axis, angle)
    elif c.kind == "cardan":
        other = turned @ about(axis, angle) @ about(unit(c.axis_b), float(rng.uniform(-1, 1)))
    elif c.kind in ("spherique", "lineaire_annulaire"):
        other = axes(unit4(rng))
    if c.kind in ("prismatique", "verrou", "helicoidale", "lineaire_annulaire"):
        shift = along * axis
    elif c.kind == "appui_plan":
        shift = across - axis * float(across @ axis)
    _put(c.a, place - turned @ shift, turned, values, state)
    _put(c.b, place, other, values, state)


def unit4(rng: Random) -> Floats:
    """Any unit quaternion."""
    q = rng.normal(size=4)
    return np.asarray(q / np.linalg.norm(q))


def speeds(s: SpaceScene, values: dict[str, float], state: dict[str, State], rng: Random) -> None:
    """Random speeds that keep the relations, with the rates of drives."""
    now = Mechanism(s, values, state, 0.0)
    matrix = now.matrix()
    wanted = np.array([r.rate for c in s.links for r in now.rows[c.name]])
    v = rng.uniform(-1.5, 1.5, now.n) * float(rng.choice([0.0, 1.0], p=[0.25, 0.75]))
    if len(matrix):
        inverse = np.linalg.pinv(matrix, rcond=1e-9)
        for _ in range(3):
            v = v + inverse @ (wanted - matrix @ v)
    v[np.abs(v) < 1e-14] = 0.0
    for b in s.bodies:
        k = now.at[b.name]
        state[b.name].velocity, state[b.name].spin = v[k : k + 3], v[k + 3 : k + 6]


def rank(matrix: Floats) -> tuple[int, float]:
    """Rank of rows, each of them scaled, and the smallest part that counts."""
    if not len(matrix):
        return 0, 1.0
    s = np.linalg.svd(matrix / np.linalg.norm(matrix, axis=1)[:, None], compute_uv=False)
    found = int(np.sum(s > NONE * s[0]))
    return found, float(s[found - 1] / s[0])


def sound(s: SpaceScene, setting: Setting) -> bool:
    """Whether drives can be followed, and no relation nearly follows from others."""
    state = start_of(s, setting.values)
    now = Mechanism(s, setting.values, state, 0.0)
    own, clear = rank(now.matrix(free=True))
    every, all_clear = rank(now.matrix())
    drives = sum(bool(c.drive) for c in s.links)
    return every == own + drives and clear > CLEAR and all_clear > CLEAR


def start_of(s: SpaceScene, values: dict[str, float]) -> dict[str, State]:
    """The state that the guesses say."""
    state = {}
    for b in s.bodies:
        place, velocity, spin = (
            np.array([values[f"{k}_{b.name}"] for k in keys.split()])
            for keys in ("x0 y0 z0", "u0 v0 w0", "o1 o2 o3")
        )
        q = np.array([values[f"q{k}_{b.name}"] for k in range(1, 5)])
        state[b.name] = State(place, axes(q / np.linalg.norm(q)), velocity, spin)
    return state


def _family(most: int, loops: int) -> Callable[[Random], Structure]:
    def make(rng: Random) -> Structure:
        while True:
            s = Maker(rng).make(most, int(rng.integers(0, loops + 1)) if loops == 1 else loops)
            if not sound(s, draw(s, rng)):
                continue

            def drawn(rng: Random, s: SpaceScene = s) -> Setting:
                while True:
                    setting = draw(s, rng)
                    if sound(s, setting):
                        return setting

            return Structure(s, drawn)  # type: ignore[arg-type]

    return make


FAMILIES = (
    Family("space", _family(4, 0), 1.5, 10, "trees of joints in space, drives, smooth contacts"),
    Family("loops", _family(4, 2), 1.5, 10, "loops of joints in space, redundant or not"),
)
