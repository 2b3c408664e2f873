"""Where things lie that are no texts: the cache, and the rooms of Frot itself."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path


def cache_folder() -> Path:
    """`$FROT_CACHE`, else the user's cache folder; it need not exist."""
    chosen = os.environ.get("FROT_CACHE")
    if chosen:
        return Path(chosen)
    import platformdirs

    return Path(platformdirs.user_cache_dir("frot", appauthor=False))


def room(package: str) -> Path:
    """The folder of a package of Frot.

    Its files are given to a C compiler or read at every start: they lie on a disk, and
    `importlib.resources`, which would find them in an archive too, takes longer than reading them.
    """
    return Path(import_module(package).__path__[0])
