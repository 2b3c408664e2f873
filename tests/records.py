"""The recorded segments of a run, one by one, as `segment_store.h` says them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

HEAD = 3  # length, how far back what stands still is, what it tells of its inside
IMPLICIT = 4  # so many vectors tell the inside of a Rosenbrock step


def records(record: Sequence[float]) -> list[np.ndarray]:
    """Each segment with its head."""
    items, at, found = np.asarray(record), 0, []
    while at < len(items):
        found.append(items[at : at + int(items[at])])
        at += len(found[-1])
    return found
