"""The text of a scene with impacts."""

from __future__ import annotations

from collections.abc import Mapping

from judge.collisions.scene import END, Body, ImpactScene, Joint, Place, Touch, Wall
from judge.space.scene import UNITS

SIZES = {
    "particle": {},
    "rod": {"l": "Length"},
    "disc": {"r": "Length"},
    "ring": {"r": "Length"},
    "sphere": {"r": "Length"},
    "polygon": {"l": "Length"},
}


def sizes_of(shape: str, plane: bool) -> dict[str, str]:
    """Keys and types of the sizes of a shape."""
    if shape == "box":
        return dict.fromkeys(("s1", "s2") if plane else ("s1", "s2", "s3"), "Length")
    return dict(SIZES[shape])


def text_of(scene: ImpactScene, values: Mapping[str, float], experiment: str) -> str:
    """The scene in Frot; `values` become the defaults of its parameters."""
    lines = [f"{'planar ' if scene.plane else ''}model {scene.name}", "  world(gravity = g);"]
    units = {**UNITS, "Momentum": " N.s", "Time": " s"}
    for word, kind in scene.parameters.items():
        lines.append(f"  parameter {kind} {word} = {values.get(word, 1.0)!r}{units[kind]};")
    if not experiment:
        lines.append(f"  parameter Time {END} = 1 s;")
        experiment = f"stop = {END}"
    lines += [_body(b, scene.plane) for b in scene.bodies]
    frames = {p.named: p for p in _places(scene) if p.named}
    axes = scene.axes
    for word, p in frames.items():
        place = ", ".join(f"{k}_{word}" for k in axes)
        lines.append(f"  frame {word} on {p.body.name if p.body else 'ground'} at ({place});")
    lines += [_wall(w, scene.plane) for w in scene.walls]
    lines += [_joint(scene, j) for j in scene.joints]
    lines += [_touch(scene, c) for c in scene.touches if c.of is None]
    for p in scene.percussions:
        push = ", ".join(f"p{k}_{p.name}" for k in axes)
        point = place_text(p.at, scene.plane)
        lines.append(f"  force {p.name}: impulse({point}, value = ({push}), at = t_{p.name});")
    lines += ["initial", *(x for b in scene.bodies for x in _start(scene, b))]
    lines += [f"  experiment({experiment});", f"end {scene.name};", ""]
    return "\n".join(lines)


def _places(scene: ImpactScene) -> list[Place]:
    found = [p for c in scene.touches for p in (c.a, c.b) if p]
    found += [p for j in scene.joints for p in (j.a, j.b)]
    return found + [p.at for p in scene.percussions]


def place_text(p: Place, plane: bool) -> str:
    """The name of a place, such as `b.tip` or `b.corners[2]`."""
    if p.named:
        return p.named
    assert p.body is not None
    b = p.body
    if not any(p.parts):
        return b.name
    if b.shape == "rod":
        return f"{b.name}.{'tip' if p.parts[0] > 0 else 'start'}"
    if b.shape == "polygon":
        return f"{b.name}.corners[{b.corners.index(p.parts[:2]) + 1}]"
    return f"{b.name}.corners[{corners(plane).index(p.parts) + 1}]"


def corners(plane: bool) -> list[tuple[float, float, float]]:
    """Corners of a box in half sizes, in the order of the language."""
    around = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    if plane:
        return [(x, y, 0.0) for x, y in around]
    return [(x, y, z) for z in (-1.0, 1.0) for x, y in around]


def _body(b: Body, plane: bool) -> str:
    n = b.name
    match b.shape:
        case "particle":
            inside = f"mass = m_{n}"
        case "rod":
            inside = f"mass = m_{n}, length = l_{n}"
        case "box":
            size = ", ".join(f"{k}_{n}" for k in sizes_of("box", plane))
            inside = f"mass = m_{n}, size = ({size})"
        case "polygon":
            every = ", ".join(f"({x!r}*l_{n}, {y!r}*l_{n})" for x, y in b.corners)
            inside = f"mass = m_{n}, vertices = ({every})"
        case _:
            inside = f"mass = m_{n}, radius = r_{n}"
    return f"  body {n}: {b.shape}({inside});"


def _wall(w: Wall, plane: bool) -> str:
    n = w.name
    wave = f" + h_{n}*sin(w_{n}*time)" if w.moves else ""
    if w.body is not None:
        owner = f"  curve {n} on {w.body.name}: line(through = (0, 0) m, direction = (1, 0));"
        return (
            owner
            if plane
            else owner.replace("curve", "surface").split(":")[0]
            + (": plane(through = (0, 0, 0) m, normal = (0, 0, 1));")
        )
    if plane:
        at = f"(x_{n}, y_{n}{wave})"
        return f"  curve {n} on ground: line(through = {at}, direction = (cos(a_{n}), sin(a_{n})));"
    at = f"(x_{n}, y_{n}, z_{n}{wave})"
    up = f"(sin(a_{n})*cos(b_{n}), sin(a_{n})*sin(b_{n}), cos(a_{n}))"
    return f"  surface {n} on ground: plane(through = {at}, normal = {up});"


def _joint(scene: ImpactScene, j: Joint) -> str:
    a, b = (place_text(p, scene.plane) for p in (j.a, j.b))
    axis = ", axis = y" if j.kind == "rotoide" and not scene.plane else ""
    axis = ", axis = x" if j.kind == "prismatique" else axis
    axis = "" if scene.plane else axis
    laws = [f"coulomb(mu_{j.name}, radius = r_{j.name})"] if j.dry else []
    bounds = [c for c in scene.touches if c.of == j]
    if bounds:
        laws.append(f"stops(lo_{j.name}, hi_{j.name}, e = e_{bounds[0].law})")
    law = f" with {', '.join(laws)}" if laws else ""
    return f"  liaison {j.name}: {j.kind}({a}, {b}{axis}){law};"


def _touch(scene: ImpactScene, c: Touch) -> str:
    give = f"restitution(e_{c.law}, rule = {c.rule})"
    if c.kind == "cord":
        assert c.a is not None and c.b is not None
        ends = ", ".join(place_text(p, scene.plane) for p in (c.a, c.b))
        return f"  liaison {c.name}: fil({ends}, length = l_{c.name}) with {give};"
    ends = [_figure(scene, p) for p in (c.a, c.b) if p is not None]
    if c.wall is not None:
        ends.append(c.wall.name)
    rough = f"coulomb(mu_{c.law}, mu_s = mu_{c.law}*more_{c.law}), "
    return f"  liaison {c.name}: contact_ponctuel({', '.join(ends)}) with {rough}{give};"


def _figure(scene: ImpactScene, p: Place) -> str:
    """The rim of a round body, else the point."""
    b = p.body
    if b is not None and b.shape in ("disc", "ring", "sphere") and not p.named:
        return f"{b.name}.{'surface' if b.shape == 'sphere' else 'rim'}"
    return place_text(p, scene.plane)


def _start(scene: ImpactScene, b: Body) -> list[str]:
    n, axes = b.name, scene.axes
    said = [f"{n}.position = ({', '.join(f'{k}0_{n}' for k in axes)})"]
    said.append(f"{n}.velocity = ({', '.join(f'{k}0_{n}' for k in 'uvw'[: len(axes)])})")
    if b.shape != "particle":
        if scene.plane:
            said += [f"{n}.angle = a0_{n}", f"{n}.angular_velocity = o0_{n}"]
        else:
            said.append(f"{n}.orientation = ({', '.join(f'q{k}_{n}' for k in range(1, 5))})")
            said.append(f"{n}.angular_velocity = (o1_{n}, o2_{n}, o3_{n})")
    if scene.guessed:
        return [f"  guess({x});" for x in said]
    return [f"  {x};" for x in said]
