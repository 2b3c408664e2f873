"""A scene with impacts as data, and its text in Frot. Numbers are parameters, by their names.

A planar scene is one in space whose bodies move in the plane z = 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from judge.space.scene import END, UNITS

RULES = ("energetic", "poisson", "newton")


@dataclass(frozen=True, slots=True)
class Body:
    """`shape` of the catalogue; sizes are parameters that end in the name of the body.

    `corners` of a polygon are in parts of the parameter `l_name`, from its centroid.
    """

    name: str
    shape: str
    corners: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Place:
    """A point of a body (None: the ground), at parts of its sizes along its axes.

    With `named` the place is at the parameters x_ y_ z_ of that name.
    """

    body: Body | None
    parts: tuple[float, float, float] = (0.0, 0.0, 0.0)
    named: str = ""


@dataclass(frozen=True, slots=True)
class Wall:
    """A line or plane of a body (None: the ground) through x_ y_ z_, its normal at angles a_, b_.

    Of a body it goes through its centre along its x axis. With `moves` the wall goes up and down by
    h_ sin(w_ time) along y (z in space).
    """

    name: str
    body: Body | None = None
    moves: bool = False


@dataclass(frozen=True, slots=True)
class Touch:
    """A contact that can part, or a bound.

    `kind`: wall (a place, or the rim of a body, on a wall), pair (rims, or a place and a rim), cord
    (places no further apart than l_name), min and max (a bound lo_ or hi_ of the joint `of`).
    Coefficients are mu_, more_ (static over kinetic) and e_ of the parameter name `law`.
    """

    name: str
    kind: str
    a: Place | None = None
    b: Place | None = None
    wall: Wall | None = None
    of: Joint | None = None
    law: str = ""
    rule: str = "energetic"


@dataclass(frozen=True, slots=True)
class Joint:
    """rotoide, spherique or prismatique of two places; with `dry` a bearing mu_ of radius r_.

    A rotoide in space turns about the y axis of both; a slide goes along the x axis of a.
    """

    name: str
    kind: str
    a: Place
    b: Place
    dry: bool = False


@dataclass(frozen=True, slots=True)
class Percussion:
    """An impulse px_ py_ pz_ at a place at the time t_."""

    name: str
    at: Place


@dataclass(slots=True)
class ImpactScene:
    """All of a scene; `parameters` by name and type. `guessed` bodies start by guesses."""

    name: str
    plane: bool
    parameters: dict[str, str] = field(default_factory=lambda: {"g": "Acceleration"})
    bodies: list[Body] = field(default_factory=list)
    walls: list[Wall] = field(default_factory=list)
    touches: list[Touch] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    percussions: list[Percussion] = field(default_factory=list)
    guessed: bool = False

    @property
    def axes(self) -> str:
        """The coordinates of a place."""
        return "xy" if self.plane else "xyz"

    def add(self, word: str, kinds: Mapping[str, str]) -> None:
        """Parameters of a thing: `key_word` each."""
        self.parameters |= {f"{key}_{word}": kind for key, kind in kinds.items()}

    def text(self, values: Mapping[str, float] | None = None, experiment: str = "") -> str:
        """The scene in Frot; `values` become the defaults of its parameters."""
        from judge.collisions.write import text_of

        return text_of(self, values or {}, experiment)


__all__ = [
    "END",
    "RULES",
    "UNITS",
    "Body",
    "ImpactScene",
    "Joint",
    "Percussion",
    "Place",
    "Touch",
    "Wall",
]
