"""The mechanism as plain data: bodies, their coordinates, contacts, pins and forces."""

# Still free of any algebra: expressions are those of the checked model.

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.points import Point, point_body
from frot.compiler.translate.walk import has_time, is_fixed
from frot.dsl.checked import (
    Body,
    BodyPoint,
    Curve,
    Expression,
    Force,
    Frame,
    Liaison,
    Literal,
    Model,
    Surface,
)

# What has no bodies is reported without CasADi.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.mechanics.liaisons.motion import Motion


@dataclass(frozen=True, slots=True, eq=False)
class Hanging:
    """How a body hangs on another, or on the ground: its coordinates.

    `motions` take the axes at the place `base` of the other to those at the place `own` of the
    body; a body that moves freely has no `link` and
    hangs on the ground by its G. `names` are those of the coordinates, `speeds` those of the
    speeds.
    """

    body: Body
    link: Constraint | None
    base: Point | None
    own: Point | None
    motions: tuple[Motion, ...]
    names: tuple[str, ...]
    speeds: tuple[str, ...]

    @property
    def carries_b(self) -> bool:
        """Whether the body is that of the second place of its link."""
        return self.link is not None and self.own is self.link.ends[1]


def relinked(
    coordinates: Iterable[Hanging], links: Mapping[Liaison, Constraint]
) -> tuple[Hanging, ...]:
    """The same coordinates by these links, which stand for those of the same liaisons."""
    return tuple(
        h if h.link is None else replace(h, link=links[h.link.liaison]) for h in coordinates
    )


@dataclass(frozen=True, slots=True, eq=False)
class Mechanism:
    """What moves and what acts on it.

    `coordinates` has one entry a body, each after the bodies it hangs on. `contacts` are the
    liaisons whose reactions are computed, because a law or an expression reads them or because they
    close a loop, these relation by relation; `ideal` are those kept by coordinates alone. `halves`
    are the bodies added to the model's, each with the one it is a part of (split_bodies.py);
    `corners` the liaisons that one of faces stands for (faces.py).
    """

    model: Model
    coordinates: tuple[Hanging, ...]
    contacts: tuple[Constraint, ...]
    ideal: tuple[Constraint, ...]
    forces: tuple[Force, ...]
    halves: Mapping[Body, Body]
    corners: Mapping[Liaison, tuple[Liaison, ...]]

    @property
    def counters(self) -> tuple[tuple[Constraint, int], ...]:
        """Angles that no coordinate counts: those of liaisons that close loops, seen within a turn.

        Each with the place of its motion; in the plane the angles of bodies count the turns.
        """
        links = (*self.contacts, *self.ideal)
        return tuple(one for link in links for one in link.counted(self.model.planar))

    @property
    def fixed(self) -> frozenset[Body]:
        """The ground and the bodies that are joined to it so that they cannot move."""
        joints = [x.joint for x in (*self.contacts, *self.ideal)]
        welded = [set(x.bodies) for x in joints if x is not None and x.is_rigid]
        found, count = {self.model.ground}, 0
        while len(found) > count:
            count = len(found)
            found.update(*(both for both in welded if both & found))
        return frozenset(found)

    @property
    def is_driven(self) -> bool:
        """Whether liaisons that depend on time do work, which nobody counts."""
        return is_driven(self.model)


def is_driven(model: Model) -> bool:
    """Whether time moves a place, a figure or a liaison."""
    moved = any(
        isinstance(value, Expression) and not is_fixed(value)
        for frame in model.frames
        for value in (frame.origin, frame.angle, frame.axis)
    )
    moved |= model.world.gravity is not None and has_time(model.world.gravity)
    shapes: tuple[Curve | Surface, ...] = (*model.curves, *model.surfaces)
    moved |= any(has_time(value) for x in shapes for value in x.arguments.values())
    for liaison in model.liaisons:
        moved |= bool(liaison.driven) or any(has_time(x) for x in liaison.options.values())
        moved |= any(has_time(x) for r in liaison.relations for x in (r.left, r.right))
    return moved


def is_unilateral(liaison: Liaison) -> bool:
    """Whether the liaison may part: its option is not `false`, and no drive keeps its distance."""
    if "gap" in liaison.driven or "length" in liaison.driven:
        return False
    option = liaison.options["unilateral"]
    return not (isinstance(option, Literal) and option.value is False)


def may_part(liaison: Liaison, planar: bool) -> bool:
    """Whether liaisons of this kind can be unilateral."""
    kind = liaison.kind
    if planar and kind.in_plane == "contact":
        return True
    return kind.unilateral or "length" in kind.coordinates or kind.name == "point_surface"


def is_thread(liaison: Liaison) -> bool:
    """Whether it keeps two points no further apart than its length."""
    return "length" in liaison.kind.coordinates and is_unilateral(liaison)


# Freedoms of a body that may not turn about itself.
_SLENDER = 5


def is_slender(body: Body, model: Model) -> bool:
    """Whether nothing gives inertia to, or sees, a turn about the body's own x axis."""
    if body.shape is None or body.shape.freedoms_space != _SLENDER or "inertia" in body.arguments:
        return False
    own = [
        x
        for x in model.liaisons
        for place in (x.a, x.b)
        if isinstance(place, BodyPoint | Frame) and point_body(place) is body
    ]
    return not any(sees_turning(x) for x in own)


def sees_turning(liaison: Liaison) -> bool:
    """Whether a liaison sees how a body turns about itself: by relations, a couple or a drive."""
    couples = liaison.kind.pin and liaison.kind.of_points and bool(liaison.laws)
    couples |= any(law.kind.name.endswith("_resistance") for law in liaison.laws)
    return couples or not liaison.kind.of_points or "angular_velocity" in liaison.driven


def spins_in_vain(body: Body, model: Model) -> bool:
    """Whether it may turn about itself, in space, and has no inertia of its own in doing so."""
    bare = body.shape is not None and body.shape.freedoms_space == _SLENDER
    return bare and not (model.planar or "inertia" in body.arguments or is_slender(body, model))


def freedoms_of(body: Body, model: Model) -> int:
    """The number of speeds of the body alone: 3, 5 or 6 in space, 2 or 3 in the plane.

    A rod has five where nothing sees its turn about itself (P. Painlevé 1895, p. 32), else six.
    """
    if body.shape is None:
        return 0
    if model.planar:
        return body.shape.freedoms_planar
    least = body.shape.freedoms_space
    return 6 if least == _SLENDER and not is_slender(body, model) else least


def relations_of(mechanism: Mechanism) -> dict[Liaison, int]:
    """The number of scalar relations of each liaison of the text, in its order.

    With those that prescribe a coordinate, by a value of time or by an equation.
    """
    found: dict[Liaison, int] = dict.fromkeys(mechanism.model.liaisons, 0)
    for link in (*mechanism.contacts, *mechanism.ideal):
        if link.liaison in found:
            found[link.liaison] = link.relation_count
    for liaison, count in prescribed(mechanism).items():
        found[liaison] += count
    return found


def prescribed(mechanism: Mechanism) -> Counter[Liaison]:
    """How many coordinates of each liaison equations prescribe."""
    flanges = mechanism.model.flanges
    return Counter(
        x.liaison for x in flanges if x.effort.name.startswith(f"{x.liaison.name}.drive.")
    )
