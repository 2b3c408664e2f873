"""The page of a run: one HTML file that plays it, and needs nothing beside it.

k3d draws the scene and brings its script along; page.js moves it.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from frot.dsl.messages.errors import fail
from frot.view.colours import ALONG, BODIES, KINDS, MODES, NORMAL
from frot.view.numbers import packed
from frot.view.outline import Array, Outline, around, chain, cone, plate, together, tube
from frot.view.parts import Part
from frot.view.scene import turn

if TYPE_CHECKING:
    from frot.view.parts import Scene

HERE = Path(__file__).parent
FIELD = 22.0  # degrees of the camera's field: nearly parallel rays
MOST_EVENTS = 2000  # of a page
SERIES = 60  # shapes of a part that time changes


def page_of(scene: Scene, curves: Mapping[str, Any] | None = None, fault: str = "") -> str:
    """The page as HTML. `curves` of `curves_of`; `fault`: why the run ended, if it did."""
    k3d = k3d_package()
    plot = k3d.plot(
        background_color=0xF6F8FA,
        camera_auto_fit=False,
        camera_fov=FIELD,
        grid_visible=False,
        menu_visibility=False,
        antialias=1,
        logarithmic_depth_buffer=False,
        axes_helper=0.0 if scene.planar else 0.6,
        lighting=1.6,
        name=scene.name,
    )
    content = _Objects(k3d, plot, scene).content()
    content |= {
        "name": scene.name,
        "doc": scene.doc,
        "fault": fault,
        "css": (HERE / "page.css").read_text("utf-8"),
        "times": scene.times.tolist(),
        "poses": {name: packed(pose) for name, pose in scene.poses.items()},
        "middles": packed(scene.middles),
        "follow": scene.follow,
        "small": scene.small,
        "camera": _camera(scene),
        "events": [{"time": e.time, "text": e.text} for e in scene.events[:MOST_EVENTS]],
        "unlisted": max(len(scene.events) - MOST_EVENTS, 0),
    }
    content |= curves or {"grid": [0.0], "curves": [], "panels": []}
    # nothing in it may end the script that it stands in
    text = json.dumps(content).replace("</", "<\\/")
    script = "".join((HERE / name).read_text("utf-8") for name in ("curves.js", "page.js"))
    code = f"const frot = {text};\nconst k3d = K3DInstance;\n{script}"
    found: str = plot.get_snapshot(additional_js_code=code)
    return found


def k3d_package() -> Any:
    """The package k3d; FrotError (E0820) where it is not installed."""
    try:
        import k3d
    except ImportError:
        raise fail(
            "E0820",
            "a page is drawn by the Python package 'k3d', which is not installed",
            help="pip install k3d; pictures and films (-o posture.png, motion.gif) need it not",
        ) from None
    return k3d


def _camera(scene: Scene) -> dict[str, Any]:
    """Target, position, upward direction and extent of the camera; of a plane from the front."""
    target = scene.middles[0] if scene.follow else scene.centre
    half = np.full(3, 0.6 * scene.size) if scene.follow else scene.half
    if scene.planar:
        way, up = np.array((0.0, 0.0, 1.0)), np.array((0.0, 1.0, 0.0))
        seen = half[:2] + 2 * scene.small
    else:
        up = scene.up
        side = np.roll(up, 1)
        way = 0.85 * side - 1.5 * np.cross(up, side) + 0.75 * up
        way = way / np.linalg.norm(way)
        seen = np.full(2, 0.75 * np.linalg.norm(half))
    return {
        "target": np.asarray(target).tolist(),
        "way": way.tolist(),
        "up": up.tolist(),
        "half": seen.tolist(),
        "field": FIELD,
    }


class _Objects:
    """The objects of k3d for a scene, and what page.js is to do with them."""

    def __init__(self, k3d: Any, plot: Any, scene: Scene) -> None:
        self.k3d, self.plot, self.scene = k3d, plot, scene
        self.thin = max(0.16 * scene.small, 0.0 if scene.follow else 0.003 * scene.reach)
        self.series = False

    def content(self) -> dict[str, Any]:
        """The objects as data for page.js."""
        scene = self.scene
        parts = [entry for part in self._parts() for entry in self._part(part)]
        touching = [x for x in scene.touching if x.modes is not None or np.any(x.normal)]
        largest = max((float(np.nanmax(_sizes(x.normal), initial=0)) for x in touching), default=0)
        usual = [np.nanmedian(_sizes(x.normal)) for x in touching]
        usual_size = max((float(x) for x in usual if np.isfinite(x)), default=0.0) or largest
        arrows = []
        for one in touching:
            for vectors, colour in ((one.normal, NORMAL), (one.along, ALONG)):
                if np.any(np.nan_to_num(vectors)):
                    arrows.append(self._arrow(one.places, vectors, colour))
        cones = [self._cone(x) for x in touching if x.cone > 0 and x.direction is not None]
        colours = [(mode, colour) for mode, colour in MODES.items()] if _any_modes(scene) else []
        if arrows:
            colours += [("normal", NORMAL), ("friction", ALONG)]
        return {
            "parts": parts,
            "joinings": [self._joining(x) for x in scene.joinings],
            "arrows": arrows,
            "cones": cones,
            "modes": {x.name: packed(x.modes) for x in touching if x.modes is not None},
            "scale": 7 * scene.small / usual_size if usual_size > 0 else 0.0,
            "colours": colours,
            "series": self.series,
        }

    def _parts(self) -> list[Part]:
        """The parts; symbols of one colour that stand still are one, which is drawn at once."""
        moving, still = [], []
        for part in self.scene.parts:
            pose = self.scene.poses.get(part.owner)
            alone = part.kind != "liaison" or part.modes or len(part.shapes) > 1
            if alone or pose is None or np.any(pose != pose[0]):
                moving.append(part)
            else:
                still.append(part.shapes[0].moved(turn(pose[0, 3:]), pose[0, :3]))
        return [*moving, Part("still", "liaison", "", (together(still),))] if still else moving

    def _part(self, part: Part) -> list[dict[str, Any]]:
        """A liaison with modes has an object for each of them."""
        layer = 0.0
        if self.scene.planar:
            order = {"surface": -2.0, "curve": 0.0, "frame": 2.5, "liaison": 2.0}
            layer = self.scene.small * (order.get(part.kind, 0.0) * 0.5 + 0.03 * part.number)
        if part.kind == "liaison" and part.modes:
            colours = list(enumerate(MODES.values()))
        else:
            colours = [(-1, BODIES[part.number % len(BODIES)])]
            if part.kind in KINDS:
                colours = [(-1, KINDS[part.kind])]
        return [
            {
                "name": part.name,
                "kind": part.kind,
                "owner": part.owner,
                "layer": layer,
                "mode": mode,
                "liaison": part.modes,
                "ids": self._draw(part, colour),
            }
            for mode, colour in colours
        ]

    def _draw(self, part: Part, colour: str) -> list[int]:
        outline, ids = part.shapes[0], []
        opacity = 0.35 if part.kind == "surface" else 1.0
        vertices: Any = outline.points
        lines: Any = _segments(outline)
        if len(part.shapes) > 1:
            self.series = True
            step = max(len(part.shapes) // SERIES, 1)
            moments = range(0, len(part.shapes), step)
            times = self.scene.times
            vertices = {str(times[k]): _f32(part.shapes[k].points) for k in moments}
            lines = {str(times[k]): _f32(_segments(part.shapes[k])) for k in moments}
        if len(outline.faces):
            ids.append(self._mesh(vertices, outline.faces, colour, opacity))
        if outline.lines:
            dark = colour if part.kind in ("curve", "frame") else _darker(colour)
            ids.append(self._lines(lines, len(_segments(outline)), dark, part.kind))
        return ids

    def _mesh(self, vertices: Any, faces: Array, colour: str, opacity: float = 1.0) -> int:
        points = vertices if isinstance(vertices, dict) else _f32(vertices)
        one = self.k3d.mesh(
            points, faces.astype(np.uint32), color=int(colour[1:], 16), opacity=opacity,
            side="double", flat_shading=False, roughness=0.6,
        )  # fmt: skip
        self.plot += one
        return int(one.id)

    def _lines(self, points: Any, count: int, colour: str, kind: str = "") -> int:
        width = self.thin * {"curve": 1.8, "surface": 0.5, "frame": 1.2}.get(kind, 1.0)
        pairs = np.arange(count, dtype=np.uint32).reshape(-1, 2)
        one = self.k3d.lines(
            points if isinstance(points, dict) else _f32(points), pairs, indices_type="segment",
            color=int(colour[1:], 16), width=width,
            shader="simple" if kind == "liaison" else "thick",
        )  # fmt: skip
        self.plot += one
        return int(one.id)

    def _outline(self, outline: Outline, colour: str, opacity: float = 1.0) -> list[int]:
        ids = []
        if len(outline.faces):
            ids.append(self._mesh(outline.points, outline.faces, colour, opacity))
        if outline.lines:
            segments = _segments(outline)
            ids.append(self._lines(segments, len(segments), colour))
        return ids

    def _joining(self, one: Any) -> dict[str, Any]:
        colour = KINDS["joining"]
        return {"name": one.name, "ends": packed(one.ends), "ids": self._outline(one.shape, colour)}

    def _arrow(self, places: Array, vectors: Array, colour: str) -> dict[str, Any]:
        shaft = tube(1.0, 1.0, sides=20).moved(np.eye(3), (0, 0, 0.5))
        bare = Outline(shaft.points, shaft.faces)
        return {
            "places": packed(places),
            "vectors": packed(vectors),
            "layer": 1.5 * self.scene.small if self.scene.planar else 0.0,
            "shaft": self._outline(bare, colour),
            "head": self._outline(cone(1.0, 1.0), colour),
        }

    def _cone(self, one: Any) -> dict[str, Any]:
        """An angle of friction: open upwards from its place, or two lines in the plane."""
        if self.scene.planar:
            edges = [chain([(0, 0, 0), (0, s, 1)]) for s in (-1, 1)]
            outline = together(edges)
        else:
            rim = around(1.0) + np.eye(3)[2]
            points = np.vstack((rim, np.zeros((1, 3))))
            outline = Outline(points, plate(rim).faces)
        return {
            "name": one.name,
            "angle": one.cone,
            "places": packed(one.places),
            "normals": packed(one.direction),
            "ids": self._outline(outline, ALONG, 0.25),
        }


def _any_modes(scene: Scene) -> bool:
    return any(x.modes is not None for x in scene.touching)


def _sizes(vectors: Array) -> Array:
    return np.linalg.norm(vectors, axis=1)


def _f32(values: Array) -> Array:
    return np.ascontiguousarray(values, dtype=np.float32)


def _segments(outline: Outline) -> Array:
    """The two ends of each piece of its lines, one after the other."""
    pieces = [np.stack((x[:-1], x[1:]), axis=1).reshape(-1, 3) for x in outline.lines if len(x)]
    return np.vstack(pieces) if pieces else np.zeros((0, 3))


def _darker(colour: str, by: float = 0.55) -> str:
    parts = (int(int(colour[k : k + 2], 16) * by) for k in (1, 3, 5))
    return "#" + "".join(f"{x:02x}" for x in parts)
