"""Objects of C sources that are the same for every model: compiled once and kept in the cache."""

from __future__ import annotations

import hashlib
import sys
import tempfile
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from frot.compiler.toolchain.cache import Kept, store, stored
from frot.compiler.toolchain.compilers import (
    KERNEL_FLAGS,
    MODEL_FLAGS,
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


def kernel_folder() -> Path:
    """Where the kernel's sources lie."""
    return Path(str(files("frot.runtime.kernel")))


def kernel_sources() -> list[Path]:
    """The kernel's C files."""
    return sorted(kernel_folder().glob("*.c"))


def kept_kernel(toolchain: Toolchain) -> Kept:
    """The folder of the kernel's objects: the same ones in every program and every FMU."""
    return kept_objects(toolchain, kernel_sources(), [kernel_folder()], KERNEL_FLAGS)


def compile_library(
    toolchain: Toolchain, sources: Sequence[Path], include: Sequence[Path], target: Path
) -> None:
    """Compile the sources of an FMU to a shared library of which only FMI's functions are seen."""
    from frot.runtime.fmi.sources import TABLE_SOURCE

    kernel = {source.name for source in kernel_sources()}
    own = [source for source in sources if source.name in (MODEL_SOURCE, TABLE_SOURCE)]
    face = [source for source in sources if source not in own and source.name not in kernel]
    kept = [kept_kernel(toolchain), kept_objects(toolchain, face, include, KERNEL_FLAGS)]
    with tempfile.TemporaryDirectory(prefix="frot-") as name, Keeper(Path(name)):
        folder = Path(name)
        objects = compile_objects(toolchain, own, include, folder, MODEL_FLAGS)
        objects += sorted(part for one in kept for part in one.folder.glob("*.o"))
        link_library(toolchain, objects, target, only_seen(folder))


def only_seen(folder: Path) -> list[str]:
    """Words for the linker, so that no FMU lends its kernel to another in the same process.

    On Windows what FMI's headers export is seen, and nothing else, without a word.
    """
    if sys.platform == "win32":
        return []
    if sys.platform == "darwin":
        return ["-Wl,-exported_symbol,_fmi*"]
    script = folder / "seen.map"
    script.write_text("{ global: fmi*; local: *; };\n", encoding="ascii")
    return [f"-Wl,--version-script={script}"]
