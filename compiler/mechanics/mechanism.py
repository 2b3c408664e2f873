"""The mechanism as plain data: bodies, their coordinates, contacts, pins and forces."""

# Still free of any algebra: expressions are those of the checked model.

from __future__ import annotations

from dataclasses import dataclass

from frot.dsl.checked import Body, BodyPoint, Curve, Expression, Force, Frame, Liaison, Model

Point = BodyPoint | Frame


@dataclass(frozen=True, slots=True, eq=False)
class FreeCoordinates:
    """The body moves freely: x, y of its centre of mass and, if it turns, its angle."""

    body: Body


@dataclass(frozen=True, slots=True, eq=False)
class LineCoordinates:
    """A point of the body stays on a line: its abscissa and, if the body turns, its angle.

    The liaison is built into the coordinates, so that it never drifts.
    """

    body: Body
    point: Point
    line: Curve
    liaison: Liaison


@dataclass(frozen=True, slots=True, eq=False)
class PinCoordinates:
    """The body hangs on another by a rotoïde: the angle of the liaison, if the body turns.

    `carries_b`: the body is that of the place `b` of the liaison, else of `a`.
    """

    body: Body
    pin: Pin
    carries_b: bool


Coordinates = FreeCoordinates | LineCoordinates | PinCoordinates


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """A point, or the rim of a disc or ring, on a line, with the laws that bound its reaction.

    `round` is the body whose rim touches, or None for a point. `point` is that point or the rim's
    centre. `reduced`: the coordinates of the body already keep the liaison. `line_first`: the line
    is `a`, the first place of the liaison. Laws are None where there is none.
    """

    liaison: Liaison
    point: Point
    round: Body | None
    line: Curve
    line_first: bool
    reduced: bool
    unilateral: Expression
    mu: Expression | None
    mu_s: Expression | None
    delta: Expression | None


@dataclass(frozen=True, slots=True, eq=False)
class Pin:
    """A rotoïde of the points `a` and `b`, built into the coordinates.

    `mu` and `mu_s` with the `radius` of the pin bound its couple; all three are None without
    friction.
    """

    liaison: Liaison
    a: Point
    b: Point
    unilateral: Expression
    mu: Expression | None
    mu_s: Expression | None
    radius: Expression | None

    @property
    def reduced(self) -> bool:
        """The coordinates always keep the liaison."""
        return True

    @property
    def delta(self) -> None:
        """A pin does not roll."""
        return None


Joint = Contact | Pin


@dataclass(frozen=True, slots=True, eq=False)
class Mechanism:
    """What moves and what acts on it.

    `coordinates` has one entry a body, each after the bodies it is described relative to.
    `contacts` are the liaisons whose reactions are computed, because a law or an expression reads
    them or because they close a loop; `ideal` are the liaisons kept by coordinates alone.
    """

    model: Model
    coordinates: tuple[Coordinates, ...]
    contacts: tuple[Joint, ...]
    ideal: tuple[Joint, ...]
    forces: tuple[Force, ...]


@dataclass(frozen=True, slots=True)
class Mobility:
    """Counts for the report: freedoms of the bodies, relations, and what is left."""

    freedoms: int
    bilateral: int
    unilateral: int

    @property
    def degrees_of_freedom(self) -> int:
        """Freedoms less bilateral relations, which is exact where these are independent."""
        return self.freedoms - self.bilateral


def is_unilateral(liaison: Liaison) -> bool:
    """Whether the liaison may part at all (its option is not the word `false`)."""
    from frot.dsl.checked import Literal

    option = liaison.options["unilateral"]
    return not (isinstance(option, Literal) and option.value is False)


def mobility(mechanism: Mechanism) -> Mobility:
    """Count freedoms and relations (planar: 3 a body, 2 a particle)."""
    liaisons = mechanism.model.liaisons
    freedoms = sum(b.shape.freedoms_planar for b in mechanism.model.bodies if b.shape is not None)
    unilateral = [x for x in liaisons if is_unilateral(x)]
    relations = {x: x.kind.relations_planar or 0 for x in liaisons}
    return Mobility(
        freedoms,
        sum(n for x, n in relations.items() if x not in unilateral),
        sum(n for x, n in relations.items() if x in unilateral),
    )


def point_body(point: Point) -> Body:
    """The body a point belongs to."""
    return point.body if isinstance(point, BodyPoint) else owner_body(point)


def owner_body(owner: Body | Frame) -> Body:
    """The body a frame, or a frame on a frame, is fixed to."""
    while isinstance(owner, Frame):
        owner = owner.owner
    return owner


def turns(body: Body) -> bool:
    """Whether the body can have an angular velocity: neither the ground nor a particle."""
    return body.shape is not None and body.shape.turns
