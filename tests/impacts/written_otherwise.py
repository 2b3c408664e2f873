"""Scenes with impacts, written in other units, in turned or mirrored axes, in another order."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]
MIRROR = np.diag([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Way:
    """How a scene is written: `small` in mm, g and ms; turned about `axis`; mirrored in y."""

    small: bool = False
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mirrored: bool = False
    reverse: bool = False

    @property
    def matrix(self) -> Floats:
        """Vectors of this scene by those of the first one."""
        turn = Rotation.from_rotvec(self.turn).as_matrix()
        return np.asarray(turn @ MIRROR if self.mirrored else turn)

    @property
    def sign(self) -> float:
        """Of vectors that are products of two, as angular velocities."""
        return -1.0 if self.mirrored else 1.0


class Writer:
    """Writes statements of a planar scene, or of one in space, in one way."""

    def __init__(self, plane: bool, way: Way) -> None:
        self.plane, self.way = plane, way
        self.lines: list[str] = []
        self.starts: list[str] = []

    def number(self, x: float, unit: str) -> str:
        """A number in SI, written with its unit or a smaller one."""
        small = {"m": ("mm", 1e3), "kg": ("g", 1e3), "m/s": ("mm/ms", 1.0)}
        small |= {"rad/s": ("rad/ms", 1e-3), "m/s^2": ("mm/ms^2", 1e-3), "N.s": ("g.mm/ms", 1e3)}
        if self.way.small and unit in small:
            unit, factor = small[unit]
            x *= factor
        return f"{x!r} {unit}".rstrip()

    def vector(self, v: Floats, unit: str, sign: float = 1.0) -> str:
        """A vector in the axes of this way."""
        turned = sign * self.way.matrix @ v
        return (
            f"({', '.join(self.number(float(x), unit) for x in turned[: 2 if self.plane else 3])})"
        )

    def add(self, *lines: str) -> None:
        """Declarations."""
        self.lines += [f"  {x};" for x in lines]

    def body(
        self,
        name: str,
        shape: str,
        sizes: dict[str, float],
        at: tuple[float, ...],
        speed: tuple[float, ...],
        turn: tuple[float, ...] = (0, 0, 0),
        spin: tuple[float, ...] = (0, 0, 0),
        guess: bool = False,
    ) -> None:
        """A body with its start; `turn` is a rotation vector."""
        inside = ", ".join(
            f"{k} = {self.number(x, 'kg' if k == 'mass' else 'm')}" for k, x in sizes.items()
        )
        self.add(f"body {name}: {shape}({inside})")
        said = [f"{name}.position = {self.vector(np.array(at), 'm')}"]
        said.append(f"{name}.velocity = {self.vector(np.array(speed), 'm/s')}")
        whole = self.way.matrix @ Rotation.from_rotvec(turn).as_matrix()
        whole = whole @ MIRROR if self.way.mirrored else whole
        if shape == "particle":
            pass
        elif self.plane:
            said.append(f"{name}.angle = {math.atan2(whole[1, 0], whole[0, 0])!r}")
            said.append(
                f"{name}.angular_velocity = {self.number(self.way.sign * spin[2], 'rad/s')}"
            )
        else:
            x, y, z, w = (float(k) for k in Rotation.from_matrix(whole).as_quat())
            said.append(f"{name}.orientation = ({w!r}, {x!r}, {y!r}, {z!r})")
            turning = self.vector(np.array(spin), "rad/s", self.way.sign)
            said.append(f"{name}.angular_velocity = {turning}")
        self.starts += [f"  guess({x});" if guess else f"  {x};" for x in said]

    def wall(self, name: str, at: tuple[float, ...], normal: tuple[float, ...]) -> None:
        """A wall through a place, with its normal."""
        n = [float(x) for x in self.way.matrix @ np.array(normal)]
        through = self.vector(np.array(at), "m")
        if self.plane:
            way = f"({n[1]!r}, {-n[0]!r})"
            self.add(f"curve {name} on ground: line(through = {through}, direction = {way})")
        else:
            way = f"({n[0]!r}, {n[1]!r}, {n[2]!r})"
            self.add(f"surface {name} on ground: plane(through = {through}, normal = {way})")

    def frame(self, name: str, at: tuple[float, ...]) -> None:
        """A place on the ground."""
        self.add(f"frame {name} on ground at {self.vector(np.array(at), 'm')}")

    def text(self, stop: float) -> str:
        """All of it; `reverse` writes liaisons and bodies from the last to the first."""
        down = -self.way.matrix @ np.array([0.0, 1.0, 0.0] if self.plane else [0.0, 0.0, 1.0])
        shown = ", ".join(repr(float(x)) for x in down[: 2 if self.plane else 3])
        world = f"  world(gravity = {self.number(9.81, 'm/s^2')}, down = ({shown}));"
        lines = self.lines
        if self.way.reverse:
            kinds = ("body", "frame", "curve", "surface", "liaison", "force")
            lines = [x for k in kinds for x in reversed(lines) if x.split()[0] == k]
        head = "planar model Scene" if self.plane else "model Scene"
        end = f"  experiment(stop = {stop!r} s);"
        return "\n".join([head, world, *lines, "initial", *self.starts, end, "end Scene;", ""])


def thrown_rod(way: Way) -> str:
    """A rod thrown on a ramp, with friction; both ends strike."""
    w = Writer(True, way)
    w.body(
        "a", "rod", {"mass": 1.3, "length": 0.6}, (0, 0.6, 0), (0.7, 0, 0), (0, 0, 0.4), (0, 0, 3)
    )
    w.wall("ramp", (0, 0, 0), (-math.sin(0.2), math.cos(0.2), 0))
    for end in ("tip", "start"):
        w.add(
            f"liaison c_{end}: contact_ponctuel(a.{end}, ramp) with coulomb(0.3), restitution(0.6)"
        )
    return w.text(0.7)


def chain(way: Way) -> str:
    """Two hinged rods that fall on a floor; the first hinge is dry and has a stop."""
    w = Writer(True, way)
    w.frame("bracket", (0, 0.8, 0))
    w.body("a", "rod", {"mass": 1.0, "length": 0.6}, (0.3, 0.8, 0), (0, 0, 0), guess=True)
    w.body("b", "rod", {"mass": 0.5, "length": 0.5}, (0.85, 0.8, 0), (0, 0, 0), guess=True)
    w.wall("floor", (0, 0, 0), (0, 1, 0))
    w.add(
        f"liaison h: rotoide(bracket, a.start) with coulomb(0.2, radius = {w.number(0.01, 'm')})",
        "liaison k: rotoide(a.tip, b.start) with stops(min = -0.4 rad, max = 0.4 rad, e = 0.5)",
        "liaison c: contact_ponctuel(b.tip, floor) with coulomb(0.4), "
        "restitution(0.5, rule = poisson)",
    )
    return w.text(0.75)


def discs(way: Way) -> str:
    """A disc rolls against another one at rest, which strikes a wall."""
    w = Writer(True, way)
    w.body(
        "a", "disc", {"mass": 1.0, "radius": 0.1}, (0, 0.1, 0), (1.5, 0, 0), (0, 0, 0), (0, 0, -9)
    )
    w.body("b", "ring", {"mass": 0.6, "radius": 0.12}, (0.4, 0.12, 0), (0, 0, 0))
    w.wall("floor", (0, 0, 0), (0, 1, 0))
    w.wall("side", (0.7, 0, 0), (-1, 0, 0))
    w.add(
        "liaison fa: contact_ponctuel(floor, a.rim) with coulomb(0.2), restitution(0.3)",
        "liaison fb: contact_ponctuel(floor, b.rim) with coulomb(0.3), restitution(0.3)",
        "liaison ab: contact_ponctuel(a.rim, b.rim) with coulomb(0.1), restitution(0.8)",
        "liaison sb: contact_ponctuel(side, b.rim) with coulomb(0.2), restitution(0.7)",
    )
    return w.text(0.6)


def ball_in_space(way: Way) -> str:
    """A ball with spin between a ramp and a wall."""
    w = Writer(False, way)
    at, spin = (0.0, 0.0, 0.5), (10.0, -6.0, 3.0)
    w.body("a", "sphere", {"mass": 0.4, "radius": 0.1}, at, (1.0, 0.4, -1), (0.2, 0.1, 0), spin)
    w.wall("ramp", (0, 0, 0), (0.1, -0.2, 1.0))
    w.wall("side", (0.6, 0, 0), (-1, 0.1, 0))
    for wall in ("ramp", "side"):
        w.add(
            f"liaison on_{wall}: contact_ponctuel({wall}, a.surface) with coulomb(0.25), "
            "restitution(0.7, rule = newton)"
        )
    return w.text(0.9)


def rod_in_space(way: Way) -> str:
    """A rod that falls on a rough floor; its slip turns within the impacts."""
    w = Writer(False, way)
    spin = (0.0, 2.0, 0.0)
    turn = (0.0, 0.5, 0.0)
    w.body("a", "rod", {"mass": 0.8, "length": 0.7}, (0, 0, 0.6), (0.8, 0.6, 0), turn, spin)
    w.wall("floor", (0, 0, 0), (0, 0, 1))
    for end in ("tip", "start"):
        w.add(
            f"liaison c_{end}: contact_ponctuel(a.{end}, floor) with coulomb(0.2), restitution(0.5)"
        )
    return w.text(0.5)


def cord_in_space(way: Way) -> str:
    """A ball on a cord that comes taut, and strikes another one."""
    w = Writer(False, way)
    w.frame("hook", (0, 0, 1))
    w.body("a", "sphere", {"mass": 0.5, "radius": 0.05}, (0.5, 0.1, 0.9), (0, 0.5, 0))
    w.body("b", "sphere", {"mass": 0.7, "radius": 0.05}, (0.42, 0.2, 0.2), (0, 0, 1), (0.3, 0, 0))
    w.add(
        f"liaison cord: fil(hook, a, length = {w.number(0.8, 'm')}) with restitution(0.3)",
        "liaison ab: contact_ponctuel(a.surface, b.surface) with coulomb(0.3), restitution(0.8)",
    )
    return w.text(0.6)


SCENES = {
    f.__name__: f for f in (thrown_rod, chain, discs, ball_in_space, rod_in_space, cord_in_space)
}
