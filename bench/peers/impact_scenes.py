"""Four scenes with impacts as numbers, and their exact or converged values. SI units throughout.

ball: an elastic ball bounces a thousand times. block: a slender block rocks, a hundred blows.
billiard: nine elastic smooth balls, two hundred impacts. chain: ten rods fall on a rough table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

GRAVITY = 9.81
SCENES = ("ball", "block", "billiard", "chain")


@dataclass(frozen=True, slots=True)
class Ball:
    """Dropped from rest; it is at its first height again after each two times of fall."""

    radius: float = 0.05
    height: float = 0.1
    bounces: int = 1000

    @property
    def stop(self) -> float:
        """The highest place after the last bounce."""
        return 2 * self.bounces * math.sqrt(2 * self.height / GRAVITY)


@dataclass(frozen=True, slots=True)
class Block:
    """Tilted on one corner and let go, without restitution (G. Housner 1963)."""

    wide: float = 0.06
    high: float = 0.6
    tilt: float = 0.05
    mu: float = 3.0
    blows: int = 100


@dataclass(frozen=True, slots=True)
class Billiard:
    """The first ball is shot at a loose triangle of eight; no friction, no gravity.

    Errors grow by some ten times an impact, so places are compared after `compared` impacts.
    """

    radius: float = 0.03
    mass: float = 0.17
    half: tuple[float, float] = (0.8, 0.4)
    speed: tuple[float, float] = (2.0, 0.03)
    impacts: int = 200
    compared: int = 10

    @property
    def places(self) -> list[tuple[float, float]]:
        """Of the balls at the start."""
        rack = [(0.1 + 0.1 * i, -0.05 * i + 0.1 * j) for i in range(4) for j in range(i + 1)]
        return [(-0.5, 0.01), *rack[:8]]


@dataclass(frozen=True, slots=True)
class Chain:
    """Pinned rods in a wave above a table, let go; their ends strike it without restitution.

    The third impact is near 0.27 s; `compared` is a time after it, `stop` one of rest.
    """

    rods: int = 10
    length: float = 0.1
    mass: float = 0.1
    mu: float = 0.3
    stop: float = 1.0
    compared: float = 0.28

    @property
    def angles(self) -> list[float]:
        """Of the rods at the start."""
        return [0.2 + 0.3 * math.sin(k) for k in range(self.rods)]

    @property
    def places(self) -> list[tuple[float, float]]:
        """Centres of the rods at the start."""
        x, y, found = 0.0, 0.3, []
        for a in self.angles:
            dx, dy = self.length * math.cos(a), self.length * math.sin(a)
            found.append((x + dx / 2, y + dy / 2))
            x, y = x + dx, y + dy
        return found


BALL, BLOCK, BILLIARD, CHAIN = Ball(), Block(), Billiard(), Chain()
