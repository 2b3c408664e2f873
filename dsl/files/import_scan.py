"""Where libraries lie, and which files a text reads: found without the grammar.

`import Library.Name;` looks for `Library.frot`, which holds `package Library` or plain definitions,
or for a folder `Library` with `Name.frot`: beside the importing file, then around it where that
file lies in a folder `Library` itself, then among the libraries that come with Frot.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from frot.dsl.files.folders import room

SUFFIX = ".frot"


def member(folder: Path, name: str) -> Path | None:
    """The file, else the folder, of that name in a folder."""
    try:
        file = folder / f"{name}{SUFFIX}"
        if file.is_file():
            return file
        inner = folder / name
        return inner if inner.is_dir() else None
    except (OSError, ValueError):
        return None


def locate(head: str, importing: str) -> Path | None:
    """Where the library lies that a file names; `importing` is that file's name."""
    here = Path.cwd() if importing.startswith("<") else plain_path(importing).parent
    around = [folder.parent for folder in (here, *here.parents) if folder.name == head]
    for folder in (here, *around, installed()):
        found = member(folder, head)
        if found is not None:
            return found
    return None


def plain_path(name: str) -> Path:
    """The path of a file from the root, the same however its user goes there with `.` and `..`."""
    path = Path(name).absolute()
    plain = Path(os.path.normpath(path))
    # Behind a link to a folder `..` is not the folder written before it.
    same = plain.parent.exists() and plain.parent.samefile(path.parent)
    return plain if same else path


def installed() -> Path:
    """The folder of the libraries that come with Frot."""
    return room("frot.models")


# ------------------------------------------------------------------ what a text reads

# The library folder of a careless import could be a whole disk.
_MOST = 10_000
_SILENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\[^\n])*"', re.DOTALL)
_NAME = r"[^\W\d][\w\u0300-\u036f]*"
_IMPORT = re.compile(rf"\bimport\s+({_NAME}(?:\s*\.\s*{_NAME})*)")


def imported_files(text: str, name: str) -> list[Path]:
    """The files a text may read by its imports and theirs, found without the grammar."""
    found: dict[Path, None] = {}
    pending = [(text, name)]
    while pending:
        content, importing = pending.pop()
        for words in _paths(content):
            for path in _files(words, importing):
                if path in found:
                    continue
                found[path] = None
                try:
                    pending.append((path.read_text(encoding="utf-8", errors="replace"), str(path)))
                except OSError:
                    continue
    return sorted(found)


def _paths(text: str) -> Iterator[list[str]]:
    if "import" not in text:
        return
    for match in _IMPORT.finditer(_SILENT.sub(" ", unicodedata.normalize("NFC", text))):
        yield [word.strip() for word in match[1].split(".")]


def _files(words: list[str], importing: str) -> Iterator[Path]:
    path = locate(words[0], importing)
    for word in words[1:]:
        if path is None or path.is_file():
            break
        path = member(path, word)
    if path is not None:
        yield from islice(path.rglob(f"*{SUFFIX}"), _MOST) if path.is_dir() else [path]
