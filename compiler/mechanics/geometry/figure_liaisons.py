"""The table of liaisons between figures: points, curves and surfaces of bodies.

Each gives a pairing of the first figure with the second, or None where there is none; the caller
tries both orders. Which figures touch in closed form stands in `closest_closed_form.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from frot.compiler.mechanics.geometry.closest_closed_form import is_closed
from frot.compiler.mechanics.geometry.closest_solved import can_touch
from frot.compiler.mechanics.geometry.figure import Figure, Placed
from frot.compiler.mechanics.geometry.planes import LineOrCylinder, PlaneSurface, PointFigure
from frot.compiler.mechanics.geometry.quadrics import SphereSurface
from frot.compiler.mechanics.liaisons.alignments import Alongside, LineParallelToPlane, NoSpin
from frot.compiler.mechanics.liaisons.curves import Across, PointOnCurve, Tangent
from frot.compiler.mechanics.liaisons.joints import Options, Pairing
from frot.compiler.mechanics.liaisons.lock import Lock
from frot.compiler.mechanics.liaisons.motion import Motion
from frot.compiler.mechanics.liaisons.orientations import Attitude, Heading
from frot.compiler.mechanics.liaisons.touching import NoSlip, Touching
from frot.compiler.mechanics.liaisons.translations import FixedAlong, FixedDistance, Slide
from frot.compiler.mechanics.values import Axis
from frot.dsl.catalogue import LIAISONS
from frot.dsl.checked import Expression


def _rows(*locks: Lock) -> Pairing:
    """A liaison that rows alone keep."""
    return Pairing((), locks, carries=False)


def _any_turn(planar: bool) -> Motion:
    return Heading() if planar else Attitude()


def _on_line(axis: Axis, coordinate: str) -> Pairing:
    """A point stays on a straight line through a."""
    locks = (FixedAlong(axis, 0), FixedAlong(axis, 1))
    return Pairing((Slide(axis, coordinates=(coordinate,)), Attitude()), locks)


def _annular(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if b.is_point and a.line is not None:
        return _on_line(a.line, "displacement")
    if b.is_point and a.is_point:
        return _on_line(Axis(options.get("axis", "z")), "displacement")
    return None


def _line_on_plane(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if a.plane is None or b.line is None:
        return None
    return _rows(Touching(_endless(a), PointFigure()), LineParallelToPlane(a.plane, b.line))


def _rod(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    return _rows(FixedDistance(options["length"]))


def _point_on_curve(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    """A circle is where a plane meets a round cylinder; an ellipse likewise."""
    if not b.is_point or a.parameters != 1:
        return None
    if a.line is not None and not a.bends:
        return _on_line(a.line, "u")
    walls = () if a.bends else a.walls
    locks: tuple[Lock, ...] = tuple(Touching(wall, b) for wall in walls)
    return Pairing((PointOnCurve(a), _any_turn(planar)), locks or (Across(a, 0), Across(a, 1)))


def _point_on_surface(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if not b.is_point or not a.is_surface or not can_touch(a, b, planar):
        return None
    lock = _touch(a, b)
    if a.plane is not None:
        ways = (Slide(a.plane, 0, coordinates=("x",)), Slide(a.plane, 1, coordinates=("y",)))
        return Pairing((*ways, Attitude()), (lock,))
    return _rows(lock)


def _touching(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    lying = _lying(a, b)
    if lying is not None:
        return _rows(lying.touching, lying.level)
    return _rows(_touch(a, b)) if can_touch(a, b, planar) else None


def _touch(a: Figure, b: Figure) -> Touching:
    return Touching(a, b, followed=not is_closed(a, b))


@dataclass(frozen=True, slots=True, eq=False)
class _Lying:
    """A cylinder touches a plane along a line: its axis is parallel to it, at its radius."""

    touching: Touching
    level: LineParallelToPlane


def _endless(a: Figure) -> Figure:
    """The plane or the cylinder without its borders: what lies on it along a line reaches far."""
    if a.plane is not None:
        return PlaneSurface(a.plane, False)
    return a if a.tube is None else LineOrCylinder(*a.tube)


def _lying(a: Figure, b: Figure) -> _Lying | None:
    """How a cylinder lies on a plane; None of other figures."""
    if a.plane is None or b.tube is None:
        return None
    axis, radius = b.tube
    return _Lying(Touching(_endless(a), SphereSurface(radius)), LineParallelToPlane(a.plane, axis))


def _tangent(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    curves = a.parameters == b.parameters == 1
    if not curves or (a.line is not None and b.line is not None):
        return None
    return _rows(*(Tangent(a, b, k) for k in range(3)))


def _rolling(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    """Where they touch, the two have one velocity; along a line, everywhere on it.

    Parallel cylinders do touch so, and those that roll are taken for parallel ones.
    """
    lying = _lying(a, b)
    if lying is not None:
        still = (NoSlip(a, lying.touching.b, k, planar) for k in range(2))
        return _rows(lying.touching, lying.level, *still, NoSpin(lying.level.normal))
    if a.tube is not None and b.tube is not None:
        return _side_by_side(_endless(a), a.tube[0], *b.tube)
    if not can_touch(a, b, planar):
        return None
    ways = range(1 if planar else 2)
    touching = _touch(a, b)
    return _rows(touching, *(NoSlip(a, b, k, planar, touching.followed) for k in ways))


def _side_by_side(a: Figure, along_a: Axis, along_b: Axis, radius: Expression) -> Pairing:
    """Cylinders that roll on each other stay parallel: they touch along a line, as rollers do.

    It is where a ball about the middle of b touches a that they do not slip.
    """
    ball = SphereSurface(radius)
    still = (NoSlip(a, ball, k, planar=False) for k in range(2))
    straight = (Alongside(along_a, along_b, k) for k in range(2))
    return _rows(Touching(a, ball), *straight, *still)


_Rule = Callable[[Figure, Figure, Options, bool], Pairing | None]

_PLACED: Mapping[str, _Rule] = {
    "contact_ponctuel": _touching,
    "courbe_courbe": _tangent,
    "fil": _rod,
    "lineaire_annulaire": _annular,
    "lineaire_rectiligne": _line_on_plane,
    "point_courbe": _point_on_curve,
    "point_surface": _point_on_surface,
    "roulement": _rolling,
    "tige": _rod,
}
IN_SPACE = tuple(_PLACED)


def in_plane() -> tuple[str, ...]:
    """The kinds between figures in the plane; the others are contacts, which may have friction."""
    return tuple(name for name in IN_SPACE if LIAISONS[name].in_plane == "figures")


def pair(
    kind: str, a: Placed, b: Placed, options: Options, planar: bool
) -> tuple[Pairing, bool] | None:
    """The pairing of two places, and whether it takes them in the other order."""
    rule = _PLACED[kind]
    there = rule(a.figure, b.figure, options, planar)
    if there is not None:
        return there, False
    back = rule(b.figure, a.figure, options, planar)
    return None if back is None else (back, True)
