"""The table of liaisons between figures: points, curves and surfaces of bodies.

Each gives a pairing of the first figure with the second, or None where there is none; the caller
tries both orders. Which figures touch in closed form stands in `touches.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from frot.compiler.mechanics.geometry.figures import (
    Ball,
    Dot,
    Figure,
    Flat,
    Oval,
    Path,
    Placed,
    Ring,
    Sheet,
    Straight,
    can_touch,
    count_parameters,
    is_bent_by_time,
    is_closed,
    is_level,
)
from frot.compiler.mechanics.liaisons.joints import Options, Pairing
from frot.compiler.mechanics.liaisons.locks import (
    Across,
    Apart,
    Level,
    Lock,
    NoSlip,
    NoSpin,
    Tangent,
    Touching,
    WayAlong,
)
from frot.compiler.mechanics.liaisons.motions import Attitude, Axis, Follow, Heading, Motion, Slide


def _rows(*locks: Lock) -> Pairing:
    """A liaison that rows alone keep."""
    return Pairing((), locks, carries=False)


def _any_turn(planar: bool) -> Motion:
    return Heading() if planar else Attitude()


def _on_line(axis: Axis, coordinate: str) -> Pairing:
    """A point stays on a straight line through a."""
    locks = (WayAlong(axis, 0), WayAlong(axis, 1))
    return Pairing((Slide(axis, coordinates=(coordinate,)), Attitude()), locks)


def _annular(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if isinstance(b, Dot) and isinstance(a, Straight) and a.radius is None:
        return _on_line(a.axis, "displacement")
    if isinstance(b, Dot) and isinstance(a, Dot):
        return _on_line(Axis(options.get("axis", "z")), "displacement")
    return None


def _line_on_plane(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if isinstance(a, Flat) and isinstance(b, Straight) and b.radius is None:
        return _rows(Touching(a, Dot()), Level(a.axis, b.axis))
    return None


def _rod(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    return _rows(Apart(options["length"]))


def _point_on_curve(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    """A circle is where a plane meets a round cylinder; an ellipse likewise."""
    if not isinstance(b, Dot):
        return None
    match a:
        case Straight(radius=None) if not is_bent_by_time(a):
            return _on_line(a.axis, "u")
        case Ring():
            locks: tuple[Lock, ...] = (
                Touching(Flat(a.axis, False), b),
                Touching(Straight(a.axis, a.radius), b),
            )
        case Oval() if not is_bent_by_time(a):
            locks = (Touching(Flat(a.axis, False), b), Touching(a, b))
        case Path() | Straight(radius=None) | Oval():
            locks = (Across(a, 0), Across(a, 1))
        case _:
            return None
    return Pairing((Follow(a), _any_turn(planar)), locks)


def _point_on_surface(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    surface = is_level(a) or isinstance(a, Sheet)
    if not isinstance(b, Dot) or not surface or not can_touch(a, b, planar):
        return None
    lock = _touch(a, b)
    if isinstance(a, Flat):
        ways = (Slide(a.axis, 0, coordinates=("x",)), Slide(a.axis, 1, coordinates=("y",)))
        return Pairing((*ways, Attitude()), (lock,))
    return _rows(lock)


def _touching(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if _is_along_line(a, b):
        return _rows(*_lying(a, b))
    return _rows(_touch(a, b)) if can_touch(a, b, planar) else None


def _touch(a: Figure, b: Figure) -> Touching:
    return Touching(a, b, followed=not is_closed(a, b))


def _is_along_line(a: Figure, b: Figure) -> bool:
    """Whether a cylinder lies on a plane."""
    return isinstance(a, Flat) and isinstance(b, Straight) and b.radius is not None


def _lying(a: Figure, b: Figure) -> tuple[Lock, ...]:
    """A cylinder touches a plane along a line: its axis is parallel to it, at its radius."""
    assert isinstance(a, Flat) and isinstance(b, Straight) and b.radius is not None
    return Touching(a, Ball(b.radius)), Level(a.axis, b.axis)


def _tangent(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    if planar:
        return _touching(a, b, options, planar)
    curves = count_parameters(a) == count_parameters(b) == 1
    if not curves or (isinstance(a, Straight) and isinstance(b, Straight)):
        return None
    return _rows(*(Tangent(a, b, k) for k in range(3)))


def _rolling(a: Figure, b: Figure, options: Options, planar: bool) -> Pairing | None:
    """Where they touch, the two have one velocity; along a line, everywhere on it."""
    if _is_along_line(a, b):
        assert isinstance(a, Flat) and isinstance(b, Straight) and b.radius is not None
        still = (NoSlip(a, Ball(b.radius), k, planar) for k in range(2))
        return _rows(*_lying(a, b), *still, NoSpin(a.axis))
    if not can_touch(a, b, planar):
        return None
    ways = range(1 if planar else 2)
    touching = _touch(a, b)
    return _rows(touching, *(NoSlip(a, b, k, planar, touching.followed) for k in ways))


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
# In the plane the others are contacts, which may have friction.
IN_PLANE = ("courbe_courbe", "fil", "roulement", "tige")


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
