"""The usual symbols of liaisons (ISO 3952) and forces: one row for each kind.

A symbol is 1 across; it stands in the axes of the liaison's place on its first body.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from frot.view.outline import (
    Array,
    Outline,
    along,
    around,
    band,
    box,
    chain,
    closed,
    ellipsoid,
    plate,
    sheet,
    together,
    tube,
)

Axes = Mapping[str, Array]
_Make = Callable[[Axes, bool], Outline]
SIDES = 20  # of what is round: symbols are small, and there are many


def _circle(radius: float) -> Array:
    return around(radius, count=SIDES)


def _about(outline: Outline, axis: Array) -> Outline:
    return outline.moved(along(axis), (0, 0, 0))


def _pin(axes: Axes, planar: bool) -> Outline:
    """A circle with its centre in the plane, a short cylinder in space."""
    if planar:
        return together(
            (
                band(around(0.5, count=SIDES), around(0.36, count=SIDES)),
                plate(around(0.12, count=SIDES)),
            )
        )
    return _about(tube(0.3, 1.0, sides=SIDES), axes["axis"])


def _weld(axes: Axes, planar: bool) -> Outline:
    cross = [chain([(-a, -0.4, 0), (a, 0.4, 0)]) for a in (-0.4, 0.4)]
    return together(cross) if planar else box((0.5, 0.5, 0.5))


def _slide(axes: Axes, planar: bool) -> Outline:
    """A sleeve along the axis."""
    if not planar:
        return _about(box((0.6, 0.6, 1.4)), axes["axis"])
    corners = np.array([(-0.7, -0.35, 0), (0.7, -0.35, 0), (0.7, 0.35, 0), (-0.7, 0.35, 0)])
    n = axes["axis"] / np.linalg.norm(axes["axis"])
    turned = np.array(((n[0], -n[1], 0), (n[1], n[0], 0), (0, 0, 1)))
    return chain(closed(corners)).moved(turned, (0, 0, 0))


def _sleeve(axes: Axes, planar: bool) -> Outline:
    return _about(tube(0.3, 1.6, ends=False, sides=SIDES), axes["axis"])


def _screw(axes: Axes, planar: bool) -> Outline:
    turn = np.linspace(0, 8 * np.pi, 8 * SIDES)
    helix = np.column_stack((0.32 * np.cos(turn), 0.32 * np.sin(turn), turn / (8 * np.pi) - 0.5))
    return _about(together((tube(0.28, 1.2, sides=SIDES), chain(helix))), axes["axis"])


def _cross(axes: Axes, planar: bool) -> Outline:
    """Two crossed pins."""
    pins = [_about(tube(0.14, 1.2, sides=SIDES), axes[k]) for k in ("axis_a", "axis_b")]
    return together(pins)


def _ball(axes: Axes, planar: bool) -> Outline:
    return ellipsoid((0.4, 0.4, 0.4), SIDES)


def _planes(axes: Axes, planar: bool) -> Outline:
    return _about(box((1.4, 1.4, 0.12)), axes["normal"])


def _dot(axes: Axes, planar: bool) -> Outline:
    return plate(_circle(0.22)) if planar else ellipsoid((0.22, 0.22, 0.22), SIDES)


def _nothing(axes: Axes, planar: bool) -> Outline:
    return chain([])


# Of liaisons; what touches is a dot where it touches.
LIAISONS: Mapping[str, _Make] = {
    "appui_faces": _nothing,
    "appui_plan": _planes,
    "cardan": _cross,
    "contact_ponctuel": _dot,
    "courbe_courbe": _dot,
    "encastrement": _weld,
    "fil": _nothing,
    "helicoidale": _screw,
    "libre": _nothing,
    "lineaire_annulaire": _ball,
    "lineaire_rectiligne": _dot,
    "point_courbe": _dot,
    "point_surface": _dot,
    "prismatique": _slide,
    "rotoide": _pin,
    "roulement": _dot,
    "spherique": _ball,
    "tige": _nothing,
    "verrou": _sleeve,
}


def _zigzag(small: float) -> Outline:
    t = np.linspace(0, 1, 27)
    wide = small * np.where((t > 0.1) & (t < 0.9), (-1.0) ** np.arange(27), 0)
    return chain(np.column_stack((wide, 0 * t, t)))


def _dashpot(small: float) -> Outline:
    cup = [(-small, 0, 0.7), (-small, 0, 0.35), (small, 0, 0.35), (small, 0, 0.7)]
    plunger = [(-0.8 * small, 0, 0.55), (0.8 * small, 0, 0.55)]
    rods = [(0, 0, 0), (0, 0, 0.35)], [(0, 0, 0.55), (0, 0, 1)]
    return together(chain(x) for x in (cup, plunger, *rods))


def _straight(small: float) -> Outline:
    return chain([(0, 0, 0), (0, 0, 1)])


def _bar(small: float) -> Outline:
    grid = np.stack([closed(_circle(0.3 * small)) + np.array((0, 0, z)) for z in (0.0, 1.0)])
    return sheet(grid)


# Symbols between two points: from 0 to 1 along z, of a given width.
JOINING: Mapping[str, Callable[[float], Outline]] = {
    "attraction": _straight,
    "damper": _dashpot,
    "fil": _straight,
    "helicoidale": _straight,
    "lineaire_annulaire": _straight,
    "prismatique": _straight,
    "spring": _zigzag,
    "tige": _bar,
    "verrou": _straight,
}
