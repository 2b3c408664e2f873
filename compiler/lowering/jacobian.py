"""The Jacobian of the rates of the states, for the implicit method."""

from __future__ import annotations

import itertools
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from frot.compiler.equations.assembled import Assembled
from frot.compiler.lowering.groups import Group, Grouping
from frot.compiler.symbolic.columns import column

# What knows sparse matrices loads SciPy: only where there is one.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.compiler.symbolic.sparsity import Factors

# States up to which the matrix of equations alone is dense, and pivots are chosen by size.
FEW_STATES = 12
# States up to which blocks of equations, whose elimination fills the matrix, are condensed.
MOST_CONDENSED = 300
# States up to which bodies take the implicit method where their inertia fills its matrix.
MOST_FILLED = 400
# Part of a full matrix that its entries are, and of its multiplications that a sparse one takes,
# above which it is treated as full: then the processor does several of them at a time.
SPARSE_ENTRIES, SPARSE_WORK = 0.3, 0.25

# Operations of the values times directions up to which the entries of a motion are written out.
MOST_OPERATIONS = 4_000


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Derivatives of the equations of a motion: runtime/kernel/model/tables.h, frot_lines.

    Entries in `rows` and `columns`, those of owner k from `first`[k] on; the direction of each
    column, the number of directions (0: entries are written out); the columns of each group.
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    first: tuple[int, ...]
    directions: tuple[int, ...]
    n_directions: int
    of_groups: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Jacobian:
    """Arguments and results of the kernel's function `jacobian`, and the pattern of a sparse one.

    `rows` and `columns` are those of the entries. Without `factors` the matrix is dense. `lines`:
    of a motion, whose function gives these.
    """

    arguments: list[ca.SX]
    results: list[ca.SX]
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    factors: Factors | None
    lines: Lines | None = None


def make_jacobian(system: Assembled, grouping: Grouping, state: list[ca.SX]) -> Jacobian | None:
    """The Jacobian where the implicit method can run and may be of use, else None.

    `state`: t, q, v, u, p, d, y.
    """
    method = system.reduced.mechanism.model.experiment.method
    if method == "explicit" or why_explicit(system) is not None:
        return None
    if has_motion(system):
        if method == "auto" and not may_be_stiff(system):
            return None
        return _of_motion(system, grouping, state)
    q, t, n = system.q, system.reduced.symbols.t, system.q.numel()
    slope, rate = ca.jacobian(system.rates, q), ca.jacobian(system.rates, t)
    if system.early:
        y = system.y[: system.early, :]
        residual = column(b.residual for b in system.blocks if not b.late)
        parts = [ca.jacobian(system.rates, y), *(ca.jacobian(residual, x) for x in (q, t, y))]
        return Jacobian(state, [slope, rate, *parts], (), (), None)
    rows, columns = (tuple(x) for x in slope.sparsity().get_triplet())
    if n <= FEW_STATES:
        return Jacobian(state, [slope, rate], (), (), None)
    from frot.compiler.symbolic.sparsity import factor_pattern

    factors = factor_pattern(np.array(rows, dtype=np.intp), np.array(columns, dtype=np.intp), n)
    return Jacobian(state, [column(ca.vertsplit(slope.nz[:])), rate], rows, columns, factors)


def _of_motion(system: Assembled, grouping: Grouping, state: list[ca.SX]) -> Jacobian | None:
    """The derivatives of the equations of a motion; None where their matrix is full and too large.

    The accelerations z and reactions lam are arguments: the kernel solves for their derivatives, in
    the mode, with the matrix by which it solves for themselves. Where all entries would be a long
    function, it is one of a direction, called for each colour of the columns: those of one colour
    meet in no line.
    """
    groups = grouping.groups
    owned = _owned(system, grouping)
    values = ca.vertcat(*owned)
    moved = ca.vertcat(system.q, system.v, system.y[: system.early, :])
    arguments = [*state, system.z, system.lam]
    sizes = [int(x.numel()) for x in owned]
    pattern = ca.jacobian_sparsity(values, moved)
    colours = _colours(pattern)
    count = ca.Function("f", arguments, [values]).n_instructions() * (max(colours) + 1)
    if count <= MOST_OPERATIONS:
        slope = ca.sparsify(ca.jacobian(values, moved))
        lines = _lines(slope.sparsity(), sizes, colours, 0)
        results = _listed(slope, lines)
    else:
        seed = ca.SX.sym("seed", moved.numel())
        lines = _lines(pattern, sizes, colours, max(colours) + 1)
        arguments, results = [*arguments, seed], ca.jtimes(values, moved, seed)
    order = int(system.q.numel()) + system.nv
    rows, columns = _entries(lines, groups, int(system.q.numel()))
    factors = None if system.early else _sparse_factors(rows, columns, order)
    if factors is None:
        return None if order > MOST_FILLED else Jacobian(arguments, [results], (), (), None, lines)
    return Jacobian(arguments, [results], rows, columns, factors, lines)


def _owned(system: Assembled, grouping: Grouping) -> list[ca.SX]:
    """The equations, by owners: the rates of q, the groups, the residuals of the early blocks."""
    matrix, force = system.in_full()
    balance = matrix @ system.z - system.matrices.spread @ system.lam - force
    motion = system.matrices.rows @ system.z + system.matrices.bias
    parts = [system.rates]
    for g in grouping.groups:
        laws = [2 * e + k for e in g.elements for k in (0, 1)]
        # along what slips in several components friction turns with the slip
        turning = [grouping.elements[e].row for e in g.elements if grouping.elements[e].parts > 1]
        of_group = (
            (balance, g.unknowns),
            (motion, g.rows),
            (system.matrices.coefficients, laws),
            (system.matrices.rate, turning),
        )
        # nothing taken from a scalar would be a row of CasADi's
        parts.append(column(values[k] for values, places in of_group for k in places))
    return [*parts, column(b.residual for b in system.blocks if not b.late)]


def _colours(pattern: ca.Sparsity) -> list[int]:
    """A colour for each column, greedily."""
    colours = [0] * pattern.size2()
    by_line: list[set[int]] = [set() for _ in range(pattern.size1())]
    starts, lines = pattern.colind(), pattern.row()
    for k in range(pattern.size2()):
        own = lines[starts[k] : starts[k + 1]]
        taken = set().union(*(by_line[i] for i in own))
        colours[k] = next(c for c in itertools.count() if c not in taken)
        for i in own:
            by_line[i].add(colours[k])
    return colours


def _lines(pattern: ca.Sparsity, sizes: list[int], colours: list[int], directions: int) -> Lines:
    """`sizes`: the number of lines of each owner."""
    owner = [k for k, size in enumerate(sizes) for _ in range(size)]
    entries = sorted(zip(*pattern.get_triplet(), strict=True), key=lambda e: owner[e[0]])
    owners = [owner[line] for line, _ in entries]
    first = tuple(bisect_left(owners, k) for k in range(len(sizes) + 1))
    return Lines(
        rows=tuple(line for line, _ in entries),
        columns=tuple(c for _, c in entries),
        first=first,
        directions=tuple(colours),
        n_directions=directions,
        of_groups=tuple(
            tuple(sorted({c for _, c in entries[first[k] : first[k + 1]]}))
            for k in range(1, len(sizes) - 1)
        ),
    )


def _listed(slope: ca.SX, lines: Lines) -> ca.SX:
    """The entries in the order of the lines."""
    place = {e: k for k, e in enumerate(zip(*slope.sparsity().get_triplet(), strict=True))}
    order = [place[e] for e in zip(lines.rows, lines.columns, strict=True)]
    return ca.densify(slope.nz[order]) if order else ca.SX.zeros(0)


def _entries(
    lines: Lines, groups: Sequence[Group], nq: int
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Rows and columns of the Jacobian: of the rates of q, then group after group, by columns."""
    entries = list(zip(lines.rows[: lines.first[1]], lines.columns[: lines.first[1]], strict=True))
    for g, columns in zip(groups, lines.of_groups, strict=True):
        entries += [(nq + v, c) for c in columns for v in g.unknowns[: g.n_speeds]]
    return tuple(row for row, _ in entries), tuple(c for _, c in entries)


def _sparse_factors(rows: Sequence[int], columns: Sequence[int], n: int) -> Factors | None:
    """The pattern of the factors, or None where a full matrix is factored sooner."""
    if n <= FEW_STATES or len(rows) > SPARSE_ENTRIES * n * n:
        return None
    from frot.compiler.symbolic.sparsity import factor_pattern

    factors = factor_pattern(np.array(rows, dtype=np.intp), np.array(columns, dtype=np.intp), n)
    return factors if factors.work <= SPARSE_WORK * n**3 / 3 else None


def has_motion(system: Assembled) -> bool:
    """Whether there are accelerations or reactions to be solved for."""
    return bool(system.nv or system.lam.numel())


def may_be_stiff(system: Assembled) -> bool:
    """Whether a load depends on the motion, or equations of the text act on the bodies.

    Inertia, weight and dry friction alone have no rates that are fast beside the motion.
    """
    reduced = system.reduced
    if slips_in_space(system):
        return True  # slow slip: its direction has the rate of friction over slip
    states = any(symbol < 0 for symbol in _unturned(system))
    # blocks that say where figures touch, which have a beginning, bring no rates of their own
    blocks = any(not b.late and b.start is None for b in system.blocks)
    if states or system.nc or blocks or reduced.mechanism.model.flanges:
        return True
    if system.nv > reduced.symbols.v.numel():
        return True
    loads = system.resolve(reduced.motion.load_sizes)
    return bool(loads.numel()) and bool(ca.depends_on(loads, ca.vertcat(system.q, system.v)))


def _unturned(system: Assembled) -> list[int]:
    """`q_speed` without orientations, places of what rolls, and counted turns of angles."""
    symbols, counters = system.reduced.symbols, len(system.reduced.mechanism.counters)
    turned = {turn.coordinate + k for turn in symbols.turns for k in range(4)}
    turned |= set(symbols.spots)
    turned |= set(range(symbols.q.numel() - counters, symbols.q.numel()))
    return [speed for k, speed in enumerate(system.q_speed) if k not in turned]


def slips_in_space(system: Assembled) -> bool:
    """Whether friction opposes a slip of several components."""
    links = system.reduced.mechanism.contacts
    return any(friction.components > 1 for link in links for friction in link.frictions)


def why_explicit(system: Assembled) -> str | None:
    """What keeps the implicit method from a model whatever it costs, or None.

    As in `the method 'implicit' is not supported for a model without states`.
    """
    if system.late:
        return "a model whose rates need what is solved last"
    if system.early and system.q.numel() + system.nv > MOST_CONDENSED:
        return f"a model with blocks of equations and more than {MOST_CONDENSED} states"
    return None if system.q.numel() + system.nv else "a model without states"


def too_full(system: Assembled) -> str:
    """What keeps it from a model with bodies whose matrix is full and too large."""
    count = int(system.q.numel()) + system.nv
    return f"a model whose {count} states all act on each other: {MOST_FILLED} at most"


def alike(system: Assembled) -> tuple[int, ...]:
    """For each state that is no coordinate the first of its dimension; itself for the others."""
    chains = system.reduced.text.chains
    first: dict[tuple[object, int], int] = {}
    table = []
    for k, symbol in enumerate(ca.vertsplit(system.q) if system.q.numel() else ()):
        chain, order = chains.place.get(symbol.element_hash(), (-1, 0))
        variable = chains.items[chain].variable if chain >= 0 else None
        if variable is None or system.q_speed[k] >= 0:
            table.append(k)
        else:
            table.append(first.setdefault((variable.type.dimension, order), k))
    return tuple(table)
