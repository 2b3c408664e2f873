"""The folder of compiled programs, found by what they were made from."""

from __future__ import annotations

import errno
import functools
import hashlib
import json
import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from frot.compiler.toolchain.cache_size import UNFINISHED, read_limit, shrink, sweep, used_now
from frot.compiler.toolchain.compilers import KERNEL_FLAGS, MODEL_FLAGS, Toolchain
from frot.compiler.toolchain.hold import Hold, hold
from frot.compiler.toolchain.keeper import Keeper
from frot.dsl.data.classes import dataclass, replace
from frot.dsl.messages.errors import fail
from frot.runtime.program import MANIFEST, Program, read_program

_ROOMS = ("frot.dsl", "frot.compiler", "frot.runtime")
SEAL = "seal.json"
INSTALLED = "made"
_KINDS = (".py", ".c", ".h", ".lark")
# What a folder that cannot be written answers; a full disk is another thing.
_CLOSED = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.EEXIST)


@dataclass(frozen=True, slots=True)
class Kept:
    """A folder of the cache, which nobody removes while this object lives."""

    folder: Path
    hold: Hold | None


def cache_folder() -> Path:
    """`$FROT_CACHE`, else the user's cache folder; it need not exist."""
    chosen = os.environ.get("FROT_CACHE")
    if chosen:
        return Path(chosen)
    import platformdirs

    return Path(platformdirs.user_cache_dir("frot", appauthor=False))


def installed_folder() -> Path:
    """What was made when Frot was installed, with folders like the cache's; it need not exist."""
    return Path(str(files("frot.runtime"))) / INSTALLED


def spare_folder() -> Path:
    """Where programs go when the cache cannot be written (a service, a container)."""
    user = os.getuid() if hasattr(os, "getuid") else 0
    return Path(tempfile.gettempdir()) / f"frot-{user}"


@functools.cache
def own_identity() -> str:
    """Digest of Frot's own sources: another version never meets programs of this one."""
    digest = hashlib.sha256()
    for room in _ROOMS:
        for entry in _sources(files(room)):
            digest.update(entry.name.encode())
            digest.update(entry.read_bytes())
    return digest.hexdigest()


def _sources(folder: Traversable) -> Iterator[Traversable]:
    """The source files of a folder and of the folders in it, in a fixed order."""
    for entry in sorted(folder.iterdir(), key=lambda e: e.name):
        if entry.name.endswith(_KINDS):
            yield entry
        elif "." not in entry.name and entry.name != "__pycache__" and entry.is_dir():
            yield from _sources(entry)


def program_key(text: str, model: str | None, toolchain: Toolchain) -> str:
    """What a program is made from, as a hexadecimal digest."""
    digest, flags = hashlib.sha256(), " ".join((*KERNEL_FLAGS, *MODEL_FLAGS))
    for part in (text, model or "", own_identity(), toolchain.identity, flags):
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
        if program.key == key:
            return replace(program, hold=kept.hold)
    except (OSError, ValueError, KeyError, TypeError):
        pass
    shutil.rmtree(kept.folder, ignore_errors=True)
    return None


def store(kind: str, key: str, fill: Callable[[Path], None]) -> Kept:
    """Fill a new folder, seal it and put it in place whole, unless another was faster.

    Then what is stale goes, and what was used least recently where the cache is too large.
    FrotError (E0803) if no folder can be written.
    """
    cache = cache_folder()
    try:
        try:
            unfinished = _begin(cache / kind)
        except OSError as error:
            if error.errno not in _CLOSED:
                raise
            cache = _own_spare_folder()
            unfinished = _begin(cache / kind)
        with unfinished as made, Keeper(Path(made)):
            # Held before anything lies in it: a sweeping process takes it for given up otherwise.
            held = hold(Path(made))
            folder = Path(made) / "content"
            folder.mkdir()
            fill(folder)
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
    sweep(cache)
    shrink(cache, read_limit(cache))
    return kept


def _begin(parent: Path) -> tempfile.TemporaryDirectory[str]:
    parent.mkdir(parents=True, exist_ok=True)
    return tempfile.TemporaryDirectory(prefix=UNFINISHED, dir=parent, ignore_cleanup_errors=True)


def _own_spare_folder() -> Path:
    """The spare folder, made if need be; FrotError if it is not ours alone: programs are run."""
    folder = spare_folder()
    folder.mkdir(mode=0o700, exist_ok=True)
    if not _is_ours(folder):
        raise fail(
            "E0803",
            f"no folder for compiled models: '{folder}' belongs to someone else",
            help="set FROT_CACHE to a folder that can be written",
        )
    return folder


def _is_ours(folder: Path) -> bool:
    if not hasattr(os, "getuid"):
        return True
    try:
        found = os.lstat(folder)
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022


def stored(kind: str, key: str) -> Kept | None:
    """The folder put in place under this key, or None. A damaged one of the cache is removed."""
    made = installed_folder() / kind / key
    if is_whole(made):
        return Kept(made, None)
    spare = spare_folder()
    for cache in (cache_folder(), spare):
        folder = cache / kind / key
        if not folder.is_dir() or (cache == spare and not _is_ours(spare)):
            continue
        held = hold(folder)
        if is_whole(folder):
            used_now(folder)
            return Kept(folder, held)
        shutil.rmtree(folder, ignore_errors=True)
    return None


def seal(folder: Path) -> None:
    """Write last what its files are, so that it shows when one is cut short or changed."""
    (folder / SEAL).write_text(json.dumps(_digests(folder)), encoding="utf-8")


def is_whole(folder: Path) -> bool:
    """Whether it is there with all that it was sealed with."""
    try:
        sealed = json.loads((folder / SEAL).read_text(encoding="utf-8"))
        return bool(sealed == _digests(folder))
    except (OSError, ValueError):
        return False


def _digests(folder: Path) -> dict[str, str]:
    """The digest of every file but the seal."""
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.iterdir())
        if path.name != SEAL
    }


def write_manifest(program: Program, folder: Path) -> None:
    """Write the description last: a folder without it is not a program."""
    (folder / MANIFEST).write_text(program.to_json(), encoding="utf-8")
