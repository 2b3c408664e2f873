"""The mechanism as plain data: bodies, their coordinates, contacts, pins and forces."""

# Still free of any algebra: expressions are those of the checked model.

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from frot.compiler.lowering.walk import has_time, is_fixed
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
from frot.dsl.data.classes import dataclass, replace

# What has no bodies is told without CasADi.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.mechanics.geometry.figure import Figure, Placed
    from frot.compiler.mechanics.liaisons.lock import Lock
    from frot.compiler.mechanics.liaisons.motion import Motion

Point = BodyPoint | Frame


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """A point, a rim or a curve on a curve of the plane, with the laws that bound its reaction.

    `figure` is what touches: a point, or a rim with its centre at `point`; `track` the figure that
    it touches with a point of it, or its centre. `floor`: that is the line of the ground.
    `reduced`: the coordinates of the body already keep the liaison. `track_first`: the track is
    `a`, the first place of the liaison. Laws are None where there is none.
    """

    liaison: Liaison
    point: Point
    figure: Figure
    track: Placed
    track_first: bool
    floor: bool
    reduced: bool
    unilateral: Expression
    mu: Expression | None
    mu_s: Expression | None
    delta: Expression | None

    @property
    def radius(self) -> None:
        """Of pins only."""
        return None

    @property
    def readings(self) -> int:
        """Reactions that auxiliary speeds bring to light: the normal one."""
        return 1 if self.reduced else 0


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """A liaison of the points `a` and `b` that leaves `motions` and locks the rest.

    `carries`: coordinates can keep it, else only rows. `swapped`: `a` is the second place of the
    liaison. `reduced`: it is built into the coordinates. `mu` and `mu_s` with the `radius` of the
    pin bound its couple; all three are None without friction.
    """

    liaison: Liaison
    a: Point
    b: Point
    motions: tuple[Motion, ...]
    locks: tuple[Lock, ...]
    reduced: bool
    unilateral: Expression
    mu: Expression | None
    mu_s: Expression | None
    radius: Expression | None
    carries: bool = True
    swapped: bool = False

    @property
    def delta(self) -> None:
        """A joint does not roll."""
        return None

    @property
    def held(self) -> tuple[Lock, ...]:
        """The locks that coordinates keep, where they keep the joint: of what rolls, no slip."""
        return tuple(x for x in self.locks if x.kinematic) if rolls(self) else self.locks

    @property
    def readings(self) -> int:
        """Reactions that auxiliary speeds bring to light."""
        return len(self.held) if self.reduced else 0


@dataclass(frozen=True, slots=True, eq=False)
class Relation:
    """One lock of a joint that closes a loop: a row of its own, kept by its reaction."""

    joint: Joint
    lock: Lock
    first: bool
    reduced: bool = False
    readings: int = 0
    mu: None = None
    mu_s: None = None
    delta: None = None
    radius: None = None

    @property
    def liaison(self) -> Liaison:
        """The liaison it belongs to."""
        return self.joint.liaison

    @property
    def unilateral(self) -> Expression:
        """Never."""
        return self.joint.unilateral


Link = Contact | Joint | Relation


@dataclass(frozen=True, slots=True, eq=False)
class Hanging:
    """How a body hangs on another, or on the ground: its coordinates.

    `motions` take the axes at the place `base` of the other to those at the place `own` of the
    body; a body that moves freely has no `link` and
    hangs on the ground by its G. `names` are those of the coordinates, `speeds` those of the
    speeds.
    """

    body: Body
    link: Contact | Joint | None
    base: Point | None
    own: Point | None
    motions: tuple[Motion, ...]
    names: tuple[str, ...]
    speeds: tuple[str, ...]

    @property
    def carries_b(self) -> bool:
        """Whether the body is that of the place `b` of its joint."""
        return isinstance(self.link, Joint) and self.own is self.link.b


def relinked(
    coordinates: Iterable[Hanging], links: Mapping[Liaison, Contact | Joint]
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
    are the bodies added to the model's, each with the one it is a part of (halves.py); `corners`
    the liaisons that one of faces stands for (faces.py).
    """

    model: Model
    coordinates: tuple[Hanging, ...]
    contacts: tuple[Link, ...]
    ideal: tuple[Contact | Joint, ...]
    forces: tuple[Force, ...]
    halves: Mapping[Body, Body]
    corners: Mapping[Liaison, tuple[Liaison, ...]]

    @property
    def counters(self) -> tuple[tuple[Joint | Contact, int], ...]:
        """Angles that no coordinate counts: those of liaisons that close loops, seen within a turn.

        Each with the place of its motion; in the plane the angles of bodies count the turns.
        """
        found: list[tuple[Joint | Contact, int]] = []
        for link in self.contacts:
            if isinstance(link, Relation) and link.first and not self.model.planar:
                motions = enumerate(link.joint.motions)
                found += [(link.joint, k) for k, m in motions if m.comes_round]
        for link in (*self.contacts, *self.ideal):
            follows = isinstance(link, Contact) and link.liaison.kind.name == "point_courbe"
            if isinstance(link, Contact) and follows and not link.reduced:
                found += [(link, 0)] if link.track.figure.is_round else []
        return tuple(found)

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


def rolls(joint: Joint) -> bool:
    """Whether its figures touch without slip, whatever acts on them."""
    return any(lock.rolls for lock in joint.locks)


def is_unilateral(liaison: Liaison) -> bool:
    """Whether the liaison may part: its option is not `false`, and no drive keeps its gap."""
    if "gap" in liaison.driven:
        return False
    option = liaison.options["unilateral"]
    return not (isinstance(option, Literal) and option.value is False)


def is_slender(body: Body, model: Model) -> bool:
    """Whether nothing gives inertia to, or sees, a turn about the body's own x axis."""
    if body.shape is None or body.shape.name != "rod" or "inertia" in body.arguments:
        return False
    own = [
        x
        for x in model.liaisons
        for place in (x.a, x.b)
        if isinstance(place, BodyPoint | Frame) and point_body(place) is body
    ]
    return all(x.kind.name in _OF_POINTS for x in own)


# Liaisons that hold a point and leave every orientation.
_OF_POINTS = (
    *("spherique", "lineaire_annulaire", "tige", "fil", "point_courbe", "point_surface"),
    "contact_ponctuel",
)


def freedoms_of(body: Body, model: Model) -> int:
    """The number of speeds of the body alone: 3, 5 or 6 in space, 2 or 3 in the plane.

    A rod has five where nothing sees its turn about itself (P. Painlevé 1895, p. 32), else six.
    """
    if body.shape is None:
        return 0
    if model.planar:
        return body.shape.freedoms_planar
    return body.shape.freedoms_space if is_slender(body, model) or not _is_rod(body) else 6


def _is_rod(body: Body) -> bool:
    return body.shape is not None and body.shape.name == "rod"


def relations_of(mechanism: Mechanism) -> dict[Liaison, int]:
    """The number of scalar relations of each liaison of the text, in its order.

    With those that prescribe a coordinate, by a value of time or by an equation.
    """
    found: dict[Liaison, int] = dict.fromkeys(mechanism.model.liaisons, 0)
    for link in (*mechanism.contacts, *mechanism.ideal):
        joint = link.joint if isinstance(link, Relation) else link
        if joint.liaison in found:
            found[joint.liaison] = len(joint.locks) if isinstance(joint, Joint) else 1
    for liaison, count in prescribed(mechanism).items():
        found[liaison] += count
    return found


def prescribed(mechanism: Mechanism) -> Counter[Liaison]:
    """How many coordinates of each liaison equations prescribe."""
    flanges = mechanism.model.flanges
    return Counter(
        x.liaison for x in flanges if x.effort.name.startswith(f"{x.liaison.name}.drive.")
    )


def frames_of(point: Point) -> Iterator[Frame]:
    """The frames between a point and its body, from the point on."""
    frame: Body | Frame = point.body if isinstance(point, BodyPoint) else point
    while isinstance(frame, Frame):
        yield frame
        frame = frame.owner


def point_body(point: Point) -> Body:
    """The body a point belongs to."""
    return point.body if isinstance(point, BodyPoint) else owner_body(point)


def owner_body(owner: Body | Frame) -> Body:
    """The body a frame, or a frame on a frame, is fixed to."""
    while isinstance(owner, Frame):
        owner = owner.owner
    return owner


def is_particle(body: Body) -> bool:
    """Whether the body has no orientation."""
    return body.shape is not None and not body.shape.turns


def turns(body: Body) -> bool:
    """Whether the body can have an angular velocity: neither the ground nor a particle."""
    return body.shape is not None and body.shape.turns
