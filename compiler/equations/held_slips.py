"""What is the slip of a friction element is zero to the last bit while friction holds.

In equations, bounds and conditions it stands as a difference of speeds, each of which a run gives
to rounding: through aliases, sums and gears, and with any factor. Such sums are zero in the mode
stick. A condition on the sign of a slip, of a liaison too, follows the mode, which says whether it
slips forwards or backwards: rounding decides nothing at a departure, at a reversal or at rest.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled, HeldSlips
from frot.compiler.equations.text_slips import ModeBook
from frot.compiler.mechanics.variables import FREE, STICK
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.symbolic.vanishing_sums import Zeros
from frot.compiler.translate.text_symbols import FrictionElement


def hold_slips(system: Assembled) -> Assembled:
    """The system with slips at zero where friction holds them, and conditions that follow modes."""
    reduced = system.reduced
    book, conditions = ModeBook(reduced), list(reduced.conditions.values)
    if conditions:
        conditions = _decided_conditions(system, book)
        system = _with(system, book, conditions)
    found = _find_held(system)
    if found is not None:
        system = _hold(system, book, conditions, *found)
    return system


def _with(system: Assembled, book: ModeBook, conditions: Sequence[ca.SX]) -> Assembled:
    """The system with the modes of the book, and these values of its conditions."""
    reduced = book.reduced(conditions)
    discrete = column(d.symbol for d in reduced.text.memory)
    return replace(system, reduced=reduced, discrete=discrete)


def _hold(
    system: Assembled,
    book: ModeBook,
    conditions: list[ca.SX],
    held: HeldSlips,
    elements: list[FrictionElement],
) -> Assembled:
    """With what friction holds at zero in all that decides the motion."""

    def put(value: ca.SX) -> ca.SX:
        new, found = held.put(value)
        for k in sorted(found):
            book.follow(elements[k])
        return new

    conditions = list(conditions)
    for k, value in enumerate(scalars_of(system.resolve(column(conditions)))):
        new = put(value)
        if not ca.is_equal(new, value):  # the others are still known by the variables of the text
            conditions[k] = new
    trees = (
        replace(step, force=put(step.force), couple=put(step.couple)) for step in system.tree.steps
    )
    own, steps = system.matrices, tuple(trees)
    system = replace(
        system,
        held=held,
        rates=put(system.rates),
        matrices=replace(
            own,
            matrix=put(own.matrix),
            force=put(own.force),
            spread=put(own.spread),
            rows=put(own.rows),
            bias=put(own.bias),
            coefficients=put(own.coefficients),
            power=put(own.power),
        ),
        blocks=tuple(replace(b, residual=put(b.residual)) for b in system.blocks),
        tree=replace(system.tree, steps=steps),
    )
    return _with(system, book, conditions)


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
    first = system.matrices.rate.numel() - len(elements)
    found = [
        _Slip(system.matrices.rate[rows.tangent[0]], k)
        for k, (link, rows) in enumerate(zip(links, reduced.contact_rows, strict=True))
        if len(rows.tangent) == 1
    ]
    found += [
        _Slip(system.matrices.rate[first + k], len(links) + k, element)
        for k, element in enumerate(elements)
    ]
    for slip in found:
        if _is_linear(slip.value, v):
            yield slip


def _find_held(system: Assembled) -> tuple[HeldSlips, list[FrictionElement]] | None:
    """The slips of the text and their elements; None where it has none."""
    slips = [(x.value, x.element) for x in _slips(system) if x.element is not None]
    if not slips:
        return None
    modes, elements = system.reduced.variables.modes.of, [element for _, element in slips]
    sticks = tuple(modes[x][1] + 1 == STICK for x in elements)  # literals count from 1
    return HeldSlips(Zeros([value for value, _ in slips], system.v), sticks), elements


def _is_linear(value: ca.SX, speeds: ca.SX) -> bool:
    """Whether speeds stand in a scalar, by factors that hold none of them."""
    if not (speeds.numel() and ca.depends_on(value, speeds)):
        return False
    return not ca.depends_on(ca.jacobian(value, speeds), speeds)


def _decided_conditions(system: Assembled, book: ModeBook) -> list[ca.SX]:
    """The values of the conditions, where those on the sign of a slip follow the mode."""
    conditions, slips = system.reduced.conditions, tuple(_slips(system))
    cases = list(_cases(system, slips)) if slips else []
    decided = [
        value if at_rest is None else at_rest
        for value, at_rest in zip(conditions.values, conditions.at_rest, strict=True)
    ]
    for k, value in enumerate(scalars_of(system.resolve(column(conditions.values)))):
        at_zero = -1 if conditions.strict[k] else 1
        for case in cases if _is_linear(value, system.v) else ():
            which = case.zeros.together(case.put(value))
            if which:
                found = [slips[i] for i in which]
                decided[k] = case.by_senses(book, found, value, decided[k], at_zero)
                break
    return decided


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
        self,
        book: ModeBook,
        slips: Sequence[_Slip],
        value: ca.SX,
        otherwise: ca.SX,
        decided: int,
    ) -> ca.SX:
        """A value that is a sum of slips by their senses, where at most one of them slips."""
        reduced = self.system.reduced
        senses = column(book.sense(x.contact) for x in slips)
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
