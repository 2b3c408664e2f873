"""What a part of the library must do: a variable, its exact course, and how near the run comes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Signal = NDArray[np.float64]
Course = Callable[[Signal], Signal | float]


@dataclass(frozen=True, slots=True)
class Reference:
    """Exact course of one variable over time, SI; `jumps` are the instants it jumps at."""

    variable: str
    exact: Course
    bound: float = 1e-11
    jumps: tuple[float, ...] = ()

    def error(self, time: Signal, values: Signal) -> float:
        """The largest difference, away from the jumps by more than their rounding."""
        far = np.ones(time.shape, dtype=bool)
        for jump in self.jumps:
            far &= np.abs(time - jump) > 1e-9
        assert far.sum() > 50
        return float(np.abs(values - self.exact(time))[far].max())


@dataclass(frozen=True, slots=True)
class Bench:
    """A text that holds parts of one package, and for each part the references it must meet."""

    package: str
    text: str
    references: dict[str, tuple[Reference, ...]]
