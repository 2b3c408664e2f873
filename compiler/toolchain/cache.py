"""The folder of compiled programs, found by what they were made from."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import shutil
import stat
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from frot.compiler.toolchain.compiler_choice import (
    KERNEL_FLAGS,
    Toolchain,
    model_compiler,
    model_flags,
)
from frot.compiler.toolchain.folder_lock import Hold, hold
from frot.dsl.files.folders import cache_folder, room
from frot.runtime.program import Program, load_program, read_program

if TYPE_CHECKING:
    import tempfile

_ROOMS = ("frot.dsl", "frot.compiler", "frot.runtime")
SEAL = "seal.json"
INSTALLED = "made"
_KINDS = (".py", ".c", ".h", ".lark")


@dataclass(frozen=True, slots=True)
class Kept:
    """A folder of the cache, which nobody removes while this object lives."""

    folder: Path
    hold: Hold | None


def installed_folder() -> Path:
    """What was made when Frot was installed, with folders like the cache's; it need not exist."""
    return room("frot.runtime") / INSTALLED


def temporary_folder() -> Path:
    """Where programs go when the cache cannot be written (a service, a container)."""
    import tempfile

    user = os.getuid() if hasattr(os, "getuid") else 0
    return Path(tempfile.gettempdir()) / f"frot-{user}"


def new_folder(parent: Path) -> tempfile.TemporaryDirectory[str]:
    """A folder of an unfinished entry in `parent`, which is made if need be; else OSError."""
    import tempfile

    from frot.compiler.toolchain.cache_size import UNFINISHED

    parent.mkdir(parents=True, exist_ok=True)
    return tempfile.TemporaryDirectory(prefix=UNFINISHED, dir=parent, ignore_cleanup_errors=True)


def _is_writable(parent: Path) -> bool:
    """Whether a new entry can be made there, by making one: permissions do not say it all."""
    try:
        with new_folder(parent):
            return True
    except OSError:
        return False


@functools.cache
def own_identity() -> str:
    """Digest of Frot's own sources: another version never meets programs of this one."""
    digest = hashlib.sha256()
    for package in _ROOMS:
        for path in _sources(str(room(package))):
            digest.update(os.path.basename(path).encode())
            with open(path, "rb") as file:
                digest.update(file.read())
    return digest.hexdigest()


def _sources(folder: str) -> Iterator[str]:
    """The source files of a folder and of the folders in it, in a fixed order."""
    with os.scandir(folder) as found:
        entries = sorted(found, key=lambda e: e.name)
    for entry in entries:
        if entry.name.endswith(_KINDS):
            yield entry.path
        elif "." not in entry.name and entry.name != "__pycache__" and entry.is_dir():
            yield from _sources(entry.path)


def program_key(text: str, model: str | None, toolchain: Toolchain) -> str:
    """What a program is made from, as a hexadecimal digest."""
    digest, flags = hashlib.sha256(), " ".join((*KERNEL_FLAGS, *model_flags()))
    compilers = (toolchain.identity, model_compiler(toolchain).identity)
    for part in (text, model or "", own_identity(), *compilers, flags):
        digest.update(part.encode("utf-8", "surrogatepass"))
        digest.update(b"\0")
    return digest.hexdigest()


def find_program(key: str) -> Program | None:
    """The cached program, or None. A damaged one is removed."""
    kept = stored("programs", key)
    if kept is None:
        return None
    try:
        program = read_program(kept.folder)
        if program.key == key and (needed := _needed(program)) is not None:
            return load_program(program, (kept.hold, needed.hold))
    except (OSError, ValueError, KeyError, TypeError):
        pass
    shutil.rmtree(kept.folder, ignore_errors=True)
    return None


def _needed(program: Program) -> Kept | None:
    """The folder of the kernel that a program needs; None where it is not there as it was."""
    if not program.kernel:
        return Kept(program.folder, None)
    library = Path(program.kernel)
    held = hold(library.parent)
    if not _is_as_sealed(library):
        return None
    _used_now(library.parent)
    return Kept(library.parent, held)


def is_ours(folder: Path) -> bool:
    """Whether nobody else can write there: programs are run."""
    if not hasattr(os, "getuid"):
        return True
    try:
        found = os.lstat(folder)
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022


def stored(kind: str, key: str) -> Kept | None:
    """The folder put in place under this key, or None. A damaged one of the cache is removed.

    The temporary folder is read only where the cache cannot be written, as nothing is put there
    otherwise: what an earlier process has left there is not of the cache that `FROT_CACHE` names.
    """
    made = installed_folder() / kind / key
    if is_whole(made):
        return Kept(made, None)
    cache = cache_folder()
    if (kept := _whole(cache / kind / key)) is not None:
        return kept
    temporary = temporary_folder()
    if not (temporary / kind / key).is_dir() or not is_ours(temporary):
        return None
    return None if _is_writable(cache / kind) else _whole(temporary / kind / key)


def _whole(folder: Path) -> Kept | None:
    """A folder of the cache, held, if it is whole; a damaged one is removed."""
    if not folder.is_dir():
        return None
    held = hold(folder)
    if is_whole(folder):
        _used_now(folder)
        return Kept(folder, held)
    shutil.rmtree(folder, ignore_errors=True)
    return None


def _used_now(folder: Path) -> None:
    """Note that an entry is used; nothing happens where that cannot be written."""
    with contextlib.suppress(OSError):
        os.utime(folder)


def seal(folder: Path) -> None:
    """Write last what its files are, so that it shows when one is cut short or changed."""
    (folder / SEAL).write_text(json.dumps(_digests(folder)), encoding="utf-8")


# Name, number, size and time of change of a file: what is known of it without reading.
_About = tuple[str, int, int, int]
# What was known of files, and of those of folders, when their digests were compared.
_seen_whole: dict[str, list[_About]] = {}


def is_whole(folder: Path) -> bool:
    """Whether it is there with all that it was sealed with."""

    def outside() -> list[_About]:
        with os.scandir(folder) as entries:
            return sorted(_about(entry.name, entry.stat()) for entry in entries)

    return _is_sealed(folder, outside, lambda: _sealed(folder) == _digests(folder))


def _is_as_sealed(path: Path) -> bool:
    """Whether one file of a sealed folder is whole."""
    return _is_sealed(
        path,
        lambda: [_about(path.name, path.stat())],
        lambda: _sealed(path.parent).get(path.name) == _digest(path),
    )


def _is_sealed(
    place: Path, outside: Callable[[], list[_About]], compare: Callable[[], bool]
) -> bool:
    """Whether a place compares with its seal: again only where what is `outside` has changed."""
    try:
        found = outside()
        if _seen_whole.get(str(place)) == found:
            return True
        if not compare():
            return False
    except (OSError, ValueError):
        return False
    _seen_whole[str(place)] = found
    return True


def _about(name: str, found: os.stat_result) -> _About:
    return name, found.st_ino, found.st_size, found.st_mtime_ns


def _sealed(folder: Path) -> dict[str, str]:
    return dict(json.loads((folder / SEAL).read_text(encoding="utf-8")))


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _digests(folder: Path) -> dict[str, str]:
    """The digest of every file but the seal."""
    return {path.name: _digest(path) for path in sorted(folder.iterdir()) if path.name != SEAL}
