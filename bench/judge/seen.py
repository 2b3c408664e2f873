"""A result as the judge sees it: its variables at instants, its sizes, and what was found in it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from judge.mechanics import Floats, Joint, Mechanics, Row
from judge.motions import accelerations, parts
from judge.readings import state_of
from judge.scene import Pin, Scene
from judge.sides import start_sides

EXACT = 1e-8
SLACK = 300.0
OPEN, STICK, SLIP = 0, 1, 2
# Instants at which what loads would bring about is asked for: one at the start may bring nothing.
LOOKS = 5


# Part of an instant by which a record is read before it: an event is in effect some ulps earlier.
BEFORE = 1e-13


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


class Seen:
    """A scene with values of its parameters, and a result of it."""

    def __init__(self, scene: Scene, values: Mapping[str, float], result: Outcome, tol: float):
        self.scene, self.values, self.result, self.tol = scene, values, result, tol
        self.found = Findings()
        self.placed = True  # the scene says where every body starts
        self.sides: dict[str, int] = {}
        begin = float(result.time[0])
        self.sides = start_sides(scene, self.mechanics(begin, {}))
        self.length, self.speed = self._sizes()
        self._natural()
        self.joined = self._joined()

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

    def just_before(self, t: float) -> float:
        """The instant at which the record is read for what was before t."""
        return max(t - BEFORE * abs(t), float(self.result.time[0]))

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

    def _joined(self) -> dict[str, float]:
        """The largest speed (and angular) among the bodies that each is joined to.

        What loads would bring about counts too, where reactions take all of it away.
        """
        joined_to = {}
        now = self.mechanics(float(self.result.time[0]))
        looks = np.linspace(0, len(self.result.time) - 1, LOOKS).astype(int)
        instants = [self.mechanics(float(self.result.time[k])) for k in looks]
        quick = np.max([accelerations(x) for x in instants], axis=0)
        for places, _ in parts(now):
            joined = [self.scene.bodies[int(k) // 3] for k in places[:, 0]]
            natural = math.sqrt(self.length * float(np.max(quick[places[:, :2]])))
            largest = max(natural, *(self.speed[b.name] for b in joined))
            widths = [b.size.at(now.look) for b in joined if b.turns and b.size is not None]
            spins = [self.speed.get(f"{b.name}.w", 0.0) for b in joined]
            spin = max(*spins, *(natural / x for x in widths), 0.0)
            for b in joined:
                joined_to[b.name], joined_to[f"{b.name}.w"] = largest, spin
        return joined_to

    def kept(self, joint: Joint) -> bool:
        """Whether the liaison can never part."""
        return isinstance(joint.liaison, Pin) or joint.liaison.bilateral

    def usual(self, row: Row) -> float:
        """Size of the terms of a relative velocity with the largest speeds of the run."""
        largest = []
        for b in self.scene.bodies:
            largest += [self.speed[b.name]] * 2 + [self.speed.get(f"{b.name}.w", 0.0)]
        return float(row.reach @ np.array(largest))

    def spins(self) -> float:
        """The largest angular velocity of the run."""
        return max([v for k, v in self.speed.items() if k.endswith(".w")], default=0.0)
