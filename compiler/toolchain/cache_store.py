"""Putting what was compiled into its folder, whole, and making room for it."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path

from frot.compiler.toolchain.cache import Kept, is_ours, new_folder, seal, temporary_folder
from frot.compiler.toolchain.cache_size import make_room
from frot.compiler.toolchain.child_processes import Keeper
from frot.compiler.toolchain.folder_lock import hold
from frot.dsl.files.folders import cache_folder
from frot.dsl.messages.errors import fail
from frot.runtime.program import MANIFEST, Program

# What a folder that cannot be written answers; a full disk is another thing.
_CLOSED = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.EEXIST)


def store(kind: str, key: str, fill: Callable[[Path, Keeper], None]) -> Kept:
    """Fill a new folder, seal it and put it in place whole, unless another was faster.

    `fill` starts its compilers by the keeper, which ends them and removes the folder if this
    process dies. Then room is made: see `make_room`.
    FrotError (E0803) if no folder can be written.
    """
    cache = cache_folder()
    try:
        try:
            unfinished = new_folder(cache / kind)
        except OSError as error:
            if error.errno not in _CLOSED:
                raise
            cache = _own_temporary_folder()
            unfinished = new_folder(cache / kind)
        with unfinished as made, Keeper(Path(made)) as keeper:
            # Held before anything lies in it: a sweeping process takes it for given up otherwise.
            held = hold(Path(made))
            folder = Path(made) / "content"
            folder.mkdir()
            fill(folder, keeper)
            seal(folder)
            target = cache / kind / key
            try:
                os.rename(folder, target)
            except OSError:
                if not target.is_dir():
                    raise
            del held
    except OSError as error:
        raise fail(
            "E0803",
            f"the compiled model cannot be written: {error}",
            help="free some space, or set FROT_CACHE to another folder",
        ) from None
    kept = Kept(target, hold(target))
    make_room(cache, target)
    return kept


def _own_temporary_folder() -> Path:
    """The temporary folder, made if need be; FrotError unless it is ours alone."""
    folder = temporary_folder()
    folder.mkdir(mode=0o700, exist_ok=True)
    if not is_ours(folder):
        raise fail(
            "E0803",
            f"no folder for compiled models: '{folder}' belongs to someone else",
            help="set FROT_CACHE to a folder that can be written",
        )
    return folder


def write_manifest(program: Program, folder: Path) -> None:
    """Write the description last: a folder without it is not a program."""
    (folder / MANIFEST).write_text(program.to_json(), encoding="utf-8")
