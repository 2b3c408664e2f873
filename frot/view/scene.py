"""Makes the scene of a run: bodies, curves, surfaces, liaisons and reactions at its moments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from frot.dsl import Log, default_values, evaluate
from frot.dsl.checked import BodyGeometry, BodyPoint, Frame, Liaison, Model
from frot.dsl.messages.errors import FrotError
from frot.dsl.messages.interrupts import DeferredInterrupts, raise_noted_interrupt
from frot.view.bodies import Look, outline_of
from frot.view.figures import Scope, changes, curve_outline, surface_outline
from frot.view.moments import Moments
from frot.view.numbers import Numbers
from frot.view.outline import Array, Outline, bar, chain, fan, together
from frot.view.parts import Joining, Part, Scene, Touching
from frot.view.seen import Owner, body_of, key_of, owners_of
from frot.view.symbols import JOINING, LIAISONS

if TYPE_CHECKING:
    from frot.compiler.equations.assembled import Assembled

FAR = 6.0  # travel over size from which the camera follows
SMALL = 0.035  # size of symbols and points, of that of the mechanism


def scene_of(model: Model, moments: Moments) -> Scene:
    """The scene of a checked model at the moments of a run.

    FrotError where the model cannot be prepared, which its run would have said before.
    """
    from frot.compiler.driver import assembled_of

    log = Log()
    with DeferredInterrupts():
        system = assembled_of(model, log)
        if system is None:
            raise FrotError(log)
        return _Maker(model, system, moments).make()


class _Maker:
    def __init__(self, model: Model, system: Assembled, moments: Moments) -> None:
        self.model, self.system, self.moments = model, system, moments
        self.owners = owners_of(model)
        self.poses = {name: moments.vector(f"pose:{name}", 7) for name in self.owners}
        self.numbers = Numbers(system, moments.parameters, float(moments.times[0]))
        self.given = {
            body: {
                name: self.numbers.of(value)
                for name, value in body.arguments.items()
                if name not in ("mass", "inertia")
            }
            for body in model.bodies
            if body.shape is not None
        }
        self._measure()

    def _measure(self) -> None:
        """How large the mechanism is, and how far it goes."""
        points = [pose[:, :3] for pose in self.poses.values()]
        points += [self.moments.vector(f"place:{x.name}", 3) for x in self._shown_liaisons()]
        points = points or [np.zeros((len(self.moments.times), 3))]
        # what a body reaches from G, by its lengths
        reach = max((self._reach_of(body) for body in self.given), default=0.0)
        every = np.stack(points, axis=1)
        every = np.where(np.isfinite(every), every, 0.0)
        low, high = every.min(axis=(0, 1)) - reach, every.max(axis=(0, 1)) + reach
        spread = every.max(axis=1) - every.min(axis=1)
        own = float(np.max(spread, initial=0.0)) + 2 * reach
        whole = float(np.max(high - low))
        self.size = own if own > 0.02 * whole and own > 0 else 0.25 * whole or 1.0
        self.centre, self.reach = (low + high) / 2, 0.5 * whole + 0.25 * self.size
        self.half = np.where(high > low, (high - low) / 2, self.size)
        bodies = [self.poses[body.name][:, :3] for body in self.model.bodies] or [np.zeros((1, 3))]
        self.middles = np.mean(bodies, axis=0)
        self.follow = whole > FAR * self.size
        self.small = SMALL * self.size
        self.look = Look(self.model.planar, self.small)
        self.scope = Scope(self.centre, self.reach, self.size, self.model.planar)

    def _reach_of(self, body: Any) -> float:
        found = 0.0
        for name, value in self.given[body].items():
            size = float(np.max(np.abs(value), initial=0.0))
            if name in ("length", "size"):
                size /= 2
            if np.isfinite(size):
                found = max(found, size)
        return found

    def _shown_liaisons(self) -> list[Liaison]:
        """Those of the text, and of the contacts that one stands for what closes in the picture."""
        every = [x for x in self.system.reduced.variables.geometry if x.kind.name != "libre"]
        return [x for x in every if x in self.model.liaisons or self._closes(x)]

    def _closes(self, liaison: Liaison) -> bool:
        modes = self.moments.column(f"{liaison.name}.mode")
        return modes is None or bool(np.any(modes != 0))

    def make(self) -> Scene:
        """The scene with all its parts."""
        parts = [*self._bodies(), *self._figures(), *self._frames(), *self._symbols()]
        return Scene(
            name=self.model.name,
            doc=self.model.doc,
            planar=self.model.planar,
            times=self.moments.times,
            poses=self.poses,
            parts=tuple(parts),
            joinings=tuple(self._joinings()),
            touching=tuple(self._touching()),
            events=self.moments.events,
            small=self.small,
            size=self.size,
            centre=self.centre,
            middles=self.middles,
            reach=self.reach,
            half=self.half,
            follow=self.follow,
            up=_up(self.model),
        )

    def _bodies(self) -> list[Part]:
        found = []
        for number, body in enumerate(self.given):
            assert body.shape is not None
            raise_noted_interrupt()
            outline = outline_of(body.shape.name, self.given[body], self.look)
            outline = together((outline, *self._links(body)))
            found.append(Part(body.name, "body", body.name, (outline,), number))
        return found

    def _links(self, body: Any) -> list[Outline]:
        """Lines from G of a body without a figure of its own to what is fixed to it."""
        if body.shape.geometry or not body.shape.turns:
            return []
        own = self.poses[body.name][0]
        found = []
        for name, owner in self.owners.items():
            if name != body.name and body_of(owner) is body:
                there = _local(own, self.poses[name][0][:3])
                found.append(bar(there, 0.3 * self.small, self.model.planar))
        for curve in self.model.curves:
            if body_of(curve.owner) is body and curve.kind in ("circle", "ellipse"):
                outline = curve_outline(curve, self.numbers, self.scope, self.moments.times[0])
                start = self._home(body)
                found += [
                    fan(start, self._in_body(curve.owner, body, line[::8]))
                    for line in (outline.lines if outline else ())
                ]
        return found

    def _home(self, body: Any) -> Array:
        com = self.given[body].get("com")
        if com is None:
            return np.zeros(3)
        values = np.ravel(com)
        return -np.append(values, np.zeros(3 - len(values))) if len(values) > 1 else np.zeros(3)

    def _in_body(self, owner: Owner, body: Any, points: Array) -> Array:
        if owner is body:
            return points + self._home(body)
        pose, own = self.poses[key_of(owner)][0], self.poses[body.name][0]
        return np.array([_local(own, pose[:3] + turn(pose[3:]) @ p) for p in points])

    def _figures(self) -> list[Part]:
        found = []
        for kind, shapes, make in (
            ("curve", self.model.curves, curve_outline),
            ("surface", self.model.surfaces, surface_outline),
        ):
            for shape in dict.fromkeys((*shapes, *self._of_ground(kind))):
                moving = changes(shape, self.numbers)
                times = self.moments.times if moving else self.moments.times[:1]
                raise_noted_interrupt()
                outlines = [make(shape, self.numbers, self.scope, float(t)) for t in times]
                if any(outline is None for outline in outlines):
                    continue
                offset = self._home(shape.owner) if shape.owner in self.given else np.zeros(3)
                moved = tuple(x.moved(np.eye(3), offset) for x in outlines if x is not None)
                owner = key_of(shape.owner)
                found.append(Part(shape.name, kind, owner if owner in self.poses else "", moved))
        return found

    def _of_ground(self, kind: str) -> list[Any]:
        """The line or the plane that every ground has, where a liaison is on it."""
        places = [place for x in self.model.liaisons for place in (x.a, x.b)]
        found = [getattr(place, kind, None) for place in places]
        return [x for x in found if x is not None and x.span is None]

    def _frames(self) -> list[Part]:
        size = 1.6 * self.small
        axes = np.eye(3)[: 2 if self.model.planar else 3]
        lines = tuple(np.array([(0, 0, 0), size * axis]) for axis in axes)
        cross = Outline(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.uint32), lines)
        ground = Outline(cross.points, cross.faces, tuple(2 * x for x in lines))
        names = [frame.name for frame in self.model.frames if frame.name in self.poses]
        names += [body.name for body in self.given if body.shape and body.shape.turns]
        return [
            Part("ground", "frame", "", (ground,)),
            *(Part(name, "frame", name, (cross,)) for name in names),
        ]

    def _symbols(self) -> list[Part]:
        found = []
        for liaison in self._shown_liaisons():
            raise_noted_interrupt()
            outline = self._symbol(liaison)
            if not (len(outline.points) or outline.lines):
                continue
            owner = f"place:{liaison.name}"
            if isinstance(liaison.a, (BodyPoint, Frame)) and not (
                liaison.kind.along_curve or self._touches(liaison)
            ):
                named = key_of(liaison.a)
                owner = named if named in self.poses else owner
            modes = liaison.name if self.moments.has(f"{liaison.name}.mode") else ""
            found.append(Part(liaison.name, "liaison", owner, (outline,), modes=modes))
        for liaison in self._shown_liaisons():
            place = self.moments.vector(f"place:{liaison.name}", 3)
            still = np.tile((1.0, 0.0, 0.0, 0.0), (len(place), 1))
            self.poses[f"place:{liaison.name}"] = np.hstack((place, still))
        return found

    def _touches(self, liaison: Liaison) -> bool:
        return self.moments.has(f"picture:normal:{liaison.name}[0]")

    def _symbol(self, liaison: Liaison) -> Outline:
        axes = {}
        for name, value in liaison.options.items():
            given = getattr(value, "value", None)
            if isinstance(given, str):
                axis = np.eye(3)["xyz".index(given[-1])] * (-1 if given[0] == "-" else 1)
                axes[name] = axis
            elif name.startswith(("axis", "normal")):
                axis = np.ravel(self.numbers.of(value))
                axes[name] = np.append(axis, np.zeros(3 - len(axis)))
        make = LIAISONS.get(liaison.kind.name)
        if make is None:
            return chain([])
        scale = 2.2 * self.small
        return make(axes, self.model.planar).moved(scale * np.eye(3), (0, 0, 0))

    def _joinings(self) -> list[Joining]:
        found = []
        every: tuple[Any, ...] = (*self.model.liaisons, *self.model.forces)
        for one in every:
            make = JOINING.get(one.kind.name)
            if make is None:
                continue
            if isinstance(one, Liaison):
                places: tuple[Any, ...] = (one.a, one.b)
            else:
                names = ("point", "centre") if one.kind.name == "attraction" else ("a", "b")
                places = tuple(one.arguments[name] for name in names)
            first, second = (self._track(place) for place in places)
            if first is not None and second is not None:
                both = np.stack((first, second), axis=1)
                found.append(Joining(one.name, one.kind.name, make(0.8 * self.small), both))
        return found

    def _track(self, place: Any) -> Array | None:
        """Where a place is at each moment; None of one that is no point."""
        count = len(self.moments.times)
        if isinstance(place, (BodyPoint, Frame)):
            pose = self.poses.get(key_of(place))
            return np.zeros((count, 3)) if pose is None else pose[:, :3]
        if isinstance(place, (BodyGeometry, Liaison)) or not hasattr(place, "type"):
            return None
        try:
            point = np.ravel(self.numbers.of(place))
        except (RuntimeError, TypeError):
            return None
        return np.tile(np.append(point, np.zeros(3 - len(point))), (count, 1))

    def _touching(self) -> list[Touching]:
        found = []
        for liaison in self._shown_liaisons():
            force = self.moments.vector_of(f"{liaison.name}.force")
            modes = self.moments.column(f"{liaison.name}.mode")
            if force is None and modes is None:
                continue
            places = self.moments.vector(f"place:{liaison.name}", 3)
            if force is None:
                force = np.zeros_like(places)
            if body_of(liaison.b).shape is None:
                force = -force
            direction = None
            normal, along = force, np.zeros_like(force)
            if self._touches(liaison):
                direction = self.moments.vector(f"normal:{liaison.name}", 3)
                size = np.sum(force * direction, axis=1, keepdims=True)
                normal, along = size * direction, force - size * direction
                direction = np.where(size < 0, -direction, direction)
            found.append(
                Touching(
                    name=liaison.name,
                    kind=liaison.kind.name,
                    places=places,
                    normal=normal,
                    along=along,
                    modes=modes,
                    direction=direction,
                    cone=self._cone(liaison),
                )
            )
        return found

    def _cone(self, liaison: Liaison) -> float:
        """The angle of friction; 0 where the coefficient is no constant, or there is none."""
        for law in liaison.laws:
            if law.kind.name == "coulomb" and liaison.kind.name != "rotoide":
                try:
                    return float(np.arctan(np.ravel(self.numbers.of(law.arguments["mu"]))[0]))
                except (RuntimeError, TypeError):
                    return 0.0
        return 0.0


def turn(quaternion: Array) -> Array:
    """The axes (3 x 3) of a unit quaternion w, x, y, z."""
    w, x, y, z = quaternion
    return np.array(
        (
            (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
        )
    )


def _local(pose: Array, point: Array) -> Array:
    """A point of the ground in the axes of a pose."""
    return turn(pose[3:]).T @ (point - pose[:3])


def _up(model: Model) -> Array:
    """The axis on top in the picture: y of the plane, in space that against gravity."""
    if model.planar:
        return np.eye(3)[1]
    down = model.world.down
    if isinstance(down, str):
        return np.eye(3)["xyz".index(down[-1])] * (1 if down[0] == "-" else -1)
    fall = np.array(evaluate(down, default_values(model, {})), dtype=np.float64)
    return -fall / np.linalg.norm(fall)
