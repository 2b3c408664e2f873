"""What is the slip of a friction element of the text is zero to the last bit while friction holds.

In equations, bounds and conditions it stands as a difference of speeds, each of which a run gives
to rounding: through aliases, sums and gears, and with any factor. Such sums are zero in the mode
stick. A condition on the sign of a slip, of a liaison too, follows the mode, which says whether it
slips forwards or backwards: rounding decides nothing at a departure, at a reversal or at rest.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca
import numpy as np
from frot.compiler.equations.text_slips import follow_mode, sense_of
from frot.compiler.equations.text_symbols import FrictionElement
from frot.compiler.lowering.assembled import Assembled
from frot.compiler.mechanics.variables import FREE, STICK
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.symbolic.vanishing_sums import Zeros
from frot.dsl.data.classes import dataclass, replace


def with_held_slips(system: Assembled) -> Assembled:
    """The system with slips at zero where friction holds them, and conditions that follow modes."""
    reduced = system.reduced
    if reduced.conditions.values:
        _decide_conditions(system)
    held = _HeldSlips.of(system)
    if held is not None:
        system = replace(_held(system, held), held=held.put)
    return replace(system, discrete=column(d.symbol for d in reduced.text.memory))


def _held(system: Assembled, held: _HeldSlips) -> Assembled:
    """With what friction holds at zero in all that decides the motion."""
    conditions = system.reduced.conditions
    for k, value in enumerate(scalars_of(system.resolve(column(conditions.values)))):
        new, found = held.follow_one(value)
        if found:  # the others are still to be known by the variables of the text
            conditions.values[k] = new
    return replace(
        system,
        rates=held.follow(system.rates),
        matrix=held.follow(system.matrix),
        force=held.follow(system.force),
        spread=held.follow(system.spread),
        rows=held.follow(system.rows),
        bias=held.follow(system.bias),
        coefficients=held.follow(system.coefficients),
        power=held.follow(system.power),
        blocks=tuple(replace(b, residual=held.follow(b.residual)) for b in system.blocks),
        tree=replace(
            system.tree,
            steps=tuple(
                replace(step, force=held.follow(step.force), couple=held.follow(step.couple))
                for step in system.tree.steps
            ),
        ),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Slip:
    """A slip that friction may hold; that of a contact of the kernel."""

    value: ca.SX
    contact: int
    element: FrictionElement | None = None


def _slips(system: Assembled) -> Iterator[_Slip]:
    """Those of the liaisons with friction, then those of the text, that speeds make."""
    reduced, v = system.reduced, system.v
    links, elements = reduced.mechanism.contacts, system.elements
    first = system.rate.numel() - len(elements)
    found = [
        _Slip(system.rate[rows.tangent], k)
        for k, (link, rows) in enumerate(zip(links, reduced.contact_rows, strict=True))
        if rows.tangent >= 0 and any(not friction.rolling for friction in link.frictions)
    ]
    found += [
        _Slip(system.rate[first + k], len(links) + k, element) for k, element in enumerate(elements)
    ]
    for slip in found:
        if _is_linear(slip.value, v):
            yield slip


@dataclass(frozen=True, slots=True, eq=False)
class _HeldSlips:
    """Puts zero where sums are slips of the text that friction holds."""

    system: Assembled
    zeros: Zeros
    slips: tuple[_Slip, ...]

    @classmethod
    def of(cls, system: Assembled) -> _HeldSlips | None:
        """Of a system; None where the text has no such slip."""
        slips = tuple(x for x in _slips(system) if x.element is not None)
        return cls(system, Zeros([x.value for x in slips], system.v), slips) if slips else None

    def put(self, value: ca.SX) -> ca.SX:
        """The value with what friction holds at zero."""
        return self.zeros.replace(value, lambda x, k: ca.if_else(self._stick(k), 0, x))[0]

    def follow(self, value: ca.SX) -> ca.SX:
        """The same of what decides the motion."""
        return self.follow_one(value)[0]

    def follow_one(self, value: ca.SX) -> tuple[ca.SX, frozenset[int]]:
        """The same, and the slips that stand in it."""
        new, found = self.zeros.replace(value, lambda x, k: ca.if_else(self._stick(k), 0, x))
        reduced, inside = self.system.reduced, frozenset[int]().union(*found)
        for k in sorted(inside):
            element = self.slips[k].element
            assert element is not None
            follow_mode(reduced.variables, reduced.text, reduced.events, element)
        return new, inside

    def _stick(self, which: frozenset[int]) -> ca.SX:
        """Whether friction holds all of these."""
        modes, whole = self.system.reduced.variables.modes, ca.SX(1)
        for k in sorted(which):
            element = self.slips[k].element
            assert element is not None
            whole = whole * (modes[element][1] + 1 == STICK)  # literals count from 1
        return whole


def _is_linear(value: ca.SX, speeds: ca.SX) -> bool:
    """Whether speeds stand in a scalar, by factors that hold none of them."""
    if not (speeds.numel() and ca.depends_on(value, speeds)):
        return False
    return not ca.depends_on(ca.jacobian(value, speeds), speeds)


def _decide_conditions(system: Assembled) -> None:
    """Let conditions on the sign of a slip follow the mode."""
    conditions, slips = system.reduced.conditions, tuple(_slips(system))
    cases = list(_cases(system, slips)) if slips else []
    for k, value in enumerate(scalars_of(system.resolve(column(conditions.values)))):
        at_rest = conditions.at_rest[k]
        conditions.values[k] = conditions.values[k] if at_rest is None else at_rest
        decided = -1 if conditions.strict[k] else 1
        for case in cases if _is_linear(value, system.v) else ():
            which = case.zeros.together(case.put(value))
            if which:
                found = [slips[i] for i in which]
                conditions.values[k] = case.by_senses(found, value, conditions.values[k], decided)
                break


@dataclass(frozen=True, slots=True, eq=False)
class _Case:
    """The slips where every contact is on the side `side` of its line; on any where that is 0."""

    system: Assembled
    zeros: Zeros
    side: int

    def put(self, value: ca.SX) -> ca.SX:
        """The value on that side."""
        return _on_side(value, self.system, self.side)

    def by_senses(
        self, slips: Sequence[_Slip], value: ca.SX, otherwise: ca.SX, decided: int
    ) -> ca.SX:
        """A value that is a sum of slips by their senses, where at most one of them slips."""
        reduced = self.system.reduced
        senses = column(
            sense_of(reduced.variables, reduced.text, reduced.events, x.contact) for x in slips
        )
        factors = self._factors(slips, value)
        moving = ca.sum1(senses != 0)
        known = ca.if_else(moving == 0, decided, ca.dot(factors, senses))
        where = moving <= 1
        for k, slip in enumerate(slips):
            if slip.element is None:
                where = where * (senses[k] != FREE)
        sides = {x.element_hash() for x in scalars_of(reduced.symbols.sides)}
        for x in ca.symvar(column([value, *(x.value for x in slips)])) if self.side else ():
            if x.element_hash() in sides:
                where = where * (x == self.side)
        return ca.if_else(where, known, otherwise)

    def _factors(self, slips: Sequence[_Slip], value: ca.SX) -> ca.SX:
        """Of the slips in a value that is a sum of them."""
        v = self.system.v
        own = ca.jacobian(self.put(column(x.value for x in slips)), v)
        along = ca.jacobian(self.put(value), v)
        factors = ca.solve(ca.densify(own @ own.T), ca.densify(own @ along.T))
        p = self.system.reduced.symbols.p
        return column(_of_parameters(x, p, self.zeros) for x in ca.vertsplit(factors))


def _cases(system: Assembled, slips: Sequence[_Slip]) -> Iterator[_Case]:
    sides = system.reduced.symbols.sides
    whole = column(x.value for x in slips)
    either = sides.numel() > 0 and ca.depends_on(whole, sides)
    for side in (0, 1, -1) if either else (0,):
        found = scalars_of(_on_side(whole, system, side))
        yield _Case(system, Zeros(found, system.v), side)


def _on_side(value: ca.SX, system: Assembled, side: int) -> ca.SX:
    sides = system.reduced.symbols.sides
    if side == 0 or not sides.numel():
        return value
    return ca.substitute(value, sides, side * ca.SX.ones(sides.shape))


def _of_parameters(factor: ca.SX, p: ca.SX, zeros: Zeros) -> ca.SX:
    """The factor in terms of parameters alone, if these decide it."""
    given = {x.element_hash() for x in scalars_of(p)}
    others = [x for x in ca.symvar(factor) if x.element_hash() not in given]
    if not others:
        return factor
    one, other = (
        ca.substitute(
            factor, column(others), ca.SX(np.random.default_rng(k).uniform(0.5, 2, len(others)))
        )
        for k in range(2)
    )
    return one if zeros.is_zero(one - other) else factor
