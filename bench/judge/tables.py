"""Families of bodies on lines: rests, hoops, stacks, corners, starts at zero."""

from __future__ import annotations

import math

import numpy as np

from judge.family import Family, Random, Setting, Structure, decades, in_units, some_tolerance
from judge.feet import TIME, blocks, floor, kept, legs, put, stated
from judge.scene import Contact, Force, Scene
from judge.values import Value, as_value, bell, clamp, name, sin, switch


def _pushes(rng: Random, s: Scene) -> Value:
    """A force that grows from nothing, waves, comes as a bell or is switched."""
    f, t0, w = (
        s.parameter("F", "Force"),
        s.parameter("T0", "Time"),
        s.parameter("w", "AngularVelocity"),
    )
    made = (
        f * sin(w * TIME),
        f * (TIME / t0),
        f * bell((TIME - t0) / s.parameter("T1", "Time")),
        switch(TIME, t0, f, f * -0.5),
        f * clamp(TIME / t0) * sin(w * TIME),
    )
    return made[int(rng.integers(len(made)))]


def rest(rng: Random) -> Structure:
    """A block or disc at rest, pushed by a load that changes over any time."""
    s = Scene("Rest")
    s.gravity = s.parameter("g", "Acceleration")
    disc = bool(rng.integers(2))
    b = s.body("b", "disc" if disc else "particle")
    line = s.line("floor", None)
    mu = s.parameter("mu", "Real")
    delta = s.parameter("delta", "Length") if disc and rng.random() < 0.7 else None
    s.contacts.append(
        Contact(
            "c",
            line,
            point=None if disc else s.middle(b),
            rim=b if disc else None,
            bilateral=False,
            kind="contact_ponctuel",
            swapped=bool(rng.integers(2)),
            mu=mu,
            mu_s=mu * s.parameter("more", "Real"),
            delta=delta,
        )
    )
    push, a = _pushes(rng, s), name("a_floor")
    from judge.values import cos

    s.forces.append(Force("f", "on", (s.middle(b),), (push * cos(a), push * sin(a))))
    stated(s, "b", disc)

    def draw(rng: Random) -> Setting:
        tilt, r, m = (
            float(rng.choice([0.0, rng.uniform(-0.15, 0.15)])),
            float(rng.uniform(0.1, 1)),
            float(rng.uniform(0.3, 3)),
        )
        mu, stop = float(rng.uniform(0.2, 0.6)), float(10 ** rng.uniform(-1, 2))
        values = {"g": 9.81, "m_b": m, "l_b": r, "x_floor": 0.0, "y_floor": 0.0, "a_floor": tilt}
        values |= {
            "mu": mu,
            "more": float(rng.choice([1.0, 1.3])),
            "delta": float(rng.uniform(0.16, 0.4)) * r,
        }
        values |= {
            "F": m * 9.81 * mu * float(rng.uniform(0.5, 2)),
            "T0": stop * float(rng.uniform(0.2, 0.8)),
        }
        values |= {
            "T1": stop * float(10 ** rng.uniform(-3.5, -1)),
            "w": 2 * math.pi * float(rng.uniform(0.3, 5)) / stop,
        }
        up = np.array([-math.sin(tilt), math.cos(tilt)]) * (r if disc else 0.0)
        put(values, "b", (up[0], up[1], 0.0, 0.0, 0.0, 0.0), disc)
        setting = Setting(kept(s, values), stop, some_tolerance(rng), compare=True)
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def hoop(rng: Random) -> Structure:
    """A disc or ring thrown on a line, above or below it, with rolling resistance."""
    s = Scene("Hoop")
    s.gravity = s.parameter("g", "Acceleration")
    b = s.body("b", str(rng.choice(["disc", "ring"])))
    line = s.line("floor", None)
    mu, place = s.parameter("mu", "Real"), s.parameter("L0", "Length")
    law = (
        mu if rng.random() < 0.5 else mu * (as_value(1.0) + sin(name("b.position.x") / place) * 0.3)
    )
    s.contacts.append(
        Contact(
            "c",
            line,
            point=None,
            rim=b,
            bilateral=bool(rng.integers(2)),
            kind="contact_ponctuel",
            swapped=bool(rng.integers(2)),
            mu=law,
            mu_s=law * s.parameter("more", "Real"),
            delta=s.parameter("delta", "Length") if rng.random() < 0.7 else None,
        )
    )
    if rng.random() < 0.5:
        s.forces.append(Force("d", "drag", (s.middle(b),), (s.parameter("drag", "Damping"),)))
    stated(s, "b", True)

    def draw(rng: Random) -> Setting:
        tilt = float(rng.uniform(-0.4, 0.4) + rng.choice([0.0, math.pi]))
        r = float(rng.uniform(0.1, 1))
        values = {
            "g": 9.81,
            "m_b": float(rng.uniform(0.3, 3)),
            "l_b": r,
            "x_floor": 0.1,
            "y_floor": 0.2,
            "a_floor": tilt,
        }
        values |= {
            "mu": float(rng.uniform(0.02, 0.7)),
            "more": float(rng.choice([1.0, 1.4])),
            "delta": float(rng.choice([0.0, rng.uniform(0, 0.2)])) * r,
            "drag": float(rng.uniform(0, 1)),
            "L0": 0.7,
        }
        d, up = (
            np.array([math.cos(tilt), math.sin(tilt)]),
            np.array([-math.sin(tilt), math.cos(tilt)]),
        )
        if up[1] < 0:
            up = -up
        at = np.array([0.1, 0.2]) + d * rng.uniform(-1, 1) + r * up
        v = float(rng.choice([0.0, rng.uniform(-5, 5)])) * d
        put(
            values,
            "b",
            (at[0], at[1], float(rng.uniform(-3, 3)), v[0], v[1], float(rng.uniform(-20, 20))),
            True,
        )
        setting = Setting(
            kept(s, values), float(rng.uniform(0.5, 5)), some_tolerance(rng), compare=True
        )
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def stack(rng: Random) -> Structure:
    """A plank on a rough floor, blocks and discs on the plank: lines that move."""
    s = Scene("Stack")
    s.gravity = s.parameter("g", "Acceleration")
    plank = s.body("plank", "particle")
    floor, top = s.line("floor", None), s.line("top", plank)
    n = int(rng.integers(1, 4))
    s.contacts.append(
        Contact(
            "base",
            floor,
            s.middle(plank),
            None,
            True,
            "point_courbe",
            False,
            s.parameter("mu", "Real"),
        )
    )
    shapes = [str(rng.choice(["particle", "disc", "ring"])) for _ in range(n)]
    for i, shape in enumerate(shapes):
        b = s.body(f"b{i}", shape)
        s.contacts.append(
            Contact(
                f"c{i}",
                top,
                point=s.middle(b) if shape == "particle" else None,
                rim=None if shape == "particle" else b,
                bilateral=False,
                kind="contact_ponctuel",
                swapped=bool(rng.integers(2)),
                mu=s.parameter(f"mu{i}", "Real"),
                mu_s=None,
                delta=s.parameter(f"delta{i}", "Length")
                if shape != "particle" and rng.random() < 0.5
                else None,
            )
        )
    s.forces.append(
        Force("f", "on", (s.middle(plank),), (_pushes(rng, s), as_value(0.0) * name("F")))
    )
    for b in s.bodies:
        stated(s, b.name, b.turns)

    def draw(rng: Random) -> Setting:
        tilt, rise = (
            float(rng.choice([0.0, rng.uniform(-0.3, 0.3)])),
            float(rng.choice([0.0, rng.uniform(-0.3, 0.3)])),
        )
        values = {
            "g": 9.81,
            "a_floor": tilt,
            "x_floor": 0.0,
            "y_floor": 0.0,
            "a_top": rise,
            "x_top": 0.0,
            "y_top": 0.1,
        }
        spread = 4.0 if rng.random() < 0.3 else 0.4
        values |= {
            "m_plank": float(10 ** rng.uniform(-spread, spread)),
            "mu": float(rng.choice([0.0, rng.uniform(0, 0.5)])),
        }
        d = np.array([math.cos(tilt), math.sin(tilt)])
        base = float(rng.choice([0.0, rng.uniform(-1, 1)])) * d
        put(values, "plank", (0.0, 0.0, 0.0, base[0], base[1], 0.0), False)
        e, up = (
            np.array([math.cos(rise), math.sin(rise)]),
            np.array([-math.sin(rise), math.cos(rise)]),
        )
        total = values["m_plank"]
        for i, shape in enumerate(shapes):
            r = 0.0 if shape == "particle" else float(rng.uniform(0.1, 0.3))
            values |= {
                f"m_b{i}": float(10 ** rng.uniform(-spread, spread)),
                f"l_b{i}": r,
                f"mu{i}": float(rng.uniform(0, 0.6)),
                f"delta{i}": float(rng.uniform(0, 0.1)) * r,
            }
            total += values[f"m_b{i}"]
            p = np.array([0.0, 0.1]) + (i + float(rng.uniform(0, 0.5))) * e + r * up
            slide = float(rng.choice([0.0, rng.uniform(-2, 2)]))
            v = base + slide * e
            # rolling from the start, or not
            w = 0.0 if r == 0 else (-slide / r if rng.random() < 0.4 else float(rng.uniform(-5, 5)))
            put(values, f"b{i}", (p[0], p[1], 0.0, v[0], v[1], w), shape != "particle")
        values |= {"F": total * 9.81 * float(rng.uniform(0, 0.6)), "T0": 0.7, "T1": 0.1, "w": 6.0}
        setting = Setting(kept(s, values), float(rng.uniform(0.5, 2)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def corner(rng: Random) -> Structure:
    """A point or a disc between two lines, rough or smooth, pushed about."""
    s = Scene("Corner")
    s.gravity = s.parameter("g", "Acceleration")
    round_ = bool(rng.integers(2))
    b = s.body("b", str(rng.choice(["disc", "ring"])) if round_ else "particle")
    one, two = s.line("one", None), s.line("two", None)
    wave = s.parameter("T0", "Time")
    for line, word in ((one, "A"), (two, "B")):
        mu = s.parameter(f"mu_{word}", "Real")
        law = (
            None
            if rng.random() < 0.25
            else (mu * (as_value(1.0) + TIME / wave * 0.3) if rng.random() < 0.3 else mu)
        )
        delta = s.parameter(f"delta_{word}", "Length") if round_ and rng.random() < 0.4 else None
        s.contacts.append(
            Contact(
                word,
                line,
                point=None if round_ else s.middle(b),
                rim=b if round_ else None,
                bilateral=False,
                kind="contact_ponctuel",
                swapped=False,
                mu=law,
                mu_s=None,
                delta=delta,
            )
        )
        if law is None and delta is None:
            s.told.append(word)
    if rng.random() < 0.5:
        push = _pushes(rng, s)
        s.forces.append(Force("f", "on", (s.middle(b),), (push, as_value(0.0) * name("F"))))
    if round_:
        s.statements += [f"b.angular_velocity = {s.parameter('w0', 'AngularVelocity').text}"]
    s.statements += ["A.gap = 0 m", "B.gap = 0 m"]
    for axis in "xy":
        s.statements.append(f"guess(b.position.{axis} = {s.parameter(f'{axis}0', 'Length').text})")

    def draw(rng: Random) -> Setting:
        right, away = float(rng.uniform(0.0, 1.3)), -float(rng.uniform(0.1, 1.3))
        r = float(rng.uniform(0.1, 1)) if round_ else 0.0
        values = {
            "g": 9.81,
            "m_b": float(rng.uniform(0.3, 3)),
            "l_b": r,
            "a_one": right,
            "a_two": away,
            "w0": float(rng.choice([0.0, rng.uniform(-20, 20)])),
        }
        values |= {
            "x_one": 0.0,
            "y_one": 0.0,
            "x_two": 0.0,
            "y_two": 0.0,
            "T0": 0.7,
            "T1": 0.2,
            "F": float(rng.uniform(-6, 6)),
            "w": 5.0,
        }
        values |= {
            f"{k}_{w}": float(rng.uniform(0, 0.5)) * (1 if k == "mu" else 0.1 * r)
            for k in ("mu", "delta")
            for w in "AB"
        }
        # the centre is at r from both lines, above them
        n = np.array([[-math.sin(a), math.cos(a)] for a in (right, away)])
        at = np.linalg.solve(n, np.full(2, r))
        values |= {"x0": float(at[0]), "y0": float(at[1])}
        setting = Setting(kept(s, values), float(rng.uniform(0.5, 2)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


def zero(rng: Random) -> Structure:
    """Starts at zero: springs at rest length, rails without load, loads that begin at nothing."""
    s = Scene("Zero")
    s.gravity = s.parameter("g", "Acceleration")
    n = int(rng.integers(1, 4))
    t0, f = s.parameter("T0", "Time"), s.parameter("F", "Force")
    bodies = [s.body(f"b{i}", "particle") for i in range(n)]
    guided = [bool(rng.integers(2)) for _ in range(n)]
    for i, b in enumerate(bodies):
        if guided[i]:
            rail = s.line(f"r{i}", None)
            mu = s.parameter(f"mu{i}", "Real") if rng.random() < 0.7 else None
            s.contacts.append(
                Contact(f"c{i}", rail, s.middle(b), None, True, "point_courbe", False, mu)
            )
        stated(s, b.name, False)
        before = s.middle(bodies[i - 1]) if i else s.frame("eye", None)
        s.forces.append(
            Force(
                f"s{i}",
                "spring",
                (before, s.middle(b)),
                (s.parameter(f"k{i}", "Stiffness"), s.parameter(f"n{i}", "Length")),
            )
        )
        if rng.random() < 0.3:
            s.forces.append(
                Force(
                    f"damp{i}", "damper", (before, s.middle(b)), (s.parameter(f"d{i}", "Damping"),)
                )
            )
    last = s.middle(bodies[-1])
    growing = f * (TIME / t0) if rng.random() < 0.5 else f * sin(TIME / t0)
    turn = name("turn")
    s.parameter("turn", "Angle")
    from judge.values import cos

    if rng.random() < 0.7:
        s.forces.append(Force("f", "on", (last,), (growing * cos(turn), growing * sin(turn))))

    def draw(rng: Random) -> Setting:
        turn = float(rng.choice([0.0, rng.uniform(-3, 3)]))
        d = np.array([math.cos(turn), math.sin(turn)])
        values = {
            "g": 0.0,
            "T0": float(10 ** rng.uniform(-1, 1)),
            "F": float(10 ** rng.uniform(-2, 1)),
            "turn": turn,
            "x_eye": 0.0,
            "y_eye": 0.0,
        }
        x = 0.0
        for i in range(n):
            rest = float(rng.uniform(0.3, 1))
            x += rest
            p = x * d
            values |= {
                f"m_b{i}": float(10 ** rng.uniform(-1, 1)),
                f"k{i}": float(10 ** rng.uniform(0, 2)),
                f"n{i}": rest,
                f"d{i}": float(rng.uniform(0, 1)),
                f"mu{i}": float(rng.uniform(0, 0.5)),
            }
            values |= {f"x_r{i}": 0.0, f"y_r{i}": 0.0, f"a_r{i}": turn}
            put(values, f"b{i}", (p[0], p[1], 0.0, 0.0, 0.0, 0.0), False)
        setting = Setting(
            kept(s, values), float(rng.uniform(0.5, 3)), some_tolerance(rng), compare=True
        )
        return in_units(s, setting, *decades(rng))

    return Structure(s, draw)


FAMILIES = (
    Family("legs", legs, 1.5, 25, "a bar on 2 to 9 rough feet"),
    Family("blocks", blocks, 1, 25, "blocks that never meet, masses 1e14 apart"),
    Family("rest", rest, 1.5, 40, "rest under loads of any duration"),
    Family("hoop", hoop, 1.5, 60, "discs and rings that slide, roll and stop"),
    Family("stack", stack, 1.5, 25, "bodies on a plank that moves"),
    Family("corner", corner, 1.5, 30, "a body between two lines"),
    Family("zero", zero, 1.5, 30, "starts at zero"),
    Family("floor", floor, 1, 25, "pinned rods on a rough floor"),
)
