"""A scene as a text in Frot."""

from __future__ import annotations

from judge.collisions.scene import ImpactScene
from judge.scene import Body, Contact, Force, Line, Pin, Point, Scene
from judge.space.scene import END, SpaceScene
from judge.values import DIMENSIONS, Value

UNITS = {
    "Real": "",
    "Angle": " rad",
    "Mass": " kg",
    "Length": " m",
    "Time": " s",
    "Velocity": " m/s",
    "AngularVelocity": " rad/s",
    "Acceleration": " m/s^2",
    "Force": " N",
    "Torque": " N.m",
    "Inertia": " kg.m^2",
    "Stiffness": " N/m",
    "Damping": " N.s/m",
}


def write(
    scene: Scene | SpaceScene | ImpactScene,
    values: dict[str, float] | None = None,
    experiment: str = "",
    *,
    small: bool = False,
) -> str:
    """The scene's text; `values` become the defaults of its parameters (1 where not given).

    Without an `experiment` the end of the run is the parameter `END`. With `small` the values are
    written in g, mm and ms.
    """
    if isinstance(scene, (SpaceScene, ImpactScene)):
        return scene.text(values, experiment)
    lines = [f"planar model {scene.name}"]
    if scene.gravity is not None:
        down = "" if scene.down == "-y" else f", down = {scene.down}"
        lines.append(f"  world(gravity = {scene.gravity.text}{down});")
    for word, kind in scene.parameters.items():
        number = float((values or {}).get(word, 1.0))
        written = _small(number, kind) if small else f"{number!r}{UNITS[kind]}"
        lines.append(f"  parameter {kind} {word} = {written};")
    if not experiment:
        lines.append(f"  parameter Time {END} = 1 s;")
        experiment = f"stop = {END}"
    lines += [_body(b) for b in scene.bodies]
    lines += [
        f"  frame {p.text} on {_owner(p.body)} at ({p.at[0].text}, {p.at[1].text});"
        for p in scene.points
    ]
    lines += [_line(c) for c in scene.lines if c.through is not None]
    lines += [_contact(c) for c in scene.contacts]
    lines += [_pin(p) for p in scene.pins]
    lines += [_force(f) for f in scene.forces]
    lines += [f"  output Force told_{word} = {word}.force.x;" for word in scene.told]
    if scene.statements:
        lines += ["initial", *(f"  {s};" for s in scene.statements)]
    told = ", ".join(x for x in (experiment, f"on_indeterminate = {scene.indeterminate}") if x)
    lines += [f"  experiment({told});", f"end {scene.name};", ""]
    return "\n".join(lines)


def _small(x: float, kind: str) -> str:
    """A number in g, mm and ms; what has no dimension stays."""
    powers = DIMENSIONS[kind]
    units = tuple(zip(("g", "mm", "ms"), powers, strict=True))
    above = [u if p == 1 else f"{u}^{p}" for u, p in units if p > 0]
    below = [u if p == -1 else f"{u}^{-p}" for u, p in units if p < 0]
    unit = ".".join(above) or ("rad" if kind in ("Angle", "AngularVelocity") else "")
    power = sum(powers)
    number = x * 1e3**power if power >= 0 else x / 1e3**-power
    return f"{number!r} {'/'.join([unit, *below])}".rstrip()


def _owner(body: Body | None) -> str:
    return "ground" if body is None else body.name


def _body(b: Body) -> str:
    rest = ""
    if b.size is not None:
        rest = f", {'length' if b.shape == 'rod' else 'radius'} = {b.size.text}"
    if b.inertia is not None:
        rest += f", inertia = {b.inertia.text}"
    return f"  body {b.name}: {b.shape}(mass = {b.mass.text}{rest});"


def _line(c: Line) -> str:
    assert c.through is not None
    x, y = c.through
    return (
        f"  curve {c.name} on {_owner(c.owner)}: line(through = ({x.text}, {y.text}), "
        f"direction = (cos({c.angle.text}), sin({c.angle.text})));"
    )


def _contact(c: Contact) -> str:
    point = f"{c.rim.name}.rim" if c.rim is not None else _point(c.point)
    line = c.line.name if c.line.through is not None else "ground.line"
    ends = (line, point) if c.swapped else (point, line)
    usual = c.kind == "point_courbe"
    option = "" if c.bilateral == usual else f", unilateral = {str(not c.bilateral).lower()}"
    laws = []
    if c.mu is not None:
        laws.append(_coulomb(c.mu, c.mu_s))
    if c.delta is not None:
        laws.append(f"rolling_resistance({c.delta.text})")
    law = f" with {', '.join(laws)}" if laws else ""
    return f"  liaison {c.name}: {c.kind}({ends[0]}, {ends[1]}{option}){law};"


def _coulomb(mu: Value, mu_s: Value | None, radius: Value | None = None) -> str:
    rest = "" if mu_s is None else f", mu_s = {mu_s.text}"
    if radius is not None:
        rest += f", radius = {radius.text}"
    return f"coulomb({mu.text}{rest})"


def _point(p: Point | None) -> str:
    assert p is not None
    return p.text


def _pin(p: Pin) -> str:
    law = "" if p.mu is None else f" with {_coulomb(p.mu, p.mu_s, p.radius)}"
    return f"  liaison {p.name}: rotoide({p.a.text}, {p.b.text}){law};"


def _place(p: Point) -> str:
    """A point of the ground may be given by its coordinates."""
    if p.body is None and not p.frame:
        return f"({p.at[0].text}, {p.at[1].text})"
    return p.text


def _force(f: Force) -> str:
    v = [x.text for x in f.values]
    p = [_place(x) for x in f.points]
    match f.kind:
        case "on":
            inside = f"{p[0]}, value = ({v[0]}, {v[1]})"
        case "couple":
            assert f.holder is not None
            inside = f"{f.holder.name}, value = {v[0]}"
        case "spring":
            inside = f"{p[0]}, {p[1]}, k = {v[0]}, length = {v[1]}"
        case "damper":
            inside = f"{p[0]}, {p[1]}, c = {v[0]}"
        case "attraction":
            inside = f"{p[0]}, {p[1]}, k = {v[0]}"
        case _:
            inside = f"{p[0]}, {v[0]}" + (", exponent = 2" if f.exponent == 2 else "")
    return f"  force {f.name}: {f.kind}({inside});"
