"""Where figures touch that no formula tells: solved for at each posture, as the kernel does."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import casadi as ca
import numpy as np
from frot.compiler.mechanics.geometry.closest_solved import Track
from frot.compiler.report.numbers import Floats, Numbers
from frot.compiler.symbolic.columns import column
from frot.compiler.translate.conditions import Conditions
from numpy.typing import ArrayLike

# Newton steps to a place, and the residual of its equations relative to their terms.
_STEPS = 50
_MET = 1e-13


def _seen(value: ca.SX, conditions: Conditions | None) -> ca.SX:
    if conditions is None or not conditions.flags:
        return value
    flags, values = column(conditions.flags), column(conditions.values)
    return ca.substitute(value, flags, values > 0)


class Followed:
    """The unknowns of tracks as functions of a state."""

    def __init__(
        self,
        tracks: Iterable[Track],
        symbols: Sequence[ca.SX],
        resolve: Callable[[ca.SX], ca.SX] = lambda value: value,
        conditions: Conditions | None = None,
    ) -> None:
        """`symbols` are the arguments of the state; `resolve` writes expressions in them.

        The flags of `conditions` are taken as their values say.
        """
        tracks = tuple(tracks)
        self.unknowns = column(x.unknowns for x in tracks)
        residual, size = (
            resolve(_seen(column(x), conditions))
            for x in ([x.residual for x in tracks], [x.size for x in tracks])
        )
        slope = ca.jacobian(residual, self.unknowns)
        start = resolve(column(x.start for x in tracks))
        self._begin = Numbers("begin", symbols, [start])
        self._solve = Numbers("place", [self.unknowns, *symbols], [residual, slope, size])

    def at(self, *state: ArrayLike) -> Floats:
        """The places; no numbers where they are not found."""
        if not self.unknowns.numel():
            return np.zeros(0)
        (begin,) = self._begin(*state)
        places = begin.ravel()
        for _ in range(_STEPS):
            residual, slope, size = self._solve(places, *state)
            if not (np.all(np.isfinite(residual)) and np.all(np.isfinite(slope))):
                break
            if np.all(np.abs(residual) <= _MET * size):
                return places
            step = np.linalg.lstsq(slope, -residual.ravel(), rcond=None)[0]
            places = places + step / max(1.0, 2 * float(np.max(np.abs(step))))
        return np.full(places.shape, np.nan)
