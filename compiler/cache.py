"""The folder of compiled programs, found by what they were made from."""

from __future__ import annotations

import functools
import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

from frot.compiler.toolchain import FLAGS, Toolchain
from frot.dsl.diagnostics import fail
from frot.runtime.program import MANIFEST, Program, read_program

_ROOMS = ("frot.dsl", "frot.dsl.catalogue", "frot.compiler", "frot.runtime", "frot.runtime.kernel")
SEAL = "seal.json"
_KINDS = (".py", ".c", ".h", ".lark")


def cache_folder() -> Path:
    """`$FROT_CACHE`, else the user's cache folder; made if need be, FrotError if it cannot be."""
    chosen = os.environ.get("FROT_CACHE")
    if chosen:
        folder = Path(chosen)
    else:
        import platformdirs

        folder = Path(platformdirs.user_cache_dir("frot", appauthor=False))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return folder
    except OSError:
        pass
    # A home that cannot be written (a service, a container) is no reason to fail.
    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = Path(tempfile.gettempdir()) / f"frot-{user}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        return folder
    except OSError as error:
        raise fail(
            "E0803",
            f"no folder for compiled models: {error}",
            help="set FROT_CACHE to a folder that can be written",
        ) from None


@functools.cache
def own_identity() -> str:
    """Digest of Frot's own sources: another version never meets programs of this one."""
    digest = hashlib.sha256()
    for room in _ROOMS:
        for entry in sorted(files(room).iterdir(), key=lambda e: e.name):
            if entry.name.endswith(_KINDS):
                digest.update(entry.name.encode())
                digest.update(entry.read_bytes())
    return digest.hexdigest()


def program_key(text: str, model: str | None, toolchain: Toolchain) -> str:
    """What a program is made from, as a hexadecimal digest."""
    digest = hashlib.sha256()
    for part in (text, model or "", own_identity(), toolchain.identity, " ".join(FLAGS)):
        digest.update(part.encode("utf-8", "surrogatepass"))
        digest.update(b"\0")
    return digest.hexdigest()


def find_program(key: str) -> Program | None:
    """The cached program, or None. A damaged one is removed."""
    folder = stored("programs", key)
    if folder is None:
        return None
    try:
        program = read_program(folder)
        if program.key == key:
            return program
    except (OSError, ValueError, KeyError, TypeError):
        pass
    shutil.rmtree(folder, ignore_errors=True)
    return None


def store(kind: str, key: str, fill: Callable[[Path], None]) -> Path:
    """Fill a new folder, seal it and put it in place whole, unless another was faster."""
    parent = cache_folder() / kind
    target = parent / key
    try:
        parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".new-", dir=parent) as made:
            folder = Path(made) / "content"
            folder.mkdir()
            fill(folder)
            (folder / SEAL).write_text(json.dumps(_digests(folder)), encoding="utf-8")
            try:
                os.rename(folder, target)
            except OSError:
                if not target.is_dir():
                    raise
    except OSError as error:
        raise fail(
            "E0803",
            f"the compiled model cannot be written: {error}",
            help="free some space, or set FROT_CACHE to another folder",
        ) from None
    return target


def stored(kind: str, key: str) -> Path | None:
    """The folder put in place under this key, or None. A damaged one is removed."""
    folder = cache_folder() / kind / key
    if not folder.is_dir():
        return None
    try:
        if json.loads((folder / SEAL).read_text(encoding="utf-8")) == _digests(folder):
            return folder
    except (OSError, ValueError):
        pass
    shutil.rmtree(folder, ignore_errors=True)
    return None


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
