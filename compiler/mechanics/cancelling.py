"""What cancels out in the rows of liaisons that close loops, which is rounding of its terms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import casadi as ca
from frot.compiler.mechanics.constraint import Constraint
from frot.compiler.mechanics.constraint_geometry import Geometry
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.make_symbols import link_rows
from frot.compiler.mechanics.mechanism import Mechanism
from frot.compiler.mechanics.values import pace_of
from frot.compiler.symbolic.columns import column
from frot.dsl.checked import CurvePlace, Liaison, SurfacePlace

# Of the size of its terms, what sums of products along a chain leave where they cancel out.
_ROUNDING = 64 * 2.0**-52


def _closing(
    mechanism: Mechanism, geometry: Sequence[Geometry]
) -> Iterator[tuple[int, Constraint, Geometry]]:
    """The row, the relation and the geometry of each lock that closes a loop."""
    rows = link_rows(mechanism.contacts)
    for x, link, own in zip(rows, mechanism.contacts, geometry, strict=True):
        if link.cancels:
            yield x.reaction[0], link, own


def rows_without_rounding(
    rows: ca.SX,
    mechanism: Mechanism,
    geometry: Sequence[Geometry],
) -> ca.SX:
    """The rows of liaisons that close loops, zero where all that is in them cancels out.

    A row that is rounding alone (two pins on one shaft, turned anyhow) would hold what is free. A
    small entry beside larger ones stays: it may be on its way from zero, and must not jump.
    """
    rows = ca.sparsify(rows)
    sizes = {row: 1 + own.reach for row, _, own in _closing(mechanism, geometry)}
    entries = list(ca.vertsplit(ca.vec(rows.nz[:]))) if rows.nnz() else []
    of_row: dict[int, list[int]] = {}
    for k, row in enumerate(rows.sparsity().row()):
        of_row.setdefault(row, []).append(k)
    for row, places in of_row.items():
        if row not in sizes or any(entries[k].is_constant() for k in places):
            continue
        whole = sum((ca.fabs(entries[k]) for k in places), ca.SX(0)) > _ROUNDING * sizes[row]
        for k in places:
            entries[k] = ca.if_else(whole, entries[k], 0)
    return ca.SX(rows.sparsity(), ca.vertcat(*entries)) if entries else rows


def biases_without_rounding(
    biases: ca.SX, rows: ca.SX, mechanism: Mechanism, geometry: Sequence[Geometry]
) -> ca.SX:
    """The biases of the rows; where time moves nothing, what no speed moves has none.

    Turned with its body the term of such a row, as of the pins of a flat loop, is rounding, with
    nothing beside it to be measured by.
    """
    if mechanism.is_driven:
        return biases
    moved = set(rows.sparsity().row())
    still = {row for row, _, _ in _closing(mechanism, geometry)} - moved
    return column(ca.SX(0) if k in still else biases[k] for k in range(biases.numel()))


def sizes_of_drives(
    mechanism: Mechanism,
    kinematics: Kinematics,
    geometry: Sequence[Geometry],
) -> ca.SX:
    """Sizes of what time and speeds bring to the accelerations of rows that close loops.

    Drives that say the same cancel out there, and no speed tells the kernel what is rounding.
    """
    sizes = ca.SX(sum(len(x.all) for x in link_rows(mechanism.contacts)), 1)
    if not mechanism.is_driven:
        return sizes
    for row, link, own in _closing(mechanism, geometry):
        sizes[row] += (1 + own.reach) * _told_by_time(link.liaison, kinematics)
        for place in link.ends:
            there = kinematics.moving(place)
            turns = ca.norm_1(there.angular_bias) + ca.sumsqr(there.angular)
            sizes[row] += ca.norm_1(there.linear_bias) + (1 + own.reach) * turns
    return sizes


def _told_by_time(liaison: Liaison, kinematics: Kinematics) -> ca.SX:
    """The size of the accelerations that what a liaison is given by has of itself."""
    given = [liaison.options]
    for place in (liaison.a, liaison.b):
        if isinstance(place, CurvePlace):
            given.append(place.curve.arguments)
        elif isinstance(place, SurfacePlace):
            given.append(place.surface.arguments)
    return sum((pace_of(values, kinematics.fixed.lower) for values in given), ca.SX(0))
