"""Folders that one process of a session makes and all of them read."""

from __future__ import annotations

import fcntl
import hashlib
import os
from collections.abc import Callable
from pathlib import Path

# The environment variable that names the folder of the session.
FOLDER = "FROT_TESTS_FOLDER"


def made_once(key: str, fill: Callable[[Path], object]) -> Path:
    """The folder of this key: the first to ask fills it, who asks meanwhile waits."""
    session = Path(os.environ[FOLDER])
    name = hashlib.sha256(key.encode()).hexdigest()[:24]
    target, half = session / f"made-{name}", session / f"half-{name}"
    if not target.is_dir():
        with (session / f"lock-{name}").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not target.is_dir():
                # Half made by a fill that raised: made anew.
                half.mkdir(exist_ok=True)
                fill(half)
                os.rename(half, target)
    return target
