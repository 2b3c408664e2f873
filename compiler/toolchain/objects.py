"""Objects of C sources that are the same for every model: compiled once and kept in the cache."""

from __future__ import annotations

import hashlib
import tempfile
from collections.abc import Sequence
from pathlib import Path

from frot.compiler.toolchain.cache import Kept, store, stored
from frot.compiler.toolchain.compilers import (
    FLAGS,
    HIDDEN,
    Toolchain,
    compile_objects,
    link_library,
)
from frot.compiler.toolchain.keeper import Keeper
from frot.runtime.program import MODEL_SOURCE


def kept_objects(
    toolchain: Toolchain, sources: Sequence[Path], include: Sequence[Path], flags: Sequence[str]
) -> Kept:
    """The folder of the objects of these sources; compiled if nothing they are made from is kept.

    Headers are all `.h` files beside the sources and in the folders of `include`.
    """
    folders = sorted({*include, *(source.parent for source in sources)})
    headers = [path for folder in folders for path in sorted(folder.glob("*.h"))]
    digest = hashlib.sha256("\0".join((toolchain.identity, *flags)).encode())
    for path in (*sources, *headers):
        digest.update(f"\0{path.name}\0".encode())
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    key = digest.hexdigest()

    def fill(folder: Path) -> None:
        compile_objects(toolchain, sources, include, folder, flags)

    return stored("kernels", key) or store("kernels", key, fill)


def compile_library(
    toolchain: Toolchain, sources: Sequence[Path], include: Sequence[Path], target: Path
) -> None:
    """Compile the sources of an FMU to a shared library of which only marked functions are seen."""
    from frot.runtime.fmi.sources import TABLE_SOURCE

    flags = (*FLAGS, HIDDEN)
    own = [source for source in sources if source.name in (MODEL_SOURCE, TABLE_SOURCE)]
    kept = kept_objects(toolchain, [s for s in sources if s not in own], include, flags)
    with tempfile.TemporaryDirectory(prefix="frot-") as folder, Keeper(Path(folder)):
        objects = compile_objects(toolchain, own, include, Path(folder), flags)
        link_library(toolchain, [*objects, *sorted(kept.folder.glob("*.o"))], target)
