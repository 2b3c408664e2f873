"""A bound of a coordinate: a contact whose gap is the way that is left to the bound."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry, GivenFriction, Reaction, Rows
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.laws.stops import Bounds, bounds_of
from frot.compiler.mechanics.points import Point
from frot.dsl.catalogue import LAWS, LIAISONS
from frot.dsl.checked import Expression, Law, Liaison, Literal, World
from frot.dsl.quantities.dimensions import BOOLEAN, REAL


@dataclass(frozen=True, slots=True, eq=False)
class Stop(Constraint):
    """One bound of a coordinate of the constraint `of`.

    `liaison`: one of its own, which can part and has a restitution; `upper`: it is the highest
    value. The reaction acts along the coordinate, away from the bound.
    """

    liaison: Liaison = field()
    of: Constraint
    bounds: Bounds
    upper: bool
    opens = True

    @property
    def turns(self) -> bool:  # type: ignore[override]
        """Whether its gap is an angle."""
        return self.bounds.least.type.dimension == REAL.dimension

    @property
    def unilateral(self) -> Expression:
        """It always can part."""
        return self.liaison.options["unilateral"]

    @property
    def ends(self) -> tuple[Point, Point]:
        """Those of the liaison that it bounds."""
        return self.of.ends

    @property
    def swapped(self) -> bool:
        """As the liaison that it bounds."""
        return self.of.swapped

    @property
    def slips(self) -> bool:
        """It has no tangent."""
        return False

    @property
    def side_of(self) -> Liaison:
        """Its coordinate is on the side on which the liaison is."""
        return self.of.liaison

    @property
    def sign(self) -> int:
        """In which direction it pushes the coordinate."""
        return -1 if self.upper else 1

    @property
    def pushes(self) -> tuple[str, int]:  # type: ignore[override]
        """Along the coordinate, away from the bound."""
        return self.bounds.coordinate, self.sign

    def kept(self, reduced: bool) -> Self:
        """Always by a row."""
        return self

    def without_friction(self) -> Self:
        """It has none."""
        return self

    def geometry(self, kinematics: Kinematics, side: ca.SX, world: World) -> StopGeometry:
        """The way left to the bound, by the coordinate of the liaison."""
        of, name = self.of.geometry(kinematics, side, world), self.bounds.coordinate
        nothing = Reaction(None, ca.SX(0), (ca.SX(0), ca.SX(0)), GivenFriction(), kinematics.planar)
        bound = self.bounds.largest if self.upper else self.bounds.least
        limit = kinematics.fixed.lower(bound)
        value = of.variable(name, nothing)
        rate = of.rate_of(name, kinematics) - kinematics.rate(limit)
        return StopGeometry(
            liaison=of,
            stop=self,
            gap=self.sign * (value - limit),
            rate=self.sign * rate,
            witness=ca.SX.ones(3),
            reach=ca.fabs(limit),
        )

    def labels(self, rows: Rows) -> tuple[str, ...]:
        """Along the coordinate."""
        return (f"{self.liaison.name}.normal_force",)


@dataclass(frozen=True, slots=True, eq=False)
class StopGeometry(Geometry):
    """The way left to a bound: `gap` (m or rad), its `rate`; `liaison`: of what it bounds."""

    liaison: Geometry
    stop: Stop
    gap: ca.SX
    rate: ca.SX
    witness: ca.SX
    reach: ca.SX

    @property
    def words(self) -> dict[str, str]:
        """None: what it does is a part of the liaison's reaction."""
        return {}

    def rates(self, kinematics: Kinematics) -> list[ca.SX]:
        """That of the gap."""
        return [self.rate]

    def rate_of(self, coordinate: str, kinematics: Kinematics) -> ca.SX:
        """Of its gap."""
        return self.rate

    def place(self, kinematics: Kinematics) -> ca.SX:
        """That of the liaison."""
        return self.liaison.place(kinematics)

    def variable(self, name: str, reaction: Reaction) -> ca.SX:
        """Its gap, or its reaction along the coordinate (N or N.m)."""
        if name == "gap":
            return self.gap
        if name == "normal_force" and reaction.rows is not None:
            return reaction.lam[reaction.rows.reaction[0]]
        raise KeyError(name)


def stops_of(link: Constraint, planar: bool) -> tuple[Stop, ...]:
    """The bounds of the coordinates of a liaison, as contacts of their own."""
    found = bounds_of(link.liaison, planar)
    several = len(found) > 1
    return tuple(
        Stop(_parting(link.liaison, bounds, upper, several), link, bounds, upper)
        for bounds in found
        for upper in (False, True)
    )


def _parting(liaison: Liaison, bounds: Bounds, upper: bool, several: bool) -> Liaison:
    """A liaison that can part, with the restitution of the stop."""
    span = bounds.law.span
    name = f"stops_{bounds.coordinate}" if several else "stops"
    rule = Literal("energetic", REAL, span)
    law = Law(LAWS["restitution"], {"e": bounds.restitution, "rule": rule}, span)
    return replace(
        liaison,
        name=f"{liaison.name}.{name}.{'max' if upper else 'min'}",
        kind=KIND,
        options={"unilateral": Literal(True, BOOLEAN, span)},
        laws=(law,),
        driven={},
        relations=(),
        span=span,
    )


# What a stop is to reports and results: a contact at one point.
KIND = replace(LIAISONS["contact_ponctuel"], name="stops", title="stop")
