"""The equations as the kernel takes them (runtime/kernel/model.h), in CasADi expressions."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence

import casadi as ca
from frot.compiler.equations.chains import Chains, Resolver, replace_known
from frot.compiler.equations.eliminate import Pivot, resolve_all
from frot.compiler.equations.origins import Origin
from frot.compiler.equations.text_symbols import FrictionElement
from frot.compiler.mechanics.reduce import Reduced, Tree
from frot.compiler.symbolic.columns import column
from frot.compiler.symbolic.sums import sizes_of_terms
from frot.compiler.symbolic.vanishing_sums import Zeros
from frot.dsl.data.classes import dataclass, replace
from frot.dsl.messages.source import Span

# On what the Jacobian of a row depends: always, or only beyond an end of a figure.
ALWAYS, BEYOND_ENDS = 1, 2


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
    """States (q, v), y, and the core system `matrix` z = `force` + `spread` lam.

    z (nw): rates of v (nv), auxiliary accelerations (na), algebraic unknowns (nc). The rows
    accelerate by `rows` z + `bias`, and have the speeds `rate`; those of the mechanism's contacts
    come first, then one for each friction element. `rates` are those of q; with `late` they, or
    `power`, depend on z, lam or the y of late blocks. `solution` is what the symbols of the text
    are in terms of these. `tree`: of large trees of bodies `matrix` and `force` have what `Reduced`
    says; where both are looked at, `in_full`. `held` puts zero for
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
    matrix: ca.SX
    force: ca.SX
    force_size: ca.SX
    spread: ca.SX
    metric: ca.SX
    rows: ca.SX
    bias: ca.SX
    rate: ca.SX
    gap: ca.SX
    coefficients: ca.SX
    power: ca.SX
    blocks: tuple[Block, ...]
    invariants: Invariants
    pivots: tuple[Pivot, ...]
    divisors: tuple[Pivot, ...]
    solution: Solution
    tree: Tree
    held: HeldSlips | None = None

    def at_rest(self, value: ca.SX) -> ca.SX:
        """The value with slips of the text that friction holds zero to the last bit."""
        return value if self.held is None else self.held.put(value)[0]

    def resolve(self, value: ca.SX) -> ca.SX:
        """An expression of the text's symbols in terms of t, q, v, u, p, d, y, z and lam."""
        return self.solution.of(value)

    def in_full(self) -> tuple[ca.SX, ca.SX]:
        """Matrix and force with those of large trees of bodies written out."""
        return self.tree.in_full(self.matrix, self.force, self.nv)

    @property
    def nv(self) -> int:
        """The number of speeds."""
        return int(self.v.numel())

    @property
    def early(self) -> int:
        """The number of unknowns of blocks that are solved before the core."""
        return sum(int(b.residual.numel()) for b in self.blocks if not b.late)


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


def row_depends(system: Assembled) -> tuple[tuple[int, ...], ...]:
    """For each row: on which coordinates, and last whether on anything else, its Jacobian depends.

    ALWAYS, or BEYOND_ENDS where it does so only while the contact has passed an end of a figure.
    A row that is driven, were it at a constant rate, depends on what drives it.

    Of the coordinates those count whose rates are speeds; any other state counts as anything else.
    """
    conditions = system.reduced.conditions
    ends = [k for k, contact in enumerate(conditions.contacts) if contact >= 0]
    values = ca.vertcat(ca.vec(system.rows.nz[:]), system.rate)
    table = _row_table(system, values, range(system.rows.size1()))
    flags = column(conditions.flags[k] for k in ends)
    if not ends:
        return tuple(tuple(ALWAYS if x else 0 for x in row) for row in table)
    owners = [conditions.contacts[k] for k in ends]
    passing = _rows_with_own_ends(system, values, flags, owners)
    within = ca.substitute(values, flags, ca.SX.zeros(flags.shape))
    inside = _row_table(system, within, passing, _slopes)
    return tuple(
        tuple(
            0 if not x else BEYOND_ENDS if r in passing and not inside[r][k] else ALWAYS
            for k, x in enumerate(row)
        )
        for r, row in enumerate(table)
    )


def _slopes(values: ca.SX, unknowns: ca.SX) -> ca.Sparsity:
    """Where slopes are not zero: a lever `(x - r) - x` has none."""
    return ca.sparsify(ca.jacobian(values, unknowns)).sparsity()


def _row_table(
    system: Assembled,
    values: ca.SX,
    wanted: Container[int],
    sparsity: Callable[[ca.SX, ca.SX], ca.Sparsity] = ca.jacobian_sparsity,
) -> list[list[bool]]:
    """On which coordinates, and last whether on anything else, the wanted rows depend.

    `values`: the entries of the rows' Jacobian, then their rates. `sparsity`: where these depend on
    unknowns.
    """
    s = system.reduced.symbols
    others = ca.vertcat(s.t, s.u, system.discrete, system.y)
    rows, coordinates = system.rows.size1(), system.q.numel()
    entries = values.numel() - rows
    driven = ca.substitute(values[entries:], system.v, ca.SX.zeros(*system.v.shape))
    table = [[False] * coordinates + [not driven[r].is_zero()] for r in range(rows)]
    places = [*system.rows.sparsity().get_triplet()[0], *range(rows)]
    asked = [k for k, r in enumerate(places) if r in wanted]
    depends = sparsity(values[asked], ca.vertcat(system.q, others))
    # The rates of rows count for all else alone: on coordinates their entries depend.
    for k, x in zip(*depends.get_triplet(), strict=True):
        if x >= coordinates or asked[k] < entries:
            table[places[asked[k]]][min(x, coordinates)] = True
    return table


def _rows_with_own_ends(
    system: Assembled, values: ca.SX, flags: ca.SX, owners: Sequence[int]
) -> set[int]:
    """The rows that switch at ends of figures of their own contacts, and at no other."""
    contacts = {r: k for k, rows in enumerate(system.reduced.contact_rows) for r in rows.all}
    places = [*system.rows.sparsity().get_triplet()[0], *range(system.rows.size1())]
    found: dict[int, bool] = {}
    for k, x in zip(*ca.jacobian_sparsity(values, flags).get_triplet(), strict=True):
        r = places[k]
        found[r] = found.get(r, True) and contacts.get(r) == owners[x]
    return {r for r, own in found.items() if own}


def terms_of_rates(system: Assembled) -> ca.SX:
    """Sizes of the terms of the rates of q, of states that are no coordinates: 0 of the others."""
    own = [k for k, speed in enumerate(system.q_speed) if speed < 0]
    sizes = ca.SX(system.q.numel(), 1)
    if own and not system.late:
        sizes[own] = ca.sparsify(sizes_of_terms(ca.densify(system.rates[own])))
    return sizes
