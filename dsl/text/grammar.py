"""The LALR tables of `frot.lark`: made once, when Frot is installed or by the first run."""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import shutil
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from frot.dsl.files.folders import cache_folder

if TYPE_CHECKING:
    from frot.dsl.text.lex import Lexer
    from lark import Lark

GRAMMAR = Path(__file__).with_name("frot.lark")
MADE = GRAMMAR.with_name("made")
OPTIONS = {
    "parser": "lalr",
    "lexer": "basic",
    "propagate_positions": True,
    "maybe_placeholders": False,
}


@cache
def grammar() -> Lark:
    """The parser tables: those made when Frot was installed, else in the cache if it can be."""
    import lark

    # Lark logs a traceback for an unreadable cache and then continues without it.
    lark.logger.setLevel(logging.CRITICAL + 1)
    text = GRAMMAR.read_text(encoding="utf-8")
    name = _name(text)
    with contextlib.suppress(OSError):
        if (MADE / name).is_file():
            return lark.Lark(text, cache=str(MADE / name), **OPTIONS)
        path = cache_folder() / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if os.access(path.parent, os.W_OK) or path.is_file():
            return lark.Lark(text, cache=str(path), **OPTIONS)
    return lark.Lark(text, **OPTIONS)


def make_tables(folder: Path) -> None:
    """Write the tables into a folder, alone, unless they are there; OSError if they cannot be."""
    import lark

    text = GRAMMAR.read_text(encoding="utf-8")
    path = folder / _name(text)
    if path.is_file():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    lark.Lark(text, cache=str(path), **OPTIONS)


def _name(text: str) -> str:
    """Of the file of a grammar's tables, by all that they are made from."""
    import lark

    key = hashlib.sha256(f"{lark.__version__}\n{sorted(OPTIONS.items())}\n{text}".encode())
    return f"grammar-{key.hexdigest()[:16]}.bin"


@cache
def lexer() -> Lexer:
    """The lexer of the grammar's terminals."""
    from frot.dsl.text.lex import Lexer

    return Lexer(grammar())
