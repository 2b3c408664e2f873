"""What scalar equations hold, and their slopes, in time proportional to their length.

A sum over all parts, as the balance of currents at the ground, is one long row among thousands of
short ones. CasADi finds a Jacobian by directions along which several columns are seen at once; one
long row needs as many as it has entries, each through all equations. Such rows are taken alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import casadi as ca
from frot.compiler.lowering.symbols import column

# Entries of a row that is taken together with others.
_SHORT = 24


def symbols_inside(values: Sequence[ca.SX]) -> tuple[list[ca.SX], list[list[int]]]:
    """All symbols that scalars hold, and for each scalar the places of its own among these."""
    whole = column(values)
    symbols = ca.symvar(whole)
    inside: list[list[int]] = [[] for _ in values]
    if symbols:
        rows, places = ca.jacobian_sparsity(whole, column(symbols)).get_triplet()
        for row, place in zip(rows, places, strict=True):
            inside[row].append(place)
    return symbols, inside


def slopes(
    values: Sequence[ca.SX], symbols: Sequence[ca.SX]
) -> tuple[list[int], list[int], list[ca.SX]]:
    """Rows, columns and values of the entries of d(values)/d(symbols), row by row."""
    inside: list[list[int]] = [[] for _ in values]
    if values and symbols:
        pattern = ca.jacobian_sparsity(column(values), column(symbols))
        for i, j in zip(*pattern.get_triplet(), strict=True):
            inside[i].append(j)
    short = [i for i, own in enumerate(inside) if 0 < len(own) <= _SHORT]
    groups: list[tuple[list[int], Sequence[int]]] = []
    if short:
        groups.append((short, range(len(symbols))))
    groups += [([i], own) for i, own in enumerate(inside) if len(own) > _SHORT]
    found: list[tuple[int, int, ca.SX]] = []
    for group, own in groups:
        along = column(symbols[j] for j in own)
        jacobian = ca.jacobian(column(values[i] for i in group), along)
        items = cast("list[ca.SX]", jacobian.nonzeros())
        for i, j, item in zip(*jacobian.sparsity().get_triplet(), items, strict=True):
            found.append((group[i], own[j], item))
    found.sort(key=lambda entry: entry[:2])
    return [i for i, _, _ in found], [j for _, j, _ in found], [x for _, _, x in found]
