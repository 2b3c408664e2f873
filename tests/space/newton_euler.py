"""Newton-Euler residuals in space, from a result alone: plain numpy, nothing of the compiler."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from frot.runtime.result import Result

GRAVITY = np.array([0.0, 0.0, -9.81])


@dataclass(frozen=True)
class Body:
    """Mass and principal moments about G along the body's axes."""

    name: str
    mass: float
    moments: tuple[float, float, float]


@dataclass(frozen=True)
class Place:
    """A point of a body (None: the ground) in its axes at G, or in those of the ground."""

    body: str | None
    local: tuple[float, float, float]


@dataclass(frozen=True)
class Link:
    """A liaison whose reaction acts at the place b, or where `at` tells for an instant."""

    name: str
    a: Place
    b: Place
    at: Callable[[object], np.ndarray] | None = None


def box(name: str, mass: float, size: Sequence[float]) -> Body:
    """A homogeneous box."""
    a, b, c = (s**2 / 12 for s in size)
    return Body(name, mass, (mass * (b + c), mass * (c + a), mass * (a + b)))


def axes(r: np.ndarray) -> np.ndarray:
    """Unit vectors of a body's axes, as columns, from the quaternion w, x, y, z."""
    w, v = r[0], r[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


def vector(at: object, name: str) -> np.ndarray:
    """A vector of a result at an instant."""
    return np.array([at[f"{name}.{c}"] for c in "xyz"], dtype=float)  # type: ignore[index]


def orientation(at: object, body: str) -> np.ndarray:
    """The quaternion of a body."""
    return np.array([at[f"{body}.orientation[{k}]"] for k in range(1, 5)], dtype=float)  # type: ignore[index]


def place_of(at: object, place: Place) -> np.ndarray:
    """Ground coordinates of a place."""
    local = np.array(place.local)
    if place.body is None:
        return local
    turned = axes(orientation(at, place.body)) @ local
    return vector(at, f"{place.body}.position") + turned


def residual(
    result: Result,
    bodies: Sequence[Body],
    links: Sequence[Link],
    times: Sequence[float],
    gravity: np.ndarray = GRAVITY,
) -> float:
    """Largest part of the forces and couples on any body that its motion leaves unexplained."""
    worst = 0.0
    for t in times:
        at = result.at(t)
        for body in bodies:
            turn = axes(orientation(at, body.name))
            inertia = turn @ np.diag(body.moments) @ turn.T
            omega = vector(at, f"{body.name}.angular_velocity")
            alpha = vector(at, f"{body.name}.angular_acceleration")
            centre = vector(at, f"{body.name}.position")
            force = body.mass * (gravity - vector(at, f"{body.name}.acceleration"))
            couple = -inertia @ alpha - np.cross(omega, inertia @ omega)
            size = np.abs(force).max() + np.abs(couple).max() + body.mass * 9.81
            for link in links:
                for sign, own in ((1, link.b), (-1, link.a)):
                    if own.body != body.name:
                        continue
                    reaction = sign * vector(at, f"{link.name}.force")
                    force = force + reaction
                    there = place_of(at, link.b) if link.at is None else link.at(at)
                    arm = there - centre
                    couple = couple + np.cross(arm, reaction)
                    couple = couple + sign * vector(at, f"{link.name}.torque")
                    size += np.abs(reaction).max()
            worst = max(worst, np.abs(force).max() / size, np.abs(couple).max() / size)
    return worst
