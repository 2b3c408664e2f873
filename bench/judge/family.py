"""What a family of scenes gives: a structure to compile once, and settings of its parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from judge.scene import Scene
from judge.values import DIMENSIONS

if TYPE_CHECKING:
    from judge.others import Other

Random = np.random.Generator


@dataclass(slots=True)
class Setting:
    """Values of all parameters, the end of the run and its tolerance, in SI."""

    values: dict[str, float]
    stop: float
    tolerance: float = 1e-8
    compare: bool = False
    start_known: bool = True
    units: tuple[float, float, float] = (1.0, 1.0, 1.0)


@dataclass(slots=True)
class Structure:
    """A scene, a function that draws settings, and scenes that must move as it does.

    `speeds`, "guessed" or "stated", may go into contacts that are stated to be closed.
    """

    scene: Scene
    draw: Callable[[Random], Setting]
    others: list[Other] = field(default_factory=list)
    speeds: str = ""


@dataclass(frozen=True, slots=True)
class Family:
    """`make` builds a structure; of `structures` texts each gets a share of the runs."""

    name: str
    make: Callable[[Random], Structure]
    weight: float
    settings: int
    what: str


def in_units(scene: Scene, setting: Setting, mass: float, length: float, time: float) -> Setting:
    """The same motion in other units: every parameter is scaled by its dimension."""
    values = {}
    for name, x in setting.values.items():
        a, b, c = DIMENSIONS[scene.parameters[name]]
        values[name] = x * mass**a * length**b * time**c
    m, x, t = setting.units
    units = (m * mass, x * length, t * time)
    return replace(setting, values=values, stop=setting.stop * time, units=units)


def decades(rng: Random, most: float = 6.0) -> tuple[float, float, float]:
    """Units of mass, length and time: in half of all cases the usual ones."""
    if rng.random() < 0.5:
        return 1.0, 1.0, 1.0
    m, x, t = (float(np.round(rng.uniform(-most, most))) for _ in range(3))
    return 10.0**m, 10.0**x, 10.0**t


def some_tolerance(rng: Random) -> float:
    return float(10.0 ** np.round(rng.uniform(-11.5, -3.5)))
