"""Objects of C sources that are the same for every model: compiled once and kept in the cache."""

from __future__ import annotations

import functools
import hashlib
import shutil
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from frot.compiler.toolchain.cache import Kept, is_whole, seal, stored
from frot.compiler.toolchain.cache_store import store
from frot.compiler.toolchain.child_processes import Keeper
from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS, Toolchain, find_toolchain
from frot.compiler.toolchain.compilers import (
    compile_objects,
    join_objects,
    link_library,
    merge_sections,
)
from frot.dsl.files.folders import room
from frot.dsl.messages.errors import FrotError

KERNELS = "kernels"
# The kernel's objects as one, which a linker takes in half of the time.
_JOINED = "kernel.joined.o"
# The same for programs, which take all of it: a linker takes three quarters of the time.
_WHOLE = "kernel.whole.o"
# The library that programs of this machine share, each with its path in it.
_SHARED = "kernel.so"


def kept_objects(
    toolchain: Toolchain, sources: Sequence[Path], include: Sequence[Path], flags: Sequence[str]
) -> Kept:
    """The folder of the objects of these sources; compiled if nothing they are made from is kept.

    Headers are all `.h` files beside the sources and in the folders of `include`, however deep.
    """
    key = _key(toolchain, sources, include, flags)

    def fill(folder: Path, keeper: Keeper) -> None:
        compile_objects(toolchain, sources, include, folder, flags, keeper)

    return stored(KERNELS, key) or store(KERNELS, key, fill)


def _key(
    toolchain: Toolchain, sources: Sequence[Path], include: Sequence[Path], flags: Sequence[str]
) -> str:
    """What objects are made from, as a hexadecimal digest."""
    roots = sorted({*include, *(source.parent for source in sources)})
    headers = {path: path.relative_to(root) for root in roots for path in root.rglob("*.h")}
    named = {**{path: Path(path.name) for path in sources}, **headers}
    digest = hashlib.sha256("\0".join((toolchain.identity, *flags)).encode())
    for path, name in sorted(named.items(), key=lambda item: item[1]):
        digest.update(f"\0{name.as_posix()}\0".encode())
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def install_kernel(folder: Path, made: Sequence[Path], target: Path) -> None:
    """Put the objects of the kernel, whose sources lie in `folder`, under the folder `target`.

    They are looked for there as in the cache. Copied from one of `made`, folders like `target`,
    where one has them; whatever else `target` holds goes. FrotError (E0801, E0802) if there is no
    compiler or it fails.
    """
    toolchain = find_toolchain()
    key = _key_of_kernel(toolchain, folder)
    new, old = target / KERNELS / key, [root / KERNELS / key for root in made]
    if is_whole(new):
        return
    shutil.rmtree(target, ignore_errors=True)
    new.mkdir(parents=True)
    whole = next((one for one in old if is_whole(one)), None)
    if whole is None:
        with Keeper() as keeper:
            _compile_kernel(toolchain, folder, new, keeper)
        seal(new)
    else:
        shutil.copytree(whole, new, dirs_exist_ok=True)


def kernel_folder() -> Path:
    """Where the kernel's sources lie."""
    return room("frot.runtime.kernel")


def kernel_sources(folder: Path) -> list[Path]:
    """The kernel's C files, in the folders below the one given."""
    return sorted(folder.rglob("*.c"))


def kept_kernel(toolchain: Toolchain) -> Kept:
    """The folder of the kernel's objects: the same ones in every program and every FMU."""
    key = _own_key(replace(toolchain, environment=()))

    def fill(folder: Path, keeper: Keeper) -> None:
        _compile_kernel(toolchain, kernel_folder(), folder, keeper)

    return stored(KERNELS, key) or store(KERNELS, key, fill)


def kernel_objects(kernel: Kept) -> list[Path]:
    """What a linker takes of the kernel's folder."""
    joined = kernel.folder / _JOINED
    return [joined] if joined.is_file() else sorted(kernel.folder.glob("*.o"))


def whole_kernel(kernel: Kept) -> list[str | Path]:
    """What a linker takes of the kernel's folder for a library that nothing is left out of."""
    shared, whole = kernel.folder / _SHARED, kernel.folder / _WHOLE
    if shared.is_file() and _is_named_by_path(shared):
        return ["-Wl,--no-as-needed", shared]
    return [whole] if whole.is_file() else [*kernel_objects(kernel)]


def shared_kernel(kernel: Kept, linked: Sequence[str | Path]) -> str:
    """The path of the kernel that a library needs which is linked of `linked`; "": its own."""
    shared = kernel.folder / _SHARED
    return str(shared) if shared in linked else ""


def _is_named_by_path(shared: Path) -> bool:
    """Whether a library can need it by its path, in which a loader replaces `$` and a name."""
    return shared.is_absolute() and "$" not in str(shared)


def _compile_kernel(toolchain: Toolchain, folder: Path, made: Path, keeper: Keeper) -> None:
    """From its sources in `folder`; left in single objects by a compiler that cannot join them."""
    sources = kernel_sources(folder)
    objects = compile_objects(toolchain, sources, [folder], made, KERNEL_FLAGS, keeper)
    if not toolchain.joins:
        return
    target = made / _JOINED
    try:
        join_objects(toolchain, objects, target, keeper)
        target = made / _WHOLE
        merge_sections(toolchain, made / _JOINED, target, keeper)
        if sys.platform.startswith("linux"):
            target = made / _SHARED
            link_library(toolchain, [made / _WHOLE], target, keeper=keeper)
    except FrotError:
        target.unlink(missing_ok=True)


def _key_of_kernel(toolchain: Toolchain, folder: Path) -> str:
    joined = (_JOINED, _WHOLE, _SHARED) if toolchain.joins else ()
    return _key(toolchain, kernel_sources(folder), [folder], (*KERNEL_FLAGS, *joined))


@functools.cache
def _own_key(identity: Toolchain) -> str:
    """As for the key of a program, the kernel's sources are read once in a process."""
    return _key_of_kernel(identity, kernel_folder())


def only_seen(folder: Path, system: str = sys.platform) -> list[str]:
    """Words for the linker of a library for `system`, which is as small as it can be.

    No FMU lends its kernel to another in the same process, and none carries what it never calls. On
    Windows what FMI's headers export is seen, and nothing else, without a word.
    """
    if system == "win32":
        return ["-s", "-Wl,--gc-sections"]
    if system == "darwin":
        return ["-Wl,-exported_symbol,_fmi*", "-Wl,-dead_strip"]
    script = folder / "seen.map"
    script.write_text("{ global: fmi*; local: *; };\n", encoding="ascii")
    return ["-s", f"-Wl,--version-script={script}", "-Wl,--gc-sections"]
