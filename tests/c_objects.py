"""C sources to objects, each compiled once: the same text with the same flags.

The kernel with its own flags is compiled already: these objects are the ones that programs link.
"""

from __future__ import annotations

import functools
import re
import subprocess
from collections.abc import Callable, Sequence
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
    # Sources share most headers: each is looked for and read once.
    find = functools.cache(_find)
    return [_object(source, tuple(include), tuple(flags), find) for source in sources]


# The bytes of a header by its name, in the first of these folders that has it; None: in none.
_Find = Callable[[str, tuple[Path, ...]], bytes | None]


def _object(source: Path, include: tuple[Path, ...], flags: tuple[str, ...], find: _Find) -> Path:
    kernel = _kernel_paths().get(source.name)
    if source == kernel:
        return _kernel_object(source.name, flags)
    texts = _with_headers(source, include, find)
    # That of an FMU is the one of the kernel, with other folders.
    if kernel is not None and _flat(texts) == _kernel_texts()[source.name]:
        return _kernel_object(source.name, flags)
    return _compiled(source, texts, include, flags)


@functools.cache
def _kernel_object(name: str, flags: tuple[str, ...]) -> Path:
    """Of a source of the kernel, which stays as it is."""
    source, include = _kernel_paths()[name], (kernel_folder(),)
    if flags == KERNEL_FLAGS:
        return _kernel_objects() / f"{source.stem}.o"
    return _compiled(source, _kernel_headers()[name], include, flags)


def _compiled(
    source: Path, texts: dict[str, bytes], include: tuple[Path, ...], flags: tuple[str, ...]
) -> Path:
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
def _kernel_headers() -> dict[str, dict[str, bytes]]:
    """Each source of the kernel with its headers."""
    folder, find = kernel_folder(), functools.cache(_find)
    return {name: _with_headers(path, (folder,), find) for name, path in _kernel_paths().items()}


@functools.cache
def _kernel_texts() -> dict[str, dict[str, bytes]]:
    """The same as in one flat folder."""
    return {name: _flat(texts) for name, texts in _kernel_headers().items()}


def _flat(texts: dict[str, bytes]) -> dict[str, bytes]:
    """The same without folders: sources of an FMU lie in one."""
    return {Path(name).name: _flattened(text) for name, text in texts.items()}


_flattened = functools.cache(flat)


def _find(name: str, folders: tuple[Path, ...]) -> bytes | None:
    path = next((folder / name for folder in folders if (folder / name).is_file()), None)
    return None if path is None else path.read_bytes()


def _with_headers(source: Path, include: tuple[Path, ...], find: _Find) -> dict[str, bytes]:
    """The source and all headers that it reads, by name."""
    folders = (source.parent, *include)
    waiting, texts = [source.name], {source.name: source.read_bytes()}
    while waiting:
        for name in _included(texts[waiting.pop()]):
            content = find(name, folders)
            if content is not None and name not in texts:
                texts[name] = content
                waiting.append(name)
    return texts


@functools.cache
def _included(text: bytes) -> tuple[str, ...]:
    return tuple(found.decode() for found in _INCLUDE.findall(text))
