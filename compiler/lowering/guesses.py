"""Guesses: where the search for initial values begins, and which of several places it takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.translate.derivative_chains import replace_known
from frot.compiler.translate.expressions import Lowering
from frot.compiler.translate.text_symbols import scalars
from frot.compiler.translate.walk import is_fixed
from frot.dsl.checked import Element, Expression, Quantity
from frot.dsl.quantities.dimensions import Dimension

# Square of the part of a guess that stronger ones must leave, or it says nothing more.
_SLIGHT = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Guess:
    """A scalar, what it is guessed to be equal to and the dimension of both.

    `start`: it is no statement of `initial`, but the `start` of a variable. `whole` is the vector
    of which the scalar is an item: an item that hardly moves beside the others guesses nothing.
    `statement` is the same for all items that are guessed together.
    """

    left: ca.SX
    right: ca.SX
    dimension: Dimension
    start: bool
    whole: ca.SX
    statement: int = -1

    @property
    def missed(self) -> ca.SX:
        """By how much the guess is missed."""
        return self.left - self.right


def list_guesses(system: Assembled, display: Lowering) -> list[Guess]:
    """The guesses of a model, the strongest first.

    A `guess` is stronger than a `start`, and a guess on a state than one on what follows from it.
    """
    model, without_auxiliary = (
        system.reduced.mechanism.model,
        system.reduced.variables.without_auxiliary,
    )
    starts: list[Guess] = []
    for variable in model.variables:
        if variable.start is not None and not variable.discrete and is_fixed(variable.start):
            left = scalars(system.resolve(system.reduced.text.values[variable]))
            right = scalars(display.lower(variable.start))
            right = right * len(left) if len(right) == 1 else right
            of = variable.start.type.dimension
            starts += [Guess(a, b, of, True, a) for a, b in zip(left, right, strict=True)]
    guesses: list[Guess] = []
    for index, equation in enumerate(model.initial):
        if equation.guess:
            left, right = (
                scalars(system.resolve(without_auxiliary(display.lower(side))))
                for side in (equation.left, equation.right)
            )
            of = equation.left.type.dimension
            right = _nearer_turn(equation.left, left, right)
            whole = column(left) - column(right)
            if isinstance(equation.left, Element):
                whole = system.resolve(without_auxiliary(display.lower(equation.left.operand)))
            guesses += [
                Guess(a, b, of, False, whole, index) for a, b in zip(left, right, strict=True)
            ]
    ordered = [sorted(each, key=lambda g: g.left.is_symbolic()) for each in (starts, guesses)]
    return [*ordered[0], *ordered[1]][::-1]


def _nearer_turn(read: Expression, left: list[ca.SX], right: list[ca.SX]) -> list[ca.SX]:
    """What is guessed of an orientation, or its opposite: both turn alike.

    The one is meant that is nearer to what follows from the coordinates. A coordinate itself takes
    the quaternion as it is written.
    """
    turns = isinstance(read, Quantity) and read.name == "orientation"
    if not turns or all(x.is_symbolic() for x in left):
        return right
    opposite = ca.dot(column(left), column(right)) < 0
    return [ca.if_else(opposite, -x, x) for x in right]


def guessed_states(
    system: Assembled, guesses: Sequence[Guess], known: Mapping[int, ca.SX]
) -> dict[int, ca.SX]:
    """The values of the states of the text that are guessed themselves, and not `known`."""
    turns = [range(t.coordinate, t.coordinate + 4) for t in system.reduced.symbols.turns]
    of_text = {
        s.element_hash()
        for k, (s, speed) in enumerate(zip(scalars_of(system.q), system.q_speed, strict=True))
        if speed < 0 and not any(k in four for four in turns)
    }
    moving = ca.vertcat(system.q, system.v, system.y, system.z, system.lam)
    found: dict[int, ca.SX] = {}
    for g in guesses:
        key, own = g.left.element_hash(), g.left.is_symbolic() and not g.start
        if own and key in of_text - known.keys() and not ca.depends_on(g.right, moving):
            found.setdefault(key, g.right)
    return found


def guessed_halves(system: Assembled, guesses: Sequence[Guess]) -> dict[int, ca.SX]:
    """1 or -1, by the first coordinate of each quaternion whose sign is guessed.

    It and its opposite turn alike, so that the search begins at the one that is nearer.
    """
    firsts = {system.q[turn.coordinate].element_hash() for turn in system.reduced.symbols.turns}
    moving = ca.vertcat(system.q, system.v, system.y, system.z, system.lam)
    return {
        g.left.element_hash(): ca.if_else(g.right < 0, -1, 1)
        for g in reversed(guesses)
        if g.left.element_hash() in firsts and not g.start and not ca.depends_on(g.right, moving)
    }


def guessed_places(
    system: Assembled, guesses: Sequence[Guess], known: Mapping[int, ca.SX]
) -> tuple[list[ca.SX], tuple[int, ...]]:
    """The guesses of `initial` of what follows from the coordinates that are not `known`.

    By how much each is missed, the slopes (nq x n) in these coordinates and the size of both sides;
    and, for each, the first item of the vector that it is an item of. Nothing without guesses.
    """
    free = column(s for s in scalars_of(system.q) if s.element_hash() not in known)
    others = ca.vertcat(system.v, system.y, system.z, system.lam)
    found = _guesses_of(guesses, free, others)
    if not found:
        return [], ()
    statements = [g.statement for g in found]
    missed = column(g.missed for g in found)
    sizes = column(ca.fabs(g.left) + ca.fabs(g.right) for g in found)
    moves = column(ca.SX(s.element_hash() not in known) for s in scalars_of(system.q))
    slopes = ca.sparsify(ca.jacobian(missed, system.q) @ ca.diag(moves)).T
    return [missed, slopes, sizes], tuple(statements.index(k) for k in statements)


def guessed_speeds(
    system: Assembled, guesses: Sequence[Guess], known: Mapping[int, ca.SX]
) -> tuple[list[ca.SX], tuple[Dimension, ...]]:
    """The guesses of `initial` of what follows from the speeds that are not `known`.

    By how much each is missed, the square of both its sides; the slopes (nv x n), those of all
    items of the vector that it is an item of (nv x 3 n), both zero but for speeds that nothing but
    these guesses speaks of; 1 for each of these speeds; with the dimension of each. Nothing where
    nothing asks.
    """
    alone = {g.left.element_hash() for g in guesses if g.left.is_symbolic() and not g.start}
    speeds = [(s, s.element_hash()) for s in scalars_of(system.v)]
    free = column(s for s, key in speeds if key not in known)
    found = _guesses_of(
        guesses, free, ca.vertcat(system.y[system.early :, :], system.z, system.lam)
    )
    moves = column(ca.SX(key not in known and key not in alone) for _, key in speeds)
    vectors = (g.whole if g.whole.numel() <= 3 else g.left for g in found)
    wholes = [scalars(ca.vertcat(x, ca.SX.zeros(3 - x.numel()))) for x in vectors]
    missed, squares = (
        column(g.missed for g in found),
        column(g.left**2 + g.right**2 for g in found),
    )
    slopes, all_slopes = (
        ca.sparsify(ca.jacobian(x, system.v) @ ca.diag(moves)).T
        for x in (missed, column(x for w in wholes for x in w))
    )
    if not found or not (slopes.nnz() or system.reduced.mechanism.contacts):
        return [], ()
    return [missed, squares, slopes, all_slopes, moves], tuple(g.dimension for g in found)


def _guesses_of(guesses: Sequence[Guess], free: ca.SX, others: ca.SX) -> list[Guess]:
    """Those of `initial` that follow from what is free, and not from `others`."""
    return [
        g
        for g in guesses
        if not g.start
        and free.numel()
        and ca.depends_on(g.missed, free)
        and not (others.numel() and ca.depends_on(g.missed, others))
    ]


def move_by(
    system: Assembled,
    guesses: Sequence[Guess],
    unknown: ca.SX,
    value: ca.SX,
    known: Mapping[int, ca.SX],
) -> ca.SX:
    """Where the search for the nearest values starts: `value`, moved by each guess in turn.

    What is `known` stays. A guess moves in the directions that the stronger ones before it leave.
    Conditions, which nobody knows yet, are taken not to hold.
    """
    if not unknown.numel():
        return value
    here = {
        s.element_hash(): ca.SX(0) for x in (system.q, system.v, system.y) for s in scalars_of(x)
    }
    reduced = system.reduced
    flags, memory = column(reduced.conditions.flags), column(d.start for d in reduced.text.memory)
    sides = reduced.symbols.sides
    given = values_of(flags, ca.SX.zeros(flags.shape)) | values_of(sides, ca.SX.ones(sides.shape))
    given |= values_of(system.discrete, memory)
    here |= {**given, **values_of(unknown, value), **known}
    free = [s for s in scalars_of(unknown) if s.element_hash() not in known]
    own = {s.element_hash() for s in scalars_of(unknown)} | known.keys() | given.keys()
    solved = ca.vertcat(system.z, system.lam)
    taken: list[ca.SX] = []
    for guess in guesses:
        missed = guess.missed
        inside = {s.element_hash() for s in ca.symvar(missed)} & here.keys()
        if not free or (unknown is system.q and inside - own):
            continue
        if solved.numel() and ca.depends_on(missed, solved):
            continue
        slope = replace_known(ca.jacobian(missed, column(free)).T, here)
        whole = ca.sumsqr(slope)
        if guess.whole.numel() > 1:
            whole = ca.sumsqr(replace_known(ca.jacobian(guess.whole, column(free)), here))
        for other in taken:
            slope -= ca.dot(slope, other) * other
        length = ca.sumsqr(slope)
        if length.is_zero():
            continue
        usable = length > _SLIGHT * whole
        short = -replace_known(missed, here)
        move = ca.if_else(usable, slope * short / length, ca.SX.zeros(slope.shape))
        taken.append(ca.if_else(usable, slope / ca.sqrt(length), ca.SX.zeros(slope.shape)))
        for s, change in zip(free, ca.vertsplit(move), strict=True):
            here[s.element_hash()] = here[s.element_hash()] + change
    return column(here[s.element_hash()] for s in scalars_of(unknown))


def values_of(symbols: ca.SX, values: ca.SX) -> dict[int, ca.SX]:
    """The value of each scalar symbol, by its hash."""
    return {
        s.element_hash(): x for s, x in zip(scalars_of(symbols), scalars_of(values), strict=True)
    }


def natural_places(system: Assembled) -> ca.SX:
    """Where the search begins without a guess: no turn, and zero; what rolls, at the origin."""
    start = ca.SX.zeros(system.q.shape)
    for turn in system.reduced.symbols.turns:
        start[turn.coordinate] = 1
    for place, value in system.reduced.variables.kinematics.starts.items():
        start[place] = replace_known(value, values_of(system.q, start))
    return start


def natural_unknowns(system: Assembled) -> ca.SX:
    """Where the search for the unknowns of the blocks begins without a guess, at these places."""
    start = ca.SX.zeros(system.y.shape)
    for block in system.blocks:
        if block.start is not None:
            start[block.first : block.first + block.start.numel()] = block.start
    return start
