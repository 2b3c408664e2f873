"""CasADi functions as functions of arrays of numpy.

A call through CasADi's own door makes a matrix of each argument and of each result, which takes
longer than a small function itself. Here both have their memory, which is read and filled.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np
from frot.compiler.symbolic.columns import dense
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


class Numbers:
    """The values of expressions, as dense matrices, where their symbols have values."""

    __slots__ = ("_buffer", "_function", "_given", "_made", "_run")

    def __init__(self, name: str, symbols: Sequence[ca.SX], values: Sequence[ca.SX]) -> None:
        """`symbols` are the arguments in their order, `values` the results."""
        self._function = ca.Function(name, list(symbols), [dense(x) for x in values])
        # CasADi's types leave out that both take whatever has memory.
        buffer: Any
        buffer, self._run = self._function.buffer()
        self._buffer = buffer
        self._given = [np.zeros(self._function.nnz_in(k)) for k in range(len(symbols))]
        self._made = [np.zeros(self._function.size_out(k), order="F") for k in range(len(values))]
        for k, given in enumerate(self._given):
            if given.size:
                buffer.set_arg(k, given.data)
        for k, made in enumerate(self._made):
            if made.size:
                buffer.set_res(k, made.ravel(order="K").data)

    def __call__(self, *given: ArrayLike) -> list[Floats]:
        """All values, each an array of its own; one argument for each symbol."""
        for room, values in zip(self._given, given, strict=True):
            room[:] = np.ravel(values)
        self._run()
        return [room.copy() for room in self._made]
