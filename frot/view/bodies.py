"""Outlines of bodies: one row for each shape, in the body's axes at G."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from frot.view.outline import (
    Array,
    Outline,
    along,
    around,
    band,
    box,
    chain,
    ellipsoid,
    lamina,
    plate,
    together,
    torus,
    tube,
)


@dataclass(frozen=True, slots=True)
class Look:
    """`small` is the size (m) of what has none of its own, as a particle."""

    planar: bool
    small: float


Arguments = Mapping[str, Array]
_Make = Callable[[Arguments, Look], Outline]


def _spoke(radius: float) -> Outline:
    """A radius that shows how something round turns."""
    return chain([(0, 0, 0), (radius, 0, 0)])


def _particle(given: Arguments, look: Look) -> Outline:
    return plate(around(look.small)) if look.planar else ellipsoid((look.small,) * 3)


def _rod(given: Arguments, look: Look) -> Outline:
    """Slender: as thick as can be seen."""
    long, thick = float(given["length"]), 0.5 * look.small
    if not look.planar:
        return tube(thick, long).moved(along((1, 0, 0)), (0, 0, 0))
    arc = np.linspace(-np.pi / 2, np.pi / 2, 12)
    right = np.column_stack((long / 2 + thick * np.cos(arc), thick * np.sin(arc), 0 * arc))
    return plate(np.vstack((right, -right)))


def _disc(given: Arguments, look: Look) -> Outline:
    radius = float(given["radius"])
    return together((plate(around(radius)), _spoke(radius)))


def _ring(given: Arguments, look: Look) -> Outline:
    radius = float(given["radius"])
    if not look.planar:
        return torus(radius, 0.05 * radius)
    return together((band(around(radius), around(0.9 * radius)), _spoke(radius)))


def _ellipse(given: Arguments, look: Look) -> Outline:
    a, b = float(given["a"]), float(given["b"])
    return together((plate(around(a, b)), _spoke(a)))


def _ball(given: Arguments, look: Look) -> Outline:
    return ellipsoid((float(given["radius"]),) * 3)


def _ellipsoid(given: Arguments, look: Look) -> Outline:
    a, b, c = (float(x) for x in np.ravel(given["semi_axes"]))
    return ellipsoid((a, b, c))


def _cylinder(given: Arguments, look: Look) -> Outline:
    return tube(float(given["radius"]), float(given["length"]))


def _box(given: Arguments, look: Look) -> Outline:
    size = np.ravel(given["size"])
    if len(size) == 3:
        return box(size)
    x, y = size / 2
    return plate(np.array([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)]))


def _polygon(given: Arguments, look: Look) -> Outline:
    corners = np.asarray(given["vertices"], dtype=float).reshape(-1, 2)
    after = np.roll(corners, -1, axis=0)
    parts = corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]
    centroid = ((corners + after) * parts[:, None]).sum(axis=0) / (3 * parts.sum())
    return lamina(corners - centroid)


def _solid(given: Arguments, look: Look) -> Outline:
    """The mark of G: nothing is known of its shape but what is fixed to it."""
    if look.planar:
        rim = around(0.8 * look.small)
        cross = [chain([a, -a]) for a in (rim[0], rim[len(rim) // 4])]
        return together((plate(rim), *cross))
    return ellipsoid((0.8 * look.small,) * 3)


SHAPES: Mapping[str, _Make] = {
    "box": _box,
    "cylinder": _cylinder,
    "disc": _disc,
    "ellipse": _ellipse,
    "ellipsoid": _ellipsoid,
    "particle": _particle,
    "polygon": _polygon,
    "ring": _ring,
    "rod": _rod,
    "shell": _ball,
    "solid": _solid,
    "sphere": _ball,
}


def outline_of(shape: str, given: Arguments, look: Look) -> Outline:
    """The outline of a body; a shape of the text is one given by its mass and inertia."""
    return SHAPES.get(shape, _solid)(given, look)
