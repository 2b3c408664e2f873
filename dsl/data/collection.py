"""The collector of cycles, left out while a compiler makes what it keeps.

Trees, models and expressions are freed where nobody counts on them any more; what few cycles there
are wait for the end. Meanwhile the collector would go through all that is kept, again and again.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_collection() -> Iterator[None]:
    """Leave the collector out.

    It is a third of the time of a large text, and a tenth of that of its equations.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()
