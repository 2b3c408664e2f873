"""Writing a file, whole or not at all."""

from __future__ import annotations

import errno
import os
import stat
import tempfile
from pathlib import Path

from frot.dsl.diagnostics import fail


def write_whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there whole or not at all; FrotError (E0803) if it cannot be.

    A file that is there keeps its permissions, and a link stays one to the file written.
    """
    target = Path(os.path.realpath(path))
    try:
        mode = _permissions(target)
        handle, name = tempfile.mkstemp(prefix=f".{target.name}-", dir=target.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            os.chmod(name, mode)
            os.replace(name, target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise fail(
            "E0803",
            f"'{path}' cannot be written: {error.strerror or error}",
            help=_remedy(path, error),
        ) from None


def _permissions(target: Path) -> int:
    """Those of the file that is there; OSError if it may not be written."""
    if target.is_file():
        if not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return stat.S_IMODE(target.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def _remedy(path: Path, error: OSError) -> str:
    if not path.parent.is_dir():
        return f"make the folder '{path.parent}' first"
    if error.errno == errno.ENOSPC:
        return "free some space, or write to another disk"
    return "choose a file that can be written"
