"""What a liaison is to the equations: a contact, a joint, or one relation of a joint.

Each kind answers these questions for itself (geometry/contact.py, liaisons/joint.py,
liaisons/relation.py); nobody asks which kind one is. Free of CasADi, but for what it is asked to
lower.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Self

from frot.dsl.checked import Body, BodyPoint, Expression, Frame, Liaison, Literal
from frot.dsl.quantities.dimensions import BOOLEAN

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.geometry.figure import Figure
    from frot.compiler.mechanics.kinematics import Kinematics
    from frot.compiler.mechanics.liaisons.actions import Effort
    from frot.compiler.mechanics.liaisons.joint import Joint
    from frot.compiler.mechanics.liaisons.lock import Lock
    from frot.compiler.mechanics.liaisons.motion import Motion
    from frot.compiler.mechanics.liaisons.moves import Column
    from frot.compiler.mechanics.spatial import Pose
    from frot.dsl.checked import World

Point = BodyPoint | Frame


@dataclass(frozen=True, slots=True, eq=False)
class Friction:
    """Dry friction of a liaison, bounded by its reaction times `mu`, at rest times `mu_s`.

    Of a contact |R_t| <= mu R_n (P. Painlevé 1895, p. 39), of what rolls a couple up to delta R_n
    (p. 106). A pin of radius r touches its bearing in one place, where R passes at the angle of
    friction f to the normal, tan f = mu: it misses the axis by r sin f, so its couple is
    r |R| sin f. To first order in mu that is mu r |R|, against the turning q', a slip r q'.

    `arm`: the radius of a pin, on which it makes a couple; None where it is a force, or where the
    coefficient is a length itself: `rolling`.
    """

    mu: Expression
    mu_s: Expression
    arm: Expression | None = None
    rolling: bool = False

    @property
    def coefficients(self) -> tuple[Expression, Expression]:
        """Of motion, and of rest."""
        return self.mu, self.mu_s


class Geometry:
    """A link as functions of the coordinates: CasADi expressions.

    `gap` >= 0 while apart; `witness` (3), the first of which that is not zero has the sign of the
    side; `reach`, the size of the lengths that the gap is made of beside the coordinates.

    Of what does not slip `still` is the velocity (3) that is zero beside the normal, with the
    direction (3) in which the row says so. Which direction that is means nothing: how it turns
    adds nothing to the row's acceleration in the motion, and beside it, where the stages of a step
    lie, it must add nothing.
    """

    __slots__ = ()

    gap: ca.SX
    witness: ca.SX
    reach: ca.SX
    still: tuple[ca.SX, ca.SX] | None = None

    @property
    def is_free(self) -> bool:
        """Whether it locks nothing, so that what drives it is all that acts."""
        return False

    @property
    def words(self) -> Mapping[str, str]:
        """Those of `slip`, `normal_force` and `tangential_force` that it has, described."""
        raise NotImplementedError

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """Relative velocities of the link's rows, in their order."""
        raise NotImplementedError

    def coordinate(self, index: int, kinematics: Kinematics) -> tuple[ca.SX, ca.SX]:
        """A coordinate by the place of its motion, and its rate."""
        raise NotImplementedError

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """The rate of a coordinate, with what auxiliary speeds add to it."""
        raise NotImplementedError

    def effort(self, coordinate: str, kinematics: Kinematics) -> Effort:
        """One unit along a coordinate, whether coordinates keep the liaison or not."""
        raise NotImplementedError

    def place(self, kinematics: Kinematics) -> ca.SX:
        """Where it touches, or its place b (3)."""
        raise NotImplementedError

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """A variable of the liaison; KeyError if it has none of this name."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Rows:
    """Rows of a link in the order of the kernel's arrays; -1 where there is none.

    `reaction` are the components of what it locks: of a contact the normal one.
    """

    reaction: tuple[int, ...]
    tangent: int
    rolling: int

    @property
    def all(self) -> tuple[int, ...]:
        """Every row."""
        return (*self.reaction, *(r for r in (self.tangent, self.rolling) if r >= 0))


@dataclass(frozen=True, slots=True, eq=False)
class Reaction:
    """What acts in a liaison.

    `rows` of the reactions `lam`, None where they are not computed; force and couple of what keeps
    prescribed coordinates (`drive`), what a law of the user gives on the body (`friction`).
    """

    rows: Rows | None
    lam: ca.SX
    drive: tuple[ca.SX, ca.SX]
    friction: ca.SX
    planar: bool


class Constraint:
    """A liaison, or a relation of one; what a kind has not, it says no to.

    `reduced`: it is built into the coordinates. `first`: it stands for the liaison, the mode of
    which it has. `opens`: its mode says whether it is closed, and on which side it pushes; `ruled`:
    it has a mode at all. `has_normal`: its reaction is one number along a normal. `rolls`: figures
    touch without slip, whatever acts on them. `kinematic`: a relation between velocities.
    `cancels`: its row may be rounding alone, where it keeps what others keep. `turns`: its gap is
    an angle.
    """

    __slots__ = ()

    first = True
    opens = False
    ruled = True
    has_normal = True
    rolls = False
    kinematic = False
    cancels = False
    turns = False
    frictions: tuple[Friction, ...] = ()

    @property
    def liaison(self) -> Liaison:
        """The liaison it is of."""
        raise NotImplementedError

    @property
    def reduced(self) -> bool:
        """Whether it is built into the coordinates."""
        return False

    @property
    def unilateral(self) -> Expression:
        """Whether it may part: never, but for contacts."""
        return Literal(False, BOOLEAN, self.liaison.span)

    @property
    def whole(self) -> Constraint:
        """That of its liaison."""
        return self

    @property
    def joint(self) -> Joint | None:
        """The joint that it is, or is of."""
        return None

    @property
    def ends(self) -> tuple[Point, Point]:
        """The places: that which would carry, and that which would be carried."""
        raise NotImplementedError

    @property
    def bodies(self) -> tuple[Body, Body]:
        """Those of the places."""
        a, b = self.ends
        return point_body(a), point_body(b)

    @property
    def swapped(self) -> bool:
        """Whether the first of its places is the second of the liaison's."""
        return False

    @property
    def held(self) -> tuple[Lock, ...]:
        """The locks that it keeps as it is."""
        return ()

    @property
    def relation_count(self) -> int:
        """The number of scalar relations of its liaison."""
        return 1

    @property
    def readings(self) -> int:
        """Reactions that auxiliary speeds bring to light."""
        return 0

    @property
    def can_carry(self) -> bool:
        """Whether a point on it carries its body, where no joint does."""
        return False

    @property
    def keeps_places(self) -> bool:
        """Whether it keeps more than velocities."""
        return True

    @property
    def has_gap(self) -> bool:
        """Whether a row keeps its gap."""
        return not self.reduced and not self.kinematic

    @property
    def slips(self) -> bool:
        """Whether there is one way to slip in the plane, so that slip has a sign."""
        return True

    @property
    def by_coordinates(self) -> bool:
        """Whether rows alone cannot tell where on a curve its point is."""
        return False

    @property
    def pairs(self) -> tuple[tuple[Figure, Figure], ...]:
        """The figures that meet."""
        return ()

    @property
    def curves(self) -> tuple[Figure, ...]:
        """Those along which its coordinates go."""
        return ()

    def counted(self, planar: bool) -> Iterator[tuple[Constraint, int]]:
        """Angles that no coordinate counts, by the places of their motions."""
        yield from ()

    def kept(self, reduced: bool) -> Self:
        """The same, built into the coordinates or not."""
        raise NotImplementedError

    def without_friction(self) -> Self:
        """The same without laws."""
        raise NotImplementedError

    def rows(self, told: bool) -> tuple[Constraint, ...]:
        """What it is as rows; `told` if the text has it."""
        return (self,)

    def carrying(self) -> tuple[Motion, ...]:
        """The motions by which it carries bodies that no joint joins to the ground."""
        raise NotImplementedError

    def columns(self, kinematics: Kinematics, a: Pose, b: Pose) -> list[Column]:
        """What auxiliary speeds do that bring its reactions to light, where it carries a body."""
        raise NotImplementedError

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> Geometry:
        """Where it is and how it moves."""
        raise NotImplementedError

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """The names of its rows."""
        raise NotImplementedError


def point_body(point: Point) -> Body:
    """The body a point belongs to."""
    return point.body if isinstance(point, BodyPoint) else owner_body(point)


def owner_body(owner: Body | Frame) -> Body:
    """The body a frame, or a frame on a frame, is fixed to."""
    while isinstance(owner, Frame):
        owner = owner.owner
    return owner


def frames_of(point: Point) -> Iterator[Frame]:
    """The frames between a point and its body, from the point on."""
    frame: Body | Frame = point.body if isinstance(point, BodyPoint) else point
    while isinstance(frame, Frame):
        yield frame
        frame = frame.owner
