"""The equations as the kernel takes them (runtime/kernel/model/model.h), in CasADi expressions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import casadi as ca
from frot.compiler.equations.reduced import Reduced
from frot.compiler.equations.structure.eliminate import Pivot, resolve_all
from frot.compiler.mechanics.reduce import BodyTrees, SystemMatrices
from frot.compiler.symbolic.columns import column, scalars_of
from frot.compiler.symbolic.sums import sizes_of_terms
from frot.compiler.symbolic.vanishing_sums import Zeros
from frot.compiler.translate.derivative_chains import Chains, Resolver, replace_known
from frot.compiler.translate.origins import Origin
from frot.compiler.translate.text_symbols import FrictionElement
from frot.dsl.messages.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Equations 0 = `residual` that determine y[first .. first + count) together.

    `size` is that of their terms and `start` where the search begins, None where nobody knows.
    `followed`: they say where figures touch, and which of several places counts is decided there.
    """

    residual: ca.SX
    first: int
    linear: bool
    late: bool
    name: str
    span: Span
    size: ca.SX | None = None
    start: ca.SX | None = None
    followed: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Invariants:
    """Relations 0 = `values` between states, which every step is projected onto."""

    values: ca.SX
    origins: tuple[Origin, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """What unknowns of the text are in terms of those left.

    `removed` are given by definitions, with all their derivatives, `known` by formulas of
    components (hashes of symbols to values).
    """

    chains: Chains
    removed: Resolver
    known: Mapping[int, ca.SX]

    def of(self, value: ca.SX) -> ca.SX:
        """The value with all of them put in."""
        return replace_known(resolve_all(value, self.chains, self.removed), self.known)


@dataclass(frozen=True, slots=True, eq=False)
class HeldSlips:
    """The slips of the text: where they are zero, and for each whether friction holds it."""

    zeros: Zeros
    sticks: tuple[ca.SX, ...]

    def put(self, value: ca.SX) -> tuple[ca.SX, frozenset[int]]:
        """The value with what friction holds at zero, and the slips that stand in it."""
        new, found = self.zeros.replace(value, lambda x, k: ca.if_else(self._stick(k), 0, x))
        return new, frozenset[int]().union(*found)

    def _stick(self, which: frozenset[int]) -> ca.SX:
        whole = ca.SX(1)
        for k in sorted(which):
            whole = whole * self.sticks[k]
        return whole


@dataclass(frozen=True, slots=True, eq=False)
class Assembled:
    """States (q, v), y, and the core system: see `SystemMatrices`.

    z (nw): rates of v (nv), auxiliary accelerations (na), algebraic unknowns (nc). Rows of the
    mechanism's contacts come first, then one for each friction element. `rates` are those of q;
    with `late` they, or the power, depend on z, lam or the y of late blocks. `solution` is what
    the symbols of the text are in terms of these. `tree`: of large trees of bodies matrix and
    force have what `MotionEquations` says; `in_full` has them written out. `held` puts zero for
    what friction holds.
    """

    reduced: Reduced
    elements: tuple[FrictionElement, ...]
    q: ca.SX
    v: ca.SX
    y: ca.SX
    z: ca.SX
    lam: ca.SX
    discrete: ca.SX
    names: tuple[str, ...]
    q_speed: tuple[int, ...]
    na: int
    nc: int
    late: bool
    rates: ca.SX
    matrices: SystemMatrices
    blocks: tuple[Block, ...]
    invariants: Invariants
    pivots: tuple[Pivot, ...]
    divisors: tuple[Pivot, ...]
    solution: Solution
    tree: BodyTrees
    held: HeldSlips | None = None

    def at_rest(self, value: ca.SX) -> ca.SX:
        """The value with slips of the text that friction holds zero to the last bit."""
        return value if self.held is None else self.held.put(value)[0]

    def resolve(self, value: ca.SX) -> ca.SX:
        """An expression of the text's symbols in terms of t, q, v, u, p, d, y, z and lam."""
        return self.solution.of(value)

    def in_full(self) -> tuple[ca.SX, ca.SX]:
        """Matrix and force with those of large trees of bodies written out."""
        return self.tree.in_full(self.matrices.matrix, self.matrices.force, self.nv)

    @property
    def nv(self) -> int:
        """The number of speeds."""
        return int(self.v.numel())

    @property
    def early(self) -> int:
        """The number of unknowns of blocks that are solved before the core."""
        return sum(int(b.residual.numel()) for b in self.blocks if not b.late)


def plain_system(reduced: Reduced) -> Assembled:
    """A mechanism alone: its mass matrix is the core."""
    s = reduced.symbols
    na = s.sw.numel()
    nothing = ca.SX.zeros(0)
    y, blocks = followed_blocks(reduced)
    return Assembled(
        reduced=reduced,
        elements=(),
        q=s.q,
        v=s.v,
        y=y,
        z=ca.vertcat(s.a, ca.SX.sym("auxiliary", na)),
        lam=s.lam,
        discrete=column(d.symbol for d in reduced.text.memory),
        names=tuple(x.name() for x in (*scalars_of(s.q), *scalars_of(s.v))),
        q_speed=s.q_speed,
        na=na,
        nc=0,
        late=False,
        rates=s.rates,
        matrices=reduced.motion.matrices,
        blocks=blocks,
        invariants=Invariants(nothing, ()),
        pivots=(),
        divisors=(),
        solution=Solution(reduced.text.chains, Resolver(), {}),
        tree=reduced.motion.tree,
    )


def followed_blocks(reduced: Reduced) -> tuple[ca.SX, tuple[Block, ...]]:
    """The unknowns that say where figures touch, and the blocks that solve for them."""
    y: list[ca.SX] = []
    blocks: list[Block] = []
    for liaison, track in reduced.variables.kinematics.tracks.items():
        name = f"the place where '{liaison.name}' touches"
        first, span = sum(int(x.numel()) for x in y), liaison.span
        y.append(track.unknowns)
        own = Block(track.residual, first, False, False, name, span, track.size, track.start)
        blocks.append(replace(own, followed=True))
    return column(y), tuple(blocks)


def row_depends(system: Assembled) -> tuple[tuple[bool, ...], ...]:
    """For each row: on which coordinates, and last whether on anything else, its Jacobian depends.

    A row that is driven, were it at a constant rate, depends on what drives it.

    Of the coordinates those count whose rates are speeds; any other state counts as anything else.
    """
    s = system.reduced.symbols
    others = ca.vertcat(s.t, s.u, system.discrete, system.y)
    driven = ca.substitute(system.matrices.rate, system.v, ca.SX.zeros(*system.v.shape))
    rows, coordinates = system.matrices.rows.size1(), system.q.numel()
    table = [[False] * coordinates + [not driven[r].is_zero()] for r in range(rows)]
    places = [*system.matrices.rows.sparsity().get_triplet()[0], *range(rows)]
    # The rates of rows are asked for all else alone: on coordinates their entries depend.
    values = ca.vertcat(ca.vec(system.matrices.rows.nz[:]), system.matrices.rate)
    entries = len(places) - rows
    depends = ca.jacobian_sparsity(values, ca.vertcat(system.q, others))
    for k, x in zip(*depends.get_triplet(), strict=True):
        if x >= coordinates or k < entries:
            table[places[k]][min(x, coordinates)] = True
    return tuple(map(tuple, table))


def terms_of_rates(system: Assembled) -> ca.SX:
    """Sizes of the terms of the rates of q, of states that are no coordinates: 0 of the others."""
    own = [k for k, speed in enumerate(system.q_speed) if speed < 0]
    sizes = ca.SX(system.q.numel(), 1)
    if own and not system.late:
        sizes[own] = ca.sparsify(sizes_of_terms(ca.densify(system.rates[own])))
    return sizes
