"""Frot: the texts of the four scenes with impacts, compiled before; the call `simulate` timed."""

from __future__ import annotations

import time
from functools import partial

import frot
from peers.impact_scenes import BALL, BILLIARD, BLOCK, CHAIN
from peers.interface import Outcome, Setting

NAME = "Frot"
NOTES = {
    "ball": "`contact_ponctuel` with `restitution(1)`; the whole call `simulate`",
    "block": "`appui_faces` with `coulomb(3)`, no restitution",
    "billiard": "72 contacts with `restitution(1)`",
    "chain": "eleven contacts with `coulomb(0.3)`, no restitution",
}


def version() -> str:
    from importlib.metadata import version

    return version("frot")


def ball() -> str:
    """The text of the scene."""
    return f"""planar model Ball
      body b: disc(mass = 1 kg, radius = {BALL.radius} m);
      liaison c: contact_ponctuel(ground.line, b.rim) with restitution(1);
    initial
      b.position = (0, {BALL.radius + BALL.height}) m;
      experiment(stop = {BALL.stop} s);
    end Ball;"""


def block() -> str:
    """The text of the scene."""
    return f"""planar model Block
      body b: box(mass = 1 kg, size = ({BLOCK.wide}, {BLOCK.high}) m);
      liaison floor: appui_faces(b.bottom, ground.line) with coulomb({BLOCK.mu});
    initial
      guess(b.position = (0, {BLOCK.high / 2 + 0.01}) m);
      b.angle = {BLOCK.tilt};
      floor.gap = 0 m;
      b.velocity.x = 0 m/s;
      b.angular_velocity = 0 rad/s;
      experiment(stop = 30 s);
    end Block;"""


def billiard() -> str:
    """The text of the scene."""
    x, y = BILLIARD.half
    walls = {"s": (0, -y, 1, 0), "e": (x, 0, 0, 1), "n": (0, y, -1, 0), "w": (-x, 0, 0, -1)}
    lines = ["planar model Billiard", "world(gravity = 0 m/s^2);"]
    count = len(BILLIARD.places)
    disc = f"disc(mass = {BILLIARD.mass} kg, radius = {BILLIARD.radius} m)"
    lines += [f"body b{k}: {disc};" for k in range(count)]
    for n, (px, py, dx, dy) in walls.items():
        through = f"line(through = ({px}, {py}) m, direction = ({dx}, {dy}))"
        lines.append(f"curve w{n} on ground: {through};")
    law = "with restitution(1)"
    for k in range(count):
        lines += [f"liaison c{k}{n}: contact_ponctuel(w{n}, b{k}.rim) {law};" for n in walls]
        pairs = [f"p{j}_{k}: contact_ponctuel(b{j}.rim, b{k}.rim)" for j in range(k)]
        lines += [f"liaison {pair} {law};" for pair in pairs]
    lines.append("initial")
    for k, (px, py) in enumerate(BILLIARD.places):
        u, v = BILLIARD.speed if k == 0 else (0.0, 0.0)
        lines.append(f"b{k}.position = ({px}, {py}) m; b{k}.velocity = ({u}, {v}) m/s;")
    return "\n".join([*lines, "experiment(stop = 30 s);", "end Billiard;"])


def chain() -> str:
    """The text of the scene."""
    law = f"with coulomb({CHAIN.mu})"
    lines = ["planar model Chain"]
    n = CHAIN.rods
    rod = f"rod(mass = {CHAIN.mass} kg, length = {CHAIN.length} m)"
    lines += [f"body b{k}: {rod};" for k in range(n)]
    lines += [f"liaison h{k}: rotoide(b{k - 1}.tip, b{k}.start);" for k in range(1, n)]
    ends = ["b0.start", *(f"b{k}.tip" for k in range(n))]
    for k, end in enumerate(ends):
        lines.append(f"liaison c{k}: contact_ponctuel(ground.line, {end}) {law};")
    lines.append("initial")
    for k, ((x, y), a) in enumerate(zip(CHAIN.places, CHAIN.angles, strict=True)):
        lines.append(f"guess(b{k}.position = ({x}, {y}) m); guess(b{k}.angle = {a});")
    return "\n".join([*lines, f"experiment(stop = {CHAIN.stop} s);", "end Chain;"])


TEXTS = {"ball": ball, "block": block, "billiard": billiard, "chain": chain}


def settings(scene: str, times: dict[str, tuple[float, float]]) -> list[Setting]:
    model = frot.compile(TEXTS[scene]())
    model.program()
    tolerances = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
    return [
        Setting(
            "events, order 8",
            f"tolerance {x:.0e}",
            "evaluations",
            partial(run, model, scene, x, times),
        )
        for x in tolerances
    ]


def run(
    model: frot.Model, scene: str, tolerance: float, times: dict[str, tuple[float, float]]
) -> Outcome:
    """A run to the end, and places at the instant that is compared."""
    compared, stop = times[scene]
    begun = time.perf_counter()
    result = model.simulate(stop=stop, tolerance=tolerance, interval=stop)
    wall = time.perf_counter() - begun
    end = result.at(compared)
    if scene == "block":
        places = [float(end["b.angle"])]
    elif scene == "ball":
        places = [float(end["b.position.y"])]
    else:
        count = len(BILLIARD.places) if scene == "billiard" else CHAIN.rods
        places = [float(end[f"b{k}.position.{x}"]) for k in range(count) for x in "xy"]
    last = result.at(result.time[-1])
    kinetic = float(last["energy.kinetic"]) if "energy.kinetic" in last else 0.0
    return Outcome(
        tuple(places), kinetic, wall, result.figures.evaluations, result.figures.wall_time
    )
