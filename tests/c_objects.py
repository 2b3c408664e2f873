"""C sources to objects, each compiled once: the same text with the same flags.

The kernel with its own flags is compiled already: these objects are the ones that programs link.
"""

from __future__ import annotations

import functools
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path

from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS, find_toolchain
from frot.compiler.toolchain.objects import kept_kernel, kernel_folder, kernel_sources
from frot.runtime.fmi.sources import flat
from made_once import made_once

# What tests under sanitizers compile with: all the same, so that the kernel is compiled once.
SANITIZED = (
    *("-std=c99", "-g1", "-O0", "-ffp-contract=off", "-fPIC"),
    *("-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
)

_INCLUDE = re.compile(rb'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def c_objects(sources: Sequence[Path], include: Sequence[Path], flags: Sequence[str]) -> list[Path]:
    """The objects of the sources; `cc` is called for those that no test has asked for."""
    return [_object(source, include, flags) for source in sources]


def _object(source: Path, include: Sequence[Path], flags: Sequence[str]) -> Path:
    texts = _with_headers(source, [source.parent, *include])
    if _flat(texts) == _kernel_texts().get(source.name):
        if tuple(flags) == KERNEL_FLAGS:
            return _kernel_objects() / f"{source.stem}.o"
        # That of an FMU is the one of the kernel, with other folders.
        source, include = _kernel_paths()[source.name], [kernel_folder()]
        texts = _with_headers(source, [source.parent, *include])
    key = repr((source.name, sorted(texts.items()), *flags))

    def fill(folder: Path) -> None:
        folders = [f"-I{folder}" for folder in include]
        command = ["cc", *flags, *folders, "-c", str(source), "-o", str(folder / "it.o")]
        subprocess.run(command, check=True)

    return made_once(key, fill) / "it.o"


@functools.cache
def _kernel_objects() -> Path:
    return kept_kernel(find_toolchain()).folder


@functools.cache
def _kernel_paths() -> dict[str, Path]:
    return {source.name: source for source in kernel_sources(kernel_folder())}


@functools.cache
def _kernel_texts() -> dict[str, dict[str, bytes]]:
    """Each source of the kernel with its headers, as in one flat folder."""
    folder = kernel_folder()
    return {
        source.name: _flat(_with_headers(source, [folder])) for source in kernel_sources(folder)
    }


def _flat(texts: dict[str, bytes]) -> dict[str, bytes]:
    """The same without folders: sources of an FMU lie in one."""
    return {Path(name).name: flat(text) for name, text in texts.items()}


def _with_headers(source: Path, folders: Sequence[Path]) -> dict[str, bytes]:
    """The source and all headers it reads from these folders, by name."""
    waiting, texts = [source.name], {source.name: source.read_bytes()}
    while waiting:
        for name in _included(texts[waiting.pop()]):
            path = next((f / name for f in folders if (f / name).is_file()), None)
            if path is not None and name not in texts:
                texts[name] = path.read_bytes()
                waiting.append(name)
    return texts


@functools.cache
def _included(text: bytes) -> tuple[str, ...]:
    return tuple(found.decode() for found in _INCLUDE.findall(text))
