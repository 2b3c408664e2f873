"""Expressions in columns."""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca


def column(values: Iterable[ca.SX]) -> ca.SX:
    """The values below one another; an empty column for none."""
    items = list(values)
    if len(items) == 1:  # most columns of equations
        return items[0]
    return ca.vertcat(*items) if items else ca.SX.zeros(0)


def dense(value: ca.SX) -> ca.SX:
    """The value with an entry everywhere: itself where it has that."""
    return value if value.is_dense() else ca.densify(value)


def scalars_of(symbols: ca.SX) -> list[ca.SX]:
    """The items of a column; none of an empty one."""
    return list(ca.vertsplit(symbols)) if symbols.numel() else []
