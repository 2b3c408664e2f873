"""Libraries of an FMU for other platforms than this machine, which `ziglang` compiles and links."""

from __future__ import annotations

import importlib.util
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from frot.compiler.toolchain.cache import Kept
from frot.compiler.toolchain.child_processes import Keeper
from frot.compiler.toolchain.compiler_choice import (
    KERNEL_FLAGS,
    ZIG_FLAGS,
    Toolchain,
    model_compiler,
    toolchain_of,
)
from frot.compiler.toolchain.compilers import (
    Job,
    link_library,
    model_jobs,
    run_compilers,
    words_for,
)
from frot.compiler.toolchain.objects import (
    kept_kernel,
    kept_objects,
    kernel_folder,
    kernel_objects,
    kernel_sources,
    only_seen,
)
from frot.dsl.files.folders import room
from frot.dsl.messages.errors import fail
from frot.runtime.fmi.platforms import NATIVE, own_platform
from frot.runtime.program import MODEL_SOURCE

# What a library lacks that is linked without the compiler's own: see the sources.
_QUAD, _WINDOWS = "binary128.c", "windows.c"
_NO_BUILTIN = "-fno-builtin"
# glibc of 2012, which every Linux in use has; macOS of 2020; Windows 10 with its C library.
_OF_WINDOWS = ("heap", "math", "stdio", "string", "convert", "time", "environment", "private")


@dataclass(frozen=True, slots=True)
class Target:
    """A platform: its name for `ziglang`, its system's for Python, libraries, further sources."""

    triple: str
    system: str
    libraries: tuple[str, ...]
    besides: tuple[str, ...] = ()


_LINUX = ("-lm", "-lc", "-Wl,-z,defs")
# Hidden functions are not seen.
_DARWIN = ("-lSystem", "-s", "-Wl,-dead_strip")
TARGETS: Mapping[str, Target] = {
    "x86_64-linux": Target("x86_64-linux-gnu.2.17", "linux", _LINUX, (_QUAD,)),
    "aarch64-linux": Target("aarch64-linux-gnu.2.17", "linux", _LINUX, (_QUAD,)),
    "x86_64-windows": Target(
        "x86_64-windows-gnu",
        "win32",
        tuple(f"-lapi-ms-win-crt-{part}-l1-1-0" for part in _OF_WINDOWS),
        (_QUAD, _WINDOWS),
    ),
    "x86_64-darwin": Target("x86_64-macos.11.0", "darwin", _DARWIN),
    "aarch64-darwin": Target("aarch64-macos.11.0", "darwin", _DARWIN),
}


def possible_platforms() -> tuple[str, ...]:
    """Those that libraries can be made for: all where `ziglang` is installed, else `native`."""
    return tuple(TARGETS) if _zig() is not None else (NATIVE,)


def _zig() -> Path | None:
    """The compiler of the package `ziglang`; run as a module it would take twice as long."""
    found = importlib.util.find_spec("ziglang")
    if found is None or not found.submodule_search_locations:
        return None
    path = Path(found.submodule_search_locations[0]) / ("zig.exe" if os.name == "nt" else "zig")
    return path if path.is_file() else None


def toolchain_for(target: Target, folder: Path) -> Toolchain:
    """The compiler for a platform, which keeps what it needs meanwhile in a folder.

    FrotError (E0801) if it is not installed.
    """
    zig = _zig()
    if zig is None:
        raise fail(
            "E0801",
            f"no compiler for {target.triple} was found",
            help="`pip install ziglang`, or export for the platform 'native'",
        )
    words = ("-target", target.triple, "-g0", "-fvisibility=hidden", *ZIG_FLAGS)
    made = toolchain_of((str(zig), "cc", *words, "-Wno-unused-command-line-argument"))
    caches = (("ZIG_GLOBAL_CACHE_DIR", str(folder)), ("ZIG_LOCAL_CACHE_DIR", str(folder)))
    return replace(made, environment=caches, joins=False)


@dataclass(frozen=True, slots=True)
class _Library:
    """One library on its way: who compiles it and the model, who links it, what is ready."""

    compiler: Toolchain
    models: Toolchain
    linker: Toolchain
    target: Target | None
    ready: tuple[Kept, ...]
    kernel: Kept
    folder: Path
    path: Path


def compile_libraries(
    toolchain: Toolchain,
    sources: Sequence[Path],
    include: Sequence[Path],
    libraries: Mapping[str, Path],
) -> None:
    """Compile the sources of an FMU to shared libraries of which only FMI's functions are seen.

    `libraries` are their paths by platform. That of this machine consists of the objects of
    `toolchain`, like the program's own, so that it gives the same bits.
    """
    from frot.runtime.fmi.sources import TABLE_SOURCE

    kernel = {source.name for source in kernel_sources(kernel_folder())}
    own = [source for source in sources if source.name in (MODEL_SOURCE, TABLE_SOURCE)]
    face = [source for source in sources if source not in own and source.name not in kernel]
    with tempfile.TemporaryDirectory(prefix="frot-") as name, Keeper(Path(name)) as keeper:
        begun = [
            _begin(toolchain, face, include, platform, path, Path(name))
            for platform, path in libraries.items()
        ]
        jobs = list[Job]()
        for one in begun:
            jobs += model_jobs(one.models, one.compiler, own, include, one.folder)
        run_compilers(jobs, keeper)
        for one in begun:
            _link(one, keeper)


def _begin(
    toolchain: Toolchain,
    face: Sequence[Path],
    include: Sequence[Path],
    platform: str,
    path: Path,
    room_for_all: Path,
) -> _Library:
    """With the objects that are the same for every model."""
    folder = room_for_all / platform
    folder.mkdir()
    own = platform == NATIVE or (platform == own_platform() and not _is_zig(toolchain))
    # A library for this Linux is to run on older ones too.
    target = None if own and not platform.endswith("linux") else TARGETS[platform]
    linker = toolchain if target is None else toolchain_for(target, room_for_all / "zig")
    compiler = toolchain if own else linker
    ready = [kept_objects(compiler, face, include, KERNEL_FLAGS)]
    if target is not None and target.besides:
        besides = [room("frot.compiler.toolchain") / name for name in target.besides]
        ready.append(kept_objects(linker, besides, [], (*KERNEL_FLAGS, _NO_BUILTIN)))
    models = model_compiler(toolchain) if own else linker
    kernel = kept_kernel(compiler)
    return _Library(compiler, models, linker, target, tuple(ready), kernel, folder, path)


def _is_zig(toolchain: Toolchain) -> bool:
    """Without a platform it makes use of what the processor of this machine alone may have."""
    return any(Path(word).stem in ("zig", "ziglang") for word in toolchain.command)


def _link(one: _Library, keeper: Keeper) -> None:
    objects = sorted(one.folder.glob("*.o"))
    objects += kernel_objects(one.kernel)
    for kept in one.ready:
        objects += sorted(kept.folder.glob("*.o"))
    if one.target is None:
        seen = only_seen(one.folder)
        words = [*seen, *words_for(one.models, one.linker)]
        link_library(one.linker, objects, one.path, words, keeper)
        return
    words = ["-nostdlib", *one.target.libraries]
    if one.target.system != "darwin":
        words += only_seen(one.folder, one.target.system)
    if one.target.system == "win32":
        words.append(f"-Wl,--out-implib={one.folder / 'unused.lib'}")
    link_library(one.linker, objects, one.path, words, keeper)
