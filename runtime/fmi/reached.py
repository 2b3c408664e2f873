"""Which C sources a library consists of: those that its first ones call, and what these call."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePath

_COMMENT = re.compile(rb"/\*.*?\*/", re.DOTALL)
_NAME = re.compile(rb"\bfrot_\w+")
_INCLUDE = re.compile(rb'^#include "(?:[a-z_]+/)*(\w+\.[ch])"', re.MULTILINE)
# A definition that other files see: it begins a line, with its type.
_DEFINITION = re.compile(
    rb"^(?!static\b|typedef\b|extern\b)[a-z]\w*[\w *]*?\b(frot_\w+)(?:\([^;{]*\)\s*\{|[][\w]*\s*=)",
    re.MULTILINE,
)


def reached(sources: Mapping[str, bytes], first: Iterable[str]) -> tuple[str, ...]:
    """The names among `sources`, in their order, of `first` and of all that these reach.

    `sources` are C files by name, without folders. A `.c` reaches the headers that it includes, as
    a header does, and the `.c` that define a function or table `frot_...` that its text names. The
    text of a header reaches what it defines, an inline function or a macro, not what it declares.
    """
    texts = {name: _COMMENT.sub(b"", content) for name, content in sources.items()}
    definers = _definers(texts)
    found = set[str]()
    line = list(first)
    while line:
        name = line.pop()
        if name in found or name not in texts:
            continue
        found.add(name)
        line += (one.decode() for one in _INCLUDE.findall(texts[name]))
        for used in _NAME.findall(_body(name, texts[name])):
            line += definers.get(used, ())
    return tuple(name for name in sources if name in found)


def _definers(texts: Mapping[str, bytes]) -> dict[bytes, Sequence[str]]:
    """The `.c` that define each name."""
    found: dict[bytes, list[str]] = {}
    for name, text in texts.items():
        if PurePath(name).suffix == ".c":
            for defined in _DEFINITION.findall(text):
                found.setdefault(defined, []).append(name)
    return {name: tuple(files) for name, files in found.items()}


# What a header declares: everything at its outermost level that ends without a body.
_DECLARATION = re.compile(rb"^(?!#|static\b)[a-z][^{}]*?;", re.MULTILINE)


def _body(name: str, text: bytes) -> bytes:
    return _DECLARATION.sub(b"", text) if PurePath(name).suffix == ".h" else text
