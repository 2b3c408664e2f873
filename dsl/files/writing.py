"""Writing a file, whole or not at all."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable
from pathlib import Path

from frot.dsl.messages.errors import fail

DATA, PICTURES = (".csv", ".json", ".npz", ".frotrun"), (".png", ".svg", ".pdf")


def check_target(path: str | Path, formats: tuple[str, ...]) -> Path:
    """The path of a file to be written in one of `formats`.

    Called before long work, so that none is lost: FrotError for an unknown format (E0806) and for a
    folder that is not there (E0803).
    """
    path = Path(path)
    if path.suffix.lower() not in formats:
        raise fail(
            "E0806",
            f"the format of '{path}' is not known",
            help=f"name a file that ends in {', '.join(formats)}",
        )
    if not path.parent.is_dir():
        raise fail(
            "E0803",
            f"'{path}' cannot be written: the folder '{path.parent}' does not exist",
            help=f"make the folder '{path.parent}' first",
        )
    return path


def write_whole(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Write a file so that it is there whole or not at all; FrotError (E0803) if it cannot be.

    `content`: the bytes, or pieces of them that are made as they are written. A file that is there
    keeps its permissions, and a link stays one to the file written.
    """
    import tempfile

    pieces = (content,) if isinstance(content, bytes) else content
    target = Path(os.path.realpath(path))
    try:
        if target.exists() and not target.is_file():
            # a device or a pipe is written to, never replaced
            with open(target, "wb") as device:
                device.writelines(pieces)
            return
        mode = _permissions(target)
        handle, name = tempfile.mkstemp(prefix=f".{target.name}-", dir=target.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.writelines(pieces)
            os.chmod(name, mode)
            os.replace(name, target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise fail(
            "E0803",
            f"'{path}' cannot be written: {error.strerror or error}",
            help=remedy(path, error),
        ) from None


def _permissions(target: Path) -> int:
    """Permissions of the existing file; OSError if it may not be written."""
    if target.is_file():
        if not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return stat.S_IMODE(target.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def remedy(path: Path, error: OSError) -> str:
    """The remedy when `path` could not be written."""
    if not path.parent.is_dir():
        return f"make the folder '{path.parent}' first"
    if error.errno == errno.ENOSPC:
        return "free some space, or write to another disk"
    return "choose a file that can be written"
