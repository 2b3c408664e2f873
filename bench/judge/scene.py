"""A planar scene as data: bodies, points, lines, liaisons, laws, forces, start."""

from __future__ import annotations

from dataclasses import dataclass, field

from judge.values import Value, as_value

Pair = tuple[Value, Value]


@dataclass(frozen=True, slots=True)
class Body:
    """`shape` is particle, rod, disc or ring; `size` the length or radius; `inertia` overrides."""

    name: str
    shape: str
    mass: Value
    size: Value | None = None
    inertia: Value | None = None

    @property
    def turns(self) -> bool:
        """A particle has no angle."""
        return self.shape != "particle"


@dataclass(frozen=True, slots=True)
class Point:
    """A point of a body (None: the ground), at `at` in its axes; `text` names it in Frot.

    With `frame` the text declares a frame of that name.
    """

    body: Body | None
    at: Pair
    text: str
    frame: bool = False


@dataclass(frozen=True, slots=True)
class Line:
    """`owner` None is the ground; direction at the angle `angle` in the owner's axes.

    `through` None is `ground.line`.
    """

    name: str
    owner: Body | None
    through: Pair | None
    angle: Value


@dataclass(frozen=True, slots=True)
class Contact:
    """A point (or the rim of a body that is given as `rim`) on a line."""

    name: str
    line: Line
    point: Point | None = None
    rim: Body | None = None
    bilateral: bool = False
    kind: str = "contact_ponctuel"
    swapped: bool = False
    mu: Value | None = None
    mu_s: Value | None = None
    delta: Value | None = None

    @property
    def body(self) -> Body | None:
        """The body whose point or rim it is."""
        if self.rim is not None:
            return self.rim
        assert self.point is not None
        return self.point.body


@dataclass(frozen=True, slots=True)
class Pin:
    """Two points that coincide, with a dry bearing of radius `radius` or without."""

    name: str
    a: Point
    b: Point
    mu: Value | None = None
    mu_s: Value | None = None
    radius: Value | None = None


@dataclass(frozen=True, slots=True)
class Force:
    """`kind` of the catalogue with its points and values in its order.

    on: (point), (fx, fy); couple: body or pin, (value); spring: (a, b), (k, length); damper: (a, b)
    and (c); attraction: (point, centre), (k); drag: (point), (c), `exponent`.
    """

    name: str
    kind: str
    points: tuple[Point, ...] = ()
    values: tuple[Value, ...] = ()
    holder: Body | Pin | None = None
    exponent: int = 1


@dataclass(slots=True)
class Scene:
    """All of a scene. `statements` are lines of `initial`; `told` names liaisons put out.

    `down` is an axis with its sign, in which gravity acts.
    """

    name: str
    parameters: dict[str, str] = field(default_factory=dict)
    bodies: list[Body] = field(default_factory=list)
    points: list[Point] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    contacts: list[Contact] = field(default_factory=list)
    pins: list[Pin] = field(default_factory=list)
    forces: list[Force] = field(default_factory=list)
    statements: list[str] = field(default_factory=list)
    told: list[str] = field(default_factory=list)
    gravity: Value | None = None
    down: str = "-y"
    indeterminate: str = "rest"

    def parameter(self, word: str, kind: str) -> Value:
        """A run-time parameter of a type of the language."""
        from judge.values import name

        self.parameters[word] = kind
        return name(word)

    def body(self, word: str, shape: str) -> Body:
        """A body whose mass and size are the parameters `m_word` and `l_word`."""
        mass = self.parameter(f"m_{word}", "Mass")
        size = None if shape == "particle" else self.parameter(f"l_{word}", "Length")
        self.bodies.append(Body(word, shape, mass, size))
        return self.bodies[-1]

    def middle(self, body: Body) -> Point:
        """G of the body."""
        return Point(body, (as_value(0.0), as_value(0.0)), body.name)

    def end(self, body: Body, which: str) -> Point:
        """`start` or `tip` of a rod."""
        assert body.size is not None
        half = body.size * (0.5 if which == "tip" else -0.5)
        return Point(body, (half, as_value(0.0)), f"{body.name}.{which}")

    def frame(self, word: str, body: Body | None) -> Point:
        """A point at the parameters `x_word`, `y_word`."""
        x, y = self.parameter(f"x_{word}", "Length"), self.parameter(f"y_{word}", "Length")
        self.points.append(Point(body, (x, y), word, frame=True))
        return self.points[-1]

    def line(self, word: str, owner: Body | None) -> Line:
        """A line through the parameters `x_word`, `y_word` at the angle `a_word`."""
        x, y = self.parameter(f"x_{word}", "Length"), self.parameter(f"y_{word}", "Length")
        self.lines.append(Line(word, owner, (x, y), self.parameter(f"a_{word}", "Angle")))
        return self.lines[-1]
