"""Families of one mechanism: cranks, trammels, chains of dry pins."""

from __future__ import annotations

import math

import numpy as np

from judge.family import Family, Random, Setting, Structure, decades, in_units, some_tolerance
from judge.scene import Contact, Force, Pin, Point, Scene
from judge.values import as_value, name, sin

ZERO = (as_value(0.0), as_value(0.0))


def crank(rng: Random) -> Structure:
    """A slider crank in any direction, dry in every liaison, driven evenly or by a wave."""
    s = Scene("Crank")
    s.gravity = s.parameter("g", "Acceleration")
    arm, rod = s.body("arm", "rod"), s.body("rod", "rod")
    piston = s.body("piston", "particle")
    eye = s.frame("eye", None)
    bore = s.line("bore", None)
    radius = s.parameter("pin", "Length")
    mu, mu_b = s.parameter("mu", "Real"), s.parameter("mu_b", "Real")
    factor = s.parameter("more", "Real")
    pins = [
        Pin("O", eye, s.end(arm, "start"), mu, mu * factor, radius),
        Pin("A", s.end(arm, "tip"), s.end(rod, "start"), mu, None, radius),
        Pin("B", s.end(rod, "tip"), s.middle(piston), mu, None, radius),
    ]
    s.pins += pins
    s.contacts.append(
        Contact(
            "C",
            bore,
            point=s.middle(piston),
            rim=None,
            bilateral=True,
            kind="point_courbe",
            swapped=False,
            mu=mu_b,
            mu_s=mu_b * factor,
        )
    )
    even, wave, w = (
        s.parameter("even", "Torque"),
        s.parameter("wave", "Torque"),
        s.parameter("w", "AngularVelocity"),
    )
    s.forces.append(Force("motor", "couple", (), (even + wave * sin(w * name("time")),), pins[0]))
    a0 = s.parameter("A0", "Angle")
    w0 = s.parameter("W0", "AngularVelocity")
    guess = s.parameter("guess", "Angle")
    s.statements += [f"arm.angle = {a0.text}", f"arm.angular_velocity = {w0.text}"]
    s.statements += [f"guess(rod.angle = {guess.text})"]

    def draw(rng: Random) -> Setting:
        turn = float(rng.choice([0.0, rng.uniform(-math.pi, math.pi)]))
        mirror = float(rng.choice([1.0, -1.0]))
        r, long = float(rng.uniform(0.04, 0.12)), float(rng.uniform(0.17, 0.4))
        off = float(rng.choice([0.0, rng.uniform(-0.3, 0.3) * (long - r)]))
        mu = float(rng.choice([0.0, 0.05, 0.1, 0.2, 0.3, rng.uniform(0, 0.3)]))
        n = np.array([-math.sin(turn), math.cos(turn)])
        th = float(rng.uniform(-math.pi, math.pi))
        reach = (off - r * math.sin(th)) / long
        values = {
            "m_arm": float(rng.uniform(0.2, 2)),
            "l_arm": r,
            "m_rod": float(rng.uniform(0.2, 2)),
            "l_rod": long,
            "m_piston": float(rng.uniform(0.2, 2)),
            "x_eye": 0.0,
            "y_eye": 0.0,
            "x_bore": float(off * n[0]),
            "y_bore": float(off * n[1]),
            "a_bore": turn if mirror > 0 else turn + math.pi,
            "pin": float(rng.uniform(0.004, 0.015)),
            "mu": mu,
            "mu_b": mu * float(rng.uniform(0.3, 1)),
            "more": float(rng.choice([1.0, 1.3])),
            "A0": th + turn,
            "guess": math.asin(reach) + turn,
            "W0": float(rng.choice([0.0, rng.uniform(-10, 10)])),
            "g": float(rng.choice([9.81, 0.0], p=[0.8, 0.2])),
            "even": mirror * float(rng.uniform(1, 12)),
            "wave": 0.0,
            "w": 5.0,
        }
        if rng.random() < 0.4:
            values |= {"even": 4.0 * mirror, "wave": 3.0}
        tolerance = float(10.0 ** rng.integers(-10, -3))
        setting = Setting(values, 1.0, tolerance, compare=True)
        return in_units(s, setting, *(decades(rng) if rng.random() < 0.3 else (1.0, 1.0, 1.0)))

    return Structure(s, draw)


def trammel(rng: Random) -> Structure:
    """A rod on two lines, friction at one or both ends; sticking is singular where it stands."""
    s = Scene("Trammel")
    s.gravity = s.parameter("g", "Acceleration")
    both, ends = bool(rng.integers(2)), bool(rng.integers(2))
    bar = s.body("bar", "rod")
    one, two = s.line("one", None), s.line("two", None)
    mu, nu = s.parameter("mu", "Real"), s.parameter("nu", "Real")
    first = s.end(bar, "start") if ends else s.middle(bar)
    s.contacts += [
        Contact("A", one, first, None, True, "point_courbe", False, mu),
        Contact(
            "B", two, s.end(bar, "tip"), None, True, "point_courbe", False, nu if both else None
        ),
    ]
    if not both:
        s.told.append("B")
    s.statements += [f"bar.angle = {s.parameter('A0', 'Angle').text}"]
    s.statements += [f"bar.angular_velocity = {s.parameter('W0', 'AngularVelocity').text}"]

    def draw(rng: Random) -> Setting:
        turn, length = float(rng.choice([0.0, rng.uniform(-3, 3)])), float(rng.uniform(0.5, 3))
        tilt = float(rng.uniform(-1.2, 1.2)) + turn
        values = {
            "g": 9.81,
            "m_bar": float(rng.uniform(0.5, 2)),
            "l_bar": length,
            "x_one": 0.0,
            "y_one": 0.0,
            "a_one": tilt,
            "x_two": 0.0,
            "y_two": 0.0,
            "a_two": math.pi / 2 + turn,
            "mu": float(rng.uniform(0, 0.4)),
            "nu": float(rng.choice([0.0, rng.uniform(0, 0.3)])),
            "A0": float(rng.uniform(-3, 3)),
            "W0": float(rng.uniform(-4, 4)),
        }
        setting = Setting(values, float(rng.uniform(1, 6)), some_tolerance(rng), compare=True)
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def chain(rng: Random) -> Structure:
    """Rods on dry pins, hung from the ground, at rest or thrown."""
    n = int(rng.integers(1, 7))
    s = Scene("Chain")
    s.gravity = s.parameter("g", "Acceleration")
    mu, radius = s.parameter("mu", "Real"), s.parameter("pin", "Length")
    more = s.parameter("more", "Real")
    rods = [s.body(f"b{i}", "rod") for i in range(n)]
    at: Point = s.frame("eye", None)
    dry = rng.random(n) < 0.8
    for i, rod in enumerate(rods):
        law = (mu, mu * more, radius) if dry[i] else (None, None, None)
        first = s.end(rod, "start")
        a, b = (at, first) if rng.random() < 0.7 else (first, at)
        s.pins.append(Pin(f"j{i}", a, b, *law))
        at = s.end(rod, "tip")
    if rng.random() < 0.5:
        push, w = s.parameter("push", "Force"), s.parameter("w", "AngularVelocity")
        s.forces.append(Force("f", "on", (at,), (push * sin(w * name("time")), push * 0.0)))
    for i in range(n):
        s.statements += [f"b{i}.angle = {s.parameter(f'A{i}', 'Angle').text}"]
        s.statements += [f"b{i}.angular_velocity = {s.parameter(f'W{i}', 'AngularVelocity').text}"]

    def draw(rng: Random) -> Setting:
        rest = rng.random() < 0.3
        values = {"g": float(rng.choice([9.81, 0.0], p=[0.85, 0.15])), "x_eye": 0.3, "y_eye": -0.2}
        values |= {"mu": float(rng.uniform(0, 0.5)), "pin": float(rng.uniform(0.005, 0.05))}
        values |= {
            "more": float(rng.choice([1.0, 1.5])),
            "push": float(rng.uniform(0, 20)),
            "w": 3.0,
        }
        for i in range(n):
            spread = 6.0 if rng.random() < 0.15 else 0.5
            values |= {
                f"m_b{i}": float(10 ** rng.uniform(-spread, spread)),
                f"l_b{i}": float(rng.uniform(0.2, 1)),
            }
            values |= {
                f"A{i}": float(rng.uniform(-3, 3)),
                f"W{i}": 0.0 if rest else float(rng.uniform(-4, 4)),
            }
        values = {k: x for k, x in values.items() if k in s.parameters}
        setting = Setting(values, float(rng.uniform(0.3, 1.5)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


FAMILIES = (
    Family("crank", crank, 3, 400, "slider cranks, dry in every liaison, in any direction"),
    Family("trammel", trammel, 2, 100, "a rod on two lines"),
    Family("chain", chain, 1, 25, "rods on dry pins"),
)
