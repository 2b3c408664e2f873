"""The family `held`: a body on several contacts, under a forced load off its centre of mass."""

from __future__ import annotations

import math

import numpy as np

from judge.family import Family, Random, Setting, Structure, decades, in_units, some_tolerance
from judge.feet import TIME, kept, put, stated
from judge.scene import Contact, Force, Scene
from judge.values import Value, bell, cos, sin, switch


def _load(rng: Random, s: Scene) -> Value:
    """A force that grows, waves, passes, or changes its sign at once."""
    f, t0 = s.parameter("F", "Force"), s.parameter("T0", "Time")
    w = s.parameter("w", "AngularVelocity")
    made = (
        f,
        f * sin(w * TIME),
        f * (TIME / t0),
        f * bell((TIME - t0) / s.parameter("T1", "Time")),
        switch(TIME, t0, f, f * -0.5),
    )
    return made[int(rng.integers(len(made)))]


def held(rng: Random) -> Structure:
    """Points of a body, each on a line of its own, with friction or without, drawn at a hand."""
    n, parallel = int(rng.integers(2, 5)), bool(rng.random() < 0.6)
    s = Scene("Held")
    s.gravity = s.parameter("g", "Acceleration")
    bar = s.body("bar", str(rng.choice(["rod", "disc", "ring"])))
    parting = bool(rng.random() < 0.4)
    smooth = bool(rng.random() < 0.3)
    for i in range(n):
        mu = None if smooth or rng.random() < 0.3 else s.parameter(f"mu{i}", "Real")
        more = None if mu is None or rng.random() < 0.5 else mu * s.parameter("more", "Real")
        kind = "point_courbe" if rng.random() < 0.4 else "contact_ponctuel"
        s.contacts.append(
            Contact(
                f"c{i}",
                s.line(f"l{i}", None),
                s.frame(f"f{i}", bar),
                bilateral=not (parting and parallel),
                kind=kind,
                swapped=kind == "contact_ponctuel" and bool(rng.integers(2)),
                mu=mu,
                mu_s=more,
            )
        )
        if mu is None:
            s.told.append(f"c{i}")
    push, way = _load(rng, s), s.parameter("way", "Angle")
    hand = s.frame("hand", bar)
    s.forces.append(Force("pull", "on", (hand,), (push * cos(way), push * sin(way))))
    stated(s, "bar", True)

    def draw(rng: Random) -> Setting:
        tilt, wide = float(rng.uniform(-0.4, 0.4)), float(rng.uniform(0.3, 1.5))
        turned = float(rng.uniform(-3, 3))
        m, stop = float(rng.uniform(0.5, 3)), float(rng.uniform(0.3, 3))
        place = rng.uniform(-1, 1, 2)
        ahead = np.array([math.cos(tilt), math.sin(tilt)])
        values = {"g": float(rng.choice([9.81, 0.0], p=[0.8, 0.2])), "m_bar": m, "l_bar": wide}
        values |= {"more": float(rng.choice([1.0, 1.3])), "T0": stop * float(rng.uniform(0.2, 0.8))}
        values |= {"T1": 0.1 * stop, "w": float(rng.uniform(1, 10)) / stop}
        values |= {"F": m * float(rng.uniform(-15, 15)), "way": float(rng.uniform(-3, 3))}
        x, y = rng.uniform(-0.7, 0.7, 2) * wide
        values |= {"x_hand": float(x), "y_hand": float(y)}
        c, d = math.cos(turned), math.sin(turned)
        level = bool(rng.integers(2))
        for i in range(n):
            # the feet of a body that can part are below it, on one line or on steps
            offset = rng.uniform(-1, 1, 2) * wide
            if parting:
                up = np.array([-ahead[1], ahead[0]])
                height = 0.4 if level else 0.4 + 0.1 * i
                offset = (2 * i / (n - 1) - 1) * wide * ahead - height * wide * up
            angle = tilt if parallel else float(rng.uniform(-3, 3))
            at = (
                place
                + offset
                + float(rng.uniform(-0.3, 0.3)) * np.array([math.cos(angle), math.sin(angle)])
            )
            values |= {f"x_f{i}": float(c * offset[0] + d * offset[1])}
            values |= {f"y_f{i}": float(c * offset[1] - d * offset[0])}
            values |= {f"x_l{i}": float(at[0]), f"y_l{i}": float(at[1]), f"a_l{i}": angle}
            values |= {f"mu{i}": float(rng.uniform(0, 0.6))}
        v = ahead * (float(rng.choice([0.0, rng.uniform(-2, 2)])) if parallel else 0.0)
        put(values, "bar", (place[0], place[1], turned, v[0], v[1], 0.0), True)
        setting = Setting(kept(s, values), stop, some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


FAMILIES = (Family("held", held, 2, 12, "a body on several contacts, loaded off its centre"),)
