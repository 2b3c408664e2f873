"""The family `anything`: 1 to 6 bodies, liaisons, laws and forces drawn without regard to sense.

Bodies are put anywhere first; lines, frames and pins are then laid where the bodies are, so that
every start is consistent. Velocities are projected onto the relations (and onto rest of some rows)
with the judge's own rows.
"""

from __future__ import annotations

import math

import numpy as np

from judge.family import Family, Random, Setting, Structure, decades, in_units, some_tolerance
from judge.mechanics import Floats, Mechanics, left
from judge.scene import Body, Contact, Force, Line, Pin, Point, Scene
from judge.values import Value, as_value, clamp, name, sin, switch

TIME = name("time")


class Maker:
    """Draws the structure of one scene."""

    def __init__(self, rng: Random) -> None:
        self.rng, self.s = rng, Scene("Anything")
        self.s.gravity = self.s.parameter("g", "Acceleration")
        self.placed: list[tuple[Line, Contact]] = []
        self.count = 0
        self.guessed = bool(rng.random() < 0.4)

    def word(self, of: str) -> str:
        """A name nobody has yet."""
        self.count += 1
        return f"{of}{self.count}"

    def make(self) -> Structure:
        """Draw all of the scene."""
        n = int(self.rng.choice([1, 2, 3, 4, 5, 6], p=[0.2, 0.3, 0.2, 0.15, 0.1, 0.05]))
        self.s.parameter("T0", "Time")
        self.s.parameter("L0", "Length")
        self.s.parameter("w", "AngularVelocity")
        for i in range(n):
            shape = str(
                self.rng.choice(["particle", "rod", "disc", "ring"], p=[0.25, 0.4, 0.2, 0.15])
            )
            self.attach(self.s.body(f"b{i}", shape))
        for _ in range(int(self.rng.choice([0, 1, 2], p=[0.5, 0.35, 0.15]))):
            self.contact(self.s.bodies[int(self.rng.integers(n))])
        for _ in range(int(self.rng.integers(0, 4))):
            self.force()
        for joint in [*self.s.contacts, *self.s.pins]:
            told = joint.mu is None and (not isinstance(joint, Contact) or joint.delta is None)
            if told and self.rng.random() < 0.7:
                self.s.told.append(joint.name)
        self.start()
        return Structure(self.s, self.draw)

    def attach(self, body: Body) -> None:
        """Hang the body on what is there, or leave it free."""
        way = self.rng.choice(["pin", "contact", "free"], p=[0.4, 0.5, 0.1])
        if way == "pin":
            self.pin(body)
        elif way == "contact":
            self.contact(body)

    def owner(self, body: Body) -> Body | None:
        """The ground or an earlier body, to carry what `body` is tied to."""
        earlier = self.s.bodies[: self.s.bodies.index(body)]
        if not earlier or self.rng.random() < 0.5:
            return None
        return earlier[int(self.rng.integers(len(earlier)))]

    def spot(self, body: Body | None) -> Point:
        """A point of the body: its G, an end, or a frame of its own."""
        if body is None:
            return self.s.frame(self.word("f"), None)
        way = self.rng.random()
        if not body.turns or way < 0.3:
            return self.s.middle(body)
        if body.shape == "rod" and way < 0.8:
            return self.s.end(body, str(self.rng.choice(["start", "tip"])))
        return self.s.frame(self.word("f"), body)

    def pin(self, body: Body) -> None:
        """Pin the body to the ground or to an earlier body."""
        own, other = self.spot(body), self.owner(body)
        if not body.turns and (other is None or not other.turns):
            return  # nothing that turns has nothing to pin
        place = (
            self.s.frame(self.word("f"), other)
            if other is None or other.turns
            else self.s.middle(other)
        )
        # one of the two must be free to be laid where the other is
        if not own.frame and not place.frame:
            own = self.s.frame(self.word("f"), body) if body.turns else own
            if not own.frame:
                return
        ends = (place, own) if self.rng.random() < 0.7 else (own, place)
        law: tuple[Value | None, ...] = (None, None, None)
        turning = (body.turns) or (other is not None and other.turns)
        if turning and self.rng.random() < 0.6:
            mu, mu_s = self.coefficient(body)
            law = (mu, mu_s, self.s.parameter(self.word("r_pin"), "Length"))
        self.s.pins.append(Pin(self.word("P"), *ends, *law))

    def coefficient(self, body: Body) -> tuple[Value, Value | None]:
        """A coefficient that may depend on place and time, and one of rest."""
        mu = self.s.parameter(self.word("mu"), "Real")
        one, way = as_value(1.0), self.rng.random()
        x = name(f"{body.name}.position.{self.rng.choice(['x', 'y'])}") / name("L0")
        if way > 0.9:
            mu = mu * (one + sin(name("w") * TIME) * 0.3)
        elif way > 0.8:
            mu = mu * (one + sin(x) * 0.3)
        elif way > 0.75:
            mu = mu * (one + clamp(x) * 0.5)
        elif way > 0.7:
            mu = switch(TIME, name("T0"), mu, mu * 0.5)
        rest = None
        if self.rng.random() < 0.4:
            rest = mu * self.s.parameter(self.word("more"), "Real")
        return mu, rest

    def contact(self, body: Body) -> None:
        """Put a point or the rim of the body on a line."""
        owner = self.owner(body)
        line = self.s.line(self.word("l"), owner)
        bilateral = bool(self.rng.random() < 0.5)
        rim = body.shape in ("disc", "ring") and self.rng.random() < 0.7
        point = None if rim else self.spot(body)
        kind = "contact_ponctuel" if rim or self.rng.random() < 0.5 else "point_courbe"
        mu = mu_s = delta = None
        if self.rng.random() < 0.75:
            mu, mu_s = self.coefficient(body)
        if body.turns and self.rng.random() < 0.2:
            delta = self.s.parameter(self.word("delta"), "Length")
        swapped = kind == "contact_ponctuel" and bool(self.rng.integers(2))
        c = Contact(
            self.word("C"),
            line,
            point=point,
            rim=body if rim else None,
            bilateral=bilateral,
            kind=kind,
            swapped=swapped,
            mu=mu,
            mu_s=mu_s,
            delta=delta,
        )
        self.s.contacts.append(c)

    def pushing(self, kind: str) -> Value:
        """A force or couple: even, waved, switched by time or place."""
        f = self.s.parameter(self.word("F"), kind)
        b = self.s.bodies[int(self.rng.integers(len(self.s.bodies)))]
        forms = (
            f,
            f * sin(name("w") * TIME),
            f * (TIME / name("T0")),
            switch(TIME, name("T0"), f, f * -0.5),
            switch(name(f"{b.name}.position.x"), name("L0"), f, f * 0.3),
        )
        return forms[int(self.rng.integers(len(forms)))]

    def force(self) -> None:
        """Add one of the forces of the language."""
        rng, s = self.rng, self.s
        body = s.bodies[int(rng.integers(len(s.bodies)))]
        kind = str(rng.choice(["on", "couple", "spring", "damper", "attraction", "drag"]))
        word = self.word("force")
        if kind == "on":
            s.forces.append(
                Force(
                    word, "on", (self.spot(body),), (self.pushing("Force"), self.pushing("Force"))
                )
            )
        elif kind == "couple":
            pins = [
                p
                for p in s.pins
                if (p.a.body is None or p.a.body.turns) and p.b.body is not None and p.b.body.turns
            ]
            if pins and rng.random() < 0.5:
                s.forces.append(Force(word, "couple", (), (self.pushing("Torque"),), pins[0]))
            elif body.turns:
                s.forces.append(Force(word, "couple", (), (self.pushing("Torque"),), body))
        elif kind == "drag":
            c = s.parameter(self.word("drag"), "Damping")
            if rng.random() < 0.5:
                unit = s.parameter("V0", "Velocity")
                s.forces.append(Force(word, kind, (self.spot(body),), (c / unit,), exponent=2))
            else:
                s.forces.append(Force(word, kind, (self.spot(body),), (c,)))
        else:
            others = [b for b in [None, *s.bodies] if b is not body]
            ends = (self.spot(body), self.spot(others[int(rng.integers(len(others)))]))
            k = s.parameter(self.word("k"), "Damping" if kind == "damper" else "Stiffness")
            values = (k, s.parameter(self.word("n"), "Length")) if kind == "spring" else (k,)
            s.forces.append(Force(word, kind, ends, values))

    def start(self) -> None:
        """State every coordinate and speed, or guess them."""
        s = self.s
        for b in s.bodies:
            x, y = (s.parameter(f"{k}0_{b.name}", "Length").text for k in "xy")
            u, v = (s.parameter(f"{k}0_{b.name}", "Velocity").text for k in "uv")
            lines = [f"{b.name}.position.x = {x}", f"{b.name}.position.y = {y}"]
            lines += [f"{b.name}.velocity.x = {u}", f"{b.name}.velocity.y = {v}"]
            if b.turns:
                a, w = (
                    s.parameter(f"a0_{b.name}", "Angle"),
                    s.parameter(f"w0_{b.name}", "AngularVelocity"),
                )
                lines += [f"{b.name}.angle = {a.text}", f"{b.name}.angular_velocity = {w.text}"]
            s.statements += [f"guess({x})" for x in lines] if self.guessed else lines
        if self.guessed:
            s.statements += [f"{c.name}.gap = 0 m" for c in s.contacts if not c.bilateral]

    # settings

    def draw(self, rng: Random) -> Setting:
        """Draw values of all parameters that fit together."""
        s = self.s
        values: dict[str, float] = {
            "g": float(rng.choice([9.81, 0.0], p=[0.85, 0.15])),
            "T0": float(rng.uniform(0.1, 1)),
            "L0": float(rng.uniform(0.3, 1)),
            "w": float(rng.uniform(1, 8)),
            "V0": 1.0,
        }
        spread = 5.0 if rng.random() < 0.2 else 0.6
        for b in s.bodies:
            values |= {
                f"m_{b.name}": float(10 ** rng.uniform(-spread, spread)),
                f"l_{b.name}": float(
                    rng.uniform(0.2, 1.2) if b.shape == "rod" else rng.uniform(0.1, 0.5)
                ),
            }
        for word, kind in s.parameters.items():
            values.setdefault(word, self.usual(rng, word, kind, spread, values))
        state = {
            b.name: [
                float(rng.uniform(-1, 1)),
                float(rng.uniform(-1, 1)),
                float(rng.uniform(-3, 3)) if b.turns else 0.0,
                0.0,
                0.0,
                0.0,
            ]
            for b in s.bodies
        }
        sides = self.lay(rng, values, state)
        self.move(rng, values, state, sides)
        for b in s.bodies:
            for key, x in zip(("x0", "y0", "a0", "u0", "v0", "w0"), state[b.name], strict=True):
                values[f"{key}_{b.name}"] = float(x)
        kept = {k: values[k] for k in s.parameters}
        setting = Setting(kept, float(rng.uniform(0.2, 2)), some_tolerance(rng))
        return in_units(s, setting, *decades(rng))

    def usual(
        self, rng: Random, word: str, kind: str, spread: float, values: dict[str, float]
    ) -> float:
        """A value of a parameter that nothing else decides."""
        mass = values.get("m_b0", 1.0)
        if word.startswith("more"):
            return float(rng.choice([1.0, 1.5]))
        if word.startswith("mu"):
            return float(
                rng.choice([0.0, rng.uniform(0, 1), rng.uniform(0, 0.4)], p=[0.1, 0.3, 0.6])
            )
        if word.startswith(("delta", "r_pin")):
            return float(rng.uniform(0, 0.05))
        if word.startswith("n") and kind == "Length":
            return float(rng.uniform(0, 0.8))
        if kind in ("Force", "Torque"):
            return mass * float(rng.uniform(-15, 15))
        if kind == "Stiffness":
            return mass * float(10 ** rng.uniform(0, 2))
        if kind == "Damping":
            return mass * float(rng.uniform(0, 2))
        return float(rng.uniform(-0.5, 0.5))

    def lay(
        self, rng: Random, values: dict[str, float], state: dict[str, list[float]]
    ) -> dict[str, int]:
        """Lay frames of pins and lines where the bodies are."""
        s = self.s

        def look(word: str) -> float:
            return values[word]

        def world(p: Point) -> Floats:
            x, y = (v.at(look) for v in p.at)
            if p.body is None:
                return np.array([x, y])
            g, a = state[p.body.name][:2], state[p.body.name][2]
            return (
                np.array(g)
                + x * np.array([math.cos(a), math.sin(a)])
                + y * np.array([-math.sin(a), math.cos(a)])
            )

        def local(at: Floats, body: Body | None) -> Floats:
            if body is None:
                return at
            g, a = np.array(state[body.name][:2]), state[body.name][2]
            d = at - g
            return np.array([d @ [math.cos(a), math.sin(a)], d @ [-math.sin(a), math.cos(a)]])

        for p in s.pins:
            moved, fixed = (p.a, p.b) if p.a.frame else (p.b, p.a)
            x = local(world(fixed), moved.body)
            values[f"x_{moved.text}"], values[f"y_{moved.text}"] = float(x[0]), float(x[1])
        sides = {}
        for c in s.contacts:
            a = float(rng.uniform(-0.6, 0.6) + rng.choice([0.0, math.pi]))
            if c.bilateral and rng.random() < 0.5:
                a = float(rng.uniform(-3, 3))
            d = np.array([math.cos(a), math.sin(a)])
            up = left(d)
            owner = c.line.owner
            if c.rim is not None:
                side = 1 if up[1] >= 0 or (c.bilateral and rng.random() < 0.3) else -1
                if not c.bilateral and rng.random() < 0.15:
                    side = -side
                radius = values[f"l_{c.rim.name}"]
                at = np.array(state[c.rim.name][:2]) - side * radius * up
            else:
                assert c.point is not None
                side = 1 if up[1] > 0 or (c.kind == "point_courbe" and c.bilateral) else -1
                at = world(c.point)
            at = at + float(rng.uniform(-0.5, 0.5)) * d - side * self.gap(rng, c) * up
            x = local(at, owner)
            values[f"x_{c.line.name}"], values[f"y_{c.line.name}"] = float(x[0]), float(x[1])
            values[f"a_{c.line.name}"] = a - (state[owner.name][2] if owner is not None else 0.0)
            sides[c.name] = side
        return sides

    def gap(self, _rng: Random, _contact: Contact) -> float:
        """How far a contact is open at the start."""
        return 0.0

    def move(
        self,
        rng: Random,
        values: dict[str, float],
        state: dict[str, list[float]],
        sides: dict[str, int],
    ) -> None:
        """Random velocities that keep the relations and, in some liaisons, rest."""
        s = self.s
        frozen = rng.random() < 0.25
        if not frozen:
            for b in s.bodies:
                state[b.name][3:] = [
                    float(rng.uniform(-2, 2)),
                    float(rng.uniform(-2, 2)),
                    float(rng.uniform(-4, 4)) if b.turns else 0.0,
                ]

        def look(word: str) -> float:
            if word in values:
                return values[word]
            if word == "time":
                return 0.0
            body, what, axis = word.split(".")
            return state[body][(0 if what == "position" else 3) + "xy".index(axis)]

        now = Mechanics(s, look, {k: tuple(v) for k, v in state.items()}, sides)
        rows = []
        for joint in now.joints.values():
            words = ["x", "y"] if isinstance(joint.liaison, Pin) else ["n"]
            if rng.random() < 0.3:
                words.append("c" if isinstance(joint.liaison, Pin) else "t")
            rows += [joint.rows[w].jacobian for w in words]
        if rows and not frozen:
            matrix = np.array(rows)
            v = now.speed - np.linalg.pinv(matrix, rcond=1e-10) @ (matrix @ now.speed)
            v = v - np.linalg.pinv(matrix, rcond=1e-10) @ (matrix @ v)
            v[np.abs(v) < 1e-14] = 0.0
            for b in s.bodies:
                state[b.name][3:] = list(v[now.at[b.name] : now.at[b.name] + 3])


def anything(rng: Random) -> Structure:
    """A scene that can move and whose liaisons do not say the same twice."""
    while True:
        made = Maker(rng).make()
        if stands_alone(made, rng):
            return made


def stands_alone(made: Structure, rng: Random) -> bool:
    """Whether liaisons leave some motion, and none says what others say."""
    values = made.draw(rng).values
    s = made.scene

    def look(word: str) -> float:
        if word in values:
            return values[word]
        if word == "time":
            return 0.0
        body, what, axis = word.split(".")
        return values[f"{axis if what == 'position' else 'uv'['xy'.index(axis)]}0_{body}"]

    state = {b.name: tuple(values.get(f"{k}0_{b.name}", 0.0) for k in "xyauvw") for b in s.bodies}
    now = Mechanics(s, look, state, {c.name: 1 for c in s.contacts})
    rows = [
        joint.rows[w].jacobian / (joint.rows[w].reach + (joint.rows[w].reach == 0))
        for joint in now.joints.values()
        for w in (("x", "y") if isinstance(joint.liaison, Pin) else ("n",))
    ]
    if not rows:
        return True
    freedom = sum(3 if b.turns else 2 for b in s.bodies)
    rank = int(np.linalg.matrix_rank(np.array(rows), tol=1e-9))
    return rank == len(rows) < freedom


FAMILIES = (Family("anything", anything, 8, 25, "1 to 6 bodies, any liaisons, laws and forces"),)
