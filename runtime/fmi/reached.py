"""Which C sources a library consists of: those that its first ones call, and what these call."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
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
    texts = {name: _read(PurePath(name).suffix, content) for name, content in sources.items()}
    definers: dict[bytes, list[str]] = {}
    for name, text in texts.items():
        for defined in text.defined:
            definers.setdefault(defined, []).append(name)
    found = set[str]()
    line = list(first)
    while line:
        name = line.pop()
        if name in found or name not in texts:
            continue
        found.add(name)
        line += texts[name].included
        for used in texts[name].used:
            line += definers.get(used, ())
    return tuple(name for name in sources if name in found)


# What a header declares: everything at its outermost level that ends without a body.
_DECLARATION = re.compile(rb"^(?!#|static\b)[a-z][^{}]*?;", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class _Text:
    """The headers that a text includes, the names that it defines as a `.c`, those it uses."""

    included: tuple[str, ...]
    defined: tuple[bytes, ...]
    used: tuple[bytes, ...]


# Most texts are the same in every FMU: a process that makes several reads them once.
@functools.lru_cache(maxsize=1024)
def _read(suffix: str, content: bytes) -> _Text:
    text = _COMMENT.sub(b"", content)
    body = _DECLARATION.sub(b"", text) if suffix == ".h" else text
    return _Text(
        tuple(one.decode() for one in _INCLUDE.findall(text)),
        tuple(_DEFINITION.findall(text)) if suffix == ".c" else (),
        tuple(dict.fromkeys(_NAME.findall(body))),
    )
