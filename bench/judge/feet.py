"""Families of feet: a bar on many of them, blocks each on its own line, pinned rods on a floor."""

from __future__ import annotations

import math

import numpy as np

from judge.family import Random, Setting, Structure, decades, in_units, some_tolerance
from judge.scene import Contact, Force, Pin, Scene
from judge.values import cos, name, sin

TIME = name("time")


def stated(s: Scene, word: str, turns: bool) -> None:
    """All of a body's start as parameters."""
    x, y = (s.parameter(f"{k}0_{word}", "Length").text for k in "xy")
    u, v = (s.parameter(f"{k}0_{word}", "Velocity").text for k in "uv")
    s.statements += [f"{word}.position = ({x}, {y})", f"{word}.velocity = ({u}, {v})"]
    if turns:
        a, w = s.parameter(f"a0_{word}", "Angle"), s.parameter(f"w0_{word}", "AngularVelocity")
        s.statements += [f"{word}.angle = {a.text}", f"{word}.angular_velocity = {w.text}"]


def put(values: dict[str, float], word: str, state: tuple[float, ...], turns: bool) -> None:
    for key, x in zip(("x0", "y0", "a0", "u0", "v0", "w0"), state, strict=True):
        if turns or key not in ("a0", "w0"):
            values[f"{key}_{word}"] = float(x)


def kept(s: Scene, values: dict[str, float]) -> dict[str, float]:
    return {k: float(x) for k, x in values.items() if k in s.parameters}


def legs(rng: Random) -> Structure:
    """A bar on several rough feet, on a tilted line, drawn along harder and harder."""
    n = int(rng.integers(2, 10))
    s = Scene("Legs")
    s.gravity = s.parameter("g", "Acceleration")
    bar = s.body("bar", "rod")
    floor = s.line("floor", None)
    mu, more = s.parameter("mu", "Real"), s.parameter("more", "Real")
    same = bool(rng.integers(2))
    bilateral = n <= 4 and rng.random() < 0.25
    for i in range(n):
        foot = s.frame(f"f{i}", bar)
        own = mu if same else s.parameter(f"mu{i}", "Real")
        kind = "point_courbe" if bilateral and rng.random() < 0.5 else "contact_ponctuel"
        s.contacts.append(
            Contact(
                f"c{i}",
                floor,
                point=foot,
                rim=None,
                bilateral=bilateral,
                kind=kind,
                swapped=kind != "point_courbe" and bool(rng.integers(2)),
                mu=own,
                mu_s=own * more,
            )
        )
    rate, way, t0 = (
        s.parameter("rate", "Force"),
        s.parameter("way", "Angle"),
        s.parameter("T0", "Time"),
    )

    hand = s.frame("hand", bar)
    pull = rate * (TIME / t0)
    s.forces.append(Force("pull", "on", (hand,), (pull * cos(way), pull * sin(way))))
    stated(s, "bar", True)

    def draw(rng: Random) -> Setting:
        tilt = float(rng.choice([0.0, rng.uniform(-0.2, 0.2)]))
        length, base = float(rng.uniform(0.5, 2)), float(rng.choice([0.0, rng.uniform(0, 0.3)]))
        values = {"g": 9.81, "m_bar": float(rng.uniform(0.5, 3)), "l_bar": length}
        values |= {
            "x_floor": 0.0,
            "y_floor": 0.0,
            "a_floor": tilt,
            "mu": float(rng.uniform(0.25, 0.6)),
        }
        values |= {f"mu{i}": float(rng.uniform(0.25, 0.6)) for i in range(n)}
        values |= {
            "more": float(rng.choice([1.0, 1.2])),
            "rate": float(rng.uniform(1, 5)),
            "T0": 1.0,
        }
        at = np.sort(rng.uniform(-0.5, 0.5, n))
        at[0], at[-1] = -0.5, 0.5
        for i in range(n):
            values |= {f"x_f{i}": float(at[i] * length), f"y_f{i}": -base}
        ahead = 0.0 if rng.random() < 0.7 else math.pi
        values |= {
            "way": tilt + ahead,
            "x_hand": float(rng.uniform(-0.5, 0.5) * length),
            "y_hand": -base * float(rng.uniform(0, 1)),
        }
        d, up = (
            np.array([math.cos(tilt), math.sin(tilt)]),
            np.array([-math.sin(tilt), math.cos(tilt)]),
        )
        p = 0.3 * d + base * up
        v = d * float(rng.choice([0.0, 0.0, rng.uniform(-2, 2)]))
        put(values, "bar", (p[0], p[1], tilt, v[0], v[1], 0.0), True)
        setting = Setting(kept(s, values), float(rng.uniform(1, 5)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def blocks(rng: Random) -> Structure:
    """Blocks that never meet, each on its own line, of masses up to 1e14 apart."""
    n = int(rng.integers(2, 7))
    s = Scene("Blocks")
    s.gravity = s.parameter("g", "Acceleration")
    for i in range(n):
        b = s.body(f"b{i}", "particle")
        line = s.line(f"l{i}", None)
        bilateral = bool(rng.integers(2))
        kind = "point_courbe" if bilateral and rng.integers(2) else "contact_ponctuel"
        s.contacts.append(
            Contact(
                f"c{i}",
                line,
                s.middle(b),
                None,
                bilateral,
                kind,
                False,
                s.parameter(f"mu{i}", "Real"),
            )
        )
        if rng.random() < 0.5:
            s.forces.append(
                Force(
                    f"s{i}",
                    "attraction",
                    (s.middle(b), s.frame(f"e{i}", None)),
                    (s.parameter(f"k{i}", "Stiffness"),),
                )
            )
        stated(s, f"b{i}", False)

    def draw(rng: Random) -> Setting:
        values: dict[str, float] = {"g": 9.81}
        for i in range(n):
            mass, a = float(10 ** rng.uniform(-9, 5)), float(rng.uniform(-0.6, 0.6))
            d = np.array([math.cos(a), math.sin(a)])
            x, v = rng.uniform(-2, 2), float(rng.choice([0.0, rng.uniform(-3, 3)]))
            values |= {f"m_b{i}": mass, f"a_l{i}": a, f"x_l{i}": 0.0, f"y_l{i}": float(i)}
            values |= {
                f"mu{i}": float(rng.uniform(0, 0.6)),
                f"k{i}": mass * float(rng.uniform(1, 30)),
            }
            values |= {
                f"x_e{i}": float(rng.uniform(-1, 1)),
                f"y_e{i}": float(i - rng.uniform(0, 1)),
            }
            p = np.array([0.0, i]) + x * d
            put(values, f"b{i}", (p[0], p[1], 0.0, v * d[0], v * d[1], 0.0), False)
        setting = Setting(kept(s, values), float(rng.uniform(0.5, 3)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def floor(rng: Random) -> Structure:
    """Rods in a row, pinned to each other, on a rough floor, drawn at the end."""
    n = int(rng.integers(2, 7))
    s = Scene("Floor")
    s.gravity = s.parameter("g", "Acceleration")
    mu = s.parameter("mu", "Real")
    ground = s.line("floor", None)
    rods = [s.body(f"b{i}", "rod") for i in range(n)]
    for i in range(1, n):
        s.pins.append(Pin(f"p{i}", s.end(rods[i - 1], "tip"), s.end(rods[i], "start")))
    s.contacts.append(
        Contact("foot", ground, s.end(rods[0], "start"), None, False, "contact_ponctuel", False, mu)
    )
    for i, rod in enumerate(rods):
        s.contacts.append(
            Contact(f"c{i}", ground, s.end(rod, "tip"), None, False, "contact_ponctuel", False, mu)
        )
    pull, t0 = s.parameter("F", "Force"), s.parameter("T0", "Time")

    force, a = pull * (TIME / t0), name("a_floor")
    s.forces.append(Force("f", "on", (s.end(rods[-1], "tip"),), (force * cos(a), force * sin(a))))
    for rod in rods:
        stated(s, rod.name, True)

    def draw(rng: Random) -> Setting:
        tilt = float(rng.choice([0.0, rng.uniform(-0.1, 0.1)]))
        d = np.array([math.cos(tilt), math.sin(tilt)])
        values = {
            "g": 9.81,
            "mu": float(rng.uniform(0.15, 0.6)),
            "x_floor": 0.0,
            "y_floor": 0.0,
            "a_floor": tilt,
            "T0": 1.0,
        }
        x, total = 0.0, 0.0
        for i in range(n):
            length, m = float(rng.uniform(0.2, 0.6)), float(rng.uniform(0.5, 2))
            p = (x + length / 2) * d
            x, total = x + length, total + m
            values |= {f"m_b{i}": m, f"l_b{i}": length}
            put(values, f"b{i}", (p[0], p[1], tilt, 0.0, 0.0, 0.0), True)
        values["F"] = total * 9.81 * float(rng.uniform(0.2, 1)) * float(rng.choice([1.0, -1.0]))
        setting = Setting(kept(s, values), float(rng.uniform(0.5, 2)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)
