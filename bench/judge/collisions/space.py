"""Scenes with impacts in space."""

from __future__ import annotations

import math

import numpy as np

from judge.collisions.maker import Maker, Values
from judge.collisions.scene import Body, Place
from judge.family import Random, Structure
from judge.space.rows import axes

SHAPES = ("particle", "rod", "sphere", "sphere", "box")


def pen(m: Maker, rng: Random, bodies: list[Body], walls: int):
    """A floor that may be a ramp, and walls beside it."""
    floor = m.wall("floor", moves=rng.random() < 0.1)
    sides = [m.wall(word) for word in ("left", "right")[:walls]]
    for b in bodies:
        for w in (floor, *sides):
            m.on(b, w)

    def arrange(rng: Random, v: Values) -> None:
        tilt, way = float(rng.choice([0.0, rng.uniform(0, 0.5)])), float(rng.uniform(-3, 3))
        m.level(v, floor, (0.0, 0.0, 0.0), tilt, way)
        for w, sign in zip(sides, (-1, 1), strict=False):
            m.level(v, w, (sign * float(rng.uniform(1, 2)), 0.0, 0.0), -sign * math.pi / 2)

    return arrange


def thrown(rng: Random) -> Structure:
    """A body thrown on a floor or a ramp, beside walls."""
    m = Maker(rng, False)
    b = m.body("b", str(rng.choice(SHAPES)))
    most = 1 if b.shape == "box" else 3
    return m.structure(pen(m, rng, [b], int(rng.integers(0, most))), 1.2)


def several(rng: Random) -> Structure:
    """Spheres that meet each other above a floor."""
    m = Maker(rng, False)
    bodies = [m.body(f"b{k}", "sphere") for k in range(int(rng.integers(2, 4)))]
    for k, b in enumerate(bodies):
        for a in bodies[:k]:
            m.pair(a, b)
    walled = pen(m, rng, bodies, 1)

    def arrange(rng: Random, v: Values) -> None:
        walled(rng, v)
        if rng.random() < 0.5:  # they fly at each other
            for b in bodies:
                for k, u in zip("xyz", "uvw", strict=True):
                    aim = 0.7 if k == "z" else 0.0
                    v[f"{u}0_{b.name}"] = 2 * (aim - v[f"{k}0_{b.name}"])

    return m.structure(arrange, 1.0)


def hinged(rng: Random) -> Structure:
    """Rods on hinges or ball joints, from a bracket or free, that fall on a floor."""
    m = Maker(rng, False)
    m.s.guessed = True
    free = rng.random() < 0.4
    rods = [m.body(f"b{k}", "rod") for k in range(int(rng.integers(1, 3)) + int(free))]
    root = None if free else m.frame("root", None)
    level = not free and rng.random() < 0.5
    for k, b in enumerate(rods):
        a = root if k == 0 else Place(rods[k - 1], (1.0, 0.0, 0.0))
        if a is None:
            continue
        end = Place(b, (-1.0, 0.0, 0.0))
        if level:  # a chain in a vertical plane, about parallel axes
            j = m.joint(f"h{k}", "rotoide", a, end, rng.random() < 0.4)
            if rng.random() < 0.5:
                m.stops(j)
        else:
            m.joint(f"h{k}", "spherique", a, end)
    walled = pen(m, rng, rods, 0)
    if not free:
        m.s.touches = [c for c in m.s.touches if c.a != Place(rods[0], (-1.0, 0.0, 0.0))]

    def arrange(rng: Random, v: Values) -> None:
        walled(rng, v)
        if level:
            before = 0.0
            for k, b in enumerate(rods):
                a = float(rng.uniform(-2, 2))
                if f"lo_h{k}" in m.s.parameters:
                    v[f"lo_h{k}"] = a - before - float(rng.uniform(0.1, 1.5))
                    v[f"hi_h{k}"] = a - before + float(rng.uniform(0.1, 1.5))
                    if not -3 < a - before < 3:
                        a = before + 0.5
                        v[f"lo_h{k}"], v[f"hi_h{k}"] = -0.5, 1.0
                v |= {f"q1_{b.name}": math.cos(a / 2), f"q2_{b.name}": 0.0}
                v |= {f"q3_{b.name}": math.sin(a / 2), f"q4_{b.name}": 0.0}
                v |= {f"o1_{b.name}": 0.0, f"o2_{b.name}": float(rng.normal()) * 3}
                v[f"o3_{b.name}"] = 0.0
                before = a
        _chained(rng, v, rods, free)

    return m.structure(arrange, 1.0)


def _chained(rng: Random, v: Values, rods: list[Body], free: bool) -> None:
    """Places and speeds of a chain."""
    at, speed = np.array([0.0, 0.0, 0.0]), np.zeros(3)
    if not free:
        v |= {"x_root": 0.0, "y_root": 0.0, "z_root": float(rng.uniform(0.4, 1.4))}
        at = np.array([0.0, 0.0, v["z_root"]])
    for k, b in enumerate(rods):
        n = b.name
        along = axes(np.array([v[f"q{i}_{n}"] for i in range(1, 5)]))[:, 0]
        arm = along * v[f"l_{n}"] / 2
        spin = np.array([v[f"o{i}_{n}"] for i in range(1, 4)])
        if k == 0 and free:
            at = np.array([v[f"{x}0_{n}"] for x in "xyz"]) - arm
        for part in (0, 1):
            at, speed = at + arm, speed + np.cross(spin, arm)
            if part == 0:
                v |= {f"{x}0_{n}": float(y) for x, y in zip("xyz", at, strict=True)}
                v |= {f"{x}0_{n}": float(y) for x, y in zip("uvw", speed, strict=True)}


def corded(rng: Random) -> Structure:
    """Bodies on slack cords that come taut."""
    m = Maker(rng, False)
    shapes = ["particle", "rod", "sphere"]
    bodies = [m.body(f"b{k}", str(rng.choice(shapes))) for k in range(int(rng.integers(1, 3)))]
    m.cords(bodies, "sphere")
    walled = pen(m, rng, bodies, 0) if rng.random() < 0.4 else None

    def arrange(rng: Random, v: Values) -> None:
        v |= {"x_hook": 0.0, "y_hook": 0.0, "z_hook": float(rng.uniform(0.5, 2))}
        for k, b in enumerate(bodies):
            if b.shape == "sphere":
                v |= {f"x_eye{k}": v[f"r_{b.name}"], f"y_eye{k}": 0.0, f"z_eye{k}": 0.0}
            v[f"l_cord{k}"] = float(rng.uniform(0.3, 2.5))
        if walled:
            walled(rng, v)

    return m.structure(arrange, 1.0)


def plank(rng: Random) -> Structure:
    """Balls that fall on a plate, which turns on a pivot or is free."""
    m = Maker(rng, False)
    m.s.guessed = True
    bar = m.body("bar", "box")
    balls = [
        m.body(f"b{k}", str(rng.choice(["sphere", "particle"])))
        for k in range(int(rng.integers(1, 3)))
    ]
    kind = str(rng.choice(["rotoide", "spherique", "none"]))
    if kind != "none":
        seat, eye = m.frame("seat", None), m.frame("eye", bar)
        m.joint("pivot", kind, seat, eye, kind == "rotoide" and rng.random() < 0.4)
    top = m.wall("top", bar)
    for b in balls:
        m.on(b, top)

    def arrange(rng: Random, v: Values) -> None:
        a, w = float(rng.uniform(-0.5, 0.5)), float(rng.normal())
        v |= {"q1_bar": math.cos(a / 2), "q2_bar": 0.0, "q3_bar": math.sin(a / 2), "q4_bar": 0.0}
        v |= {"o1_bar": 0.0, "o2_bar": w, "o3_bar": 0.0}
        x = float(rng.choice([0.0, rng.uniform(-0.2, 0.2)]))
        v |= {"x_eye": x, "y_eye": 0.0, "z_eye": 0.0, "x_seat": 0.0, "y_seat": 0.0, "z_seat": 0.0}
        arm = np.array([x * math.cos(a), 0.0, -x * math.sin(a)])
        speed = -np.cross([0.0, w, 0.0], arm)
        v |= {f"{k}0_bar": -float(y) for k, y in zip("xyz", arm, strict=True)}
        v |= {f"{k}0_bar": float(y) for k, y in zip("uvw", speed, strict=True)}

    return m.structure(arrange, 0.8)


def struck(rng: Random) -> Structure:
    """A body that falls on a floor and is struck there or on the way."""
    m = Maker(rng, False)
    b = m.body("b", str(rng.choice(["particle", "rod", "sphere"])))
    m.percussion("blow", m.points(b)[0])
    return m.structure(pen(m, rng, [b], int(rng.integers(0, 2))), 1.0)


MAKES = (thrown, thrown, thrown, several, hinged, hinged, corded, plank, struck)


def impacts(rng: Random) -> Structure:
    """Any of them."""
    return MAKES[int(rng.integers(len(MAKES)))](rng)
