"""The table of liaisons that coordinates can keep: the motions they leave, and what they lock.

Motions are those of b relative to a, in the order of the coordinates' names, and take the axes of a
to those of b; all coordinates are zero where both coincide. What a motion leaves out is locked
(ISO 3952; P. Painlevé 1895).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from frot.compiler.mechanics.liaisons.alignments import Aligned, Crossed, Parallel, SameAngle
from frot.compiler.mechanics.liaisons.driven import Drive, Driven
from frot.compiler.mechanics.liaisons.joint import Joint
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.orientations import Attitude
from frot.compiler.mechanics.liaisons.rotations import Screw, ScrewCoupling, Turn
from frot.compiler.mechanics.liaisons.translations import LEFT, FixedAlong, FixedPoint, Slide
from frot.compiler.mechanics.points import Point, is_particle, point_body
from frot.compiler.mechanics.values import Axis
from frot.dsl.checked import Expression, Liaison

Options = Mapping[str, Expression]


@dataclass(frozen=True, slots=True, eq=False)
class Pairing:
    """What a liaison leaves and what it locks; `carries`: whether coordinates can keep it."""

    motions: tuple[Motion, ...]
    locks: tuple[Lock, ...]
    carries: bool = True


def _ways(planar: bool) -> tuple[Lock, ...]:
    return tuple(FixedPoint(k) for k in range(2 if planar else 3))


def _no_turn(planar: bool) -> tuple[Lock, ...]:
    return (SameAngle(),) if planar else tuple(Aligned(k) for k in range(3))


def _about(axis: Axis) -> tuple[Lock, ...]:
    return Parallel(axis, 0), Parallel(axis, 1)


def _along(axis: Axis, planar: bool) -> tuple[Lock, ...]:
    return (FixedAlong(axis, LEFT),) if planar else (FixedAlong(axis, 0), FixedAlong(axis, 1))


def _axis(options: Options, name: str, default: str) -> Axis:
    return Axis(options.get(name, default))


def _weld(options: Options, planar: bool) -> Pairing:
    return Pairing((), (*_ways(planar), *_no_turn(planar)))


def _revolute(options: Options, planar: bool) -> Pairing:
    axis = _axis(options, "axis", "z")
    return Pairing((Turn(axis),), (*_ways(planar), *(() if planar else _about(axis))))


def _prismatic(options: Options, planar: bool) -> Pairing:
    axis = _axis(options, "axis", "x")
    return Pairing((Slide(axis),), (*_along(axis, planar), *_no_turn(planar)))


def _cylindrical(options: Options, planar: bool) -> Pairing:
    axis = _axis(options, "axis", "z")
    return Pairing((Turn(axis), Slide(axis)), (*_along(axis, False), *_about(axis)))


def _screw(options: Options, planar: bool) -> Pairing:
    axis, pitch = _axis(options, "axis", "z"), options["pitch"]
    locks = (*_along(axis, False), *_about(axis), ScrewCoupling(axis, pitch))
    return Pairing((Screw(axis, pitch),), locks)


def _universal(options: Options, planar: bool) -> Pairing:
    first, second = _axis(options, "axis_a", "z"), _axis(options, "axis_b", "z")
    motions = (
        Turn(first, coordinates=("angle_a",), mark=second),
        Turn(second, coordinates=("angle_b",), mark=first, on_b=True),
    )
    return Pairing(motions, (*_ways(False), Crossed(first, second)))


def _spherical(options: Options, planar: bool) -> Pairing:
    return Pairing((Attitude(),), _ways(False))


def _planar(options: Options, planar: bool) -> Pairing:
    normal = _axis(options, "normal", "z")
    motions = (
        Slide(normal, side=0, coordinates=("x",)),
        Slide(normal, side=1, coordinates=("y",)),
        Turn(normal),
    )
    return Pairing(motions, (FixedAlong(normal), *_about(normal)))


def _free(options: Options, planar: bool) -> Pairing:
    """Places relative to a, and any orientation."""
    ways = tuple(Slide(Axis(k), coordinates=(k,)) for k in ("xy" if planar else "xyz"))
    return Pairing((*ways, Turn(Axis("z")) if planar else Attitude()), ())


def drive(pairing: Pairing, values: Mapping[str, Expression]) -> Pairing:
    """The same liaison with coordinates that are values of time: they lock what they move."""
    motions: list[Motion] = []
    locks = [lock.told(values) for lock in pairing.locks]
    for motion in pairing.motions:
        if motion.name in values:
            driven = Driven(motion, values[motion.name])
            motions.append(driven)
            locks.append(Drive(driven))
        else:
            motions.append(motion)
    return Pairing(tuple(motions), tuple(locks), pairing.carries)


def let_go(pairing: Pairing, prescribed: Collection[str]) -> Pairing:
    """A liaison whose length or gap an equation of the text prescribes: it keeps none by itself."""
    seen = [lock.let_go(prescribed) for lock in pairing.locks]
    motions = tuple(motion for motion in seen if motion is not None)
    if not motions:
        return pairing
    kept = (x for x, motion in zip(pairing.locks, seen, strict=True) if motion is None)
    return Pairing((*pairing.motions, *motions), tuple(kept), carries=False)


def make_joint(
    liaison: Liaison,
    a: Point,
    b: Point,
    free: Pairing,
    driven: Mapping[str, Expression],
    *,
    swapped: bool = False,
) -> Joint:
    """A joint without friction whose coordinates in `driven` are values of time.

    What keeps a particle from turning is left out.
    """
    pairing = drive(free, driven)
    locks = pairing.locks
    if is_particle(point_body(a)) or is_particle(point_body(b)):
        locks = tuple(lock for lock in locks if not lock.turns)
    return Joint(
        liaison,
        a=a,
        b=b,
        motions=pairing.motions,
        locks=locks,
        carries=pairing.carries,
        swapped=swapped,
    )


JOINTS: Mapping[str, Callable[[Options, bool], Pairing]] = {
    "encastrement": _weld,
    "rotoide": _revolute,
    "prismatique": _prismatic,
    "verrou": _cylindrical,
    "helicoidale": _screw,
    "cardan": _universal,
    "spherique": _spherical,
    "appui_plan": _planar,
    "libre": _free,
}
