"""What a liaison is to the equations: a contact, a joint, or one relation of a joint.

Each kind answers these questions for itself (geometry/contacts.py, liaisons/joint.py,
liaisons/relation.py); nobody asks which kind one is. Free of CasADi, but for what it
lowers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Self

from frot.compiler.mechanics.points import Point, point_body
from frot.dsl.checked import Body, Expression, Liaison, Literal, World
from frot.dsl.quantities.dimensions import BOOLEAN

TYPE_CHECKING = False
if TYPE_CHECKING:
    import casadi as ca
    from frot.compiler.mechanics.constraint_geometry import Geometry, Rows
    from frot.compiler.mechanics.geometry.figure import Figure
    from frot.compiler.mechanics.kinematics import Kinematics
    from frot.compiler.mechanics.liaisons.actions import Part
    from frot.compiler.mechanics.liaisons.lock import Lock
    from frot.compiler.mechanics.liaisons.motion import Motion
    from frot.compiler.mechanics.liaisons.moves import Column
    from frot.compiler.mechanics.spatial import Pose


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """A coordinate of a joint that friction opposes; `arm`: the radius at which a turn slips."""

    name: str
    arm: Expression | None = None


@dataclass(frozen=True, slots=True, eq=False)
class FrictionBlock:
    """Rows of dry friction of a liaison, bounded by its reaction times `mu`, at rest times `mu_s`.

    The motion has `components` rows, one in the plane; the norm of the friction along them is
    bounded by the norm of one to three rows of the reaction.

    Of a contact |R_t| <= mu R_n (P. Painlevé 1895, p. 39), of what rolls a couple up to delta R_n
    (p. 106). A pin of radius r touches its bearing in one place, where R passes at the angle of
    friction f to the normal, tan f = mu: it misses the axis by r sin f, so its couple is
    r |R| sin f. To first order in mu that is mu r |R|, against the turning q', a slip r q'.

    `arm`: the radius of a pin, on which it makes a couple; None where it is a force, or where the
    coefficient is a length itself: `rolling`, and `pivoting` about the normal. `components`: of the
    motion that it opposes, two in the tangent plane of a contact in space. `ways`: of a joint the
    coordinates that it opposes, none of one that turns any way. `fades`: the speed over which the
    coefficient of motion decreases from that of rest. `smooth`: that over which it grows from zero;
    it then holds nothing at rest. `end`: of a rod without mass the end, 0 or 1,
    at which its body turns against it.
    """

    mu: Expression
    mu_s: Expression
    arm: Expression | None = None
    rolling: bool = False
    pivoting: bool = False
    components: int = 1
    ways: tuple[Way, ...] = ()
    fades: Expression | None = None
    smooth: Expression | None = None
    end: int | None = None

    @property
    def name(self) -> str:
        """The name of its reaction."""
        couple = "rolling_couple" if self.rolling else "tangential_force"
        return "pivoting_couple" if self.pivoting else couple

    @property
    def turns(self) -> bool:
        """Whether it opposes a turning, by a couple."""
        return self.rolling or self.pivoting

    @property
    def coefficients(self) -> tuple[Expression, Expression]:
        """Of motion, and of rest."""
        return self.mu, self.mu_s


class Constraint:
    """A liaison, or a relation of one; what a kind has not, it says no to.

    `reduced`: it is built into the coordinates. `first`: it stands for the liaison, the mode of
    which it has. `opens`: its mode says whether it is closed, and on which side it pushes; `ruled`:
    it has a mode at all. `has_normal`: its reaction is one number along a normal. `rolls`: figures
    touch without slip, whatever acts on them. `kinematic`: a relation between velocities.
    `cancels`: its row may be rounding alone, where it keeps what others keep. `turns`: its gap is
    an angle. `slip_components`: of a slip along it, two in the tangent plane of a contact in space.
    `pushes`: its reaction, times a sign, acts along this coordinate of the liaison `side_of`.
    `repeats`: its readings are reactions that rows of its liaison have already. `uncounted`: the
    components of slip and of turning that it leaves and no coordinate counts. `pinned`: of a rod
    without mass its ends, 0 and 1, in pins that may rub, each against `turnings` components.
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
    slip_components = 1
    frictions: tuple[FrictionBlock, ...] = ()
    pushes: tuple[str, int] | None = None
    repeats = False
    uncounted: tuple[int, int] = (0, 0)
    pinned: tuple[int, ...] = ()
    turnings = 1

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
    def side_of(self) -> Liaison:
        """The liaison on whose side it is."""
        return self.liaison

    @property
    def joint(self) -> JointParts | None:
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

    def bounding(self, rows: Rows) -> tuple[int, ...]:
        """The rows of the reactions that bound its friction."""
        return rows.reaction

    @property
    def norms(self) -> tuple[int, ...]:
        """Of a joint: of how many of these each reaction is made whose length counts."""
        return ()

    def without_friction(self) -> Self:
        """The same without laws."""
        raise NotImplementedError

    def rows(self, stated: bool) -> tuple[Constraint, ...]:
        """What it is as rows; `stated` if the text has it."""
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


@dataclass(frozen=True, slots=True, eq=False)
class JointParts(Constraint):
    """A liaison of the points `a` and `b` that leaves `motions` and locks the rest.

    `carries`: coordinates can keep it, else only rows. `swapped`: `a` is the second place of the
    liaison. `reduced`: it is built into the coordinates. `frictions`: of a pin.
    """

    liaison: Liaison = field()
    a: Point
    b: Point
    motions: tuple[Motion, ...]
    locks: tuple[Lock, ...]
    reduced: bool = False
    frictions: tuple[FrictionBlock, ...] = ()
    carries: bool = True
    swapped: bool = False
    uncounted: tuple[int, int] = (0, 0)
    pinned: tuple[int, ...] = ()
    turnings: int = 1
    has_normal = False

    @property
    def slip_components(self) -> int:  # type: ignore[override]
        """Those that no coordinate counts; of what rolls the directions that do not slip."""
        return sum(lock.rolls for lock in self.locks) or self.uncounted[0] or 1

    @property
    def pressing(self) -> tuple[Lock, ...]:
        """The locks whose reactions bound friction."""
        return tuple(lock for lock in self.locks if lock.presses is not None)

    @property
    def joint(self) -> JointParts:
        """It."""
        return self

    @property
    def is_rigid(self) -> bool:
        """Whether it joins two bodies to one."""
        return self.carries and not self.motions

    @property
    def ends(self) -> tuple[Point, Point]:
        """Its places."""
        return self.a, self.b

    @property
    def rolls(self) -> bool:  # type: ignore[override]
        """Where a lock keeps from slipping."""
        return any(lock.rolls for lock in self.locks)

    @property
    def ruled(self) -> bool:  # type: ignore[override]
        """What rolls does so in every mode."""
        return not self.rolls

    @property
    def first(self) -> bool:  # type: ignore[override]
        """What rolls has its mode with its first relation."""
        return not self.rolls

    @property
    def held(self) -> tuple[Lock, ...]:
        """The locks that coordinates keep, where they keep the joint: of what rolls, no slip."""
        return tuple(x for x in self.locks if x.kinematic) if self.rolls else self.locks

    @property
    def relation_count(self) -> int:
        """That of its locks."""
        return len(self.locks)

    @property
    def readings(self) -> int:
        """Those of all that coordinates keep."""
        return len(self.held) if self.reduced else 0

    @property
    def has_gap(self) -> bool:
        """As a whole it has none."""
        return False

    @property
    def keeps_places(self) -> bool:
        """By locks that are more than relations between velocities."""
        return not all(lock.kinematic for lock in self.locks)

    @property
    def slips(self) -> bool:
        """At the surface of a pin, where figures touch, or along a slide."""
        ways = sum(motion.bare.slides for motion in self.motions)
        pinned = any(x.end is None for x in self.frictions)
        return pinned or self.uncounted[0] > 0 or ways == 1 or self._touches

    @property
    def _touches(self) -> bool:
        return any(x.touches for x in self._parts)

    @property
    def by_coordinates(self) -> bool:
        """Where a lock is."""
        return any(lock.by_coordinates for lock in self.locks)

    @property
    def pairs(self) -> tuple[tuple[Figure, Figure], ...]:
        """Those of its parts."""
        return tuple(x.figures for x in self._parts if x.figures is not None)

    @property
    def curves(self) -> tuple[Figure, ...]:
        """Those of its motions."""
        return tuple(x.curve for x in self.motions if x.curve is not None)

    @property
    def _parts(self) -> tuple[Part, ...]:
        return (*self.motions, *self.locks)

    def kept(self, reduced: bool) -> Self:
        """By coordinates, or by rows."""
        return replace(self, reduced=reduced)

    def without_friction(self) -> Self:
        """A pin that is smooth."""
        return replace(self, frictions=())
