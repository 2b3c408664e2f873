"""The size of the folder of compiled programs: what it takes, what goes first, what is stale."""

from __future__ import annotations

import contextlib
import functools
import os
import re
import secrets
import shutil
import time
from dataclasses import dataclass
from pathlib import Path
from stat import S_ISDIR

from frot.compiler.toolchain.folder_lock import hold
from frot.dsl.messages.errors import fail

# Folders of entries; files of the parser's tables lie beside them.
KINDS = ("programs", "kernels")
TABLES = "grammar-*.bin"
UNFINISHED = ".new-"
LIMIT = 512 * 10**6
_LIMIT_FILE = "limit"
# Bytes that this process may add to a cache with a limit until it looks at it again.
_room: dict[tuple[str, int], float] = {}
_PROCESSES = 16
# A folder that nobody holds may have been made a moment ago, by someone about to hold it.
_YOUNG = 60.0
_UNITS = {"": 1, "B": 1, "KB": 10**3, "MB": 10**6, "GB": 10**9, "TB": 10**12}
_UNITS |= {"KIB": 2**10, "MIB": 2**20, "GIB": 2**30, "TIB": 2**40}


@dataclass(frozen=True, slots=True)
class Entry:
    """A program, the kernel's objects or the parser's tables: bytes, and when it was last used."""

    path: Path
    size: int
    used: float

    def remove(self) -> bool:
        """Remove it, unless someone uses it."""
        if self.path.is_file():
            with contextlib.suppress(OSError):
                self.path.unlink()
            return not self.path.exists()
        held = hold(self.path, alone=True)
        if held is None:
            return False
        # Under another name first, so that nobody finds half of it.
        doomed = self.path.with_name(f"{UNFINISHED}{secrets.token_hex(8)}")
        try:
            os.rename(self.path, doomed)
        except OSError:
            return False
        shutil.rmtree(doomed, ignore_errors=True)
        return True


def entries(cache: Path) -> list[Entry]:
    """All that is kept, the least recently used first."""
    found = [_entry(path) for kind in KINDS for path in _folders(cache / kind)]
    found += [_entry(str(path)) for path in cache.glob(TABLES)]
    return sorted((e for e in found if e is not None), key=lambda e: e.used)


def shrink(cache: Path, limit: int) -> list[Entry]:
    """Remove what was used least recently until the rest fits; those removed.

    What someone uses stays, so that the rest may still be larger. Kernels of other versions go like
    programs do.
    """
    kept = entries(cache)
    excess = sum(entry.size for entry in kept) - limit
    removed = []
    for entry in kept:
        if excess <= 0:
            break
        if entry.remove():
            removed.append(entry)
            excess -= entry.size
    return removed


def make_room(cache: Path, added: Path) -> None:
    """Remove what is stale and, where the cache is too large, what was used least recently.

    A look at all that is kept takes a while: this process looks again when it has `added` a part
    of the room that it found, the part of one of many processes.
    """
    limit = read_limit(cache)
    entry = _entry(str(added))
    left = _room.get((str(cache), limit), 0.0) - (0 if entry is None else entry.size)
    if left < 0:
        sweep(cache)
        shrink(cache, limit)
        left = (limit - sum(entry.size for entry in entries(cache))) / _PROCESSES
    _room[str(cache), limit] = left


def sweep(cache: Path) -> None:
    """Remove what was begun by processes that are no more."""
    for kind in KINDS:
        for path in _folders(cache / kind, unfinished=True):
            entry = _entry(path)
            if entry is not None and time.time() - entry.used > _YOUNG:
                entry.remove()


def read_limit(cache: Path) -> int:
    """The most bytes that are kept."""
    try:
        return int((cache / _LIMIT_FILE).read_text(encoding="ascii"))
    except (OSError, ValueError):
        return LIMIT


def write_limit(cache: Path, limit: int) -> None:
    """Keep at most so many bytes from now on; FrotError (E0803) if that cannot be noted."""
    from frot.dsl.files.writing import write_whole

    write_whole(cache / _LIMIT_FILE, f"{limit}\n".encode("ascii"))


def bytes_of(text: str) -> int:
    """The bytes of `200 MB`, `1.5GB`, `64 MiB`; FrotError (E0806) for anything else."""
    match = re.fullmatch(r"\s*([0-9]+(?:\.[0-9]+)?)\s*([A-Za-z]*)\s*", text)
    if match is None or match[2].upper() not in _UNITS:
        raise fail("E0806", f"'{text}' is not a size", help="write one such as 200MB or 1.5GB")
    return int(float(match[1]) * _UNITS[match[2].upper()])


def shown(size: int) -> str:
    """A number of bytes as people write it."""
    for unit, factor in (("GB", 10**9), ("MB", 10**6), ("kB", 10**3)):
        if size >= factor:
            return f"{size / factor:.3g} {unit}"
    return f"{size} bytes"


def _folders(parent: Path, unfinished: bool = False) -> list[str]:
    try:
        with os.scandir(parent) as found:
            return [
                entry.path
                for entry in found
                if entry.name.startswith(UNFINISHED) is unfinished and entry.is_dir()
            ]
    except OSError:
        return []


def _entry(path: str) -> Entry | None:
    """None if it has gone meanwhile."""
    try:
        about = os.stat(path)
        size = _bytes_once(path, about.st_ino) if S_ISDIR(about.st_mode) else about.st_size
    except OSError:
        return None
    return Entry(Path(path), size, about.st_mtime)


@functools.lru_cache(maxsize=100_000)
def _bytes_once(folder: str, _inode: int) -> int:
    """The bytes of an entry, whose content is final once it is in place.

    Evaluated for every entry whenever one is added; a text as key is faster than a path.
    """
    return _bytes_in(folder)


def _bytes_in(folder: str) -> int:
    with os.scandir(folder) as found:
        return sum(
            _bytes_in(entry.path) if entry.is_dir(follow_symlinks=False) else entry.stat().st_size
            for entry in found
        )
