"""C sources to objects, each compiled once in a session: the same text with the same flags."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Sequence
from pathlib import Path

from made_once import made_once

# What tests under sanitizers compile with: all the same, so that the kernel is compiled once.
SANITIZED = (
    *("-std=c99", "-g1", "-O0", "-ffp-contract=off"),
    *("-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
)

_INCLUDE = re.compile(rb'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def c_objects(sources: Sequence[Path], include: Sequence[Path], flags: Sequence[str]) -> list[Path]:
    """The objects of the sources; `cc` is called for those that no test has asked for."""
    return [_object(source, include, flags) for source in sources]


def _object(source: Path, include: Sequence[Path], flags: Sequence[str]) -> Path:
    texts = _with_headers(source, [source.parent, *include])
    key = repr((source.name, sorted(texts.items()), *flags))

    def fill(folder: Path) -> None:
        folders = [f"-I{folder}" for folder in include]
        command = ["cc", *flags, *folders, "-c", str(source), "-o", str(folder / "it.o")]
        subprocess.run(command, check=True)

    return made_once(key, fill) / "it.o"


def _with_headers(source: Path, folders: Sequence[Path]) -> dict[str, bytes]:
    """The source and all headers it reads from these folders, by name."""
    texts = {source.name: source.read_bytes()}
    waiting = [texts[source.name]]
    while waiting:
        for found in _INCLUDE.findall(waiting.pop()):
            name = found.decode()
            path = next((f / name for f in folders if (f / name).is_file()), None)
            if path is not None and name not in texts:
                texts[name] = path.read_bytes()
                waiting.append(texts[name])
    return texts
