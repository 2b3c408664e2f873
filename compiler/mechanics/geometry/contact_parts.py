"""The parts of a contact of the plane: what touches, what it touches, and the laws of both."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Self

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.constraint_geometry import Rows
from frot.compiler.mechanics.geometry.figure import Figure, Placed
from frot.compiler.mechanics.mechanism import is_thread, is_unilateral
from frot.compiler.mechanics.points import Point
from frot.dsl.checked import Expression, Liaison


@dataclass(frozen=True, slots=True, eq=False)
class ContactParts(Constraint):
    """A point, a rim or a curve on a curve of the plane, with the laws that bound its reaction.

    `figure` is what touches: a point, or a rim with its centre at `point`; `track` the figure that
    it touches with a point of it, or its centre. `floor`: that is the line of the ground.
    `reduced`: the coordinates of the body already keep the liaison. `track_first`: the track is
    `a`, the first place of the liaison. `frictions`: sliding, then rolling.
    """

    liaison: Liaison = field()
    point: Point
    figure: Figure
    track: Placed
    track_first: bool
    floor: bool
    unilateral: Expression = field()
    reduced: bool = False
    frictions: tuple[FrictionBlock, ...] = ()
    opens = True

    @property
    def ends(self) -> tuple[Point, Point]:
        """The track carries."""
        return self.track.point, self.point

    @property
    def swapped(self) -> bool:
        """Whether the track is the second place."""
        return not self.track_first

    @property
    def readings(self) -> int:
        """The normal one."""
        return 1 if self.reduced else 0

    @property
    def slips(self) -> bool:
        """A thread has no one way to slip."""
        return not is_thread(self.liaison)

    @property
    def can_carry(self) -> bool:
        """A point that cannot leave its line."""
        return self._follows and not is_unilateral(self.liaison)

    @property
    def keeps_left(self) -> bool:
        """Whether nothing chooses the side: of a thread it is the inside."""
        return self.can_carry or is_thread(self.liaison)

    @property
    def by_coordinates(self) -> bool:
        """On a curve given by its points, or an ellipse."""
        figure = self.track.figure
        return self._follows and figure.plane is None and not figure.is_round

    @property
    def pairs(self) -> tuple[tuple[Figure, Figure], ...]:
        """The one."""
        return ((self.track.figure, self.figure),)

    @property
    def _follows(self) -> bool:
        return self.liaison.kind.along_curve

    def counted(self, planar: bool) -> Iterator[tuple[Constraint, int]]:
        """That of a point on a circle."""
        if self._follows and not self.reduced and self.track.figure.is_round:
            yield self, 0

    def kept(self, reduced: bool) -> Self:
        """By coordinates, or by its row."""
        return replace(self, reduced=reduced)

    def without_friction(self) -> Self:
        """What is smooth."""
        return replace(self, frictions=())

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """Along the normal, along the line, about it."""
        name = self.liaison.name
        return (
            f"{name}.normal_force",
            *([f"{name}.tangential_force"] if rows.tangent else []),
            *([f"{name}.rolling_couple"] if rows.rolling else []),
        )
