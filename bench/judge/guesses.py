"""Families whose start is guessed: places in part, speeds that enter closed contacts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from judge.anything import Maker, stands_alone
from judge.family import Family, Random, Setting, Structure, in_units
from judge.mechanics import Mechanics
from judge.scene import Contact

OPEN_PART = 0.4


class Loose(Maker):
    """Some coordinates are guessed, not quite as they fit; contacts are open or closed."""

    def __init__(self, rng: Random) -> None:
        super().__init__(rng)
        self.guessed = True
        self.open: set[str] = set()

    def gap(self, rng: Random, contact: Contact) -> float:
        """Contacts that are open start apart."""
        return float(rng.uniform(0.05, 0.5)) if contact.name in self.open else 0.0

    def start(self) -> None:
        """Guesses of some coordinates, gaps of some contacts that are closed."""
        super().start()
        for c in self.s.contacts:
            if c.kind == "point_courbe" and self.rng.random() < 0.5:
                along = self.s.parameter(f"along_{c.name}", "Length")
                self.s.statements.append(f"guess({c.name}.abscissa = {along.text})")
        parting = [c.name for c in self.s.contacts if not c.bilateral]
        self.open = {n for n in parting if self.rng.random() < OPEN_PART}
        kept = self.rng.random()
        self.s.statements = [
            x
            for x in self.s.statements
            if x.split(".gap")[0] not in self.open
            and self.rng.random() < (kept if x.startswith("guess(") else 0.5)
        ]

    def draw(self, rng: Random) -> Setting:
        """A setting whose guesses are missed by some tenths."""
        drawn = super().draw(rng)
        m, x, t = drawn.units
        setting = in_units(self.s, drawn, 1 / m, 1 / x, 1 / t)
        wide = float(rng.choice([0.0, 0.3]))
        for word in setting.values:
            if word[1:].startswith("0_") and word[0] in "xyauvw":
                setting.values[word] += wide * float(rng.normal())
        return in_units(self.s, replace(setting, start_known=False), m, x, t)


class Pressed(Maker):
    """Contacts are stated to be closed; speeds, guessed or stated, may go into them."""

    def __init__(self, rng: Random) -> None:
        super().__init__(rng)
        self.guessed = True
        self.stated = bool(rng.random() < 0.3)

    def start(self) -> None:
        """Places are guessed, and speeds too unless they are stated."""
        super().start()
        if self.stated:
            self.s.statements = [
                x[6:-1] if x.startswith("guess(") and "velocity" in x else x
                for x in self.s.statements
            ]

    def move(
        self,
        rng: Random,
        values: dict[str, float],
        state: dict[str, list[float]],
        sides: dict[str, int],
    ) -> None:
        """Random speeds that keep what cannot part, and go into a contact or from it."""
        for b in self.s.bodies:
            state[b.name][3:] = [
                float(rng.uniform(-2, 2)),
                float(rng.uniform(-2, 2)),
                float(rng.uniform(-4, 4)) if b.turns else 0.0,
            ]
        now = Mechanics(
            self.s,
            lambda word: values.get(word, 0.0),
            {k: tuple(v) for k, v in state.items()},
            sides,
        )
        rows = []
        for joint in now.joints.values():
            c = joint.liaison
            free = isinstance(c, Contact) and not c.bilateral
            if not free:
                rows += [r.jacobian for w, r in joint.rows.items() if w in "xyn"]
        if rows:
            matrix = np.array(rows)
            for _ in range(2):
                now.speed = now.speed - np.linalg.pinv(matrix, rcond=1e-10) @ (matrix @ now.speed)
        for b in self.s.bodies:
            k = now.at[b.name]
            state[b.name][3:] = [x if abs(x) > 1e-14 else 0.0 for x in now.speed[k : k + 3]]


def loose(rng: Random) -> Structure:
    """A scene of which little is said at the start."""
    while True:
        made = Loose(rng).make()
        if stands_alone(made, rng):
            return made


def pressed(rng: Random) -> Structure:
    """Bodies on contacts that are stated to be closed."""
    while True:
        maker = Pressed(rng)
        made = maker.make()
        parting = any(not c.bilateral for c in made.scene.contacts)
        if parting and stands_alone(made, rng):
            return replace(made, speeds="stated" if maker.stated else "guessed")


FAMILIES = (
    Family("loose", loose, 1, 12, "guesses that hold in part, contacts open or closed"),
    Family("pressed", pressed, 1.5, 12, "speeds into contacts that are stated to be closed"),
)
