"""What families of scenes with impacts share: bodies, contacts of all corners, starts apart."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from judge.collisions.check import start_row
from judge.collisions.rows import Bodies, polygon
from judge.collisions.scene import (
    RULES,
    Body,
    ImpactScene,
    Joint,
    Percussion,
    Place,
    Touch,
    Wall,
)
from judge.collisions.write import corners, sizes_of
from judge.family import Random, Setting, Structure, decades, in_units, some_tolerance

Values = dict[str, float]
TRIES = 400
POLYGONS = (
    ((0.0, 0.0), (1.0, 0.0), (0.4, 0.8)),
    ((0.0, 0.0), (0.9, -0.1), (1.1, 0.5), (0.5, 0.9), (-0.1, 0.6)),
    ((-0.5, -0.2), (0.7, -0.2), (0.3, 0.3), (-0.3, 0.3)),
)


class Maker:
    """Draws the structure of a scene, and values of its parameters."""

    def __init__(self, rng: Random, plane: bool) -> None:
        self.rng, self.plane = rng, plane
        self.s = ImpactScene("Impacts", plane)
        self.rule = str(rng.choice(RULES, p=[0.5, 0.25, 0.25]))
        self.laws: list[str] = []
        self.draws: list[Callable[[Random, Values], None]] = []

    def body(self, word: str, shape: str) -> Body:
        """A body with its sizes and its start."""
        s = self.s
        outline = POLYGONS[int(self.rng.integers(len(POLYGONS)))] if shape == "polygon" else ()
        b = Body(word, shape, outline)
        s.bodies.append(b)
        s.add(word, {"m": "Mass", **sizes_of(shape, self.plane)})
        s.add(word, dict.fromkeys([f"{k}0" for k in s.axes], "Length"))
        s.add(word, dict.fromkeys([f"{k}0" for k in "uvw"[: len(s.axes)]], "Velocity"))
        if shape != "particle" and self.plane:
            s.add(word, {"a0": "Angle", "o0": "AngularVelocity"})
        elif shape != "particle":
            s.add(word, dict.fromkeys(("q1", "q2", "q3", "q4"), "Real"))
            s.add(word, dict.fromkeys(("o1", "o2", "o3"), "AngularVelocity"))
        return b

    def law(self) -> str:
        """A set of coefficients: a new one, or one that is there."""
        if self.laws and self.rng.random() < 0.6:
            return str(self.rng.choice(self.laws))
        word = f"k{len(self.laws)}"
        self.laws.append(word)
        self.s.add(word, {"mu": "Real", "more": "Real", "e": "Real"})
        return word

    def wall(self, word: str, body: Body | None = None, moves: bool = False) -> Wall:
        """A line or plane."""
        w = Wall(word, body, moves)
        self.s.walls.append(w)
        if body is None:
            self.s.add(word, dict.fromkeys(self.s.axes, "Length") | {"a": "Angle"})
            if not self.plane:
                self.s.add(word, {"b": "Angle"})
        if moves:
            self.s.add(word, {"h": "Length", "w": "AngularVelocity"})
        return w

    def frame(self, word: str, body: Body | None) -> Place:
        """A place at its own parameters."""
        self.s.add(word, dict.fromkeys(self.s.axes, "Length"))
        return Place(body, (0.0, 0.0, 0.0), word)

    def points(self, b: Body) -> list[Place]:
        """The corners of a body, the ends of a rod, or the rim of a round one."""
        if b.shape == "rod":
            return [Place(b, (x, 0.0, 0.0)) for x in (1.0, -1.0)]
        if b.shape == "box":
            return [Place(b, c) for c in corners(self.plane)]
        if b.shape == "polygon":
            return [Place(b, (x, y, 0.0)) for x, y in b.corners]
        return [Place(b)]

    def on(self, b: Body, w: Wall) -> None:
        """Contacts of all corners of a body with a wall."""
        law = self.law()
        for k, p in enumerate(self.points(b)):
            name = f"c_{b.name}_{w.name}_{k}"
            self.s.touches.append(Touch(name, "wall", a=p, wall=w, law=law, rule=self.rule))

    def pair(self, a: Body, b: Body) -> None:
        """A contact of two round bodies."""
        name = f"c_{a.name}_{b.name}"
        touch = Touch(name, "pair", a=Place(a), b=Place(b), law=self.law(), rule=self.rule)
        self.s.touches.append(touch)

    def cord(self, word: str, a: Place, b: Place) -> None:
        """A cord between two places."""
        self.s.add(word, {"l": "Length"})
        self.s.touches.append(Touch(word, "cord", a=a, b=b, law=self.law(), rule=self.rule))

    def cords(self, bodies: list[Body], ball: str) -> None:
        """Cords from a hook to the first body and from each to the next, to an eye on a `ball`."""
        ends = [self.frame("hook", None)]
        for k, b in enumerate(bodies):
            at = Place(b, (1.0, 0.0, 0.0)) if b.shape == "rod" else Place(b)
            if b.shape == ball:
                at = self.frame(f"eye{k}", b)
            self.cord(f"cord{k}", ends[-1], at)
            ends.append(at)

    def joint(self, word: str, kind: str, a: Place, b: Place, dry: bool = False) -> Joint:
        """A joint, with a dry bearing or without."""
        j = Joint(word, kind, a, b, dry)
        self.s.joints.append(j)
        if dry:
            self.s.add(word, {"mu": "Real", "r": "Length"})
        return j

    def stops(self, j: Joint) -> None:
        """Bounds of the coordinate of a joint."""
        kind = "Length" if j.kind == "prismatique" else "Angle"
        self.s.add(j.name, {"lo": kind, "hi": kind})
        law = self.law()
        for end in ("min", "max"):
            touch = Touch(f"{j.name}.stops.{end}", end, of=j, law=law, rule="energetic")
            self.s.touches.append(touch)

    def percussion(self, word: str, at: Place) -> None:
        """An impulse at a time."""
        self.s.add(word, dict.fromkeys([f"p{k}" for k in self.s.axes], "Momentum"))
        self.s.add(word, {"t": "Time"})
        self.s.percussions.append(Percussion(word, at))

    def common(self, rng: Random, v: Values) -> None:
        """Masses, sizes, coefficients, and a start anywhere above the ground."""
        s = self.s
        v["g"] = float(rng.choice([9.81, 1.62, 0.0], p=[0.8, 0.1, 0.1]))
        for word in self.laws:
            v[f"mu_{word}"] = float(rng.choice([0.0, rng.uniform(0, 1)], p=[0.25, 0.75]))
            v[f"more_{word}"] = float(rng.choice([1.0, rng.uniform(1, 1.5)], p=[0.7, 0.3]))
            v[f"e_{word}"] = float(rng.choice([0.0, 1.0, rng.uniform(0, 1)], p=[0.2, 0.1, 0.7]))
        for b in s.bodies:
            n = b.name
            v[f"m_{n}"] = float(10 ** rng.uniform(-1, 1))
            for key in sizes_of(b.shape, self.plane):
                v[f"{key}_{n}"] = float(rng.uniform(0.2, 1.0)) * (0.5 if key == "r" else 1.0)
            self.put(rng, v, b)
        for j in s.joints:
            if j.dry:
                v[f"mu_{j.name}"] = float(rng.choice([0.0, rng.uniform(0, 0.6)]))
                v[f"r_{j.name}"] = float(rng.uniform(0.01, 0.05))
        for p in s.percussions:
            for k in s.axes:
                v[f"p{k}_{p.name}"] = float(rng.normal()) * 2
            v[f"t_{p.name}"] = float(rng.uniform(0.1, 0.6))
        for w in s.walls:
            if w.moves:
                v[f"h_{w.name}"] = float(rng.uniform(0.01, 0.05))
                v[f"w_{w.name}"] = float(rng.uniform(5, 25))

    def put(self, rng: Random, v: Values, b: Body) -> None:
        """A place, a turn and speeds of a body."""
        n = b.name
        for k in self.s.axes:
            up = k == self.s.axes[-1]
            v[f"{k}0_{n}"] = float(rng.uniform(0.1, 1.6) if up else rng.uniform(-1, 1))
        for k in "uvw"[: len(self.s.axes)]:
            v[f"{k}0_{n}"] = float(rng.choice([0.0, rng.normal()], p=[0.3, 0.7])) * 1.5
        if b.shape == "particle":
            return
        if self.plane:
            v[f"a0_{n}"] = float(rng.choice([0.0, rng.uniform(-3, 3)], p=[0.2, 0.8]))
            v[f"o0_{n}"] = float(rng.choice([0.0, 4 * rng.normal()]))
            return
        q = np.array([1.0, 0, 0, 0]) if rng.random() < 0.15 else rng.normal(size=4)
        q = q / np.linalg.norm(q)
        spin = np.zeros(3) if rng.random() < 0.4 else 4 * rng.normal(size=3)
        if b.shape == "rod":  # a rod does not turn about its own axis
            from judge.space.rows import axes

            along = axes(q)[:, 0]
            spin = spin - along * float(along @ spin)
        v |= {f"q{k + 1}_{n}": float(x) for k, x in enumerate(q)}
        v |= {f"o{k + 1}_{n}": float(x) for k, x in enumerate(spin)}

    def level(self, v: Values, w: Wall, at: tuple[float, ...], a: float, b: float = 0.0) -> None:
        """A wall through a place, its normal at an angle to the vertical."""
        v |= {f"{k}_{w.name}": x for k, x in zip(self.s.axes, at, strict=True)}
        v[f"a_{w.name}"] = a
        if not self.plane:
            v[f"b_{w.name}"] = b

    def structure(self, arrange: Callable[[Random, Values], None], stop: float) -> Structure:
        """The scene, with settings whose bodies start apart."""
        scene = self.s

        def draw(rng: Random) -> Setting:
            for _ in range(TRIES):
                v: Values = {}
                self.common(rng, v)
                arrange(rng, v)
                v = {word: v[word] for word in scene.parameters}
                row = start_row(scene, v) | {f"{j.name}.angle": 0.0 for j in scene.joints}
                row |= {f"{j.name}.displacement": 0.0 for j in scene.joints}
                now = Bodies(scene, v, row, 0.0)
                gaps = [m.gap for m in now.meetings.values() if m.touch.of is None]
                if min(gaps, default=1.0) > 1e-3:
                    break
            else:
                raise RuntimeError("no start is apart")
            tolerance = min(some_tolerance(rng), 1e-5)
            setting = Setting(v, stop * float(rng.uniform(0.5, 1)), tolerance)
            return in_units(scene, setting, *decades(rng, 3.0))  # type: ignore[arg-type]

        return Structure(scene, draw)  # type: ignore[arg-type]


def turned(angle: float, x: float, y: float) -> tuple[float, float]:
    """A vector of the plane, turned."""
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


__all__ = ["Maker", "Values", "polygon", "turned"]
