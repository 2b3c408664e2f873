"""Random planar scenes of several groups that nothing binds together.

A group is one or two bodies on lines that they may leave or not, open or closed at the start, with
guesses of all places. It can be written in other units and in axes turned by right angles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

# Sense of gravity after 0, 1, 2, 3 right angles.
DOWN = ("-y", "+x", "+y", "-x")


@dataclass(frozen=True)
class Axes:
    """Axes turned by right angles, and whether lengths are in mm and masses in g."""

    turns: int = 0
    small_units: bool = False

    def length(self, *values: float) -> str:
        """One length, or several in parentheses."""
        return self._given(values, 1000.0 if self.small_units else 1.0, "m")

    def mass(self, value: float) -> str:
        """A mass."""
        return self._given((value,), 1000.0 if self.small_units else 1.0, "g")

    def _given(self, values: Iterable[float], size: float, unit: str) -> str:
        numbers = [repr(float(x) * size) for x in values]
        small = {"m": "mm", "g": "g"}[unit] if self.small_units else {"m": "m", "g": "kg"}[unit]
        inside = numbers[0] if len(numbers) == 1 else f"({', '.join(numbers)})"
        return f"{inside} {small}"

    def turned(self, x: float, y: float) -> tuple[float, float]:
        """A vector of the ground."""
        for _ in range(self.turns % 4):
            x, y = -y, x
        return x, y

    def place(self, x: float, y: float) -> str:
        """A place on the ground."""
        return self.length(*self.turned(x, y))

    def speed(self, x: float, y: float) -> str:
        """A velocity."""
        return self.place(x, y) + "/s"

    def angle(self, value: float) -> str:
        """The angle of a body."""
        return repr(value + self.turns * math.pi / 2)


PLAIN = Axes()


@dataclass
class Group:
    """How one group is written in some axes: declarations and initial equations."""

    name: str
    bodies: list[str] = field(default_factory=list)
    contacts: list[str] = field(default_factory=list)
    _body: list[Callable[[Axes], str]] = field(default_factory=list)
    _initial: list[Callable[[Axes], str]] = field(default_factory=list)

    def declare(self, write: Callable[[Axes], str]) -> None:
        """Add a declaration."""
        self._body.append(write)

    def state(self, write: Callable[[Axes], str]) -> None:
        """Add an initial equation or a guess."""
        self._initial.append(write)

    def written(self, axes: Axes) -> tuple[str, str]:
        """Declarations and initial equations."""
        body = "\n".join(f"  {write(axes)}" for write in self._body)
        return body, "\n".join(f"  {write(axes)}" for write in self._initial)


def text_of(groups: Iterable[Group], gravity: float, axes: Axes = PLAIN, stop: float = 0.3) -> str:
    """The model of some groups."""
    world = f"gravity = {axes.length(gravity)}/s^2, down = {DOWN[axes.turns % 4]}"
    body, initial = (
        "\n".join(parts) for parts in zip(*(g.written(axes) for g in groups), strict=True)
    )
    return (
        f"planar model Drawn\n  world({world});\n{body}\ninitial\n{initial}\n"
        f"  experiment(stop = {stop} s, tolerance = 1e-10);\nend Drawn;\n"
    )


def draw_group(chance: np.random.Generator, name: str) -> Group:
    """A rod or a disc on one or two lines, sometimes with a bead on a line of its own."""
    group = Group(name)
    draw = chance.choice(np.array([_rod, _feet, _disc], dtype=object))
    draw(chance, group)
    return group


def _number(chance: np.random.Generator, low: float = -1, high: float = 1) -> float:
    return float(chance.uniform(low, high))


def _mass(chance: np.random.Generator) -> float:
    return float(10 ** chance.uniform(-0.5, 0.5))


def _guess(chance: np.random.Generator, group: Group, body: str, turns: bool) -> None:
    x, y, angle = _number(chance), _number(chance), _number(chance, -3, 3)
    u, v, w = (_number(chance, -0.5, 0.5) for _ in range(3))
    moves = chance.random() < 0.6
    group.state(lambda a: f"guess({body}.position = {a.place(x, y)});")
    if turns:
        group.state(lambda a: f"guess({body}.angle = {a.angle(angle)});")
    if moves:
        group.state(lambda a: f"guess({body}.velocity = {a.speed(u, v)});")
    if moves and turns and chance.random() < 0.5:
        group.state(lambda a: f"guess({body}.angular_velocity = {w!r} rad/s);")


def _line(chance: np.random.Generator, group: Group, name: str) -> None:
    x, y, angle = _number(chance), _number(chance), _number(chance, -3.1, 3.1)

    def write(a: Axes) -> str:
        dx, dy = a.turned(math.cos(angle), math.sin(angle))
        through = f"through = {a.place(x, y)}"
        return f"curve {name} on ground: line({through}, direction = ({dx!r}, {dy!r}));"

    group.declare(write)


def _contact(
    chance: np.random.Generator, group: Group, name: str, place: str, line: str, bound: float = 0.3
) -> None:
    """A liaison that may part, closed by its gap or not, or one that cannot."""
    kind, law = chance.random(), chance.choice(["", " with coulomb(0.3)"], p=[0.7, 0.3])
    order = f"{place}, {line}" if chance.random() < 0.5 else f"{line}, {place}"
    if kind < bound:
        group.declare(lambda _: f"liaison {name}: point_courbe({place}, {line});")
        return
    group.contacts.append(name)
    group.declare(lambda _: f"liaison {name}: contact_ponctuel({order}){law};")
    if chance.random() < 0.5:
        group.state(lambda a: f"{name}.gap = {a.length(0.0)};")


def _rod(chance: np.random.Generator, group: Group) -> None:
    rod, bead = f"rod{group.name}", f"bead{group.name}"
    mass, long = _mass(chance), _number(chance, 0.5, 1.5)
    group.bodies.append(rod)
    group.declare(lambda a: f"body {rod}: rod(mass = {a.mass(mass)}, length = {a.length(long)});")
    _guess(chance, group, rod, True)
    _line(chance, group, f"l{group.name}")
    _contact(chance, group, f"tip{group.name}", f"{rod}.tip", f"l{group.name}")
    if chance.random() < 0.5:
        _line(chance, group, f"m{group.name}")
        _contact(chance, group, f"end{group.name}", f"{rod}.start", f"m{group.name}")
        return
    own, x, y, angle = _mass(chance), *(_number(chance, -0.4, 0.4) for _ in range(3))
    group.bodies.append(bead)
    group.declare(lambda a: f"body {bead}: particle(mass = {a.mass(own)});")
    group.declare(
        lambda a: (
            f"curve n{group.name} on {rod}: line(through = {a.length(x, y)}, "
            f"direction = ({math.cos(angle)!r}, {math.sin(angle)!r}));"
        )
    )
    _guess(chance, group, bead, False)
    _contact(chance, group, f"rides{group.name}", bead, f"n{group.name}", bound=0.6)


def _feet(chance: np.random.Generator, group: Group) -> None:
    slab, mass = f"slab{group.name}", _mass(chance)
    group.bodies.append(slab)
    group.declare(lambda a: f"body {slab}: disc(mass = {a.mass(mass)}, radius = {a.length(0.5)});")
    _guess(chance, group, slab, True)
    _line(chance, group, f"l{group.name}")
    for k in (1, 2):
        x, y = _number(chance, -0.6, 0.6), _number(chance, -0.6, 0.6)
        group.declare(
            lambda a, k=k, x=x, y=y: f"frame f{k}{group.name} on {slab} at {a.length(x, y)};"
        )
        _contact(chance, group, f"foot{k}{group.name}", f"f{k}{group.name}", f"l{group.name}", 0.2)


def _disc(chance: np.random.Generator, group: Group) -> None:
    disc, mass, radius = f"disc{group.name}", _mass(chance), _number(chance, 0.1, 0.5)
    group.bodies.append(disc)
    group.declare(
        lambda a: f"body {disc}: disc(mass = {a.mass(mass)}, radius = {a.length(radius)});"
    )
    _guess(chance, group, disc, True)
    for k in range(int(chance.integers(1, 3))):
        _line(chance, group, f"l{k}{group.name}")
        _contact(chance, group, f"rim{k}{group.name}", f"{disc}.rim", f"l{k}{group.name}", 0.0)
