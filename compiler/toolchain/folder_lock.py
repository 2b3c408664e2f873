"""Locks on folders, which end with the process that holds them."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

try:
    import fcntl
except ImportError:  # not a POSIX system: nothing is locked
    fcntl = None  # type: ignore[assignment]


class Hold:
    """Keeps a folder from being removed for as long as this object lives."""

    __slots__ = ("_handle",)

    def __init__(self, handle: int) -> None:
        self._handle = handle

    def __del__(self, close: Callable[[int], None] = os.close) -> None:
        # The module may be gone by then, where a program ends with a model in hand.
        close(self._handle)


def hold(folder: Path, alone: bool = False) -> Hold | None:
    """A hold on a folder; with `alone` only if nobody else has one.

    None if it cannot be had: the folder is gone, held, or on a disk that knows no locks.
    """
    if fcntl is None:
        return None
    try:
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return None
    held = Hold(handle)
    try:
        fcntl.flock(handle, (fcntl.LOCK_EX if alone else fcntl.LOCK_SH) | fcntl.LOCK_NB)
        there = os.stat(folder)
    except OSError:
        return None
    # It may have been removed, and made anew, between the two calls.
    return held if os.path.samestat(there, os.fstat(handle)) else None
