"""Scenes with impacts in the plane."""

from __future__ import annotations

import math

from judge.collisions.maker import Maker, Values, turned
from judge.collisions.scene import Body, Place
from judge.family import Random, Structure

SHAPES = ("particle", "rod", "disc", "ring", "box", "polygon")


def pen(m: Maker, rng: Random, bodies: list[Body], walls: int):
    """A floor that may be a ramp, and walls beside it."""
    floor = m.wall("floor", moves=rng.random() < 0.1)
    sides = [m.wall(word) for word in ("left", "right")[:walls]]
    for b in bodies:
        for w in (floor, *sides):
            m.on(b, w)

    def arrange(rng: Random, v: Values) -> None:
        m.level(v, floor, (0.0, 0.0), float(rng.choice([0.0, rng.uniform(-0.5, 0.5)])))
        for w, sign in zip(sides, (-1, 1), strict=False):
            m.level(v, w, (sign * float(rng.uniform(1, 2)), 0.0), sign * math.pi / 2)

    return arrange


def thrown(rng: Random) -> Structure:
    """A body thrown on a floor or a ramp, beside walls."""
    m = Maker(rng, True)
    b = m.body("b", str(rng.choice(SHAPES)))
    arrange = pen(m, rng, [b], int(rng.integers(0, 3)))
    return m.structure(arrange, 1.5)


def several(rng: Random) -> Structure:
    """Round bodies that meet each other, in a pen or on a table without gravity."""
    m = Maker(rng, True)
    shapes = [str(rng.choice(["disc", "disc", "ring"])) for _ in range(int(rng.integers(2, 4)))]
    bodies = [m.body(f"b{k}", shape) for k, shape in enumerate(shapes)]
    for k, b in enumerate(bodies):
        for a in bodies[:k]:
            m.pair(a, b)
    return m.structure(pen(m, rng, bodies, 2), 1.2)


def hinged(rng: Random) -> Structure:
    """Rods on hinges, dry or smooth, from a bracket or free, that fall on a floor."""
    m = Maker(rng, True)
    m.s.guessed = True
    free, dry = rng.random() < 0.4, rng.random() < 0.4
    rods = [m.body(f"b{k}", "rod") for k in range(int(rng.integers(1, 3)) + int(free))]
    root = None if free else m.frame("root", None)
    for k, b in enumerate(rods):
        a = root if k == 0 else Place(rods[k - 1], (1.0, 0.0, 0.0))
        if a is not None:
            j = m.joint(f"h{k}", "rotoide", a, Place(b, (-1.0, 0.0, 0.0)), dry)
            if rng.random() < 0.4:
                m.stops(j)
    walled = pen(m, rng, rods, int(rng.integers(0, 2)))
    if not free:  # the start of the first rod does not move
        m.s.touches = [c for c in m.s.touches if c.a != Place(rods[0], (-1.0, 0.0, 0.0))]

    def arrange(rng: Random, v: Values) -> None:
        walled(rng, v)
        _chained(m, rng, v, rods, free)

    return m.structure(arrange, 1.2)


def _chained(m: Maker, rng: Random, v: Values, rods: list[Body], free: bool) -> None:
    """Places and speeds of a chain, and bounds that hold at the start."""
    if not free:
        v["x_root"], v["y_root"] = float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.4, 1.4))
    before = 0.0
    for k, b in enumerate(rods):
        n = b.name
        half = v[f"l_{n}"] / 2
        if k == 0 and free:
            tx, ty = turned(v[f"a0_{n}"], half, 0)
            at, speed = [v[f"x0_{n}"] - tx, v[f"y0_{n}"] - ty], [0.0, 0.0]
        elif k == 0:
            at, speed = [v["x_root"], v["y_root"]], [0.0, 0.0]
        for where in (half, half):
            x, y = turned(v[f"a0_{n}"], where, 0)
            at = [at[0] + x, at[1] + y]
            speed = [speed[0] - v[f"o0_{n}"] * y, speed[1] + v[f"o0_{n}"] * x]
            if f"done_{n}" not in v:
                v |= {f"x0_{n}": at[0], f"y0_{n}": at[1], f"u0_{n}": speed[0], f"v0_{n}": speed[1]}
                v[f"done_{n}"] = 1.0
        del v[f"done_{n}"]
        if f"lo_h{k}" in m.s.parameters:
            turn = math.remainder(v[f"a0_{n}"] - before, 2 * math.pi)
            v[f"a0_{n}"] = before + turn
            v[f"lo_h{k}"] = turn - float(rng.uniform(0.1, 1.5))
            v[f"hi_h{k}"] = turn + float(rng.uniform(0.1, 1.5))
        before = v[f"a0_{n}"]


def corded(rng: Random) -> Structure:
    """Bodies on slack cords that come taut."""
    m = Maker(rng, True)
    bodies = [
        m.body(f"b{k}", str(rng.choice(["particle", "rod", "disc"])))
        for k in range(int(rng.integers(1, 3)))
    ]
    m.cords(bodies, "disc")
    walled = pen(m, rng, bodies, 0) if rng.random() < 0.5 else None

    def arrange(rng: Random, v: Values) -> None:
        v["x_hook"], v["y_hook"] = float(rng.uniform(-0.5, 0.5)), float(rng.uniform(0.5, 2))
        for k, b in enumerate(bodies):
            if b.shape == "disc":
                v[f"x_eye{k}"] = v[f"r_{b.name}"] * float(rng.uniform(0, 1))
                v[f"y_eye{k}"] = 0.0
            v[f"l_cord{k}"] = float(rng.uniform(0.3, 2.5))
        if walled:
            walled(rng, v)

    return m.structure(arrange, 1.2)


def plank(rng: Random) -> Structure:
    """Balls that fall on a plank, which turns on a pivot or is free."""
    m = Maker(rng, True)
    m.s.guessed = True
    bar = m.body("bar", str(rng.choice(["rod", "box"])))
    balls = [
        m.body(f"b{k}", str(rng.choice(["disc", "particle"])))
        for k in range(int(rng.integers(1, 3)))
    ]
    if rng.random() < 0.7:
        m.joint("pivot", "rotoide", m.frame("seat", None), m.frame("eye", bar), rng.random() < 0.3)
    top = m.wall("top", bar)
    for b in balls:
        m.on(b, top)

    def arrange(rng: Random, v: Values) -> None:
        a = v["a0_bar"] = float(rng.uniform(-0.5, 0.5))
        v["x_eye"] = float(rng.choice([0.0, rng.uniform(-0.2, 0.2)]))
        v["y_eye"] = 0.0
        dx, dy = turned(a, v["x_eye"], 0)
        v["x_seat"], v["y_seat"] = 0.0, 0.0
        v |= {"x0_bar": -dx, "y0_bar": -dy}
        v |= {"u0_bar": v["o0_bar"] * dy, "v0_bar": -v["o0_bar"] * dx}

    return m.structure(arrange, 0.8)


def sliding(rng: Random) -> Structure:
    """A carriage on a slide with stops, with a pendulum that has stops too."""
    m = Maker(rng, True)
    m.s.guessed = True
    car = m.body("car", str(rng.choice(["box", "disc"])))
    rail = m.frame("rail", None)
    m.stops(m.joint("way", "prismatique", rail, Place(car)))
    rods = [m.body("b", "rod")] if rng.random() < 0.7 else []
    for b in rods:
        j = m.joint("h", "rotoide", Place(car), Place(b, (-1.0, 0.0, 0.0)), rng.random() < 0.4)
        if rng.random() < 0.6:
            m.stops(j)

    def arrange(rng: Random, v: Values) -> None:
        v |= {"x_rail": 0.0, "y_rail": 0.0, "x0_car": 0.0, "y0_car": 0.0, "v0_car": 0.0}
        v |= {"a0_car": 0.0, "o0_car": 0.0}
        v["lo_way"], v["hi_way"] = -float(rng.uniform(0.1, 0.6)), float(rng.uniform(0.1, 0.6))
        for b in rods:
            x, y = turned(v[f"a0_{b.name}"], v[f"l_{b.name}"] / 2, 0)
            w = v[f"o0_{b.name}"]
            v |= {"x0_b": x, "y0_b": y, "u0_b": v["u0_car"] - w * y, "v0_b": w * x}
            v["lo_h"] = v["a0_b"] - float(rng.uniform(0.1, 1.5))
            v["hi_h"] = v["a0_b"] + float(rng.uniform(0.1, 1.5))

    return m.structure(arrange, 1.2)


def struck(rng: Random) -> Structure:
    """A body that falls on a floor and is struck there or on the way."""
    m = Maker(rng, True)
    b = m.body("b", str(rng.choice(SHAPES)))
    m.percussion("blow", m.points(b)[0] if b.shape not in ("disc", "ring") else Place(b))
    return m.structure(pen(m, rng, [b], int(rng.integers(0, 2))), 1.0)


MAKES = (thrown, thrown, several, hinged, hinged, corded, plank, sliding, struck)


def impacts(rng: Random) -> Structure:
    """Any of them."""
    return MAKES[int(rng.integers(len(MAKES)))](rng)
