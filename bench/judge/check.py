"""What must hold at instants of a result, whatever made it: relations, laws, momenta, energy.

Sizes: accelerations and reactions follow from the state alone, so they are held to rounding
(`EXACT`); what the integration carries (relations of loops, velocities against the integral of the
accelerations, bounds before an event is located) to `SLACK` times the tolerance of the run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from judge.mechanics import Floats, Joint, Mechanics, Row, inertia
from judge.motions import accelerations, parts
from judge.readings import Loads, start_sides, state_of
from judge.scene import Contact, Pin, Scene

EXACT = 1e-8
SLACK = 300.0
OPEN, STICK, SLIP = 0, 1, 2
NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
# A speed is a sum along what joins bodies: known to a few roundings of the largest there.
CARRIED = 1e-15
# Part of a run that stopped within which it had stopped: an instant is known no better.
AT_LAST = 1e-9
# Parts of an interval over each of which a rule is taken; the finest sees a bell of a thousandth.
PANELS = (2, 64, 2048)


def gauss_places(a: float, b: float, panels: int) -> Floats:
    """The nodes of the Gauss rule on each of so many equal parts of [a, b], in one row."""
    middles = a + (b - a) / panels * (np.arange(panels) + 0.5)
    return (middles[:, None] + (b - a) / panels / 2 * NODES).ravel()


class Happening(Protocol):
    """An event of a result."""

    time: float
    kind: str
    liaison: str
    text: str


class Outcome(Protocol):
    """What the judge reads of a result."""

    time: Floats
    events: tuple[Happening, ...]

    def at(self, t: Floats) -> Mapping[str, Floats]:
        """Values of variables at times."""
        ...

    def __getitem__(self, name: str) -> Floats: ...

    def __contains__(self, name: object) -> bool: ...


@dataclass(slots=True)
class Findings:
    """Faults in words, and the largest of each measured quantity over what is allowed."""

    faults: list[str] = field(default_factory=list)
    worst: dict[str, float] = field(default_factory=dict)

    def hold(self, what: str, value: float, allowed: float, t: float, who: str) -> None:
        """Note a quantity that must not be larger than `allowed`."""
        ratio = abs(value) / allowed if allowed > 0 else (0.0 if value == 0 else math.inf)
        if not ratio <= self.worst.get(what, 0.0):
            self.worst[what] = ratio if math.isfinite(ratio) else 1e300
        if not ratio <= 1:
            self.fault(f"{what}: {who} at t = {t!r}: {value:.3g}, allowed {allowed:.3g}")

    def fault(self, text: str) -> None:
        """Note a fault; three of a kind are enough."""
        kind = text.split(":")[0]
        if sum(f.startswith(kind + ":") for f in self.faults) < 3:
            self.faults.append(text)


@dataclass(slots=True)
class Sizes:
    """The largest length, speed and time of a run, of each body."""

    length: float
    speed: float


class Judge:
    """A scene with values of its parameters, and a result of it."""

    def __init__(self, scene: Scene, values: Mapping[str, float], result: Outcome, tol: float):
        self.scene, self.values, self.result, self.tol = scene, values, result, tol
        self.found = Findings()
        self.sides: dict[str, int] = {}
        begin = float(result.time[0])
        self.sides = start_sides(scene, self.mechanics(begin, {}))
        self.length, self.speed = self._sizes()
        self._natural()
        self.carried = self._carried()

    # what the result says

    def look(self, t: float, row: Mapping[str, float]) -> Callable[[str], float]:
        """Parameters, `time` and variables of a row by name."""

        def look(word: str) -> float:
            if word == "time":
                return t
            if word in self.values:
                return self.values[word]
            return row[word]

        return look

    def row(self, t: float) -> dict[str, float]:
        """All variables at a time."""
        now = self.result.at(np.array([t]))
        return {name: float(now[name][0]) for name in now}

    def mechanics(self, t: float, sides: Mapping[str, int] | None = None) -> Mechanics:
        """The scene in the state the result tells at t."""
        row = self.row(t)
        return self.mechanics_of(row, t, sides)

    def mechanics_of(
        self, row: Mapping[str, float], t: float, sides: Mapping[str, int] | None = None
    ) -> Mechanics:
        """The scene in the state of a row."""
        given = self.sides if sides is None else sides
        chosen = {c.name: given.get(c.name, 1) for c in self.scene.contacts}
        return Mechanics(self.scene, self.look(t, row), state_of(self.scene, row), chosen)

    def _sizes(self) -> tuple[float, dict[str, float]]:
        """The largest length in the scene, and the largest speed of each body (and angular)."""
        length = 0.0
        speed: dict[str, float] = {}
        for b in self.scene.bodies:
            x = np.hypot(self.result[f"{b.name}.position.x"], self.result[f"{b.name}.position.y"])
            v = np.hypot(self.result[f"{b.name}.velocity.x"], self.result[f"{b.name}.velocity.y"])
            length = max(length, float(np.max(x)))
            if b.size is not None:
                length = max(length, b.size.at(self.look(0.0, {})))
            speed[b.name] = float(np.max(v))
            if b.turns:
                speed[f"{b.name}.w"] = float(
                    np.max(np.abs(self.result[f"{b.name}.angular_velocity"]))
                )
        return length, speed

    def _natural(self) -> None:
        """A body at rest still has a speed to compare rounding with: what its loads bring about."""
        now = self.mechanics(float(self.result.time[0]))
        quick = now.load_size / now.mass
        for b in self.scene.bodies:
            k = now.at[b.name]
            speed = 1e-3 * math.sqrt(self.length * float(np.max(quick[k : k + 2])))
            self.speed[b.name] = max(self.speed[b.name], speed)
            fastest = max(v for k, v in self.speed.items() if not k.endswith(".w"))
            self.speed[b.name] = max(self.speed[b.name], 1e-13 * fastest)
            if b.turns and b.size is not None:
                speed = max(speed, 1e-13 * fastest)
                spin = speed / b.size.at(now.look)
                self.speed[f"{b.name}.w"] = max(self.speed[f"{b.name}.w"], spin)

    def _carried(self) -> dict[str, float]:
        """The rounding of each body's speed (and angular) that comes from those it is joined to.

        What loads would bring about counts too, where reactions take all of it away.
        """
        rounding = {}
        now = self.mechanics(float(self.result.time[0]))
        quick = accelerations(now)
        for places, _ in parts(now):
            joined = [self.scene.bodies[int(k) // 3] for k in places[:, 0]]
            natural = math.sqrt(self.length * float(np.max(quick[places[:, :2]])))
            largest = max(natural, *(self.speed[b.name] for b in joined))
            widths = [b.size.at(now.look) for b in joined if b.turns and b.size is not None]
            spins = [self.speed.get(f"{b.name}.w", 0.0) for b in joined]
            spin = max(*spins, *(natural / x for x in widths), 0.0)
            for b in joined:
                rounding[b.name] = CARRIED * largest
                rounding[f"{b.name}.w"] = CARRIED * spin
        return rounding

    # the whole examination

    def examine(
        self,
        rng: np.random.Generator,
        instants: int = 12,
        events: int = 6,
        *,
        stopped: bool = False,
    ) -> Findings:
        """Look at random instants, at events, and over random intervals.

        Of a run that `stopped`, what it did at last, before it knew, is judged with the stop.
        """
        begin, end = float(self.result.time[0]), float(self.result.time[-1])
        end -= AT_LAST * (end - begin) if stopped else 0.0
        marks = sorted({e.time for e in self.result.events if begin <= e.time <= end})
        times = [*rng.uniform(begin, end, instants), begin]
        chosen = [marks[int(k)] for k in rng.permutation(len(marks))[:events]]
        times += chosen
        for t in times:
            self.instant(self._clear(float(t), marks, begin, end))
        for t in chosen:
            if t > begin:
                self.jump(float(t))
        self.integrals(rng, marks, begin, end)
        self.balance(rng, begin, end)
        return self.found

    def _clear(self, t: float, marks: list[float], begin: float, end: float) -> float:
        """A little later where a condition switches, so that all agree on its truth.

        A run that stops there tells the motion before: that is looked at a little earlier.
        """
        if not any(
            e.kind == "condition" and abs(e.time - t) <= 1e-12 * abs(t) for e in self.result.events
        ):
            return t
        room = 1e-12 * abs(t)
        after = min([m for m in [*marks, end] if m > t + room], default=None)
        if after is None:
            before = max([m for m in [begin, *marks] if m < t - room], default=t)
            return t - 1e-3 * (t - before)
        return t + 1e-3 * (after - t)

    def instant(self, t: float) -> None:
        """Everything that must hold at one instant."""
        row = self.row(t)
        if not all(math.isfinite(x) for x in row.values()):
            self.found.fault(f"not finite: a variable at t = {t!r}")
            return
        now = self.mechanics_of(row, t)
        loads = Loads(now, row)
        for joint in now.joints.values():
            self.relation(now, joint, row, loads, t)
            self.outputs(now, joint, row, t)
            self.law(now, joint, row, loads, t)
        self.residual(loads, t)

    def relation(
        self, now: Mechanics, joint: Joint, row: Mapping[str, float], loads: Loads, t: float
    ) -> None:
        """Positions, velocities and accelerations of what is closed."""
        name, allowed = joint.liaison.name, SLACK * self.tol + 1e-11
        pin = isinstance(joint.liaison, Pin)
        closed = pin or row.get(f"{name}.mode", SLIP if self.kept(joint) else OPEN) != OPEN
        size = max(self.length, joint.size)
        if not closed:
            self.found.hold("inside", min(joint.gap, 0.0), allowed * size, t, name)
            return
        self.found.hold("relation", joint.gap, allowed * size, t, name)
        for word in ("x", "y") if pin else ("n",):
            r = joint.rows[word]
            # a rate is known to the rounding of its position too: size * largest angular velocity
            self.found.hold("relation rate", r.rate, allowed * self.usual(r), t, name)
            self.held_acceleration("relation acceleration", loads, r, t, name)

    def kept(self, joint: Joint) -> bool:
        """Whether the liaison can never part."""
        return isinstance(joint.liaison, Pin) or joint.liaison.bilateral

    def usual(self, row: Row) -> float:
        """Size of the terms of a relative velocity with the largest speeds of the run."""
        largest = []
        for b in self.scene.bodies:
            largest += [self.speed[b.name]] * 2 + [self.speed.get(f"{b.name}.w", 0.0)]
        return float(row.reach @ np.array(largest))

    def held_acceleration(self, what: str, loads: Loads, row: Row, t: float, name: str) -> None:
        """A relative acceleration that must be zero."""
        value = row.jacobian @ loads.acceleration + row.bias
        size = row.reach @ loads.acceleration_size + row.bias_size
        self.found.hold(what, float(value), EXACT * float(size), t, name)

    def outputs(self, now: Mechanics, joint: Joint, row: Mapping[str, float], t: float) -> None:
        """Variables of a liaison against what the bodies say."""
        c = joint.liaison
        if isinstance(c, Pin):
            if f"{c.name}.speed" in row:
                r = joint.rows["c"]
                self.found.hold(
                    "output", row[f"{c.name}.speed"] - r.rate, 1e-12 * self.spins(), t, c.name
                )
            return
        if f"{c.name}.normal_force" in row and f"{c.name}.force.x" in row:
            n, t_ = row[f"{c.name}.normal_force"], row[f"{c.name}.tangential_force"]
            sign = 1.0 if c.swapped else -1.0
            for axis, x in zip("xy", sign * (n * joint.normal + t_ * joint.direction), strict=True):
                room = 1e-11 * (abs(n) + abs(t_))
                self.found.hold("force", row[f"{c.name}.force.{axis}"] - x, room, t, c.name)
        size = max(self.length, joint.size)
        allowed = 1e-11 * size + (SLACK * self.tol * size if self.kept(joint) else 0.0)
        if f"{c.name}.gap" in row:
            self.found.hold("output", row[f"{c.name}.gap"] - joint.gap, allowed, t, f"{c.name}.gap")
        if f"{c.name}.slip" in row:
            r = joint.rows["t"]
            given = row[f"{c.name}.slip"]
            wide = max(self.usual(r), r.rate_size)
            # the judge's touching point follows a gap that is zero to the tolerance
            room = (1e-11 + SLACK * self.tol) * wide
            self.found.hold("output", given - r.rate, room, t, f"{c.name}.slip")

    def spins(self) -> float:
        """The largest angular velocity of the run."""
        return max([v for k, v in self.speed.items() if k.endswith(".w")], default=0.0)

    def law(
        self, now: Mechanics, joint: Joint, row: Mapping[str, float], loads: Loads, t: float
    ) -> None:
        """Laws of one liaison."""
        name, c = joint.liaison.name, joint.liaison
        if f"{name}.mode" not in row:
            return
        mode = int(row[f"{name}.mode"])
        z = loads.reactions.get(name)
        if z is None:
            return
        unilateral = isinstance(c, Contact) and not c.bilateral
        load = loads.scale(joint)
        if mode == OPEN:
            for word, x in z.items():
                self.found.hold("open reaction", x, 0.0, t, f"{name} {word}")
            return
        if unilateral:
            allowed = (SLACK * self.tol + 1e-9) * load
            self.found.hold("pull", min(z["n"], 0.0), allowed, t, name)
        normal = math.hypot(z["x"], z["y"]) if isinstance(c, Pin) else abs(z["n"])
        word = "c" if isinstance(c, Pin) else "t"
        if c.mu is not None:
            arm = 1.0 if isinstance(c, Contact) else (c.radius.at(now.look) if c.radius else 1.0)
            self.friction(joint, row, loads, t, word, normal, mode, load, least=1e-3 * arm)
        elif word in z:
            self.found.hold("no friction", z[word], 0.0, t, name)
        if isinstance(c, Contact) and c.delta is not None:
            self.rolling(joint, loads, t, normal, load)

    def friction(
        self,
        joint: Joint,
        row: Mapping[str, float],
        loads: Loads,
        t: float,
        word: str,
        normal: float,
        mode: int,
        load: float,
        *,
        least: float,
    ) -> None:
        """Coulomb: rest within the bound, exactly the bound in motion, against the slip.

        A pin's coefficient has its radius in it; where it is below `least` rounding is that of
        `least`.
        """
        name, r = joint.liaison.name, joint.rows[word]
        force = loads.reactions[name][word]
        largest = max(joint.mu_s, joint.mu)
        small = (SLACK * self.tol + 1e-9) * largest * load + 1e-11 * max(largest, least) * load
        slip = row.get(f"{name}.slip", r.rate)
        if mode == STICK:
            self.found.hold("held slip", slip, 0.0, t, name)
            self.found.hold("cone", max(0.0, abs(force) - joint.mu_s * normal), small, t, name)
            self.held_acceleration("held acceleration", loads, r, t, name)
            return
        rounding = EXACT * (joint.mu * normal + abs(force)) + 1e-11 * max(joint.mu, least) * load
        self.found.hold("law", abs(force) - joint.mu * normal, rounding, t, name)
        way = slip
        if slip == 0:  # leaves rest now
            way = float(r.jacobian @ loads.acceleration + r.bias)
            size = r.reach @ loads.acceleration_size + r.bias_size
            if abs(way) <= 1e-7 * size:
                return
        wide = self.usual(r)
        if way * force > 0 and abs(force) > small and not 0 < abs(slip) <= SLACK * self.tol * wide:
            self.found.fault(
                f"drives: friction of {name} at t = {t!r} pushes along the slip {slip:.3g}"
            )

    def rolling(self, joint: Joint, loads: Loads, t: float, normal: float, load: float) -> None:
        """Resistance to rolling: at most delta N, and exactly that in motion."""
        name, r = joint.liaison.name, joint.rows["r"]
        couple, bound = loads.reactions[name]["r"], joint.delta * normal
        small = (SLACK * self.tol + 1e-9) * joint.delta * load
        self.found.hold("rolling bound", max(0.0, abs(couple) - bound), small, t, name)
        if r.rate == 0:
            return
        if abs(r.rate) > 10 * SLACK * self.tol * self.spins():
            self.found.hold(
                "rolling law",
                abs(couple) - bound,
                EXACT * bound + 1e-11 * joint.delta * load,
                t,
                name,
            )
            if r.rate * couple > 0 and abs(couple) > small:
                self.found.fault(f"drives: rolling resistance of {name} at t = {t!r}")

    def residual(self, loads: Loads, t: float) -> None:
        """Newton-Euler of every body; reactions that are not told are chosen as they fit best."""
        rest, size, now = loads.rest, loads.size, loads.now
        scaled = rest / np.where(size > 0, size, 1)
        if loads.untold:
            columns = np.array(loads.untold).T / np.where(size > 0, size, 1)[:, None]
            lengths = np.linalg.norm(columns, axis=0)
            columns = columns / np.where(lengths > 0, lengths, 1)
            scaled = scaled - columns @ np.linalg.lstsq(columns, scaled, rcond=1e-13)[0]
        for b in self.scene.bodies:
            k = now.at[b.name]
            for i, word in enumerate("xyz" if b.turns else "xy"):
                self.found.hold("Newton-Euler", float(scaled[k + i]), EXACT, t, f"{b.name} {word}")

    def jump(self, t: float) -> None:
        """Positions and velocities are continuous: there are no impacts."""
        before, after = self.row(math.nextafter(t, -math.inf)), self.row(t)
        for b in self.scene.bodies:
            for axis in "xy":
                for what, size in (("position", self.length), ("velocity", self.speed[b.name])):
                    name = f"{b.name}.{what}.{axis}"
                    allowed = (SLACK * self.tol + 1e-12) * size
                    self.found.hold(f"jump of {what}", after[name] - before[name], allowed, t, name)
            if b.turns:
                name = f"{b.name}.angular_velocity"
                allowed = (SLACK * self.tol + 1e-12) * self.speed[f"{b.name}.w"]
                self.found.hold("jump of velocity", after[name] - before[name], allowed, t, name)

    def integrals(
        self, rng: np.random.Generator, marks: list[float], begin: float, end: float, count: int = 5
    ) -> None:
        """Velocities are the integrals of the accelerations, positions those of the velocities."""
        cuts = [begin, *[t for t in marks if begin < t < end], end]
        for _ in range(count):
            k = int(rng.integers(len(cuts) - 1))
            a, b = cuts[k], cuts[k + 1]
            span = (b - a) * min(1.0, 10 ** rng.uniform(-2.0, 0.0))
            a = float(rng.uniform(a, b - span)) if b - span > a else a
            if self.spins() > 0:  # no rule follows many turns
                span = min(span, 1.0 / self.spins())
            b = min(a + span, math.nextafter(b, -math.inf))
            if b - a > 1e-9 * max(abs(a), abs(b), end - begin):
                self.integral(a, b)

    def integral(self, a: float, b: float) -> None:
        """Changes over [a, b] against integrals; of what they miss, by ever finer rules."""
        for panels in PANELS:
            found = list(self.missed(a, b, panels))
            if all(abs(missed) <= allowed for *_, missed, allowed in found):
                break
        for of, rate, missed, allowed in found:
            self.found.hold(f"integral of {rate}", missed, allowed, a, f"{of} to {b!r}")

    def missed(self, a: float, b: float, panels: int) -> Iterator[tuple[str, str, float, float]]:
        """The names of values and of their rates, what they differ by and what is allowed."""
        coarse, fine = (self.result.at(gauss_places(a, b, n)) for n in (panels // 2, panels))
        ends = self.result.at(np.array([a, b]))
        pairs = [("position", "velocity"), ("velocity", "acceleration")]
        for body in self.scene.bodies:
            names = [
                (f"{body.name}.{x}.{axis}", f"{body.name}.{y}.{axis}")
                for x, y in pairs
                for axis in "xy"
            ]
            if body.turns:
                names += [(f"{body.name}.angle", f"{body.name}.angular_velocity")]
                names += [(f"{body.name}.angular_velocity", f"{body.name}.angular_acceleration")]
            for of, rate in names:
                one, two = (
                    (b - a) / (2 * n) * float(np.tile(WEIGHTS, n) @ at[rate])
                    for n, at in ((panels // 2, coarse), (panels, fine))
                )
                size = float(np.max(np.abs(fine[of])) + (b - a) * np.max(np.abs(fine[rate])))
                change = float(ends[of][1] - ends[of][0])
                # the sizes the kernel measures against: the largest of the run
                if ".position" in of:
                    size = max(size, self.length)
                elif of.endswith(".angle"):
                    size = max(size, 1e-3)  # rad
                elif "angular_velocity" in of:
                    size = max(size, self.speed[f"{body.name}.w"])
                elif ".velocity" in of:
                    size = max(size, self.speed[body.name])
                allowed = SLACK * self.tol * size + 1e-12 * size + 100 * abs(one - two)
                if "velocity" in of:
                    allowed += self.carried[f"{body.name}.w" if "angular" in of else body.name]
                yield of, rate.split(".")[1], change - two, allowed

    def balance(self, rng: np.random.Generator, begin: float, end: float) -> None:
        """Kinetic + potential + dissipated - work is constant, and the kinetic energy right."""
        if "energy.kinetic" not in self.result:
            return
        now = self.result.at(np.sort(rng.uniform(begin, end, 8)))
        parts = [now[f"energy.{x}"] for x in ("kinetic", "potential", "dissipated", "work")]
        kinetic = np.zeros(8)
        look = self.look(begin, {})
        for b in self.scene.bodies:
            speed = now[f"{b.name}.velocity.x"] ** 2 + now[f"{b.name}.velocity.y"] ** 2
            kinetic += b.mass.at(look) * speed / 2
            if b.turns:
                kinetic += inertia(b, look) * now[f"{b.name}.angular_velocity"] ** 2 / 2
        grid = sum(
            np.max(np.abs(self.result[f"energy.{x}"]))
            for x in ("kinetic", "potential", "dissipated", "work")
        )
        size = float(np.max(self.result["energy.kinetic"]))
        for x, y, t in zip(kinetic, parts[0], now_times(now), strict=True):
            self.found.hold("kinetic energy", float(x - y), 1e-11 * size, t, "energy")
        total = parts[0] + parts[1] + parts[2] - parts[3]
        now_here = self.mechanics(end)
        grid += 1e-6 * float(np.max(now_here.load_size.reshape(-1, 3)[:, :2])) * self.length
        steps = max(1, len(self.result.events))
        allowed = 1e4 * steps * self.tol * float(grid) + 1e-10 * float(grid)
        self.found.hold(
            "energy balance", float(np.max(total) - np.min(total)), allowed, begin, "energy"
        )
        fall = float(np.min(np.diff(parts[2]), initial=0.0))
        self.found.hold(
            "dissipated", fall, (SLACK * self.tol + 1e-12) * float(grid), begin, "energy"
        )


def now_times(now: Mapping[str, Floats]) -> Floats:
    return now["time"] if "time" in now else np.zeros(8)
