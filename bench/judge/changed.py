"""Scenes made from others: renamed, several in one, turned and mirrored, in another order."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from judge.family import Random
from judge.mechanics import AXES
from judge.scene import Body, Contact, Force, Line, Pair, Pin, Point, Scene
from judge.values import Value, as_value

WORD = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.\w+)*")
# The one parameter that all groups of a scene have in common.
COMMON = ("g",)


def put_in(v: Value, words: Mapping[str, Value]) -> Value:
    """The expression with variables of these names replaced."""
    if not any(w in words for w in WORD.findall(v.text)):
        return v
    text = WORD.sub(lambda m: words[m[0]].text if m[0] in words else m[0], v.text)
    return Value(text, lambda look: v.at(lambda w: words[w].at(look) if w in words else look(w)))


class Rebuilt:
    """A scene with every value, place and name mapped; the scene keeps its order."""

    def __init__(
        self,
        scene: Scene,
        value: Callable[[Value], Value] = lambda v: v,
        name: Callable[[str], str] = lambda n: n,
    ) -> None:
        self.value, self.name = value, name
        s = Scene(scene.name, {name(k): x for k, x in scene.parameters.items()})
        s.gravity = self.maybe(scene.gravity)
        s.down, s.indeterminate = scene.down, scene.indeterminate
        self.bodies: dict[str, Body] = {b.name: self._body(b) for b in scene.bodies}
        s.bodies = list(self.bodies.values())
        s.points = [self.point(p) for p in scene.points]
        self.lines = {c.name: self.line(c) for c in scene.lines}
        s.lines = list(self.lines.values())
        s.contacts = [self._contact(c) for c in scene.contacts]
        self.pins = {p.name: self._pin(p) for p in scene.pins}
        s.pins = list(self.pins.values())
        s.forces = [self.force(f) for f in scene.forces]
        s.statements = [self.statement(x) for x in scene.statements]
        s.told = [name(w) for w in scene.told]
        self.scene = s

    def maybe(self, v: Value | None) -> Value | None:
        """The value mapped, if there is one."""
        return None if v is None else self.value(v)

    def pair(self, at: Pair) -> Pair:
        """Both values mapped."""
        return self.value(at[0]), self.value(at[1])

    def of(self, b: Body | None) -> Body | None:
        """The body of this scene that stands for one of the first; None is the ground."""
        return None if b is None else self.bodies[b.name]

    def _body(self, b: Body) -> Body:
        inertia, size = self.maybe(b.inertia), self.maybe(b.size)
        return Body(self.name(b.name), b.shape, self.value(b.mass), size, inertia)

    def point(self, p: Point) -> Point:
        """The same place."""
        return replace(p, body=self.of(p.body), at=self.pair(p.at), text=self.statement(p.text))

    def line(self, c: Line) -> Line:
        """The same line."""
        through = None if c.through is None else self.pair(c.through)
        return Line(self.statement(c.name), self.of(c.owner), through, self.value(c.angle))

    def _contact(self, c: Contact) -> Contact:
        return replace(
            c,
            name=self.name(c.name),
            line=self.lines.get(c.line.name) or self.line(c.line),
            point=None if c.point is None else self.point(c.point),
            rim=self.of(c.rim),
            mu=self.maybe(c.mu),
            mu_s=self.maybe(c.mu_s),
            delta=self.maybe(c.delta),
        )

    def _pin(self, p: Pin) -> Pin:
        law = self.maybe(p.mu), self.maybe(p.mu_s), self.maybe(p.radius)
        return Pin(self.name(p.name), self.point(p.a), self.point(p.b), *law)

    def force(self, f: Force) -> Force:
        """The same force."""
        holder = f.holder
        if isinstance(holder, Pin):
            holder = self.pins[holder.name]
        elif isinstance(holder, Body):
            holder = self.bodies[holder.name]
        return replace(
            f,
            name=self.name(f.name),
            points=tuple(self.point(p) for p in f.points),
            values=tuple(self.value(v) for v in f.values),
            holder=holder,
        )

    def statement(self, text: str) -> str:
        """A statement with its names mapped."""

        def renamed(m: re.Match[str]) -> str:
            first, dot, rest = m[0].partition(".")
            return self.name(first) + dot + rest

        return WORD.sub(renamed, text)


def names_of(scene: Scene) -> set[str]:
    """All names that a scene gives."""
    things = (scene.bodies, scene.lines, scene.contacts, scene.pins, scene.forces)
    found = {x.name for kind in things for x in kind}  # type: ignore[attr-defined]
    return found | {p.text for p in scene.points if p.frame} | set(scene.parameters)


def renamed(scene: Scene, new: Callable[[str], str]) -> Scene:
    """The scene under other names; those it does not give itself stay."""
    own = names_of(scene)

    def name(word: str) -> str:
        return new(word) if word in own else word

    def value(v: Value) -> Value:
        def whole(word: str) -> str:
            first, dot, rest = word.partition(".")
            return name(first) + dot + rest

        text = WORD.sub(lambda m: whole(m[0]), v.text)
        return Value(text, lambda look: v.at(lambda w: look(whole(w))))

    return Rebuilt(scene, value, name).scene


def together(scenes: Sequence[Scene]) -> Scene:
    """All groups in one scene; their names differ but for the gravity they have in common."""
    s = Scene("Groups", gravity=scenes[0].gravity, down=scenes[0].down)
    for one in scenes:
        s.parameters |= one.parameters
        for kind in ("bodies", "points", "lines", "contacts", "pins", "forces"):
            getattr(s, kind).extend(getattr(one, kind))
        s.statements += one.statements
        s.told += one.told
    return s


def reordered(scene: Scene, rng: Random) -> Scene:
    """Everything declared in another order, under names that sort otherwise, places swapped."""
    own = sorted(names_of(scene) - set(scene.parameters))
    numbers = rng.permutation(len(own))
    new = {word: f"n{int(k)}_{word}" for word, k in zip(own, numbers, strict=True)}
    s = renamed(scene, lambda word: new.get(word, word))
    for kind in ("bodies", "points", "lines", "contacts", "pins", "forces", "statements"):
        listed = getattr(s, kind)
        setattr(s, kind, [listed[int(k)] for k in rng.permutation(len(listed))])
    s.contacts = [
        replace(c, swapped=not c.swapped) if c.kind == "contact_ponctuel" else c for c in s.contacts
    ]
    return s


class Moved(Rebuilt):
    """A scene turned about the origin by `turn`, after it was mirrored (y to -y) with `flip` -1."""

    def __init__(self, scene: Scene, turn: float, flip: float) -> None:
        self.turn, self.flip = turn, flip
        self.c, self.s = direction(turn)
        self.words: dict[str, Value] = {}
        for b in scene.bodies:
            for what in ("position", "velocity"):
                x, y = (
                    Value(f"{b.name}.{what}.{a}", _looking(f"{b.name}.{what}.{a}")) for a in "xy"
                )
                self.words[f"{b.name}.{what}.x"] = x * self.c + y * self.s
                self.words[f"{b.name}.{what}.y"] = (y * self.c - x * self.s) * flip
        super().__init__(scene, lambda v: put_in(v, self.words))
        axis = self.around((as_value(AXES[scene.down][0]), as_value(AXES[scene.down][1])))
        along = tuple(v.at(_nothing) for v in axis)
        self.scene.down = next((w for w, d in AXES.items() if d == along), scene.down)
        self.scene.statements = self._statements(scene.statements)

    def around(self, at: Pair) -> Pair:
        """A vector of the ground."""
        x, y = at[0], at[1] * self.flip
        return x * self.c - y * self.s, x * self.s + y * self.c

    def point(self, p: Point) -> Point:
        """The same place of the moved scene."""
        x, y = self.pair(p.at)
        body = self.of(p.body)
        at = self.around((x, y)) if body is None else (x, y * self.flip)
        return replace(p, body=body, at=at)

    def line(self, c: Line) -> Line:
        """The same line of the moved scene."""
        assert c.through is not None
        x, y = self.pair(c.through)
        owner, angle = self.of(c.owner), self.value(c.angle) * self.flip
        if owner is None:
            return Line(c.name, None, self.around((x, y)), angle + self.turn)
        return Line(c.name, owner, (x, y * self.flip), angle)

    def force(self, f: Force) -> Force:
        """The same force on the moved scene."""
        moved = super().force(f)
        if f.kind == "on":
            return replace(moved, values=self.around((moved.values[0], moved.values[1])))
        if f.kind == "couple":
            return replace(moved, values=(moved.values[0] * self.flip,))
        return moved

    def statement(self, text: str) -> str:
        """Statements are moved two by two."""
        return text

    def _statements(self, given: Sequence[str]) -> list[str]:
        right = {left_of(x): right_of(x) for x in given}
        found = []
        for text in given:
            left, value = left_of(text), right_of(text)
            if left.endswith((".position", ".velocity")):
                x, y = value[1:-1].split(", ")
                value = "({}, {})".format(*self._two(x, y))
            elif left.endswith((".x", ".y")):
                pair = self._two(right[left[:-1] + "x"], right[left[:-1] + "y"])
                value = pair["xy".index(left[-1])]
            elif left.endswith(".angle"):
                value = f"({self.flip!r})*{value} + ({self.turn!r})"
            elif left.endswith(".angular_velocity"):
                value = f"({self.flip!r})*{value}"
            whole = f"{left} = {value}"
            found.append(f"guess({whole})" if text.startswith("guess(") else whole)
        stated = {left_of(x) for x in given}
        turning = (b.name for b in self.scene.bodies if b.turns)
        return found + [
            f"guess({b}.angle = {self.turn!r})" for b in turning if f"{b}.angle" not in stated
        ]

    def _two(self, x: str, y: str) -> tuple[str, str]:
        words = (Value(x, _nothing), Value(y, _nothing))
        one, two = self.around(words)
        return one.text, two.text


def direction(turn: float) -> tuple[float, float]:
    """Cosine and sine, exact for quarter turns."""
    quarters = turn / (math.pi / 2)
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(turn), math.sin(turn)


def weighed(scene: Scene) -> Scene:
    """The scene with its weights as forces, so that no axis is that of gravity."""
    s = Rebuilt(scene, lambda v: v).scene
    assert scene.gravity is not None
    for b in s.bodies:
        weight = (as_value(0.0) * scene.gravity * b.mass, -(scene.gravity * b.mass))
        s.forces.append(Force(f"weight_{b.name}", "on", (s.middle(b),), weight))
    s.gravity = scene.gravity * 0.0
    return s


def left_of(statement: str) -> str:
    return statement.removeprefix("guess(").split(" = ")[0]


def right_of(statement: str) -> str:
    text = statement.split(" = ")[1]
    return text[:-1] if statement.startswith("guess(") else text


def _looking(word: str) -> Callable[[Callable[[str], float]], float]:
    return lambda look: look(word)


def _nothing(_: object) -> float:
    raise NotImplementedError
