"""Still pictures of a scene by matplotlib: without a display and without a browser.

Rays are parallel; what is nearer is drawn later.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from frot.view.colours import ALONG, BODIES, KINDS, MODES, NORMAL
from frot.view.outline import Array, Outline, along
from frot.view.scene import turn

if TYPE_CHECKING:
    from frot.view.parts import Part, Scene

ARROW = 7.0  # length of a usual reaction, in sizes of symbols
LIGHT = np.array((0.3, 0.5, 0.81))  # in the axes of the picture: right, up, to the eye


class Picture:
    """A figure that shows a scene at one moment after the other."""

    def __init__(self, scene: Scene, width: float = 8.0, height: float = 6.0) -> None:
        """The figure is `width` by `height` inches."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        self.scene = scene
        self.figure = Figure(figsize=(width, height))
        FigureCanvasAgg(self.figure)
        self.axis = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self._axes = _picture_axes(scene)
        sizes = [np.linalg.norm(x.normal, axis=1) for x in scene.touching]
        usual = max((float(np.nanmedian(x)) for x in sizes if np.any(x > 0)), default=0.0)
        self._scale = ARROW * scene.small / usual if usual > 0 else 0.0
        self._half = self._extent(width / height)

    def _extent(self, ratio: float) -> tuple[float, float]:
        scene = self.scene
        half = np.full(3, 0.6 * scene.size) if scene.follow else scene.half
        if scene.planar:
            x, y = half[:2] + 2 * scene.small
        else:
            x = y = 0.8 * float(np.linalg.norm(half))
        high = 1.15 * max(float(y), float(x) / ratio)
        return high * ratio, high

    def draw(self, k: int) -> Any:
        """The figure at the moment number k."""
        scene, axis = self.scene, self.axis
        axis.clear()
        axis.set_axis_off()
        pieces = _Pieces(self._axes)
        for part in scene.parts:
            self._add(pieces, part, k)
        for one in scene.joinings:
            start, end = one.ends[k]
            long = float(np.linalg.norm(end - start))
            if long > 0:
                axes = along(end - start) @ np.diag((1.0, 1.0, long))
                pieces.add(one.shape.moved(axes, start), KINDS["joining"], 1.2)
        pieces.draw(axis)
        self._arrows(k)
        middle = scene.middles[k] if scene.follow else scene.centre
        x, y = (middle @ self._axes)[:2]
        axis.set_xlim(x - self._half[0], x + self._half[0])
        axis.set_ylim(y - self._half[1], y + self._half[1])
        words = f"{scene.name}    t = {scene.times[k]:.4g} s"
        axis.text(0.015, 0.975, words, transform=axis.transAxes, va="top", fontsize=10)
        return self.figure

    def _add(self, pieces: _Pieces, part: Part, k: int) -> None:
        if part.kind == "frame" and part.owner:
            return
        colour = BODIES[part.number % len(BODIES)] if part.kind == "body" else KINDS[part.kind]
        if part.modes:
            modes = next((x.modes for x in self.scene.touching if x.name == part.modes), None)
            if modes is not None:
                colour = MODES[tuple(MODES)[int(modes[k])]]
        pose = self.scene.poses.get(part.owner)
        outline = part.shapes[k if len(part.shapes) > 1 else 0]
        if pose is not None:
            outline = outline.moved(turn(pose[k][3:]), pose[k][:3])
        layer = {"surface": -2.0, "liaison": 2.0, "frame": -1.0}.get(part.kind, 0.0)
        layer = self.scene.small * (layer + 0.03 * part.number) if self.scene.planar else 0.0
        opacity = 0.35 if part.kind == "surface" else 1.0
        wide = {"curve": 1.4, "surface": 0.4}.get(part.kind, 0.8)
        pieces.add(outline, colour, wide, layer, opacity)

    def _arrows(self, k: int) -> None:
        for one in self.scene.touching:
            for vector, colour in ((one.normal[k], NORMAL), (one.along[k], ALONG)):
                size = float(np.linalg.norm(vector)) * self._scale
                if not np.isfinite(size) or size < 0.3 * self.scene.small:
                    continue
                start, end = one.places[k], one.places[k] + self._scale * vector
                self.axis.annotate(
                    "",
                    xy=(end @ self._axes)[:2],
                    xytext=(start @ self._axes)[:2],
                    arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.8, "shrinkA": 0},
                    annotation_clip=False,
                )


class _Pieces:
    """Triangles and pieces of lines, drawn from the farthest to the nearest."""

    def __init__(self, axes: Array) -> None:
        self._axes = axes
        self._polygons: list[Array] = []
        self._depths: list[Array] = []
        self._faces: list[Array] = []
        self._edges: list[Array] = []
        self._widths: list[Array] = []

    def add(
        self, outline: Outline, colour: str, wide: float, layer: float = 0.0, opacity: float = 1.0
    ) -> None:
        """An outline in ground axes; `layer` is its height to the eye beside its own."""
        from matplotlib.colors import to_rgb

        base = np.array(to_rgb(colour))
        if len(outline.faces):
            corners = (outline.points @ self._axes)[outline.faces]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            size = np.linalg.norm(normal, axis=1, keepdims=True)
            shine = np.abs((normal / np.where(size > 0, size, 1)) @ LIGHT)[:, None]
            flat = np.ptp(outline.points[:, 2]) < 1e-12
            shade = np.ones_like(shine) if flat and layer else 0.62 + 0.38 * shine
            rgba = np.hstack((base * shade, np.full((len(corners), 1), opacity)))
            self._take(corners[:, :, :2], corners[:, :, 2].mean(axis=1) + layer, rgba, rgba, 0.3)
        ends = [np.stack((x[:-1], x[1:]), axis=1) for x in outline.lines if len(x) > 1]
        if ends:
            lines = np.vstack(ends) @ self._axes
            dark = np.append(base * 0.55, 1.0)
            edges = np.tile(dark, (len(lines), 1))
            none = np.zeros((len(lines), 4))
            nearer = 1e-3 * abs(layer) + 1e-6
            depths = lines[:, :, 2].mean(axis=1) + layer + nearer
            self._take(lines[:, :, :2], depths, none, edges, wide)

    def _take(
        self, polygons: Array, depths: Array, faces: Array, edges: Array, wide: float
    ) -> None:
        self._polygons.extend(polygons)
        self._depths.append(depths)
        self._faces.append(faces)
        self._edges.append(edges)
        self._widths.append(np.full(len(depths), wide))

    def draw(self, axis: Any) -> None:
        """Draw all pieces."""
        from matplotlib.collections import PolyCollection

        if not self._polygons:
            return
        order = np.argsort(np.concatenate(self._depths), kind="stable")
        axis.add_collection(
            PolyCollection(
                [self._polygons[i] for i in order],
                facecolors=np.vstack(self._faces)[order],
                edgecolors=np.vstack(self._edges)[order],
                linewidths=np.concatenate(self._widths)[order],
                closed=False,
                capstyle="round",
            )
        )


def _picture_axes(scene: Scene) -> Array:
    """Columns: right, up, and to the eye."""
    if scene.planar:
        return np.eye(3)
    side = np.roll(scene.up, 1)
    eye = 0.85 * side - 1.5 * np.cross(scene.up, side) + 0.75 * scene.up
    eye = eye / np.linalg.norm(eye)
    right = np.cross(scene.up, eye)
    right = right / np.linalg.norm(right)
    return np.column_stack((right, np.cross(eye, right), eye))
