"""Families of scenes that move as others: groups beside each other, a scene written otherwise."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from judge.anything import anything
from judge.changed import Moved, direction, renamed, reordered, together, weighed
from judge.family import Family, Random, Setting, Structure, decades, in_units, some_tolerance
from judge.feet import legs
from judge.guesses import loose
from judge.machines import chain, crank, trammel
from judge.mechanics import Floats
from judge.others import Other
from judge.tables import corner, hoop, rest, stack

Make = Callable[[Random], Structure]
GROUPS: tuple[Make, ...] = (loose, loose, loose, anything, rest, hoop, chain, corner)
SCENES: tuple[Make, ...] = (anything, anything, legs, hoop, stack, corner, crank, trammel, chain)


def _small(make: Make, rng: Random, most: int = 3) -> Structure:
    """A scene of few bodies."""
    while True:
        made = make(rng)
        if len(made.scene.bodies) <= most:
            return made


def _in_si(made: Structure, rng: Random) -> Setting:
    """A setting of a structure, in SI whatever units it was drawn in."""
    drawn = made.draw(rng)
    m, x, t = drawn.units
    return in_units(made.scene, drawn, 1 / m, 1 / x, 1 / t)


def groups(rng: Random) -> Structure:
    """Two or three scenes beside each other; each starts and moves as it does alone."""
    made = [
        _small(GROUPS[int(rng.integers(len(GROUPS)))], rng) for _ in range(int(rng.integers(2, 4)))
    ]
    scenes = []
    for k, one in enumerate(made):
        scenes.append(
            renamed(one.scene, lambda word, k=k: word if word == "g" else f"{'pqr'[k]}_{word}")
        )
    whole = together(scenes)
    others = [Other(f"alone {k}", s, part=True, bodies=s.bodies) for k, s in enumerate(scenes)]

    def draw(rng: Random) -> Setting:
        values = {"g": float(rng.choice([9.81, 0.0], p=[0.8, 0.2]))}
        stops = []
        for k, one in enumerate(made):
            drawn = _in_si(one, rng)
            stops.append(drawn.stop)
            values |= {f"{'pqr'[k]}_{w}": x for w, x in drawn.values.items() if w != "g"}
        setting = Setting(values, min(stops), some_tolerance(rng), start_known=False)
        return in_units(whole, setting, *decades(rng))

    return Structure(whole, draw, others)


def written_otherwise(rng: Random) -> Structure:
    """The same in mm, g, ms; turned; mirrored; declared in another order, under other names."""
    base = _small(SCENES[int(rng.integers(len(SCENES)))], rng, 4)
    scene, way = (
        base.scene,
        str(rng.choice(["units", "turned", "quarters", "mirrored", "reordered"])),
    )
    draw: Callable[[Random], Setting] = base.draw
    if way == "units":
        other = Other(way, scene, exact=True, literal=True)

        def draw(rng: Random) -> Setting:
            return _in_si(base, rng)

    elif way == "reordered":
        again = reordered(scene, rng)
        names = {b.name.split("_", 1)[1]: b.name for b in again.bodies}

        def read(now: Mapping[str, Floats], name: str) -> Floats:
            body, dot, rest = name.partition(".")
            return now[names[body] + dot + rest]

        other = Other(way, again, read)
    else:
        turn = 0.0
        if way == "turned":
            scene, turn = weighed(scene), float(rng.uniform(-math.pi, math.pi))
        elif way == "quarters":
            turn = math.pi / 2 * int(rng.integers(1, 4))
        flip = -1.0 if way == "mirrored" else 1.0
        other = Other(way, Moved(scene, turn, flip).scene, back(turn, flip), exact=flip < 0)
    return Structure(scene, lambda rng: replace(draw(rng), compare=False), [other])


def back(turn: float, flip: float) -> Callable[[Mapping[str, Floats], str], Floats]:
    """Values of a moved scene as those of the first one."""
    c, s = direction(turn)

    def read(now: Mapping[str, Floats], name: str) -> Floats:
        if name.endswith((".x", ".y")):
            x, y = now[name[:-1] + "x"], now[name[:-1] + "y"]
            return c * x + s * y if name.endswith(".x") else flip * (c * y - s * x)
        if name.endswith(".angle"):
            return np.asarray(flip * (now[name] - turn))
        return np.asarray(flip * now[name])

    return read


FAMILIES = (
    Family("groups", groups, 2, 8, "groups that nothing binds together, each as alone"),
    Family(
        "otherwise", written_otherwise, 2, 8, "the same turned, mirrored, reordered, in mm, g, ms"
    ),
)
