"""A mechanism in space as data, and its text in Frot. Numbers are parameters, by their names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Triple = tuple[float, float, float]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
DOWN = {"-z": (0.0, 0.0, -1.0), "+x": X, "-y": (0.0, -1.0, 0.0), "+z": Z}

UNITS = {
    "Real": "",
    "Angle": " rad",
    "Mass": " kg",
    "Length": " m",
    "Velocity": " m/s",
    "AngularVelocity": " rad/s",
    "Acceleration": " m/s^2",
    "Force": " N",
    "Torque": " N.m",
    "Inertia": " kg.m^2",
    "Stiffness": " N/m",
    "Damping": " N.s/m",
}
END = "T_end"

SHAPES = {
    "solid": "solid(mass = m_{0}, inertia = (i1_{0}, i2_{0}, i3_{0}))",
    "box": "box(mass = m_{0}, size = (s1_{0}, s2_{0}, s3_{0}))",
    "sphere": "sphere(mass = m_{0}, radius = r_{0})",
    "cylinder": "cylinder(mass = m_{0}, radius = r_{0}, length = l_{0})",
}
SIZES = {
    "solid": {"i1": "Inertia", "i2": "Inertia", "i3": "Inertia"},
    "box": {"s1": "Length", "s2": "Length", "s3": "Length"},
    "sphere": {"r": "Length"},
    "cylinder": {"r": "Length", "l": "Length"},
}


@dataclass(frozen=True, slots=True)
class Solid:
    """A rigid body; its sizes are parameters that end in its name."""

    name: str
    shape: str


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame on a body (None: the ground) at x_ y_ z_, turned about e1_ e2_ e3_ by a_."""

    name: str
    body: Solid | None


@dataclass(frozen=True, slots=True)
class Link:
    """A liaison of two frames, or of the plane of a frame (z = 0) and a point or a sphere.

    `axis` is in the axes of both frames; `drive` is the coordinate that d0_ + w_*time prescribes.
    Links of one `plane` have planes that are parallel.
    """

    name: str
    kind: str
    a: Frame
    b: Frame
    axis: Triple = Z
    axis_b: Triple = Y
    drive: str = ""
    plane: str = ""


@dataclass(frozen=True, slots=True)
class Push:
    """`on` a frame, `couple` of a body, `spring` or `damper` between two frames."""

    name: str
    kind: str
    frames: tuple[Frame, ...] = ()
    body: Solid | None = None


@dataclass(slots=True)
class SpaceScene:
    """All of a mechanism; `parameters` by name and type."""

    name: str
    down: str = "-z"
    parameters: dict[str, str] = field(default_factory=dict)
    bodies: list[Solid] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    pushes: list[Push] = field(default_factory=list)

    def add(self, word: str, kinds: Mapping[str, str]) -> None:
        """Parameters of a thing: `key_word` each."""
        self.parameters |= {f"{key}_{word}": kind for key, kind in kinds.items()}

    def body(self, word: str, shape: str) -> Solid:
        """A body with its sizes and the guesses of its start."""
        self.add(word, {"m": "Mass", **SIZES[shape]})
        self.add(word, dict.fromkeys(("x0", "y0", "z0"), "Length"))
        self.add(word, dict.fromkeys(("q1", "q2", "q3", "q4"), "Real"))
        self.add(word, dict.fromkeys(("u0", "v0", "w0"), "Velocity"))
        self.add(word, dict.fromkeys(("o1", "o2", "o3"), "AngularVelocity"))
        self.bodies.append(Solid(word, shape))
        return self.bodies[-1]

    def frame(self, word: str, body: Solid | None) -> Frame:
        """A frame at its own parameters."""
        self.add(word, {"x": "Length", "y": "Length", "z": "Length"})
        self.add(word, {"e1": "Real", "e2": "Real", "e3": "Real", "a": "Angle"})
        self.frames.append(Frame(word, body))
        return self.frames[-1]

    def text(self, values: Mapping[str, float] | None = None, experiment: str = "") -> str:
        """The scene in Frot; `values` become the defaults of its parameters."""
        lines = [f"model {self.name}", f"  world(gravity = g, down = {self.down});"]
        given = dict(values or {})
        for word, kind in {"g": "Acceleration", **self.parameters}.items():
            lines.append(f"  parameter {kind} {word} = {given.get(word, 1.0)!r}{UNITS[kind]};")
        if not experiment:
            lines.append(f"  parameter Time {END} = 1 s;")
            experiment = f"stop = {END}"
        lines += [f"  body {b.name}: {SHAPES[b.shape].format(b.name)};" for b in self.bodies]
        lines += [
            f"  frame {f.name} on {'ground' if f.body is None else f.body.name} at (x_{f.name}, "
            f"y_{f.name}, z_{f.name}) rotated(axis = (e1_{f.name}, e2_{f.name}, e3_{f.name}), "
            f"angle = a_{f.name});"
            for f in self.frames
        ]
        for one in self.links:
            lines += _link(one)
        lines += [_push(p) for p in self.pushes]
        for one in self.links:
            lines.append(f"  output Force told_{one.name} = {one.name}.force;")
            lines.append(f"  output Torque turn_{one.name} = {one.name}.torque;")
        lines += ["initial", *(x for b in self.bodies for x in _start(b.name))]
        lines += [f"  experiment({experiment});", f"end {self.name};", ""]
        return "\n".join(lines)


def _start(b: str) -> list[str]:
    return [
        f"  guess({b}.position = (x0_{b}, y0_{b}, z0_{b}));",
        f"  guess({b}.orientation = (q1_{b}, q2_{b}, q3_{b}, q4_{b}));",
        f"  guess({b}.velocity = (u0_{b}, v0_{b}, w0_{b}));",
        f"  guess({b}.angular_velocity = (o1_{b}, o2_{b}, o3_{b}));",
    ]


def _vector(v: Triple) -> str:
    return f"({v[0]!r}, {v[1]!r}, {v[2]!r})"


def _link(c: Link) -> list[str]:
    a, b, axis = c.a.name, c.b.name, _vector(c.axis)
    drive = ""
    if c.drive:
        drive = f" driven({c.drive} = d0_{c.name} + w_{c.name}*time)"
    match c.kind:
        case "point_surface" | "contact" | "ball":
            plane = (
                f"  surface s_{c.name} on {a}: plane(through = (0, 0, 0) m, normal = (0, 0, 1));"
            )
            point = f"{c.b.body.name}.surface" if c.kind == "ball" and c.b.body else b
            if c.kind == "point_surface":
                return [plane, f"  liaison {c.name}: point_surface({point}, s_{c.name});"]
            return [
                plane,
                f"  liaison {c.name}: contact_ponctuel(s_{c.name}, {point}, unilateral = false);",
            ]
        case "tige":
            inside = f"{a}, {b}, length = l_{c.name}"
        case "helicoidale":
            inside = f"{a}, {b}, axis = {axis}, pitch = p_{c.name}"
        case "cardan":
            inside = f"{a}, {b}, axis_a = {axis}, axis_b = {_vector(c.axis_b)}"
        case "spherique" | "encastrement":
            inside = f"{a}, {b}"
        case "appui_plan":
            inside = f"{a}, {b}, normal = {axis}"
        case _:
            inside = f"{a}, {b}, axis = {axis}"
    return [f"  liaison {c.name}: {c.kind}({inside}){drive};"]


def _push(p: Push) -> str:
    n = p.name
    wave = f"sin(w_{n}*time)"
    match p.kind:
        case "on":
            value = ", ".join(f"{k}_{n}*{wave}" for k in ("fx", "fy", "fz"))
            return f"  force {n}: on({p.frames[0].name}, value = ({value}));"
        case "couple":
            assert p.body is not None
            value = ", ".join(f"{k}_{n}*{wave}" for k in ("cx", "cy", "cz"))
            return f"  force {n}: couple({p.body.name}, value = ({value}));"
        case "spring":
            ends = ", ".join(f.name for f in p.frames)
            return f"  force {n}: spring({ends}, k = k_{n}, length = l_{n});"
        case _:
            ends = ", ".join(f.name for f in p.frames)
            return f"  force {n}: damper({ends}, c = c_{n});"
