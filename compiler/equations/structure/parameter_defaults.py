"""The parameters with their defaults, by which a divisor is known not to be zero."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
from frot.compiler.symbolic.columns import column


class Given:
    """Parameters as symbols, each with its default value.

    An evaluation costs as much as the value is long, however many parameters there are.
    """

    def __init__(self, p: ca.SX, defaults: Sequence[float]) -> None:
        """`p` is a column of symbols, `defaults` their values."""
        symbols = ca.vertsplit(p) if p.numel() else ()
        self._defaults = {s.element_hash(): x for s, x in zip(symbols, defaults, strict=True)}

    def __contains__(self, symbol: ca.SX) -> bool:
        """Whether a symbol is a parameter."""
        return symbol.element_hash() in self._defaults

    def fixed(self, values: ca.SX) -> list[int]:
        """The places in a column whose values hold nothing but parameters."""
        varying = [s for s in ca.symvar(values) if s not in self]
        moving: set[int] = set()
        if varying:
            moving = set(ca.jacobian_sparsity(values, column(varying)).row())
        return [k for k in range(values.numel()) if k not in moving]

    def numbers(self, values: Sequence[ca.SX]) -> list[float]:
        """What scalars of parameters alone are at the defaults."""
        whole = column(values)
        inside = ca.symvar(whole)
        at = [self._defaults[s.element_hash()] for s in inside]
        found = ca.Function("numbers", [column(inside)], [whole])(ca.DM(at)).full()
        return [float(x) for x in found.ravel()]
