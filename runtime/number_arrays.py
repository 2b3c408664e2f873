"""Arrays of numbers that the kernel fills, without numpy until it is needed."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

# A run that prints its summary must not wait for numpy.
if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def zeros(count: int) -> array[float]:
    """So many numbers in one piece of memory."""
    return array("d", [0.0]) * count


def as_floats(numbers: array[float]) -> Floats:
    """The same memory as an array of numpy."""
    import numpy as np

    return np.frombuffer(numbers, dtype=np.float64)


def joined(chunks: list[array[float]]) -> array[float]:
    """The parts as one array: a single one is not copied, each of several is freed at once."""
    whole = chunks.pop(0) if chunks else zeros(0)
    while chunks:
        whole.extend(chunks.pop(0))
    return whole


def address(numbers: array[float]) -> int:
    """Where the numbers lie in memory."""
    return numbers.buffer_info()[0]
